#!/usr/bin/env node
// The npm package as a testee; conformance/adapters/README.md describes the protocol.
//
//     ads-cnc run --testee "node codec/bindings/javascript/testee.mjs"

import { createInterface } from 'node:readline';
import * as cnc from './dist/index.js';

// The field of each stream whose value needs a type in addition to its bytes.
const TYPED = {
  content: 'content',
  'variable-value': 'value',
  'variable-handle-write': 'value',
  'variable-name-write': 'value',
};
const SERVICES = {
  '2,4': 'read-request',
  '3,4': 'write-request',
  '9,4': 'read-write-request',
  '2,5': 'read-reply',
  '3,5': 'write-reply',
  '9,5': 'read-write-reply',
};
const STREAMS = [...Object.keys(cnc.STREAMS), 'ams-frame', 'variable-path', 'index-group', 'index-offset'];
const OPS = ['decode', 'encode', 'packets'],
  EDITIONS = ['en-1.05', 'de-1.051'];

class Unsupported extends Error {}

const hex = (data) => Buffer.from(data).toString('hex');
const unhex = (text) => Uint8Array.from(Buffer.from(text.replace(/\s/g, ''), 'hex'));
const under = (name) => name.replaceAll('-', '_');
const concat = (parts) => Uint8Array.from(parts.flatMap((part) => Array.from(part)));
const typeOf = (name) => cnc.TYPES.find((it) => [it.name, it.objectName].includes(name));

function text(data, isPadded) {
  const at = data.indexOf(0),
    head = at < 0 ? data : data.slice(0, at),
    tail = data.slice(at + 1);
  const out = { type: 'STRING', hex: hex(head), value: cnc.textFromCp1252(head) };
  if (at < 0) out.open = true;
  else if (tail.length && !(isPadded && tail.every((byte) => byte === 0))) out.tail = hex(tail);
  return out;
}

function number(type, data) {
  const bits = BigInt(`0x${hex(Uint8Array.from(data).reverse())}`),
    it = typeOf(type);
  if (it.kind === 3) return { type, bits: `0x${bits.toString(16).padStart(2 * it.size, '0')}` };
  return { type, value: String(it.kind === 2 ? BigInt.asIntN(8 * it.size, bits) : bits) };
}

function elements({ type, dimensions = [] }, data) {
  if (!typeOf(type)) throw new Unsupported('context');
  // `unpack` throws an error if the data does not have the length of the value.
  cnc.unpack(type, data, dimensions);
  const count = dimensions.reduce((product, one) => product * one, 1),
    size = data.length / Math.max(count, 1);
  return Array.from({ length: count }, (_, at) => data.slice(at * size, (at + 1) * size)).map((part) =>
    type === 'STRING' ? text(part) : number(type, part),
  );
}

function valueOf(row, data) {
  if (row.kind === 1) return number(`UNS${String(8 * data.length).padStart(2, '0')}`, data);
  if (row.kind === 2) return { type: 'BOOLEAN', value: String(data[0]) };
  if (row.kind === 3) return number('REAL64', data);
  if (row.kind === 4) return text(data, row.size > 0);
  return row.kind === 5 ? { type: 'NETID', value: data.join('.') } : { type: 'BYTES', hex: hex(data) };
}

function decode(stream, data, context) {
  if (OTHERS[stream]) return OTHERS[stream].decode(data, context);
  if (stream === 'ams-frame') return decodeFrame(data);
  const rows = cnc.STREAMS[stream].fields.filter((row) => !row.isCount),
    records = [];
  for (const field of cnc.fields(stream, data)) {
    if (field.record === records.length)
      records.push(Object.fromEntries(rows.filter((row) => row.isList).map((row) => [row.name, []])));
    const row = rows.find((one) => one.name === field.name),
      record = records[field.record];
    if (!row) continue;
    if (TYPED[stream] === field.name && (stream !== 'content' || Object.keys(context).length))
      record[field.name] = elements(context, field.data);
    else if (row.isList) record[field.name].push(valueOf(row, field.data));
    else record[field.name] = valueOf(row, field.data);
  }
  return cnc.STREAMS[stream].repeats ? { descriptors: records } : (records[0] ?? {});
}

const numberOf = (type, value) => ({ type, value: String(value) });
const openText = (value) => ({ type: 'STRING', hex: hex(cnc.textToCp1252(value)), value, open: true });
const count = (data) => cnc.decode('object-count', data);
const WORDS = { objectClass: 'class' };

// Subjects that are not streams of the table, except `ams-frame`. Groups and offsets have four bytes and are
// decoded as counts.
const OTHERS = {
  'variable-path': {
    decode(data) {
      if (data.includes(0)) throw new RangeError('a NUL in a name');
      const { kind, parts } = cnc.path(cnc.textFromCp1252(data));
      return {
        kind: openText(kind),
        parts: parts.map(({ name, indices }) => ({
          name: openText(name),
          indices: indices.map((index) => numberOf('UNS32', index)),
        })),
      };
    },
    encode({ kind, parts }) {
      const textOf = (part) => cnc.textFromCp1252(unhex(part.hex));
      const all = parts.map(
        (part) => textOf(part.name) + part.indices.map(({ value }) => `[${BigInt(value)}]`).join(''),
      );
      const name = [textOf(kind), ...all].join('.');
      cnc.path(name);
      return cnc.textToCp1252(name);
    },
  },
  'index-group': {
    decode(data, { base }) {
      const number = count(data),
        out = { index_group: numberOf('UNS32', number) };
      if (base && !(number >= Number(base) && number - Number(base) <= 255))
        throw new RangeError('index group outside the range of its base');
      const group = cnc.groupParts(number);
      if (!group) return out;
      for (const [name, value] of Object.entries(group)) {
        const isTask = name === 'task',
          words = isTask ? value : String(value).toLowerCase().replaceAll(' ', '-');
        if (name !== 'instance' && value) out[WORDS[name] ?? name] = { type: 'NAME', value: words };
      }
      return { ...out, instance: numberOf('UNS08', group.instance) };
    },
    encode: ({ index_group: { value } }) => cnc.encode('object-count', Number(value)),
  },
  'index-offset': {
    decode(data, { stride }) {
      if (!stride) throw new Unsupported('context');
      const [axis, element] = cnc.axisAndElement(count(data), Number(stride));
      return { axis: numberOf('UNS16', axis), element: numberOf('UNS16', element) };
    },
    encode: ({ axis, element }, { stride }) =>
      cnc.encode('object-count', cnc.axisOffset(Number(axis.value), Number(element.value), Number(stride))),
  },
};

