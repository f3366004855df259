// Tests of the package: requests, values, errors, and dispatch for servers.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import * as cnc from 'ads-cnc';

const bytes = (...all) => Uint8Array.from(all);
const ascii = (text) => Uint8Array.from(Buffer.from(text, 'latin1'));
const operation = ({ operation: name }) => cnc[name[0].toLowerCase() + name.slice(1)];
const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

/** The number of bytes that a function copies into arrays, by `set`. */
function copied(work) {
  const { set } = Uint8Array.prototype;
  let count = 0;
  Uint8Array.prototype.set = function (data, at) {
    count += data.length;
    set.call(this, data, at);
  };
  try {
    work();
  } finally {
    delete Uint8Array.prototype.set;
  }
  return count;
}

function given(row) {
  const isElement = row.name.includes('element');
  return {
    channel: 1,
    axis: 1,
    index: 1,
    count: 1,
    size: 8,
    handle: 7,
    name: 'V.E.a',
    indices: [4, 5],
    kind: row.operation === 'FindInstance' ? 'decoder' : 'P',
    value: ascii('G0 X1\r\n'),
    index_group: isElement ? 0x123301 : 0x120101,
    index_offset: row.operation === 'CountElements' ? 0 : 3,
  };
}

test('a variable is read by its name', () => {
  const request = cnc.readByName(1, 'V.E.Länge');
  assert.deepEqual(
    [request.port, request.command, request.indexGroup, request.indexOffset],
    [552, 9, 0x122301, 0x48],
  );
  assert.deepEqual(request.data, ascii('V.E.L\xe4nge\0'));
  assert.deepEqual(request.decode(bytes(123, 0, 0, 0)), bytes(123, 0, 0, 0));
  assert.deepEqual(request.decode(Buffer.from([1])).length, 1);
});

test('every function is dispatched with its arguments', () => {
  assert.equal(cnc.FUNCTIONS.length, 30);
  for (const row of cnc.FUNCTIONS) {
    const values = row.arguments.map((name) => given(row)[name]);
    const request = operation(row)(...values);
    assert.deepEqual([request.port, request.command], [row.port, row.command]);
    const received = cnc.dispatch(request);
    assert.equal(received.function, row);
    assert.deepEqual(
      received.arguments,
      Object.fromEntries(row.arguments.map((name, n) => [camel(name), values[n]])),
    );
  }
});

test('options are kept', () => {
  const request = cnc.countObjects(0, { axis: 2 });
  assert.equal(request.indexGroup, 0x130202);
  assert.deepEqual(cnc.dispatch(request).arguments, { channel: 0, axis: 2 });
  assert.deepEqual(cnc.dispatch(cnc.countObjects(1, { byIndex: true })).arguments, {
    channel: 1,
    byIndex: true,
  });
});

test('a reply is a value', () => {
  assert.equal(cnc.countObjects(1).decode(bytes(5, 0, 0, 0)), 5);
  assert.equal(cnc.readElementWriteFlag(0x123301, 1).decode(bytes(2)), true);
  assert.equal(cnc.dynamicValueByIndex(1, 'P', 1).decode(bytes(0, 0, 0, 0, 0, 0, 0xf8, 0x3f)), 1.5);
  assert.equal(cnc.readElementName(0x123301, 1).decode(ascii('L\xe4nge\0x')), 'Länge');
  assert.equal(cnc.writeByName(1, 'V.E.a', bytes(1)).decode(bytes()), undefined);
  assert.equal(cnc.describeExtended(1, 0, 'V.E').decode(bytes()), null);
  const reply = ascii('\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0');
  const description = cnc.describeByIndex(1, 2, 'V.E').decode(reply);
  assert.deepEqual(description, {
    handle: 33554434,
    type: 1,
    access: 1,
    size: 2,
    dimensions: [2],
    name: 'V.E.Variable_3',
  });
});

