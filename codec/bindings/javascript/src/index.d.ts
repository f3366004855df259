// Types of what is the same for all functions and streams; theirs are generated at the build.

/** A call as ADS carries it: what a client sends, what a server receives. */
export interface Call {
  /** AMS port: 551 GEO, 552 SDA, 553 COM */
  port: number;
  /** AMS command: 2 Read, 3 Write, 9 ReadWrite */
  command: number;
  indexGroup: number;
  indexOffset: number;
  /** the most bytes of the reply */
  readLength: number;
  data: Uint8Array;
}

/** What to send; `decode` reads what comes back. */
export interface Request<T> extends Call {
  function: FunctionInfo;
  /** The value of a reply: of all bytes that were received, not of as many as were asked for. */
  decode(reply: Uint8Array): T;
}

/** Bytes, or a value, that cannot be. */
export class AdsCncError extends Error {
  /** the stream, or what else is at fault */
  stream: string;
  /** the field, or the argument */
  field: string;
  /** where the field begins in the stream */
  offset: number;
  kind: string;
  expected: number;
  found: number;
  /** the number that a server answers with; 0 for an error of a client */
  adsError: number;
}

export interface FieldInfo {
  name: string;
  meaning: string;
  clause: string;
  /** 1 unsigned, 2 BOOLEAN, 3 REAL64, 4 text, 5 NetId, 6 bytes */
  kind: number;
  /** bytes of the field or of one item; 0 if they vary */
  size: number;
  isCount: boolean;
  isList: boolean;
}

export interface StreamInfo {
  name: string;
  title: string;
  max: number;
  repeats: boolean;
  fields: FieldInfo[];
}

export interface FunctionInfo {
  name: string;
  operation: string;
  port: number;
  command: number;
  /** 0 none, 1 changes a value, 2 may move an axis */
  effect: number;
  request: string | null;
  reply: string | null;
  arguments: string[];
}

export interface TypeInfo {
  /** of variables and elements */
  name: string;
  /** of objects */
  objectName: string;
  /** in a description; 0 if no variable has the type */
  code: number;
  /** 0 BOOLEAN, 1 unsigned, 2 signed, 3 float, 4 text */
  kind: number;
  size: number;
}

export const STREAMS: Record<string, StreamInfo>;
export const FUNCTIONS: FunctionInfo[];
export const TYPES: TypeInfo[];

/** A field of a decoded stream, or an item of a list. */
export interface Field {
  name: string;
  record: number;
  item: number;
  offset: number;
  data: Uint8Array;
}

/** The value of a stream: its only field, or a record; a list of records of a stream of such. */
export function decode(stream: string, data: Uint8Array): unknown;
/** The bytes of a stream, the reverse of `decode`; bytes are written as they are. */
export function encode(stream: string, value: unknown): Uint8Array;
/** The fields of a stream, with their bytes. */
export function fields(stream: string, data: Uint8Array): Field[];
/** A stream from the bytes of its fields, the reverse of `fields`. Counts may be left out. */
export function join(stream: string, parts: [name: string, data: Uint8Array][]): Uint8Array;

/** CP1252 before the first NUL, or all, as text. */
export function textFromCp1252(data: Uint8Array): string;
/** A text as CP1252, without a NUL. */
export function textToCp1252(text: string): Uint8Array;

export type Scalar = number | bigint | boolean | string;
export type Value = Scalar | Value[];
/** A value by its type, which is a name or the code of a description; of arrays, nested arrays. */
export function unpack(type: string | number, data: Uint8Array, dimensions?: number[]): Value;
/** The bytes of a value, the reverse of `unpack`. A text is ended by a NUL; texts in an array need bytes. */
export function pack(type: string | number, value: Value | Uint8Array | Uint8Array[]): Uint8Array;

/** What a call received asks for. */
export interface Dispatched {
  function: FunctionInfo;
  arguments: Record<string, number | boolean | string | number[] | Uint8Array>;
  /** The data to answer with. A server checks that it is not longer than the call's `readLength`. */
  reply(value?: unknown): Uint8Array;
}
/** The function that a call received is to; the `adsError` of the exception is the number to answer with. */
export function dispatch(received: Call): Dispatched;

/** An index group in words; those that it has not are empty. */
export interface Group {
  task: string;
  access: string;
  addressing: string;
  table: string;
  objectClass: string;
  attribute: string;
  instance: number;
}
/** The parts of an index group; null for one that is not documented. */
export function groupParts(indexGroup: number): Group | null;
/** The index offset of an element of an axis; axis 0 is the channel itself. */
export function axisOffset(axis: number, element: number, stride?: number): number;
/** The axis and the element of an index offset. */
export function axisAndElement(offset: number, stride?: number): [axis: number, element: number];

/** The name of a variable, by its parts. */
export interface Path {
  kind: string;
  parts: { name: string; indices: number[] }[];
}
/** Takes the name of a variable apart. */
export function path(name: string): Path;

/** A NetId and a port: ['192.0.2.7.1.1', 552] */
export type Address = [netId: string, port: number];
/** An AMS/TCP frame. */
export interface Frame {
  target: Address;
  source: Address;
  command: number;
  /** 4 request, 5 response */
  stateFlags: number;
  error: number;
  invokeId: number;
  data: Uint8Array;
}
/** The frame of a request. */
export function frameOfCall(call: Call, targetNetId: string, source: Address, invokeId: number): Frame;
/** The call of a request's frame. */
export function callOfFrame(frame: Frame): Call;
/** The bytes of a frame, with both lengths. */
export function encodeFrame(frame: Frame): Uint8Array;
/** The frame at the front of what was received, and its length; null if bytes are missing. */
export function readFrame(received: Uint8Array, maxData?: number): { frame: Frame; length: number } | null;

export const BUSY: 1;
export const REJECTED: 2;

/** Sends an NC program: hands out packets to write by `writeProgramStream`, and takes what became of them. */
export class Sender {
  constructor(program: Uint8Array);
  /** The packet to write now; null if none is left. */
  packet(): Uint8Array | null;
  /**
   * What the CNC answered: an ADS result, or null if the answer was lost.
   * Gives 0, BUSY (then wait about half a second) or REJECTED.
   */
  acknowledge(adsError: number | null): 0 | typeof BUSY | typeof REJECTED;
  get progress(): {
    /** 0 ready, 1 in flight, 2 waiting, 3 stopped, 4 done */
    state: number;
    packets: number;
    lines: number;
    bytes: number;
    leftLines: number;
    leftBytes: number;
    busyCount: number;
  };
}

export type Step =
  | { kind: 'wait' }
  | { kind: 'read'; variable: string }
  | { kind: 'write'; variable: string; data: Uint8Array }
  | { kind: 'serve'; service: number; request: string; requestState: number };

/** Hosts services of one channel: gives the variable to read or write next. */
export class Host {
  constructor(services: string[]);
  /** What to do next; the same until it is done. */
  step(): Step;
  /** The value that was read. */
  read(value: Uint8Array): void;
  /** The response to the request, and its state, not 0. */
  answer(response: string, state: number): void;
  /** The write was done. */
  written(): void;
  /** The step failed: a write may have been done. */
  failed(): void;
  /** The wait is over. */
  poll(): void;
  /** The CNC was reset, or the connection is new. */
  restart(): void;
  /** What became of the last answer. */
  get outcome(): 'answered' | 'abandoned' | null;
}
