"use strict";
(() => {
  const form = document.getElementById("filter");
  const output = form.querySelector("output");
  const groups = [...document.querySelectorAll("details.group")].map((group) => ({
    group,
    open: group.open,
    cases: [...group.querySelectorAll(".case")].map((element) => ({
      element,
      verdicts: element.dataset.verdict.split(" "),
      areas: element.dataset.areas.split(" "),
      text: null,
    })),
  }));
  const checked = (name) => [...form.querySelectorAll(`[name=${name}]:checked`)].map((box) => box.value);
  const any = (wanted, has) => wanted.length === 0 || wanted.some((one) => has.includes(one));
  const filter = () => {
    const words = form.elements.text.value.toLowerCase().split(/\s+/).filter(Boolean);
    const verdicts = checked("verdict");
    const areas = checked("area");
    const active = words.length + verdicts.length + areas.length > 0;
    let shown = 0;
    let all = 0;
    for (const { group, open, cases } of groups) {
      let here = 0;
      for (const one of cases) {
        if (words.length > 0 && one.text === null) {
          one.text = one.element.textContent.toLowerCase().replace(/\s+/g, " ");
        }
        const fits = any(verdicts, one.verdicts) && any(areas, one.areas)
          && words.every((word) => one.text.includes(word));
        one.element.hidden = !fits;
        here += fits ? 1 : 0;
      }
      shown += here;
      all += cases.length;
      group.hidden = here === 0;
      group.open = active ? here > 0 : open;
    }
    for (const subject of document.querySelectorAll(".subject")) {
      subject.hidden = !subject.querySelector(".group:not([hidden])");
    }
    output.textContent = active ? `${shown} of ${all} cases` : `${all} cases`;
  };
  form.addEventListener("input", filter);
  form.addEventListener("reset", () => setTimeout(filter));
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
  filter();
})();