function decodeFrame(data) {
  const found = cnc.readFrame(data);
  if (found?.length !== data.length) throw new RangeError('not exactly one frame');
  const { frame } = found;
  const out = {
    ams_tcp_header: decode('ams-tcp-header', data.slice(0, 6), {}),
    ams_header: decode('ams-header', data.slice(6, 38), {}),
  };
  delete out.ams_tcp_header.length;
  delete out.ams_header.data_length;
  if (frame.data.length || !frame.error) {
    const service = SERVICES[[frame.command, frame.stateFlags]];
    out[service ? under(service) : 'data'] = service
      ? decode(service, frame.data, {})
      : { type: 'BYTES', hex: hex(frame.data) };
  }
  return out;
}

function write(part) {
  if (Array.isArray(part)) return concat(part.map(write));
  if (part.type === 'NETID') return Uint8Array.from(part.value.split('.'));
  if ('hex' in part)
    return concat([
      unhex(part.hex),
      'open' in part || part.type === 'BYTES' ? [] : [0],
      unhex(part.tail ?? ''),
    ]);
  const { size } = typeOf(part.type),
    bits = BigInt.asUintN(8 * size, BigInt(part.bits ?? part.value));
  return unhex(bits.toString(16).padStart(2 * size, '0')).reverse();
}

function encode(stream, given, context) {
  if (OTHERS[stream]) return OTHERS[stream].encode(given, context);
  if (stream === 'ams-frame') return encodeFrame(given);
  const { fields, repeats } = cnc.STREAMS[stream];
  return cnc.join(
    stream,
    (repeats ? given.descriptors : [given]).flatMap((record) =>
      fields
        .filter((row) => row.name in record)
        .flatMap((row) =>
          (row.isList ? record[row.name] : [record[row.name]]).map((item) => {
            const data = write(item);
            // A text that fills its field has no NUL.
            return [row.name, row.kind === 4 && row.size ? data.slice(0, row.size) : data];
          }),
        ),
    ),
  );
}

function encodeFrame(given) {
  const header = Object.fromEntries(
    Object.entries(given.ams_header).map(([name, part]) => [name, part.value]),
  );
  const end = (name) => [header[`${name}_net_id`], Number(header[`${name}_port`])];
  const service = Object.keys(given).find((name) => !['ams_tcp_header', 'ams_header'].includes(name));
  const data = !service
    ? new Uint8Array()
    : service === 'data'
      ? write(given.data)
      : encode(service.replaceAll('_', '-'), given[service]);
  const [command, stateFlags, error, invokeId] = ['command', 'state_flags', 'error', 'invoke_id'].map(
    (name) => Number(header[name]),
  );
  return cnc.encodeFrame({
    target: end('target'),
    source: end('source'),
    command,
    stateFlags,
    error,
    invokeId,
    data,
  });
}

function work(asked) {
  if (!OPS.includes(asked.op)) throw new Unsupported('op');
  if (!EDITIONS.includes(asked.edition)) throw new Unsupported('edition');
  if (asked.op === 'packets') {
    const sender = new cnc.Sender(unhex(asked.hex)),
      packets = [];
    for (let packet; (packet = sender.packet()); sender.acknowledge(0)) packets.push(hex(packet));
    return { packets };
  }
  if (!STREAMS.includes(asked.stream)) throw new Unsupported('stream');
  if (asked.op === 'decode') return { value: decode(asked.stream, unhex(asked.hex), asked.context) };
  return { hex: hex(encode(asked.stream, asked.value, asked.context)) };
}

function answer(line) {
  let seq = null;
  try {
    const asked = JSON.parse(line);
    if (asked.cmd === 'hello') {
      const testee = { name: 'ads-cnc for JavaScript', version: '0.2.0', language: 'JavaScript' };
      return { protocol: 1, testee, capabilities: { ops: OPS, streams: STREAMS, editions: EDITIONS } };
    }
    if (asked.cmd === 'bye') return null;
    ({ seq } = asked);
    return { seq, ok: work(asked) };
  } catch (error) {
    if (error instanceof Unsupported) return { seq, unsupported: { what: error.message } };
    if (error instanceof cnc.AdsCncError)
      return { seq, reject: { class: error.kind, at: error.offset, message: error.message } };
    if (error instanceof RangeError) return { seq, reject: { class: 'value', message: error.message } };
    return { seq, error: { message: String(error) } };
  }
}

for await (const line of createInterface({ input: process.stdin })) {
  const reply = answer(line);
  if (!reply) break;
  process.stdout.write(`${JSON.stringify(reply)}\n`);
}
