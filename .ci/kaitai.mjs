// Compiles the Kaitai Struct description of the streams, and reads golden vectors with the reader in
// JavaScript.
//
//     node kaitai.mjs compile FOLDER               makes FOLDER/ads_cnc.py and FOLDER/AdsCnc.js from
//                                                  FOLDER/ads_cnc.ksy
//     node kaitai.mjs read FOLDER VECTORS.json …   prints the fields that the reader finds, by vector ID
import { createRequire } from "node:module";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [action, folder, ...files] = process.argv.slice(2);
const require = createRequire(join(folder, "here.js"));

if (action === "compile") {
  const compiler = require("kaitai-struct-compiler");
  const description = require("yaml").parse(readFileSync(join(folder, "ads_cnc.ksy"), "utf8"));
  for (const language of ["python", "javascript"]) {
    const made = await compiler.compile(language, description, null, false);
    for (const [name, text] of Object.entries(made)) writeFileSync(join(folder, name), text);
  }
} else {
  const { AdsCnc } = require("./AdsCnc.js");
  const { KaitaiStream } = require("kaitai-struct");
  const camel = (name) => name.replace(/_(.)/g, (_, letter) => letter.toUpperCase());
  const plain = (value) => {
    // JSON cannot represent NaN, infinity and -0, so these values are printed as their bytes.
    if (Object.is(value, -0) || (typeof value === "number" && !Number.isFinite(value))) {
      return plain(new Uint8Array(Float64Array.of(value).buffer));
    }
    if (value instanceof Uint8Array) return { hex: Buffer.from(value).toString("hex") };
    if (Array.isArray(value)) return value.map(plain);
    if (value === null || typeof value !== "object") return value;
    const own = Object.entries(value).filter(([key, one]) => !key.startsWith("_") && one !== undefined);
    return Object.fromEntries(own.map(([key, one]) => [key, plain(one)]));
  };
  const found = {};
  for (const file of files) {
    for (const vector of JSON.parse(readFileSync(file, "utf8")).vectors) {
      const name = camel("_" + vector.stream.replaceAll("-", "_"));
      if (!AdsCnc[name]) continue;
      const bytes = Buffer.from(vector.segments.map((one) => one.hex.replaceAll(" ", "")).join(""), "hex");
      const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
      try {
        found[vector.id] = plain(new AdsCnc[name](new KaitaiStream(buffer)));
      } catch (error) {
        found[vector.id] = String(error);
      }
    }
  }
  console.log(JSON.stringify(found));
}
