// A testee for Node 18 or later, without packages: reads cases from stdin, one JSON object per line, and
// answers on stdout (see ../README.md). To test your own codec, replace decode() and encode().
import { isDeepStrictEqual } from "node:util";

// An answer other than a value or bytes is thrown as an error.
const end = (answer) => { throw Object.assign(new Error(JSON.stringify(answer)), { answer }); };
const must = (condition, kind, at) => condition || end({ reject: { class: kind, at } });
const support = (condition, what) => condition || end({ unsupported: { what } });

const readerOf = (bytes) => ({
  bytes, at: 0,
  get left() { return bytes.length - this.at; },
  take(count = this.left) {
    must(count <= this.left, "truncated", this.at);
    return bytes.subarray(this.at, (this.at += count));
  },
});

const hex = (bytes) => bytes.toString("hex").replace(/..(?=.)/g, "$& ");
function unhex(text) {
  const digits = text.replaceAll(" ", "");
  const bytes = Buffer.from(digits, "hex"); // stops without an error at an invalid digit
  if (bytes.length * 2 !== digits.length) throw new TypeError("no hex");
  return bytes;
}

// A codec is a pair: get(reader, context) returns a value, put(value, context) returns bytes. No put checks
// the limits of lengths, because encode() decodes its result again. A value contains its type, so write() encodes
// all values except records. Values omit readable forms: a float has only `bits`, a text has only `hex`.
const codec = (get, put = write) => ({ get, put });

const TYPES = new Map(Object.entries({
  unsigned1: "BOOLEAN UNS08 BOOL BYTE", unsigned2: "UNS16 WORD", unsigned4: "UNS32 DWORD", unsigned8: "LWORD",
  signed1: "SGN08 SINT", signed2: "SGN16 INT", signed4: "SGN32 DINT", signed8: "LINT",
  float4: "REAL32 REAL", float8: "REAL64 LREAL",
}).flatMap(([form, names]) => names.split(" ").map((name) => [name, { form: form.slice(0, -1), size: +form.at(-1) }])));
const fit = (form, size, whole) => (form === "signed" ? BigInt.asIntN : BigInt.asUintN)(size * 8, whole);

const number = (type) => codec((reader) => {
  const { form, size } = TYPES.get(type);
  const bits = "0x" + Buffer.from(reader.take(size)).reverse().toString("hex"); // least significant byte first
  // Keep the bits of a float: a conversion to a JavaScript number may change the payload of a NaN.
  return form === "float" ? { type, bits } : as(type, fit(form, size, BigInt(bits)));
});
function write(value) {
  if (Array.isArray(value)) return Buffer.concat(value.map(write));
  const { type } = value;
  if (type === "BYTES") return unhex(value.hex);
  if (type === "NETID") return Buffer.from(value.value.split("."));
  if (type === "STRING")
    return Buffer.concat([unhex(value.hex), Buffer.alloc(value.open ? 0 : 1), unhex(value.tail ?? "")]);
  const { form, size } = must(TYPES.get(type), "unexpected");
  const digits = form === "float" ? value.bits : value.value;
  must(/^(0x[0-9a-f]+|-?[0-9]+)$/.test(digits), "unexpected");
  const whole = BigInt(digits); // a Number would round integers of more than 53 bits
  must(fit(form, size, whole) === whole, "out-of-range");
  return Buffer.from(fit("unsigned", size, whole).toString(16).padStart(size * 2, "0"), "hex").reverse();
}

const [uns08, uns16, uns32, boolean, real64] = ["UNS08", "UNS16", "UNS32", "BOOLEAN", "REAL64"].map(number);
const as = (type, value) => ({ type, value: String(value) });
const netId = codec((reader) => as("NETID", reader.take(6).join(".")));
const notZero = codec((reader) => must(reader.bytes.some(Boolean), "out-of-range", 0) && uns32.get(reader));
const widths = { 1: uns08, 2: uns16, 4: uns32 }; // the size of the stream is the size of the number
const anyUnsigned = codec((reader) => must(widths[reader.left], "bad-length", 0).get(reader));

function readText(bytes) {
  const nul = bytes.indexOf(0);
  if (nul < 0) return { type: "STRING", hex: hex(bytes), open: true };
  const tail = bytes.subarray(nul + 1);
  return { type: "STRING", hex: hex(bytes.subarray(0, nul)), ...(tail.length > 0 && { tail: hex(tail) }) };
}
const onlyNuls = (tail = "") => /^[0 ]*$/.test(tail);