test('wrong arguments are named', () => {
  assert.throws(() => cnc.readByName(0, 'V.E.a'), /index-group: instance at offset 0: out of range/);
  assert.throws(() => cnc.readByName(1, 'V.E.Ω'), /text: text at offset 4: not in CP1252/);
  assert.throws(
    () => cnc.countDynamic(1, 'Q'),
    /call: kind at offset 0: argument not accepted by the function/,
  );
  assert.throws(() => cnc.readByName(-1, 'a'), /channel: -1 is not an unsigned number of 32 bits/);
  assert.throws(() => cnc.writeByName(1, 'a', 1), /value: bytes expected/);
  assert.throws(() => cnc.writeByName(1, 'a'), /value: bytes expected/);
});

test('a number that does not fit is an error', () => {
  const call = { port: 552, command: 9, indexGroup: 0x122301, indexOffset: 0x46, readLength: 4, data: bytes() };
  const frame = cnc.frameOfCall(call, '192.0.2.7.1.1', ['192.0.2.1.1.1', 1], 7);
  const sender = new cnc.Sender(ascii('M30\n'));
  sender.packet();
  const host = new cnc.Host(['560AACBF-6335-44a9-895A-8B27F3ED5E47']);
  for (const [name, work] of [
    ['channel', (value) => cnc.readByName(value, 'V.E.a')],
    ['axis', (value) => cnc.countObjects(1, { axis: value })],
    ['indices\\[1\\]', (value) => cnc.readByHandle(1, 7, [0, value])],
    ['readLength', (value) => cnc.dispatch({ ...call, readLength: value })],
    ['invokeId', (value) => cnc.encodeFrame({ ...frame, invokeId: value })],
    ['maxData', (value) => cnc.readFrame(bytes(), value)],
    ['indexGroup', cnc.groupParts],
    ['axis', (value) => cnc.axisOffset(value, 5)],
    ['element', (value) => cnc.axisOffset(2, value)],
    ['stride', (value) => cnc.axisOffset(2, 5, value)],
    ['offset', (value) => cnc.axisAndElement(value)],
    ['dimensions\\[1\\]', (value) => cnc.unpack('UNS08', bytes(1), [1, value])],
    ['adsError', (value) => sender.acknowledge(value)],
    ['state', (value) => host.answer('5', value)],
  ]) {
    for (const value of [-1, 1.5, NaN, 2 ** 32]) {
      const message = new RegExp(`^${name}: ${value} is not an unsigned number of 32 bits$`);
      assert.throws(() => work(value), { name: 'RangeError', message }, `${name}: ${value}`);
    }
    const message = new RegExp(`^${name}: number expected, found x \\(string\\)$`);
    assert.throws(() => work('x'), { name: 'TypeError', message }, name);
  }
  assert.throws(() => sender.acknowledge(undefined), /adsError: number expected, found undefined/);
  assert.throws(() => cnc.countObjects(), /channel: number expected, found undefined/);
  assert.equal(sender.progress.state, 1);
  assert.equal(sender.acknowledge(0xffffffff), cnc.BUSY);
});

