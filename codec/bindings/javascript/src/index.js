// A codec for the byte streams that read and write an ISG/TwinCAT CNC over ADS. The codec is WebAssembly;
// ads_cnc.h documents its functions. The build puts the constant WASM_BASE64 before this file, and the functions
// of the CNC after it.

const ABI = 2,
  NONE = 0xffffffff;
const wasm = Uint8Array.from(atob(WASM_BASE64), (letter) => letter.charCodeAt(0));
const compiled = new WebAssembly.Module(wasm);

/** A new instance of the codec with memory of its own. `base` is the start of its scratch memory, which is after the
 * memory of the codec. Each call reuses the scratch memory from its start, so nothing has to be freed. */
function instance() {
  const { exports } = new WebAssembly.Instance(compiled, {});
  return { codec: exports, base: exports.memory.buffer.byteLength };
}

// The instance that all functions below use. A state machine replaces it by its own instance during a call.
let { codec, base } = instance();
if (codec.ads_cnc_abi() !== ABI)
  throw new Error(`the WebAssembly module has ABI ${codec.ads_cnc_abi()}, but this package needs ${ABI}`);

// The end of the scratch memory in use.
let top = base;

function room(size) {
  const at = (top + 7) & ~7;
  top = at + size;
  const missing = top - codec.memory.buffer.byteLength;
  if (missing > 0) codec.memory.grow(Math.ceil(missing / 65536));
  return at;
}

const view = () => new DataView(codec.memory.buffer);
const u32 = (at) => view().getUint32(at, true);
const bytes = (at, size) => new Uint8Array(codec.memory.buffer, at, size);
const taken = (at, size) => bytes(at, size).slice();
const numbers = (at, count) => {
  const memory = view();
  return Array.from({ length: count }, (_, n) => memory.getUint32(at + 4 * n, true));
};

/** Checks that data is bytes. An ArrayBuffer, for example, has no `length`, and would corrupt the scratch memory. */
function checked(data) {
  if (data instanceof Uint8Array) return data;
  throw new TypeError(`Uint8Array expected, found ${data?.constructor?.name ?? data}`);
}

const wrong = (name, expected, value) =>
  new TypeError(`${name}: ${expected} expected, found ${String(value)} (${typeof value})`);

/** Copies an array. Without the check, Array.from would return an empty array for a number or another object. */
function listed(name, value) {
  if (typeof value !== 'object' || typeof value?.length !== 'number') throw wrong(name, 'array', value);
  return Array.from(value);
}

/** Checks a number of the caller, because WebAssembly and DataView wrap or truncate a number that does not fit. */
function unsigned(name, value, bits = 32) {
  if (typeof value !== 'number') throw wrong(name, 'number', value);
  if (Number.isInteger(value) && value >= 0 && value < 2 ** bits) return value;
  throw new RangeError(`${name}: ${value} is not an unsigned number of ${bits} bits`);
}

/** Copies data to the scratch memory; returns the address, which is not null even if the data is empty. */
function put(data) {
  const at = room(checked(data).length + 1);
  bytes(at, data.length).set(data);
  return at;
}

/** Like `put`, for checked numbers in an array: the number of arguments of a function is limited. */
function putNumbers(all) {
  const at = room(4 * all.length),
    memory = view();
  all.forEach((number, n) => memory.setUint32(at + 4 * n, number, true));
  return at;
}

/** A copy of the bytes to which the AdsCncBytes at this address points. */
const lent = (at) => taken(u32(at), u32(at + 4));
const word = (at) => new TextDecoder().decode(lent(at));

/** The error for invalid bytes or values. */
export class AdsCncError extends Error {
  constructor(at) {
    const [, , , offset, expected, found] = numbers(at, 6);
    const [stream, field, kind] = [24, 32, 40].map((part) => word(at + part));
    const place = [stream, field].filter(Boolean).join(': ');
    super(
      `${place} at offset ${offset}: ${kind}` +
        (expected || found ? `, expected ${expected}, found ${found}` : ''),
    );
    Object.assign(this, { name: 'AdsCncError', stream, field, offset, kind, expected, found, adsError: 0 });
    // The number of the kind, which only this module uses.
    Object.defineProperty(this, 'number', { value: u32(at) });
  }
}