// A field that contains the rest of the stream, from `least` to `most` bytes
const rest = (least, most, read, put) => codec((reader) => {
  must(reader.left >= least, "truncated", reader.at);
  must(reader.left <= most, "too-long", reader.at + most);
  return read(reader.take());
}, put);
const bytes = (least, most) => rest(least, most, (all) => ({ type: "BYTES", hex: hex(all) }));
const text = (least, most) => rest(least, most, readText);
// The text of a request: only NULs may follow its NUL. `mayLack` returns whether the NUL may be missing.
const request = (least, most, mayLack = () => false) => rest(least, most, (all) => {
  const value = readText(all);
  must(!value.open || mayLack(all), "missing-nul");
  must(onlyNuls(value.tail), "trailing");
  return value;
});
const text32 = codec((reader) => { // STRING(32) of a descriptor, padded with NULs
  const { tail, ...value } = readText(reader.take(32));
  return onlyNuls(tail) ? value : { ...value, tail };
}, (value) => (value.open || value.tail ? write(value) : Buffer.concat([write(value), Buffer.alloc(32)], 32)));
const textBefore = codec((reader) => { // the name before a value ends with its first NUL
  const nul = reader.bytes.subarray(reader.at, reader.at + 256).indexOf(0);
  must(nul >= 0, reader.left < 256 ? "missing-nul" : "too-long", reader.at);
  return readText(reader.take(nul + 1));
});

const record = (fields, most = Infinity) => codec((reader, context) => {
  must(reader.left <= most, "too-long", most);
  return Object.fromEntries(Object.entries(fields).map(([name, field]) => [name, field.get(reader, context)]));
}, (value, context) => Buffer.concat(Object.entries(fields).map(([name, { put }]) => put(value[name], context))));
const counted = codec((reader) => {
  const count = reader.take(4).readUInt32LE();
  must(count * 4 <= reader.left, "too-many", reader.at - 4); // check this before allocating the list
  return Array.from({ length: count }, () => uns32.get(reader));
}, (list) => write([as("UNS32", list.length), list]));
const measured = codec((reader) => ({ type: "BYTES", hex: hex(reader.take(reader.take(4).readUInt32LE())) }),
  (value) => write([as("UNS32", write(value).length), value]));

const typed = codec((reader, { type, dimensions }) => {
  support(Array.isArray(dimensions) && (type === "STRING" || TYPES.has(type)), "context");
  const count = dimensions.reduce((product, dimension) => product * dimension, 1);
  const size = TYPES.get(type)?.size ?? Math.floor(reader.left / Math.max(count, 1)); // all texts have the same size
  must(count * size === reader.left && (size > 0 || count < 2), "bad-length", reader.at);
  return Array.from({ length: count }, () => TYPES.has(type) ? number(type).get(reader) : readText(reader.take(size)));
});
const content = codec((reader, context) => (context.type ? typed : bytes(0, Infinity)).get(reader, context));

const descriptor = record({ id: uns32, size: uns32, write_access: uns16, not_assigned: uns16,
  index_group: uns32, index_offset: uns32, name: text32, type: text32 });
const descriptors = codec((reader) => {
  must(reader.left > 0 && reader.left % 84 === 0, "bad-length", reader.left - (reader.left % 84));
  return Array.from({ length: reader.left / 84 }, () => descriptor.get(reader));
}, (list) => Buffer.concat(list.map((value) => descriptor.put(value))));

const CLASSES = ["position-controller", "interpolator", "decoder", "hld", "path-preparation", "spindle"];
const ATTRIBUTES = ["content", "name", "type", "length", "unit", "write-flag", "object-address"]; // tables 3 to 9
function wordsOf(group) {
  const [high, kind, table] = [group >>> 16, (group >>> 12) & 15, (group >>> 8) & 15];
  const [access, addressing] = [{ 2: "element", 3: "object" }[high & ~16], high & 16 ? "logical" : "index"];
  if (access && kind === 0 && (table === 1 || table === 2))
    return { task: "COM", access, addressing, table: table === 1 ? "channel" : "axis" };
  const own = { class: CLASSES[kind], attribute: ATTRIBUTES[table - 3] };
  if (access !== "element" || !own.class || !own.attribute) return {};
  return own.class === "spindle" && addressing === "logical" ? {} : { task: "SDA/GEO", access, addressing, ...own };
}
const indexGroup = codec((reader, { base }) => {
  const group = reader.take(4).readUInt32LE();
  // The number of the channel, axis or spindle is added to the base, and must change only its lowest byte.
  must(base === undefined || (group >= Number(base) && group >>> 8 === Number(base) >>> 8), "out-of-range", 0);
  const words = Object.entries(wordsOf(group)).map(([key, word]) => [key, as("NAME", word)]);
  if (words.length > 0) words.push(["instance", as("UNS08", group & 255)]);
  return { index_group: as("UNS32", group), ...Object.fromEntries(words) };
}, (value) => write(value.index_group));