test('an argument of a wrong type is named', () => {
  const host = new cnc.Host(['560AACBF-6335-44a9-895A-8B27F3ED5E47']);
  for (const value of [undefined, null, 5, {}, '', () => 1, new ArrayBuffer(4)]) {
    const message = new RegExp(`^indices: array expected, found .* \\(${typeof value}\\)$`);
    const isArray = { name: 'TypeError', message };
    assert.throws(() => cnc.readByHandle(1, 7, value), isArray);
    assert.throws(() => cnc.writeByHandle(1, 7, value, bytes(1)), isArray);
    if (value !== undefined && value !== null)
      assert.throws(() => cnc.encode('variable-handle-read', { handle: 4, indices: value }), isArray);
  }
  assert.throws(() => cnc.unpack('UNS08', bytes(1), 5), /^TypeError: dimensions: array expected, found 5/);
  for (const value of [undefined, null, 0, 1, {}, ['a']]) {
    const isText = (name) => new RegExp(`^TypeError: ${name}: string or Uint8Array expected, found`);
    assert.throws(() => cnc.readByName(1, value), isText('name'));
    assert.throws(() => cnc.countDynamic(1, value), isText('kind'));
    for (const work of [cnc.textToCp1252, cnc.path, (text) => host.answer(text, 1)])
      assert.throws(() => work(value), /^TypeError: text: string expected, found/);
  }
  assert.deepEqual(cnc.readByName(1, ascii('V.E.a')).data, ascii('V.E.a\0'));
  for (const data of ['192.0.2.7.1.1', 'x', 1, []])
    assert.throws(() => cnc.encode('content', data), /^TypeError: content: Uint8Array expected, found/);
  for (const value of ['', [], '5', 5n, true])
    assert.throws(() => cnc.encode('object-count', value), /^TypeError: count: number expected, found/);
  for (const value of ['', 'x', [], true])
    assert.throws(() => cnc.encode('dynamic-value', value), /^TypeError: value: number expected, found/);
  assert.deepEqual(cnc.encode('element-write-flag', true), bytes(1));
});

test('the indices are copied', () => {
  const indices = [4, 5],
    request = cnc.readByHandle(1, 7, indices);
  indices[0] = -1;
  assert.deepEqual(request.decode(bytes(1)), bytes(1));
  assert.deepEqual(cnc.dispatch(cnc.readByHandle(1, 7, Uint16Array.of(4, 5))).arguments.indices, [4, 5]);
});

test('numbers are read by one DataView', () => {
  const { DataView } = globalThis;
  let count = 0;
  globalThis.DataView = class extends DataView {
    constructor(...given) {
      super(...given);
      count += 1;
    }
  };
  try {
    cnc.dispatch(cnc.readByHandle(1, 7, Array(500).fill(1)));
    cnc.unpack('UNS16', new Uint8Array(1_000), [500]);
  } finally {
    globalThis.DataView = DataView;
  }
  assert.ok(count < 100, `${count} views`);
});

test('only a Uint8Array is bytes', () => {
  const buffer = new ArrayBuffer(8),
    frame = cnc.frameOfCall(cnc.readByName(1, 'a'), '192.0.2.7.1.1', ['192.0.2.1.1.1', 1], 7);
  for (const work of [
    (data) => cnc.textFromCp1252(data),
    (data) => cnc.fields('content', data),
    (data) => cnc.join('content', [['content', data]]),
    (data) => cnc.countObjects(1).decode(data),
    (data) => cnc.readFrame(data),
    (data) => cnc.encodeFrame({ ...frame, data }),
    (data) => cnc.unpack('UNS08', data),
    (data) => new cnc.Sender(data),
  ]) {
    assert.throws(() => work(buffer), {
      name: 'TypeError',
      message: 'Uint8Array expected, found ArrayBuffer',
    });
    assert.throws(() => work([1]), /Uint8Array expected, found Array/);
    assert.throws(() => work(), TypeError);
  }
});

test('results are copies of the passed bytes', () => {
  const passed = Buffer.from([1, 2, 3, 4]);
  const results = [cnc.decode('content', passed), cnc.fields('content', passed)[0].data, cnc.pack('UNS08', passed)];
  passed.fill(0);
  for (const result of results) {
    assert.equal(result.constructor, Uint8Array);
    assert.deepEqual([...result], [1, 2, 3, 4]);
  }
});

test('an error has stream, field and offset', () => {
  const cut = () => cnc.handleByName(1, 'V.E.a').decode(bytes(0, 0));
  assert.throws(cut, {
    name: 'AdsCncError',
    stream: 'variable-handle',
    field: 'handle',
    offset: 0,
    kind: 'truncated',
  });
  assert.throws(cut, cnc.AdsCncError);
  assert.throws(() => cnc.decode('nothing', bytes()), /no such stream: nothing/);
});