/** Calls a function whose last argument is the error. */
function call(name, ...given) {
  const error = room(48);
  if (!codec[`ads_cnc_${name}`](...given, error)) throw new AdsCncError(error);
}

/** Like `call`, for a function that fills a buffer. Repeats the call with a larger buffer if necessary. */
function sized(size, name, ...given) {
  const length = room(4);
  for (;;) {
    const buffer = room(size);
    try {
      call(name, ...given, buffer, size, length);
      return taken(buffer, u32(length));
    } catch (error) {
      if (![15, 37].includes(error.number) || error.expected <= size) throw error;
      size = error.expected;
    }
  }
}

/** Frees the scratch memory, then runs a function, which may use all scratch memory. */
function begin(work) {
  top = base;
  return work();
}

/** The rows of a table of the library, in the order of their numbers. */
function each(name, size, read, ...before) {
  const rows = [],
    at = room(size);
  while (codec[`ads_cnc_${name}`](...before, rows.length, at)) rows.push(read(at, rows.length));
  return rows;
}

const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

const streams = begin(() =>
  each('stream_info', 28, (at, number) => {
    const fields = each(
      'field_info',
      40,
      (row) => {
        const [kind, size, isCount, isList] = numbers(row + 24, 4);
        const [name, meaning, clause] = [0, 8, 16].map((part) => word(row + part));
        return { name, meaning, clause, kind, size, isCount: !!isCount, isList: !!isList };
      },
      number,
    );
    return {
      name: word(at),
      title: word(at + 8),
      max: u32(at + 16),
      repeats: !!u32(at + 24),
      fields,
      number,
    };
  }),
);
export const STREAMS = Object.fromEntries(streams.map((stream) => [stream.name, stream]));

const argument = (number) => {
  const at = room(8);
  codec.ads_cnc_argument_name(number, at);
  return word(at);
};

export const FUNCTIONS = begin(() =>
  each('function_info', 72, (at, number) => {
    const [port, command, effect, request, reply, count] = numbers(at + 16, 6);
    const [asked, answered] = [request, reply].map((one) => (one === NONE ? null : streams[one].name));
    const names = numbers(at + 40, count).map(argument);
    return {
      name: word(at),
      operation: word(at + 8),
      port,
      command,
      effect,
      request: asked,
      reply: answered,
      arguments: names,
      number,
    };
  }),
);

/** Converts CP1252 to text, up to the first NUL or the end. */
export const textFromCp1252 = (data) =>
  begin(() =>
    new TextDecoder('utf-8', { ignoreBOM: true }).decode(
      sized(3 * data.length, 'text_to_utf8', put(data), data.length),
    ),
  );

/** Converts a text to CP1252, without a NUL. */
export const textToCp1252 = (text) =>
  begin(() => {
    if (typeof text !== 'string') throw wrong('text', 'string', text);
    const utf8 = new TextEncoder().encode(text);
    return sized(utf8.length, 'text_from_utf8', put(utf8), utf8.length);
  });

function found(stream, data, name, before) {
  const at = put(data),
    count = room(4);
  for (let size = 64; ; size = u32(count)) {
    const array = room(24 * size);
    try {
      call(name, before, at, data.length, array, size, count);
    } catch (error) {
      if (error.number === 37) continue;
      throw error;
    }
    return Array.from({ length: u32(count) }, (_, n) => {
      const [field, record, item, offset, length] = numbers(array + 24 * n, 5);
      return {
        name: stream.fields[field].name,
        record,
        item,
        offset,
        data: taken(at + offset, length),
      };
    });
  }
}

function named(stream) {
  const it = STREAMS[stream];
  if (!it) throw new TypeError(`no such stream: ${stream}`);
  return it;
}

/** Splits a stream into its fields, with their bytes. */
export const fields = (stream, data) =>
  begin(() => found(named(stream), data, 'decode', named(stream).number));

