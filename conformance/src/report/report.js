"use strict";
(() => {
  const form = document.getElementById("filter");
  const output = form.querySelector("output");
  const groups = [...document.querySelectorAll("details.group")].map((group) => ({
    group,
    open: group.open,
    rest: group.querySelector("details.rest"),
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
    for (const { group, open, rest, cases } of groups) {
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
      if (rest) {
        rest.open = active;
        rest.hidden = active && !rest.querySelector(".case:not([hidden])");
      }
    }
    for (const subject of document.querySelectorAll(".subject")) {
      subject.hidden = !subject.querySelector(".group:not([hidden])");
    }
    const cases = `${all} case${all === 1 ? "" : "s"}`;
    output.textContent = active ? `${shown} of ${cases}` : cases;
  };
  // The fragment of the URL contains the filter, so that a link can share the filtered view.
  const remember = () => {
    const wanted = new URLSearchParams();
    for (const [name, value] of new FormData(form)) {
      if (value) {
        wanted.append(name, value);
      }
    }
    const hash = wanted.toString();
    history.replaceState(null, "", hash ? `#${hash}` : location.pathname + location.search);
  };
  const follow = () => {
    const hash = location.hash.slice(1);
    if (hash.includes("=")) {
      const wanted = new URLSearchParams(hash);
      form.elements.text.value = wanted.get("text") ?? "";
      for (const box of form.querySelectorAll("[type=checkbox]")) {
        box.checked = wanted.getAll(box.name).includes(box.value);
      }
      filter();
      form.scrollIntoView();
      return;
    }
    const target = hash && document.getElementById(decodeURIComponent(hash));
    if (!target) {
      return;
    }
    if (target.closest("[hidden]")) {
      form.reset();
      filter();
    }
    for (let part = target.parentElement; part; part = part.parentElement) {
      if (part.tagName === "DETAILS") {
        part.open = true;
      }
    }
    target.scrollIntoView();
  };
  // Open the profile for printing.
  window.addEventListener("beforeprint", () => {
    for (const details of document.querySelectorAll("header .facts details")) {
      details.open = true;
    }
  });
  const changed = () => {
    filter();
    remember();
  };
  form.addEventListener("input", changed);
  form.addEventListener("reset", () => setTimeout(changed));
  window.addEventListener("hashchange", follow);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
  filter();
  follow();
})();