test('values are encoded as they were decoded', () => {
  const descriptor = [...Array(16).fill(0), 1, 1, 0x12, 0, ...Array(64).fill(0)];
  for (const [stream, data] of [
    ['object-descriptors', bytes(...descriptor, ...descriptor)],
    ['variable-handle-read', bytes(4, 0, 0, 2, 2, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0)],
    ['dynamic-value', bytes(0, 0, 0, 0, 0, 0, 0xf8, 0x3f)],
    ['variable-extended-description', bytes()],
    ['read-reply', bytes(0, 0, 0, 0, 2, 0, 0, 0, 97, 98)],
    ['read-reply', bytes(5, 7, 0, 0)],
    ['ams-header', Uint8Array.from({ length: 32 }, (_, n) => n)],
  ]) {
    assert.deepEqual(cnc.encode(stream, cnc.decode(stream, data)), data, stream);
  }
  assert.throws(() => cnc.encode('element-write-flag', 256), /flag: 256 is not an unsigned number of 8 bits/);
});

test('long lists and contents are not truncated', () => {
  const indices = Array.from({ length: 510 }, (_, n) => n);
  const data = cnc.encode('variable-handle-read', { handle: 4, indices });
  assert.deepEqual(cnc.decode('variable-handle-read', data).indices, indices);
  const content = new Uint8Array(3_000_000).fill(7);
  assert.deepEqual(cnc.decode('content', content), content);
  assert.deepEqual(cnc.writeObject(0x120101, 3, content).data, content);
  const descriptor = [...Array(16).fill(0), 1, 1, 0x12, 0, ...Array(64).fill(0)];
  const descriptors = Uint8Array.from({ length: 5_000 * 84 }, (_, n) => descriptor[n % 84]);
  const records = cnc.decode('object-descriptors', descriptors);
  assert.equal(records.length, 5_000);
  assert.ok(Buffer.from(descriptors).equals(cnc.encode('object-descriptors', records)));
  const text = cnc.pack('STRING', 'a'.repeat(300_000));
  assert.deepEqual([text.length, text[299_999], text[300_000]], [300_001, 97, 0]);
});

test('values are read by their types', () => {
  assert.deepEqual(cnc.unpack('SGN16', bytes(11, 0, 12, 0, 255, 255, 21, 0), [2, 2]), [
    [11, 12],
    [-1, 21],
  ]);
  assert.equal(cnc.unpack(8, bytes(0, 0, 0, 0, 0, 0, 0xf8, 0x3f)), 1.5);
  assert.deepEqual(cnc.unpack('STRING', ascii('a\0b\0'), [2]), ['a', 'b']);
  assert.equal(cnc.unpack('LINT', bytes(...Array(8).fill(255))), -1n);
  assert.equal(cnc.unpack('BOOL', bytes(2)), true);
  assert.deepEqual(cnc.pack('LREAL', [1.5, 0]), bytes(0, 0, 0, 0, 0, 0, 0xf8, 0x3f, ...Array(8).fill(0)));
  assert.deepEqual(cnc.pack('LWORD', 258), bytes(2, 1, 0, 0, 0, 0, 0, 0));
  assert.deepEqual(cnc.pack('STRING', 'Länge'), ascii('L\xe4nge\0'));
  for (const [type, value, meaning] of [
    ['SGN08', 200, 'a signed number of 8 bits'],
    ['SGN08', -129, 'a signed number of 8 bits'],
    ['UNS32', -1, 'an unsigned number of 32 bits'],
    ['UNS32', 2n ** 32n, 'an unsigned number of 32 bits'],
    ['SGN16', 1.5, 'a signed number of 16 bits'],
    ['UNS32', NaN, 'an unsigned number of 32 bits'],
    ['LWORD', 0.5, 'an unsigned number of 64 bits'],
    ['LWORD', Infinity, 'an unsigned number of 64 bits'],
    ['LINT', 2 ** 63, 'a signed number of 64 bits'],
    ['BOOLEAN', 2, 'true, false, 0 or 1'],
    ['REAL32', 1e300, 'a float of 32 bits'],
  ]) {
    const message = `${type}: ${value} is not ${meaning}`;
    assert.throws(() => cnc.pack(type, value), { name: 'RangeError', message });
  }
  for (const [type, value, expected] of [
    ['REAL64', 'x', 'number'],
    ['REAL64', undefined, 'number'],
    ['REAL32', 1n, 'number'],
    ['SGN32', '', 'number or bigint'],
    ['UNS08', true, 'number or bigint'],
    ['LWORD', '5', 'number or bigint'],
    ['BOOLEAN', 'false', 'boolean or number'],
    ['STRING', 5, 'string'],
  ]) {
    const message = `${type}: ${expected} expected, found ${value} (${typeof value})`;
    assert.throws(() => cnc.pack(type, value), { name: 'TypeError', message });
    assert.throws(() => cnc.pack(type, [[value]]), { name: 'TypeError', message });
  }
  assert.throws(() => cnc.pack('UNS08', new Array(2)), /UNS08: number or bigint expected, found undefined/);
  assert.deepEqual(cnc.pack('BOOLEAN', [true, false, 1, 0]), bytes(1, 0, 1, 0));
  assert.deepEqual(cnc.pack('LWORD', 2 ** 63), bytes(0, 0, 0, 0, 0, 0, 0, 128));
  assert.deepEqual(cnc.pack('LINT', [-1n, -(2 ** 63)]), bytes(...Array(8).fill(255), ...Array(7).fill(0), 128));
  assert.deepEqual(cnc.pack('SGN08', [-128, 127, 0]), bytes(128, 127, 0));
  assert.equal(cnc.unpack('REAL32', cnc.pack('REAL32', -Infinity)), -Infinity);
  assert.deepEqual(cnc.pack('UNS08', []), bytes());
  assert.throws(() => cnc.unpack('SGN16', bytes(0)), RangeError);
  assert.throws(() => cnc.unpack(77, bytes(0)), TypeError);
});