/** Builds a stream from its fields, [name, bytes] each: the inverse of `fields`. Counts may be omitted. */
export const join = (stream, parts) =>
  begin(() => {
    const it = named(stream);
    const all = parts.flatMap(([name, data]) => {
      const field = it.fields.findIndex((row) => row.name === name);
      return [field < 0 ? NONE : field, 0, put(data), data.length];
    });
    const size = parts.reduce((sum, [, data]) => sum + data.length, 64);
    return sized(size, 'build', it.number, putNumbers(all), parts.length);
  });

const little = (data) => data.reduceRight((sum, byte) => sum * 256 + byte, 0);
const dataView = (data) => new DataView(data.buffer, data.byteOffset, data.byteLength);

function read(row, data) {
  if (row.kind === 1) return little(data);
  if (row.kind === 2) return data[0] !== 0;
  if (row.kind === 3) return dataView(data).getFloat64(0, true);
  if (row.kind === 4) return textFromCp1252(data);
  return row.kind === 5 ? data.join('.') : data;
}

function ended(text) {
  const data = textToCp1252(text),
    all = new Uint8Array(data.length + 1);
  all.set(data);
  return all;
}

/** The bytes of a NetId. Without the check, Uint8Array would wrap a number above 255. */
function netIdToBytes(name, text) {
  const parts = /^\d{1,3}(\.\d{1,3}){5}$/.test(text) ? text.split('.').map(Number) : [];
  if (parts.length !== 6 || parts.some((part) => part > 255))
    throw new RangeError(`${name}: six numbers from 0 to 255 expected, found ${text}`);
  return Uint8Array.from(parts);
}

function write(row, value) {
  if (value instanceof Uint8Array) return value;
  if (row.kind <= 2) {
    const size = row.size || 4,
      isBoolean = row.kind === 2 && typeof value === 'boolean';
    const number = unsigned(row.name, isBoolean ? Number(value) : value, 8 * size);
    return Uint8Array.from({ length: size }, (_, at) => Math.floor(number / 256 ** at) % 256);
  }
  if (row.kind === 3) {
    if (typeof value !== 'number') throw wrong(row.name, 'number', value);
    return new Uint8Array(Float64Array.of(value).buffer);
  }
  if (row.kind === 4) return textToCp1252(value).length === row.size ? textToCp1252(value) : ended(value);
  if (row.kind === 5) return netIdToBytes(row.name, value);
  throw wrong(row.name, 'Uint8Array', value);
}

const shown = (stream) => stream.fields.filter((row) => !row.isCount);

function valueOf(stream, parts) {
  const rows = shown(stream),
    records = [];
  for (const part of parts) {
    if (part.record === records.length)
      records.push(Object.fromEntries(rows.map((row) => [camel(row.name), row.isList ? [] : null])));
    const row = rows.find((one) => one.name === part.name);
    if (row?.isList) records[part.record][camel(row.name)].push(read(row, part.data));
    else if (row) records[part.record][camel(row.name)] = read(row, part.data);
  }
  if (stream.repeats) return records;
  if (!records.length) return null;
  return rows.length === 1 ? records[0][camel(rows[0].name)] : records[0];
}

/** Decodes a stream: to its only field, to a record, or to a list of records if the stream repeats; to null if the
 * data contains no field. */
export const decode = (stream, data) => valueOf(named(stream), fields(stream, data));

/** Encodes a stream, the inverse of `decode`. Bytes are written unchanged. */
export function encode(stream, value) {
  const it = named(stream),
    rows = shown(it);
  const records = it.repeats ? value : value === null || value === undefined ? [] : [value];
  return join(
    stream,
    records.flatMap((record) =>
      rows.flatMap((row) => {
        const one = rows.length > 1 ? record[camel(row.name)] : record;
        if (one === null || one === undefined) return [];
        return (row.isList ? listed(camel(row.name), one) : [one]).map((item) => [row.name, write(row, item)]);
      }),
    ),
  );
}

const NUMBERS = 'function channel by_index axis index count size handle index_group index_offset'.split(
  ' ',
);
const TEXTS = ['kind', 'name', 'value'];