const strideOf = ({ stride }) => support(["0x10000", "0x1000"].includes(stride), "context") && Number(stride);
const indexOffset = codec((reader, context) => {
  const [offset, stride] = [reader.take(4).readUInt32LE(), strideOf(context)];
  must(offset / stride < 65536, "out-of-range", 0);
  return { axis: as("UNS16", Math.floor(offset / stride)), element: as("UNS16", offset % stride) };
}, ({ axis, element }, context) => write(as("UNS32", axis.value * strideOf(context) + Number(element.value))));

const PATH = /^(V\.[^\0.[\]]+)((?:\.[^\0.[\]]+(?:\[[0-9]+\])*)+)$/;
const PARTS = /\.([^\0.[\]]+)((?:\[[0-9]+\])*)/g;
const open = (latin1) => ({ type: "STRING", hex: hex(Buffer.from(latin1, "latin1")), open: true });
const variablePath = rest(1, 255, (all) => {
  const [, kind, parts] = must(PATH.exec(all.toString("latin1")), "unexpected");
  const index = (digits) => must(digits <= 4294967294, "out-of-range") && as("UNS32", BigInt(digits));
  const part = ([, name, indices]) => ({ name: open(name), indices: (indices.match(/[0-9]+/g) ?? []).map(index) });
  return { kind: open(kind), parts: Array.from(parts.matchAll(PARTS), part) };
}, ({ kind, parts }) => Buffer.concat([kind, ...parts.flatMap(({ name, indices }) =>
  [open("."), name, ...indices.map(({ value }) => open(`[${value}]`))])].map(write)));

const address = { index_group: uns32, index_offset: uns32 };
const wholeReply = record({ result: uns32, data: measured });
const dataReply = codec((reader) => { // an error reply may end after its result
  const failed = reader.left === 4 && reader.bytes.readUInt32LE(reader.at) !== 0;
  return failed ? { result: uns32.get(reader) } : wholeReply.get(reader);
}, (value) => (value.data ? wholeReply.put(value) : write(value.result)));
const SERVICES = { // by command and state flags
  "2 4": ["read_request", record({ ...address, length: uns32 })], "2 5": ["read_reply", dataReply],
  "3 4": ["write_request", record({ ...address, data: measured })], "3 5": ["write_reply", record({ result: uns32 })],
  "9 4": ["read_write_request", record({ ...address, read_length: uns32, data: measured })],
  "9 5": ["read_write_reply", dataReply],
};
const serviceOf = ({ command, state_flags }) =>
  SERVICES[`${command.value} ${state_flags.value}`] ?? ["data", bytes(0, Infinity)];
const tcpHeader = record({ reserved: uns16, length: uns32 });
const amsHeader = record({ target_net_id: netId, target_port: uns16, source_net_id: netId, source_port: uns16,
  command: uns16, state_flags: uns16, data_length: uns32, error: uns32, invoke_id: uns32 });
const frame = codec((reader) => {
  const { length, ...ams_tcp_header } = tcpHeader.get(reader);
  const { data_length, ...ams_header } = amsHeader.get(reader);
  must(ams_tcp_header.reserved.value === "0", "mismatch", 0);
  must(length.value - 32 === Number(data_length.value), "mismatch", 2);
  must(reader.left === Number(data_length.value), "truncated", 38);
  if (reader.left === 0 && ams_header.error.value !== "0") return { ams_tcp_header, ams_header };
  const [name, service] = serviceOf(ams_header);
  return { ams_tcp_header, ams_header, [name]: service.get(reader) };
}, ({ ams_tcp_header, ams_header, ...services }) => {
  const [name, service] = serviceOf(ams_header);
  const body = services[name] ? service.put(services[name]) : Buffer.of();
  return Buffer.concat([tcpHeader.put({ ...ams_tcp_header, length: as("UNS32", 32 + body.length) }),
    amsHeader.put({ ...ams_header, data_length: as("UNS32", body.length) }), body]);
});

