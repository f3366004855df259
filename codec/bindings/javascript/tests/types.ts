// tsc --strict compiles this file, to check that results have the types that a program expects.
import * as cnc from 'ads-cnc';

const description: cnc.VariableDescription = cnc.describeByIndex(1, 2, 'V.E').decode(new Uint8Array());
const dimensions: number[] = description.dimensions;
const value: Uint8Array = cnc
  .readByHandle(1, description.handle, [0, 1], { byIndex: true })
  .decode(new Uint8Array());
const elements: cnc.Value = cnc.unpack(description.type, value, dimensions);
const count: number = cnc.countObjects(0, { axis: 1 }).decode(new Uint8Array());
const names: string[] = cnc
  .readDescriptors(1, 1, count)
  .decode(new Uint8Array())
  .map((one) => one.name);
const extended: cnc.VariableExtendedDescription | null = cnc
  .describeExtended(1, 0, 'V.E')
  .decode(new Uint8Array());
const written: undefined = cnc.writeByName(1, 'V.E.a', cnc.pack('REAL64', 1.5)).decode(new Uint8Array());
// @ts-expect-error: a name is needed
cnc.readByName(1);
// @ts-expect-error: not a number
const wrong: number = cnc.readByName(1, 'V.E.a').decode(new Uint8Array());
export const all = [elements, names, extended, written, wrong];