/** Writes an AdsCncRequest; returns its address. The texts in `given` must be CP1252, because a conversion here
 * would overwrite the scratch memory. */
function putRequest(given) {
  const plain = NUMBERS.map((name) => (name in given ? unsigned(camel(name), given[name]) : 0));
  const texts = TEXTS.flatMap((name) => (given[name] ? [put(given[name]), given[name].length] : [0, 0]));
  const indices = given.indices ?? [];
  return putNumbers([...plain, ...texts, putNumbers(indices), indices.length]);
}

const CALL = ['port', 'command', 'indexGroup', 'indexOffset', 'readLength'];
const callAt = (at) => ({
  ...Object.fromEntries(numbers(at, 5).map((number, n) => [CALL[n], number])),
  data: lent(at + 20),
});
const putCall = (it) =>
  putNumbers([...CALL.map((name) => unsigned(name, it[name])), put(it.data), it.data.length]);

/** Creates the function of this module for a function of the CNC. */
function operation(number) {
  const it = FUNCTIONS[number];
  return (...values) => {
    const options = values[it.arguments.length] ?? {};
    const given = Object.fromEntries(it.arguments.map((name, n) => [name, values[n]]));
    given.function = number;
    if ('byIndex' in options) given.by_index = options.byIndex ? 1 : 0;
    if ('axis' in options) given.axis = options.axis ?? 0;
    for (const name of ['kind', 'name'])
      if (typeof given[name] === 'string') given[name] = textToCp1252(given[name]);
      else if (name in given && !(given[name] instanceof Uint8Array))
        throw wrong(name, 'string or Uint8Array', given[name]);
    if ('indices' in given)
      given.indices = listed('indices', given.indices).map((one, n) => unsigned(`indices[${n}]`, one));
    if ('value' in given && !(given.value instanceof Uint8Array))
      throw new TypeError('value: bytes expected, see `pack`');
    const sent = begin(() => {
      const at = putRequest(given),
        out = room(28),
        size = 4096 + (given.value?.length ?? 0);
      call('encode', at, room(size), size, out);
      return callAt(out);
    });
    return {
      ...sent,
      function: it,
      decode(reply) {
        const stream = it.reply && STREAMS[it.reply];
        const parts = begin(() => found(stream, reply, 'decode_reply', putRequest(given)));
        return stream ? valueOf(stream, parts) : undefined;
      },
    };
  };
}

/** Dispatches a received call. If it throws, answer with the `adsError` of the exception. */
export function dispatch(received) {
  const [it, indices, number, texts] = begin(() => {
    const at = putCall(received),
      list = room(4 * 512),
      out = room(72),
      adsErrorAt = room(4);
    try {
      call('dispatch', at, list, 512, out, adsErrorAt);
    } catch (error) {
      throw Object.assign(error, { adsError: u32(adsErrorAt) });
    }
    const given = Object.fromEntries(numbers(out, 10).map((value, n) => [NUMBERS[n], value]));
    return [
      given,
      numbers(list, u32(out + 68)),
      given.function,
      TEXTS.map((_, n) => lent(out + 40 + 8 * n)),
    ];
  });
  const [kind, name] = texts.slice(0, 2).map(textFromCp1252),
    row = FUNCTIONS[number];
  const all = { ...it, kind, name, value: texts[2], indices };
  const more = ['axis', 'by_index'].filter((one) => !row.arguments.includes(one) && it[one]);
  const given = [...row.arguments, ...more].map((one) => [
    camel(one),
    one === 'by_index' ? true : all[one],
  ]);
  return {
    function: row,
    arguments: Object.fromEntries(given),
    reply: (value) => (row.reply ? encode(row.reply, value) : new Uint8Array()),
  };
}

// Addresses and names.

const GROUP = ['task', 'access', 'addressing', 'table', 'objectClass', 'attribute'];

/** Parses an index group; null if it is not documented. */
export const groupParts = (indexGroup) =>
  begin(() => {
    const at = room(52);
    if (!codec.ads_cnc_group(unsigned('indexGroup', indexGroup), at)) return null;
    return {
      ...Object.fromEntries(GROUP.map((name, n) => [name, word(at + 8 * n)])),
      instance: u32(at + 48),
    };
  });