test('any number of dimensions is read', () => {
  for (const dimensions of [
    [0],
    [2, 0],
    [0xffffffff, 0],
    [...Array(40).fill(0xffffffff), 0],
  ]) {
    for (const type of ['SGN16', 'STRING'])
      assert.deepEqual(cnc.unpack(type, bytes(), dimensions), [], dimensions);
    assert.throws(() => cnc.unpack('UNS08', bytes(1), dimensions), /expected 0 elements of 1 bytes, found 1/);
  }
  let value = cnc.unpack('UNS08', bytes(1, 2), [...Array(506).fill(1), 2]);
  for (let depth = 0; depth < 506; depth += 1) {
    assert.equal(value.length, 1);
    [value] = value;
  }
  assert.deepEqual(value, [1, 2]);
  const cube = [0, 4, 8].map((n) => [
    [n, n + 1],
    [n + 2, n + 3],
  ]);
  assert.deepEqual(cnc.unpack('UNS08', cnc.pack('UNS08', cube), [3, 2, 2]), cube);
  let deep = [1, 2];
  for (let depth = 0; depth < 100_000; depth += 1) deep = [deep];
  assert.deepEqual(cnc.pack('UNS08', deep), bytes(1, 2));
  assert.equal(
    copied(() => cnc.pack('STRING', [[[ascii('a\0')], [ascii('b\0')]]])),
    4,
  );
});

test('addresses and names are parsed', () => {
  const { objectClass, attribute, table, instance } = cnc.groupParts(0x122301);
  assert.deepEqual([objectClass, attribute, table, instance], ['decoder', 'content', '', 1]);
  assert.equal(cnc.groupParts(0x133301), null);
  assert.equal(cnc.axisOffset(2, 5), 0x20005);
  assert.deepEqual(cnc.axisAndElement(0x20005, 0x1000), [0x20, 5]);
  const parts = [
    { name: 'NP', indices: [0] },
    { name: 'Länge', indices: [1, 2] },
  ];
  assert.deepEqual(cnc.path('V.G.NP[0].Länge[1][2]'), { kind: 'V.G', parts });
  assert.throws(() => cnc.path('V.G..a'), /variable-path: part/);
});