const [count, extended] = [record({ count: uns32 }), record({ synchronisation: uns32, validity: uns32 })];
const description = { handle: uns32, type: uns32, access: uns32, size: uns32, dimensions: counted };
const STREAMS = new Map(Object.entries({
  "ams-tcp-header": tcpHeader, "ams-header": amsHeader, "ams-frame": frame,
  ...Object.fromEntries(Object.values(SERVICES).map(([name, service]) => [name.replaceAll("_", "-"), service])),
  "object-count": count, "element-count": count, "dynamic-count": count, "variable-count": count,
  "object-descriptor": descriptor, "object-descriptors": record({ descriptors }),
  "content": record({ content }, 4194304), "object-address": record(address),
  "object-address-query": record({ channel: uns32, axis: uns32 }),
  "element-text": record({ text: text(0, 256) }), "element-length": record({ length: anyUnsigned }),
  "element-write-flag": record({ flag: boolean }), "dynamic-index": record({ index: notZero }),
  "dynamic-value": record({ value: real64 }), "dynamic-name": record({ name: text(1, 96) }),
  "dynamic-name-request": record({ name: request(1, 96, () => true) }),
  "variable-kind": record({ kind: request(0, 256, (all) => all.length === 0) }),
  "variable-index-kind": record({ index: uns32, kind: request(1, 256) }),
  "variable-description": record({ ...description, name: text(1, 256) }, 2048),
  "variable-description-by-name": record(description, 2048),
  "variable-name": record({ name: request(1, 256) }), "variable-path": variablePath,
  "variable-value": record({ value: typed }, 2048), "variable-handle": record({ handle: uns32 }),
  "variable-handle-read": record({ handle: uns32, indices: counted }, 2048),
  "variable-handle-write": record({ handle: uns32, indices: counted, value: typed }, 2048),
  "variable-name-write": record({ name: textBefore, value: typed }, 2048),
  "variable-extended-description": codec((reader) => (reader.left > 0 ? extended.get(reader) : {}),
    (value) => (Object.keys(value).length > 0 ? extended.put(value) : Buffer.of())),
  "program-stream": record({ data: bytes(1, 992) }), "index-group": indexGroup, "index-offset": indexOffset,
}));

function essence(value) { // the exact value without readable forms, to be compared
  if (Array.isArray(value)) return value.map(essence);
  must(typeof value === "object", "unexpected");
  if (typeof value.type !== "string") // a record, which may have a field called `type`
    return Object.fromEntries(Object.entries(value).map(([name, field]) => [name, essence(field)]));
  const { type, bits, hex, tail, open } = value;
  return [type, bits ?? (hex === undefined ? value.value : unhex(hex)), unhex(tail ?? ""), open ?? false];
}

function decode({ get }, bytes, context) {
  const reader = readerOf(bytes);
  const value = get(reader, context);
  return must(reader.left === 0, "trailing", reader.at) && value;
}
function encode(codec, value, context) {
  const bytes = codec.put(value, context);
  return must(isDeepStrictEqual(essence(decode(codec, bytes, context)), essence(value)), "mismatch") && bytes;
}

function packets(text) { // each has as many whole lines as fit; LF, CR LF or CR ends a line
  const lines = text.toString("latin1").split(/\r\n|[\r\n]/);
  if (lines.at(-1) === "") lines.pop();
  const packets = [];
  for (const line of lines) {
    must(/^[\x01-\x7f]{0,990}$/.test(line), line.length > 990 ? "too-long" : "not-ascii");
    if (packets.length === 0 || packets.at(-1).length + line.length > 990) packets.push("");
    packets[packets.length - 1] += `${line}\r\n`;
  }
  return packets.map((packet) => Buffer.from(packet).toString("hex"));
}

const OPS = {
  decode: (stream, context, { hex }) => ({ value: decode(stream, unhex(hex), context) }),
  encode: (stream, context, { value }) => ({ hex: encode(stream, value, context).toString("hex") }),
  packets: (stream, context, { hex }) => ({ packets: packets(unhex(hex)) }),
};
const EDITIONS = ["en-1.05", "de-1.051"]; // the streams do not depend on the edition
const testee = { name: "javascript-adapter", version: "1.0.0", language: "JavaScript" };
const capabilities = { ops: Object.keys(OPS), streams: [...STREAMS.keys()], editions: EDITIONS };

function answer(line) {
  let asked = null;
  try {
    asked = JSON.parse(line);
    const { cmd, seq, op, stream, edition, context = {} } = asked;
    if (cmd === "hello" || cmd === "bye") return cmd === "hello" ? { protocol: 1, testee, capabilities } : null;
    if (cmd !== "case") throw new Error(`unknown command ${cmd}`);
    support(Object.hasOwn(OPS, op), "op");
    support(op === "packets" ? stream === "nc-text" : STREAMS.has(stream), "stream");
    support(EDITIONS.includes(edition), "edition");
    return { seq, ok: OPS[op](STREAMS.get(stream), context, asked) };
  } catch (error) {
    const shape = error instanceof TypeError && asked?.op === "encode"; // put() failed at the value
    const other = shape ? { reject: { class: "unexpected" } } : { error: { message: String(error) } };
    return { seq: asked?.seq ?? null, ...(error.answer ?? other) };
  }
}

async function* lines(input) { // not readline, which also splits at U+2028, which JSON texts may contain
  let pieces = [];
  for await (const chunk of input) {
    let start = 0;
    for (let end; (end = chunk.indexOf("\n", start)) >= 0; start = end + 1) {
      yield Buffer.concat([...pieces, chunk.subarray(start, end)]).toString();
      pieces = [];
    }
    pieces.push(chunk.subarray(start));
  }
}

for await (const line of lines(process.stdin)) {
  const reply = answer(line);
  if (!reply) break;
  await new Promise((sent) => process.stdout.write(JSON.stringify(reply) + "\n", sent));
}