/** The index offset of an element of an axis; axis 0 is the channel itself. */
export const axisOffset = (axis, element, stride = 0x10000) =>
  begin(() => {
    const out = room(4),
      given = Object.entries({ stride, axis, element });
    call('offset', ...given.map(([name, value]) => unsigned(name, value)), out);
    return u32(out);
  });

/** The axis and the element of an index offset. */
export const axisAndElement = (offset, stride = 0x10000) =>
  begin(() => {
    const out = room(8);
    call('offset_parts', unsigned('stride', stride), unsigned('offset', offset), out, out + 4);
    return numbers(out, 2);
  });

/** Parses the name of a variable. */
export function path(name) {
  const data = textToCp1252(name);
  const all = begin(() => {
    const array = room(24 * 256),
      count = room(4);
    call('path', put(data), data.length, array, 256, count);
    return Array.from({ length: u32(count) }, (_, n) => numbers(array + 24 * n, 6));
  });
  const text = ([, , , offset, length]) => textFromCp1252(data.slice(offset, offset + length));
  const parts = [];
  for (const part of all.slice(1)) {
    if (part[0] === 2) parts[part[1]].indices.push(part[5]);
    else parts.push({ name: text(part), indices: [] });
  }
  return { kind: text(all[0]), parts };
}

// AMS/TCP frames, for programs without an ADS library.

function putFrame(it) {
  const ends = ['target', 'source'].flatMap((name) => {
    const [netId, port] = it[name];
    unsigned(`${name} port`, port, 16);
    return [...netIdToBytes(`${name} NetId`, netId), port & 255, port >> 8];
  });
  const values = ['command', 'stateFlags', 'error', 'invokeId'].map((name) => unsigned(name, it[name]));
  const at = putNumbers([0, 0, 0, 0, ...values, put(it.data), it.data.length]);
  bytes(at, 16).set(ends);
  return at;
}

/** Creates the frame of a request. An address is a NetId and a port: ['192.0.2.7.1.1', 552]. */
export const frameOfCall = (it, targetNetId, source, invokeId) => ({
  target: [targetNetId, it.port],
  source,
  command: it.command,
  stateFlags: 4,
  error: 0,
  invokeId,
  data: begin(() => sized(64 + it.data.length, 'call_write', putCall(it))),
});

/** Decodes the call in the frame of a request. */
export const callOfFrame = (frame) =>
  begin(() => {
    const at = putFrame(frame),
      out = room(28);
    call('call_read', at, out);
    return callAt(out);
  });

/** Encodes a frame, including both lengths. */
export const encodeFrame = (frame) =>
  begin(() => sized(38 + frame.data.length, 'frame_write', putFrame(frame)));

/** Decodes the first received frame, and returns its length; null if the frame is not complete yet. */
export const readFrame = (received, maxData = 0x400000) =>
  begin(() => {
    // Copies only the first frame, because many more may follow it. Its length is after two reserved bytes.
    const isKnown = checked(received).length >= 6;
    const first = isKnown ? received.subarray(0, 6 + dataView(received).getUint32(2, true)) : received;
    const at = put(first),
      out = room(40),
      used = room(4);
    call('frame_read', at, first.length, unsigned('maxData', maxData), out, used);
    if (!u32(used)) return null;
    const end = (from) => [bytes(from, 6).join('.'), view().getUint16(from + 6, true)];
    const [command, stateFlags, error, invokeId] = numbers(out + 16, 4);
    const frame = {
      target: end(out),
      source: end(out + 8),
      command,
      stateFlags,
      error,
      invokeId,
      data: lent(out + 32),
    };
    return { frame, length: u32(used) };
  });

// Values by their types.

const GETTERS = [
  () => 'Uint8',
  (size) => `${size > 4 ? 'BigUint' : 'Uint'}${8 * size}`,
  (size) => `${size > 4 ? 'BigInt' : 'Int'}${8 * size}`,
  (size) => `Float${8 * size}`,
  () => '',
];

