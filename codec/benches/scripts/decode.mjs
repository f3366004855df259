// A typical client in JavaScript: Node's Buffer on the bytes of a reply. Prints nanoseconds per record.

import { strict as assert } from "node:assert";
import { readFileSync } from "node:fs";
import { join } from "node:path";

const TURNS = 15;
const cp1252 = new TextDecoder("windows-1252");

function text(bytes) {
  const end = bytes.indexOf(0);
  return cp1252.decode(end < 0 ? bytes : bytes.subarray(0, end));
}

function descriptors(data) {
  if (data.length === 0 || data.length % 84 !== 0) throw new Error("not a list of descriptors");
  const objects = [];
  for (let at = 0; at < data.length; at += 84) {
    objects.push({
      id: data.readUInt32LE(at),
      size: data.readUInt32LE(at + 4),
      writable: data.readUInt16LE(at + 8) !== 0,
      group: data.readUInt32LE(at + 12),
      offset: data.readUInt32LE(at + 16),
      name: text(data.subarray(at + 20, at + 52)),
      type: text(data.subarray(at + 52, at + 84)),
    });
  }
  return objects;
}

function description(data) {
  if (data.length < 21) throw new Error("truncated");
  const count = data.readUInt32LE(16);
  if (count > (data.length - 21) >> 2) throw new Error("too many dimensions");
  const dimensions = [];
  for (let at = 0; at < count; at++) dimensions.push(data.readUInt32LE(20 + 4 * at));
  return {
    handle: data.readUInt32LE(0),
    type: data.readUInt32LE(4),
    access: data.readUInt32LE(8),
    size: data.readUInt32LE(12),
    dimensions,
    name: text(data.subarray(20 + 4 * count)),
  };
}

function show(what, go, records) {
  const turns = [];
  for (let turn = 0; turn < TURNS; turn++) {
    const start = process.hrtime.bigint();
    go();
    turns.push(Number(process.hrtime.bigint() - start) / records);
  }
  turns.sort((a, b) => a - b);
  console.log(`${what}\t${turns[TURNS >> 1]}`);
}

const folder = process.argv[2];
const data = readFileSync(join(folder, "descriptors.bin"));
const everything = readFileSync(join(folder, "descriptions.bin"));
const each = [];
for (let at = 0; at < everything.length; ) {
  const length = everything.readUInt32LE(at);
  each.push(everything.subarray(at + 4, at + 4 + length));
  at += 4 + length;
}
const objects = descriptors(data);
assert.equal(objects.length, 10000);
assert.deepEqual([objects[9999].offset, objects[9999].name], [10000, "gdb[0].object_9999"]);
const last = description(each[9999]);
assert.deepEqual([last.size, last.dimensions, last.name], [60, [3, 5], "V.E.Array_9999"]);
show("descriptors", () => descriptors(data), objects.length);
show("descriptions", () => each.map(description), each.length);