test('a server answers a call with data or an ADS error', () => {
  const call = {
    port: 552,
    command: 9,
    indexGroup: 0x122301,
    indexOffset: 0x46,
    readLength: 4,
    data: ascii('V.E.vartest\0'),
  };
  const received = cnc.dispatch(call);
  assert.equal(received.arguments.name, 'V.E.vartest');
  assert.deepEqual(received.reply(33554436), bytes(4, 0, 0, 2));
  assert.throws(() => cnc.dispatch({ ...call, indexOffset: 0x4e }), { adsError: 0x703 });
});

test('frames carry calls', () => {
  const frame = cnc.frameOfCall(cnc.readByName(1, 'V.E.a'), '192.0.2.7.1.1', ['192.0.2.1.1.1', 0x8001], 7);
  const data = cnc.encodeFrame(frame);
  assert.equal(cnc.readFrame(data.slice(0, -1)), null);
  assert.deepEqual(cnc.readFrame(Uint8Array.of(...data, 1)), { frame, length: data.length });
  assert.deepEqual(cnc.dispatch(cnc.callOfFrame(frame)).arguments, { channel: 1, name: 'V.E.a' });
  assert.throws(() => cnc.readFrame(Uint8Array.of(1, ...data.slice(1))), /ams-tcp-header: reserved/);
});

test('only the first of many frames is copied', () => {
  const frame = cnc.frameOfCall(cnc.readByName(1, 'V.E.a'), '192.0.2.7.1.1', ['192.0.2.1.1.1', 0x8001], 7);
  const data = cnc.encodeFrame(frame),
    received = new Uint8Array(1 + 1_000 * data.length).subarray(1);
  for (let at = 0; at < received.length; at += data.length) received.set(data, at);
  assert.equal(
    copied(() => assert.deepEqual(cnc.readFrame(received), { frame, length: data.length })),
    data.length,
  );
  for (let length = 0; length < data.length; length += 1)
    assert.equal(cnc.readFrame(received.subarray(0, length)), null);
  const wrong = (at, value) => Uint8Array.from(received, (byte, n) => (n === at ? value : byte));
  for (const [at, value, error] of [
    [0, 1, /ams-tcp-header: reserved at offset 0: mismatch, expected 0, found 1/],
    [2, 31, /ams-tcp-header: length at offset 2: out of range, expected 32, found 31/],
    [5, 255, /ams-tcp-header: length/],
    [26, 1, /ams-header: data_length at offset 26: mismatch/],
  ])
    assert.throws(() => cnc.readFrame(wrong(at, value)), error);
});

test('a NetId has six numbers of one byte, and a port has two bytes', () => {
  const frame = cnc.frameOfCall(cnc.readByName(1, 'a'), '192.0.2.7.1.1', ['192.0.2.1.1.1', 1], 7);
  const header = cnc.decode('ams-header', bytes(...Array(32).fill(1)));
  for (const netId of [
    '',
    '1.2.3.4.5',
    '1.2.3.4.5.6.7',
    '1.2.3.4.5.256',
    '1.2.3.4.5.',
    '1.2.3.4.5.x',
    '1.2.3.4.5.-1',
    '1.2.3.4.5. 6',
    '1.2.3.4.5.0x6',
    '1.2.3.4.5.0006',
  ]) {
    const message = (name) => `${name}: six numbers from 0 to 255 expected, found ${netId}`;
    const wrong = { name: 'RangeError', message: message('target NetId') };
    assert.throws(() => cnc.encodeFrame({ ...frame, target: [netId, 1] }), wrong, netId);
    wrong.message = message('target_net_id');
    assert.throws(() => cnc.encode('ams-header', { ...header, targetNetId: netId }), wrong, netId);
  }
  for (const port of [-1, 0x10000, 1.5]) {
    assert.throws(() => cnc.encodeFrame({ ...frame, source: ['1.2.3.4.5.6', port] }), {
      name: 'RangeError',
      message: `source port: ${port} is not an unsigned number of 16 bits`,
    });
  }
  const end = ['255.0.3.4.5.6', 0xffff];
  assert.deepEqual(
    cnc.encodeFrame({ ...frame, target: end }).slice(6, 14),
    bytes(255, 0, 3, 4, 5, 6, 255, 255),
  );
});