export const TYPES = begin(() =>
  each('type', 28, (at) => {
    const [code, kind, size] = numbers(at + 16, 3);
    return { name: word(at), objectName: word(at + 8), code, kind, size };
  }),
);

function typeOf(type) {
  const it = TYPES.find(
    (one) => [one.name, one.objectName].includes(type) || (one.code && one.code === type),
  );
  if (!it) throw new TypeError(`no such type: ${type}`);
  return it;
}

/** Nests the items, of which there is at least one, from the last dimension to the first. */
function nested(items, dimensions) {
  let all = items;
  for (const size of dimensions.slice(1).reverse()) {
    const from = all;
    all = Array.from({ length: from.length / size }, (_, at) => from.slice(at * size, (at + 1) * size));
  }
  return dimensions.length ? all : all[0];
}

/** Decodes a value by its type (a name, or a code from a description); an array to nested arrays. The result is an
 * empty array if a dimension is 0. */
export function unpack(type, data, dimensions = []) {
  const it = typeOf(type),
    all = listed('dimensions', dimensions).map((one, n) => unsigned(`dimensions[${n}]`, one));
  checked(data);
  // With a dimension 0, the product of the others may be infinite, and that times 0 is not a number.
  const count = all.includes(0) ? 0 : all.reduce((product, one) => product * one, 1);
  const size = it.size || (all.length ? Math.floor(data.length / Math.max(count, 1)) : data.length);
  if (size * count !== data.length || (count && !size && all.length)) {
    throw new RangeError(
      `${it.name}: expected ${count} elements of ${size} bytes, found ${data.length} bytes`,
    );
  }
  // Without elements, the other dimensions are only numbers: they may stand for billions of empty arrays.
  if (!count) return [];
  const get = `get${GETTERS[it.kind](size)}`,
    memory = dataView(data);
  return nested(
    Array.from({ length: count }, (_, at) => {
      if (it.kind === 4) return textFromCp1252(data.subarray(at * size, (at + 1) * size));
      const value = memory[get](at * size, true);
      return it.kind ? value : value !== 0;
    }),
    all,
  );
}

/** Encodes a value, the inverse of `unpack`. A text gets a NUL; pass the texts of an array as bytes. */
export function pack(type, value) {
  const it = typeOf(type),
    parts = [],
    left = [value];
  // Not recursive, because a value may have more dimensions than the stack has room for.
  while (left.length) {
    const one = left.pop();
    if (Array.isArray(one)) for (let n = one.length - 1; n >= 0; n -= 1) left.push(one[n]);
    else parts.push(packed(it, one));
  }
  const data = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    data.set(part, at);
    at += part.length;
  }
  return data;
}

// What `packed` accepts, by the kind of the type.
const ACCEPTED = [['boolean', 'number'], ['number', 'bigint'], ['number', 'bigint'], ['number'], ['string']];

function packed(it, value) {
  if (value instanceof Uint8Array) return value;
  if (!ACCEPTED[it.kind].includes(typeof value))
    throw wrong(it.name, ACCEPTED[it.kind].join(' or '), value);
  if (it.kind === 4) return ended(value);
  const bits = 8 * it.size;
  const [low, end, meaning] = [
    [0, 2, 'true, false, 0 or 1'],
    [0, 2 ** bits, `an unsigned number of ${bits} bits`],
    [-(2 ** (bits - 1)), 2 ** (bits - 1), `a signed number of ${bits} bits`],
    [0, 0, `a float of ${bits} bits`],
  ][it.kind];
  const isWhole = typeof value === 'bigint' || Number.isInteger(Number(value));
  // A float may be rounded, but a finite number must not become infinite.
  const fits =
    it.kind === 3
      ? bits > 32 || !Number.isFinite(value) || Number.isFinite(Math.fround(value))
      : isWhole && value >= low && value < end;
  if (!fits) throw new RangeError(`${it.name}: ${value} is not ${meaning}`);
  const data = new Uint8Array(it.size),
    name = GETTERS[it.kind](it.size);
  dataView(data)[`set${name}`](0, name.startsWith('Big') ? BigInt(value) : Number(value), true);
  return data;
}

