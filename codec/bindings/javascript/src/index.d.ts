// Types that do not depend on the tables of functions and streams; the build generates the others.

/** An ADS call, as a client sends it and a server receives it. */
export interface Call {
  /** AMS port: 551 GEO, 552 SDA, 553 COM */
  port: number;
  /** AMS command: 2 Read, 3 Write, 9 ReadWrite */
  command: number;
  indexGroup: number;
  indexOffset: number;
  /** the maximum length of the reply in bytes */
  readLength: number;
  data: Uint8Array;
}

/** A request to send. Pass the reply to `decode`. */
export interface Request<T> extends Call {
  function: FunctionInfo;
  /** Decodes a reply. Pass the received bytes only, not a buffer of `readLength` bytes. */
  decode(reply: Uint8Array): T;
}

/** The error for invalid bytes or values. */
export class AdsCncError extends Error {
  /** the stream or other subject at fault */
  stream: string;
  /** the field or argument at fault, or empty */
  field: string;
  /** the offset of the fault in the stream */
  offset: number;
  kind: string;
  expected: number;
  found: number;
  /** the ADS error number for the response of a server; 0 for a client */
  adsError: number;
}

export interface FieldInfo {
  name: string;
  meaning: string;
  clause: string;
  /** 1 unsigned, 2 BOOLEAN, 3 REAL64, 4 text, 5 NetId, 6 bytes */
  kind: number;
  /** size of the field or of one item in bytes; 0 if it varies */
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
  /** name for variables and elements */
  name: string;
  /** name for objects */
  objectName: string;
  /** code in a description; 0 if variables do not use the type */
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

/** Decodes a stream: to its only field, to a record, or to a list of records if the stream repeats; to null if the
 * data contains no field. */
export function decode(stream: string, data: Uint8Array): unknown;
/** Encodes a stream, the inverse of `decode`. Bytes are written unchanged. */
export function encode(stream: string, value: unknown): Uint8Array;
/** Splits a stream into its fields, with their bytes. */
export function fields(stream: string, data: Uint8Array): Field[];
/** Builds a stream from the bytes of its fields, the inverse of `fields`. Counts may be omitted. */
export function join(stream: string, parts: [name: string, data: Uint8Array][]): Uint8Array;

/** Converts CP1252 to text, up to the first NUL or the end. */
export function textFromCp1252(data: Uint8Array): string;
/** Converts a text to CP1252, without a NUL. */
export function textToCp1252(text: string): Uint8Array;

export type Scalar = number | bigint | boolean | string;
export type Value = Scalar | Value[];
/** Decodes a value by its type (a name, or a code from a description); an array to nested arrays. The result is an
 * empty array if a dimension is 0. */
export function unpack(type: string | number, data: Uint8Array, dimensions?: number[]): Value;
/** Encodes a value, the inverse of `unpack`. A text gets a NUL; pass the texts of an array as bytes. Throws a
 * `RangeError` for a number that the type cannot represent, and a `TypeError` for a value of another type. */
export function pack(type: string | number, value: Value | Uint8Array | Uint8Array[]): Uint8Array;

/** A dispatched call: its function and arguments. */
export interface Dispatched {
  function: FunctionInfo;
  arguments: Record<string, number | boolean | string | number[] | Uint8Array>;
  /** Encodes the reply. The server must check that it is not longer than the `readLength` of the call. */
  reply(value?: unknown): Uint8Array;
}
/** Dispatches a received call. If it throws, answer with the `adsError` of the exception. */
export function dispatch(received: Call): Dispatched;

/** The parts of an index group, as words; parts that a group does not have are empty. */
export interface Group {
  task: string;
  access: string;
  addressing: string;
  table: string;
  objectClass: string;
  attribute: string;
  instance: number;
}
/** Parses an index group; null if it is not documented. */
export function groupParts(indexGroup: number): Group | null;
/** The index offset of an element of an axis; axis 0 is the channel itself. */
export function axisOffset(axis: number, element: number, stride?: number): number;
/** The axis and the element of an index offset. */
export function axisAndElement(offset: number, stride?: number): [axis: number, element: number];

/** The parts of the name of a variable. */
export interface Path {
  kind: string;
  parts: { name: string; indices: number[] }[];
}
/** Parses the name of a variable. */
export function path(name: string): Path;

/** A NetId of six numbers from 0 to 255, and a port from 0 to 65535: ['192.0.2.7.1.1', 552] */
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
/** Creates the frame of a request. */
export function frameOfCall(call: Call, targetNetId: string, source: Address, invokeId: number): Frame;
/** Decodes the call in the frame of a request. */
export function callOfFrame(frame: Frame): Call;
/** Encodes a frame, including both lengths. */
export function encodeFrame(frame: Frame): Uint8Array;
/** Decodes the first received frame, and returns its length; null if the frame is not complete yet. */
export function readFrame(received: Uint8Array, maxData?: number): { frame: Frame; length: number } | null;

export const BUSY: 1;
export const REJECTED: 2;

/** Sends an NC program: returns packets to write by `writeProgramStream`, and accepts the results. */
export class Sender {
  /** Copies the program: later changes of the array have no effect. */
  constructor(program: Uint8Array);
  /** The packet to write now; null if no packet is left. */
  packet(): Uint8Array | null;
  /**
   * Reports the ADS result of the write, a number of 32 bits, or null if the reply was lost.
   * Returns 0, BUSY (wait about half a second, then repeat) or REJECTED.
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

/** Hosts the services of a channel: returns the variable to read or write next. */
export class Host {
  constructor(services: string[]);
  /** The next step. Returns the same step until a read value, an answer or an event is reported. */
  step(): Step;
  /** Reports the value that was read. */
  read(value: Uint8Array): void;
  /** Answers the request. The state must not be 0. */
  answer(response: string, state: number): void;
  /** Reports that the write was done. */
  written(): void;
  /** Reports that the step failed; a write may have taken effect. */
  failed(): void;
  /** Ends a wait. */
  poll(): void;
  /** Starts again, after a reset of the CNC or on a new connection. */
  restart(): void;
  /** The outcome of the last answer; null before the first answer, and until the outcome of an answer is known. */
  get outcome(): 'answered' | 'abandoned' | null;
}