test('a program is sent', () => {
  const sender = new cnc.Sender(ascii('N10 G0 X0\nN20 M30')),
    sent = [];
  for (const result of [0x706, 0]) {
    sent.push(Buffer.from(sender.packet()).toString());
    sender.acknowledge(result);
  }
  assert.deepEqual(sent, Array(2).fill('N10 G0 X0\r\nN20 M30\r\n'));
  assert.equal(sender.packet(), null);
  assert.deepEqual([sender.progress.state, sender.progress.lines], [4, 2]);
  assert.throws(() => sender.acknowledge(0), /no packet/);
  assert.throws(
    () => new cnc.Sender(ascii('N1\xe4')),
    /nc-text: line at offset 3: a byte that is not ASCII/,
  );
});

test('a sender has a copy of the program, and copies it once', () => {
  for (const program of [ascii('N10 G0 X0\nN20 M30\n'), Buffer.from('N10 G0 X0\nN20 M30\n')]) {
    const sender = new cnc.Sender(program);
    program.fill(0);
    assert.equal(Buffer.from(sender.packet()).toString(), 'N10 G0 X0\r\nN20 M30\r\n');
  }
  const program = ascii('N10 G0 X0\n'.repeat(10_000)),
    [one, two] = [new cnc.Sender(program), new cnc.Sender(ascii('M30\n'))];
  // Calls of other senders and of the codec in between must not change a sender.
  const count = copied(() => {
    for (let n = 1; one.packet(); n += 1) {
      assert.equal(Buffer.from(two.packet()).toString(), 'M30\r\n');
      assert.equal(cnc.readByName(1, 'V.E.a').data.length, 6);
      one.acknowledge(0);
      assert.equal(one.progress.packets, n);
    }
  });
  assert.deepEqual([one.progress.state, one.progress.lines, two.progress.state], [4, 10_000, 1]);
  assert.ok(count < program.length, `${count} bytes copied`);
});

test('a request is served', () => {
  const uuid = '560AACBF-6335-44a9-895A-8B27F3ED5E47',
    written = [];
  const host = new cnc.Host([uuid.replace('5', '6'), uuid]);
  const values = { UUID: ascii(uuid), REQUEST: ascii('L\xe4nge\0'), REQUEST_STATE: bytes(1, 0, 0, 0) };
  for (let step; (step = host.step()).kind !== 'wait';) {
    if (step.kind === 'read') host.read(values[step.variable.split('.').at(-1)]);
    else if (step.kind === 'serve') {
      assert.deepEqual([step.service, step.request, step.requestState], [1, 'Länge', 1]);
      host.answer('5', 1);
    } else {
      written.push([step.variable, step.data]);
      host.written();
    }
  }
  assert.deepEqual(written[0], ['V.G.SERVICE.RESPONSE', ascii('5\0')]);
  assert.equal(host.outcome, 'answered');
  assert.throws(() => new cnc.Host(['no UUID']), cnc.AdsCncError);
});

test('the example of the README prints its comments', async () => {
  const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8'),
    shown = [];
  const [, code] = readme.match(/```js\n([^]*?)```/);
  const { inspect } = await import('node:util');
  const log = (...all) => shown.push(all.map((one) => inspect(one)).join(' '));
  new Function('cnc', 'console', code.replace(/^import.*$/m, ''))(cnc, { log });
  assert.deepEqual(
    shown,
    [...code.matchAll(/console\.log\(.*\); \/\/ (.*)/g)].map(([, text]) => text),
  );
});