// The state machines. Each has an instance of the codec, whose memory holds the machine and a copy of the data that
// the machine points to. So no call has to copy them.

class Machine {
  #own = instance();
  #kept;
  #at;

  constructor(kept, size) {
    this.use(() => {
      [this.#kept, this.#at] = [put(kept), put(new Uint8Array(size))];
      // The scratch memory of later calls begins after both.
      this.#own.base = top;
    });
  }

  /** Calls a function with the address of the machine and of the data that the machine points to. */
  use(work) {
    const shared = { codec, base };
    ({ codec, base } = this.#own);
    try {
      return begin(() => work(this.#at, this.#kept));
    } finally {
      ({ codec, base } = shared);
    }
  }
}

export const BUSY = 1,
  REJECTED = 2;

/** Sends an NC program: returns packets to write by `writeProgramStream`, and accepts the results. */
export class Sender {
  #it;

  constructor(program) {
    this.#it = new Machine(program, 1216);
    this.#it.use((at, kept) => call('sender_start', at, kept, program.length));
  }

  /** The packet to write now; null if no packet is left. */
  packet() {
    return this.#it.use((at) => {
      const out = room(8);
      return codec.ads_cnc_sender_packet(at, out) ? lent(out) : null;
    });
  }

  /** Reports the ADS result of the write, or null if the reply was lost. Returns 0, BUSY or REJECTED. */
  acknowledge(adsError) {
    const number =
      adsError === null ? REJECTED : codec.ads_cnc_acknowledgement(unsigned('adsError', adsError));
    if (!this.#it.use((at) => codec.ads_cnc_sender_acknowledge(at, number)))
      throw new Error('no packet is in flight');
    return number;
  }

  get progress() {
    return this.#it.use((at) => {
      const out = room(28);
      codec.ads_cnc_sender_progress(at, out);
      const names = ['state', 'packets', 'lines', 'bytes', 'leftLines', 'leftBytes', 'busyCount'];
      return Object.fromEntries(numbers(out, 7).map((number, n) => [names[n], number]));
    });
  }
}

/** Hosts the services of a channel: returns the variable to read or write next. */
export class Host {
  #it;

  constructor(services) {
    const ids = begin(() => {
      const at = room(36 * services.length);
      services.forEach((service, n) => {
        const text = new TextEncoder().encode(service);
        call('service_id', put(text), text.length, at + 36 * n);
      });
      return taken(at, 36 * services.length);
    });
    this.#it = new Machine(ids, 576);
    this.#it.use((at, kept) => call('host_start', at, kept, services.length));
  }

  /** The next step. Returns the same step until a read value, an answer or an event is reported. */
  step() {
    const [kind, service, requestState, variable, data] = this.#it.use((at) => {
      const out = room(28);
      codec.ads_cnc_host_step(at, out);
      return [...numbers(out, 3), word(out + 12), lent(out + 20)];
    });
    if (kind === 0) return { kind: 'wait' };
    if (kind === 1) return { kind: 'read', variable };
    if (kind === 2) return { kind: 'write', variable, data };
    return { kind: 'serve', service, request: textFromCp1252(data), requestState };
  }

  /** Reports the value that was read. */
  read(value) {
    this.#it.use((at) => call('host_read', at, put(value), value.length));
  }

  /** Answers the request. The state must not be 0. */
  answer(response, state) {
    const data = textToCp1252(response);
    this.#it.use((at) => call('host_answer', at, put(data), data.length, unsigned('state', state)));
  }

  #event(number) {
    this.#it.use((at) => codec.ads_cnc_host_event(at, number));
  }

  written() {
    this.#event(0);
  }
  failed() {
    this.#event(1);
  }
  poll() {
    this.#event(2);
  }
  restart() {
    this.#event(3);
  }

  /** The outcome of the last answer: 'answered' or 'abandoned'; null before the first answer, and until the
   * outcome of an answer is known. */
  get outcome() {
    return [null, 'answered', 'abandoned'][this.#it.use((at) => codec.ads_cnc_host_outcome(at))];
  }
}
