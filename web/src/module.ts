// SPDX-License-Identifier: MIT
// The module of WebAssembly: started once, and called through rows of numbers in its memory.

/** The library's refusal, in its own words, as in C++ and Python. */
export class DomainError extends Error {
  override name = "DomainError";
}

/** What web/core/polhode_web.h exports; pointers are numbers. */
type Call = (...values: number[]) => number;
interface Exports {
  readonly memory: WebAssembly.Memory;
  readonly [name: `polhode_${string}`]: Call;
}

let exports: Exports | undefined;
let starting: Promise<void> | undefined;
// Arguments and results of one call, each of at most ROOM numbers.
const ROOM = 64;
let desk = 0;

/** A path or an address, a URL, a Response, bytes, or a WebAssembly.Module; typed without the names of a
 *  browser, which programs for Node need not know. */
export type Source = string | object;

/** Compiles and starts the core; later calls return at once. Without a source: the file polhode.wasm
 *  beside this script. */
export function load(source?: Source): Promise<void> {
  starting ??= start(source).catch((error: unknown) => {
    starting = undefined;
    throw error;
  });
  return starting;
}

/** The same of bytes that are there, at once: for Node and workers. Where a page is drawn, browsers
 *  refuse to compile so much while it waits. */
export function loadSync(bytes: ArrayBuffer | ArrayBufferView): void {
  if (exports !== undefined) return;
  const module = new WebAssembly.Module(bytes as BufferSource);
  begin(new WebAssembly.Instance(module, imports(module)));
  starting = Promise.resolve();
}

async function start(source: Source = new URL("./polhode.wasm", import.meta.url)): Promise<void> {
  const module = source instanceof WebAssembly.Module ? source : await compiled(source);
  begin(await WebAssembly.instantiate(module, imports(module)));
}

function begin(instance: WebAssembly.Instance): void {
  if (exports !== undefined) return; // what has been prepared lies in the memory of the first
  (instance.exports["_initialize"] as (() => void) | undefined)?.();
  exports = instance.exports as unknown as Exports;
  desk = allocate(2 * ROOM);
}

async function compiled(source: Source): Promise<WebAssembly.Module> {
  if (source instanceof Response) return WebAssembly.compile(await source.arrayBuffer());
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source))
    return WebAssembly.compile(source as BufferSource);
  const url = new URL(String(source), import.meta.url);
  if (url.protocol === "file:" && typeof process !== "undefined") {
    const files = "node:fs/promises"; // a bundler for the browser need not find it
    const { readFile } = (await import(files)) as typeof import("node:fs/promises");
    return WebAssembly.compile(new Uint8Array(await readFile(url)));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url.href}: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

// What the module asks for: digits of numbers, and word of memory that has grown; what it would ask of
// an operating system, nothing but an abort calls.
function imports(module: WebAssembly.Module): WebAssembly.Imports {
  const result: Record<string, Record<string, WebAssembly.ImportValue>> = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (result[from] ??= {})[name] = fail;
  return { ...result, env: { ...result["env"], emscripten_notify_memory_growth: () => undefined, polhode_digits: digits } };
}

function fail(): never {
  throw new Error("polhode: the core stopped");
}

// std::to_chars of the core: significant digits as text into memory, and the exponent.
function digits(value: number, count: number, to: number, exponent: number): number {
  const text = count > 0 ? value.toExponential(count - 1) : value.toExponential();
  const [mantissa = "", power = "0"] = text.split("e");
  const found = mantissa.replace(".", "");
  const memory = core().memory.buffer;
  new Uint8Array(memory, to, found.length).set(new TextEncoder().encode(found));
  new DataView(memory).setInt32(exponent, Number(power), true);
  return found.length;
}

function core(): Exports {
  if (exports === undefined) throw new Error("polhode: await load() first");
  return exports;
}

/** The sentence at an address. */
function text(address: number): string {
  const bytes = new Uint8Array(core().memory.buffer, address);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

export function refusal(): string {
  return text(call("refusal"));
}
export function version(): string {
  return text(call("version"));
}

/** Calls polhode_NAME. */
export function call(name: string, ...values: number[]): number {
  return (core()[`polhode_${name}`] as Call)(...values);
}
/** The same of a function that may refuse. */
export function checked(name: string, ...values: number[]): void {
  if (call(name, ...values) !== 0) throw new DomainError(refusal());
}

/** Where arguments lie for one call: so many numbers, and after them room for results. */
export function args(count: number, ...values: readonly number[]): number {
  if (values.length !== count)
    throw new RangeError(
      `polhode: got ${values.length} numbers, expected ${count}; vectors have 3, quaternions 4, matrices 9`,
    );
  new Float64Array(core().memory.buffer, desk, ROOM).set(values);
  return desk;
}
export function results(): number {
  return desk + 8 * ROOM;
}
/** Copies of the first results. */
export function result(count: number): number[] {
  return [...new Float64Array(core().memory.buffer, results(), count)];
}
export function setResult(index: number, value: number): void {
  new Float64Array(core().memory.buffer, results(), ROOM)[index] = value;
}

// Numbers that fill the memory of the module, 2 GB.
const MOST = 2 ** 28;

function allocate(numbers: number): number {
  const address = numbers > MOST ? 0 : call("allocate", 8 * numbers);
  if (address === 0) throw new RangeError(`polhode: no memory for ${numbers} numbers`);
  return address;
}
export const release = (address: number): void => {
  call("release", address);
};

// Room for rows, kept between calls: a picture asks for as many again.
let rows = { address: 0, size: 0 };

/** How many numbers `rows` rows of `size` have; RangeError for what counts no rows. */
export function numbersOf(rows: number, size: number, least = 0): number {
  const most = Math.floor(MOST / size);
  if (!Number.isInteger(rows) || rows < least || rows > most)
    throw new RangeError(`polhode: got a count of ${rows}, expected a whole number from ${least} to ${most}`);
  return rows * size;
}

/** Lets `fill` write `count` numbers at an address, with `input` before them where there is some, and
 *  copies what it says it wrote (all, unless it returns a number) into `out` or a new array. */
export function filled(
  count: number,
  out: Float64Array | undefined,
  fill: (address: number, input: number) => number | void,
  input?: ArrayLike<number>,
): Float64Array {
  if (out !== undefined && out.length < count)
    throw new RangeError(`polhode: room for ${out.length} numbers; expected ${count}`);
  const before = input?.length ?? 0;
  if (before + count > rows.size) {
    if (rows.size > 0) release(rows.address);
    rows = { address: 0, size: 0 };
    rows = { address: allocate(before + count), size: before + count };
  }
  const { address } = rows;
  if (input !== undefined) new Float64Array(core().memory.buffer, address, before).set(input);
  const made = fill(address + 8 * before, address) ?? count;
  const found = new Float64Array(core().memory.buffer, address + 8 * before, made);
  if (out === undefined) return found.slice();
  out.set(found);
  return out;
}
