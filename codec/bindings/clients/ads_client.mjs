// Reads and writes the simulated CNC with ads-client.
//
//     node ads_client.mjs TCP-PORT EXPECTED.json
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { Client } from 'ads-client';
import * as cnc from 'ads-cnc';

const [tcpPort, expectedFile] = process.argv.slice(2);
const expected = JSON.parse(readFileSync(expectedFile, 'utf8'));
const client = new Client({
  targetAmsNetId: '127.0.0.1.1.1',
  targetAdsPort: 552,
  // A direct connection to the CNC, without a router: requires the addresses of both ends.
  routerAddress: '127.0.0.1',
  routerTcpPort: Number(tcpPort),
  localAmsNetId: '127.0.0.1.1.9',
  localAdsPort: 32900,
  // Do not read the symbols and the state of a PLC, because a CNC has neither of them.
  rawClient: true,
});

async function send(request) {
  const { command, indexGroup, indexOffset, readLength, port } = request;
  const data = Buffer.from(request.data);
  const to = { adsPort: port };
  if (command === 3) {
    await client.writeRaw(indexGroup, indexOffset, data, to);
    return undefined;
  }
  const reply = command === 2
    ? await client.readRaw(indexGroup, indexOffset, readLength, to)
    : await client.readWriteRaw(indexGroup, indexOffset, readLength, data, to);
  return request.decode(reply);
}

function shown(what, found, wanted) {
  assert.deepEqual(found, wanted, what);
  console.log(`${what}: ${JSON.stringify(found)}`);
}

async function read(name) {
  const { type, dimensions } = await send(cnc.describeByName(1, name));
  return cnc.unpack(type, await send(cnc.readByName(1, name)), dimensions);
}

async function main() {
  // Describe all variables of the kind V.E, by index.
  const count = await send(cnc.countVariables(1, 'V.E'));
  const listed = [];
  for (let index = 0; index < count; index += 1) {
    const { name, type, dimensions } = await send(cnc.describeByIndex(1, index, 'V.E'));
    listed.push([name, cnc.TYPES.find((it) => it.code === type).name, dimensions]);
  }
  assert.deepEqual(listed, expected.variables);
  console.log(`V.E: ${count} variables, ${listed[0][0]} to ${listed.at(-1)[0]}`);

  for (const [name, value] of Object.entries(expected.read)) shown(name, await read(name), value);
  for (const [name, [type, value]] of Object.entries(expected.write)) {
    await send(cnc.writeByName(1, name, cnc.pack(type, value)));
    shown(`${name}, written`, await read(name), value);
  }

  // Find an element of SDA by name: query the instance of the class, then read the names of its elements.
  const { indexGroup, indexOffset } = await send(cnc.findInstance('HLD', 1, 0));
  const elements = await send(cnc.countElements(indexGroup, indexOffset));
  const names = [];
  for (let at = 1; at <= elements; at += 1) {
    names.push(await send(cnc.readElementName(indexGroup, indexOffset + at)));
  }
  const [element, ...wanted] = expected.element;
  assert(names.includes(element), `no element ${element}`);
  const at = indexOffset + 1 + names.indexOf(element);
  const type = await send(cnc.readElementType(indexGroup, at));
  const size = await send(cnc.readElementLength(indexGroup, at));
  const value = cnc.unpack(type, await send(cnc.readElement(indexGroup, at, size)));
  shown(`${element} at 0x${indexGroup.toString(16)}, ${at}`, [type, value], wanted);

  const failure = await read('V.E.nothing').catch((error) => error);
  shown('V.E.nothing, ADS error', failure.adsError?.errorCode, 0x710);

  // A reply padded with zeros to the read length, like one from a library that does not return the length.
  const request = cnc.describeByIndex(1, 0, 'V.E');
  const { indexGroup: group, indexOffset: offset, readLength, data } = request;
  const reply = await client.readWriteRaw(group, offset, readLength, Buffer.from(data));
  const padded = Buffer.concat([reply], readLength);
  assert.throws(() => request.decode(padded), (error) => {
    assert(error instanceof cnc.AdsCncError);
    shown('a padded reply', [error.stream, error.field, error.offset], ['variable-description', 'name', 20]);
    return true;
  });
}

await client.connect();
try {
  await main();
} finally {
  await client.disconnect();
}
