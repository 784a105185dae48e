// The module in memory: how its functions are called, and how the structs of the C interface
// (bindings/c/include/foretouch) are written and read there. Options that are left out are C's.

export type Point = readonly [number, number, number];

/** What was given cannot be used; the message says where, and what was expected. */
export class ForetouchError extends Error {
  override readonly name = "ForetouchError";
}

type Scalar = "i32" | "u32" | "i64" | "u64" | "f64" | "pointer";
/** A struct within another one. */
interface Inner {
  readonly size: number;
  readonly align: number;
  read(memory: DataView, from: number): unknown;
  write(memory: DataView, to: number, given: never, what: string): void;
}
type Field = Scalar | "point" | Inner;
export type Fields = Readonly<Record<string, Field>>;
type ValueOf<F> = F extends Scalar ? number : F extends "point" ? Point : F extends Struct<infer M> ? Values<M> : never;
type Hidden = "size" | `reserved${string}`;
/** A struct that was read: whole numbers are numbers, whatever their width. */
export type Values<M> = { readonly [K in keyof M as K extends Hidden ? never : K]: ValueOf<M[K]> };
type WriteOf<F> = F extends "point" ? ArrayLike<number> : F extends Struct<infer M> ? Writes<M> : number | boolean;
/** What is written into one: the fields that are to be other than they are. */
export type Writes<M> = { readonly [K in keyof M as K extends Hidden ? never : K]?: WriteOf<M[K]> | undefined };

const widths: Readonly<Record<string, number>> = { i32: 4, u32: 4, pointer: 4, i64: 8, u64: 8, f64: 8, point: 24 };
export function pointAt(memory: DataView, at: number): Point {
  return [memory.getFloat64(at, true), memory.getFloat64(at + 8, true), memory.getFloat64(at + 16, true)];
}

type Reader = (memory: DataView, at: number) => unknown;
const readers: Readonly<Record<Scalar | "point", Reader>> = {
  i32: (memory, at) => memory.getInt32(at, true),
  u32: (memory, at) => memory.getUint32(at, true),
  pointer: (memory, at) => memory.getUint32(at, true),
  i64: (memory, at) => Number(memory.getBigInt64(at, true)),
  u64: (memory, at) => Number(memory.getBigUint64(at, true)),
  f64: (memory, at) => memory.getFloat64(at, true),
  point: pointAt,
};
const isHidden = (name: string): boolean => name === "size" || name.startsWith("reserved");

/** A C struct as the module has it, where pointers have four bytes. Its names are C's in camelCase. */
export class Struct<M extends Fields> {
  readonly size: number;
  readonly align: number;
  readonly places = new Map<string, { readonly at: number; readonly field: Field }>();
  private readonly shown: { readonly name: string; readonly at: number; readonly read: Reader }[];

  constructor(readonly fields: M) {
    let at = 0, widest = 4;
    for (const [name, field] of Object.entries(fields)) {
      const size = typeof field === "string" ? widths[field] : field.size;
      const align = typeof field === "string" ? Math.min(size, 8) : field.align;
      at = Math.ceil(at / align) * align;
      this.places.set(name, { at, field });
      at += size;
      widest = Math.max(widest, align);
    }
    this.align = widest;
    this.size = Math.ceil(at / widest) * widest;
    this.shown = Array.from(this.places, ([name, { at, field }]) => ({ name, at, read: typeof field === "string" ? readers[field] : field.read.bind(field) })).filter(
      ({ name }) => !isHidden(name),
    );
  }

  read(memory: DataView, from: number): Values<M> {
    const values: Record<string, unknown> = {};
    for (const { name, at, read } of this.shown) values[name] = read(memory, from + at);
    return values as Values<M>;
  }

  /** Where a field lies in it. */
  placeOf(name: keyof M & string): number {
    return this.places.get(name)?.at ?? 0;
  }

  /** `what`: the struct's name in messages. */
  write(memory: DataView, to: number, given: Writes<M>, what: string): void {
    for (const [name, value] of Object.entries(given)) {
      if (value === undefined) continue;
      const place = isHidden(name) ? undefined : this.places.get(name);
      if (place === undefined) throw new ForetouchError(`${what}: expected another option than '${name}'`);
      writeField(memory, to + place.at, place.field, value, name);
    }
  }
}

function writeField(memory: DataView, at: number, field: Field, value: unknown, name: string): void {
  if (field === "point") {
    point(value as ArrayLike<number>, name).forEach((number, axis) => memory.setFloat64(at + 8 * axis, number, true));
    return;
  }
  if (typeof field !== "string") return field.write(memory, at, value as never, name);
  const given = typeof value === "boolean" ? Number(value) : value;
  if (field === "i32") memory.setInt32(at, whole(given, name), true);
  else if (field === "u32" || field === "pointer") memory.setUint32(at, whole(given, name, 0, 2 ** 32 - 1), true);
  else if (field === "i64") memory.setBigInt64(at, instant(given, name), true);
  else if (field === "u64") memory.setBigUint64(at, given === Infinity ? 2n ** 64n - 1n : BigInt(whole(given, name, 0, Number.MAX_SAFE_INTEGER)), true);
  else memory.setFloat64(at, real(given, name), true);
}

// What JavaScript is given: WebAssembly would make 0 of what is not a number.

/** What is not known is NaN in C, and null here. */
export function known(value: number): number | null {
  return Number.isNaN(value) ? null : value;
}

/** A number. C judges its value, and refuses NaN by what it expects. */
export function real(value: unknown, name: string): number {
  if (typeof value !== "number") throw new ForetouchError(`${name}: expected a number, found ${String(value)}`);
  return value;
}

export function whole(value: unknown, name: string, least = -(2 ** 31), most = 2 ** 31 - 1): number {
  if (typeof value === "number" && Number.isInteger(value) && value >= least && value <= most) return value;
  throw new ForetouchError(`${name}: expected a whole number from ${least} to ${most}, found ${String(value)}`);
}

/** Microseconds, as C takes them. */
export function instant(value: unknown, name: string): bigint {
  if (typeof value === "number" && Number.isSafeInteger(value)) return BigInt(value);
  throw new ForetouchError(`${name}: expected whole microseconds within 2^53, found ${String(value)}`);
}

export function point(value: ArrayLike<number>, name: string): Point {
  const [x, y, z] = Array.from(value ?? []);
  if (value?.length !== 3) throw new ForetouchError(`${name}: expected three numbers, found ${String(value)}`);
  return [real(x, name), real(y, name), real(z, name)];
}

/** The number that C has for a word: its place among all. */
export function numberOf(words: readonly string[], word: string | undefined, name: string): number | undefined {
  if (word === undefined) return undefined;
  const number = words.indexOf(word);
  if (number < 0) throw new ForetouchError(`${name}: expected one of ${words.join(", ")}, found ${String(word)}`);
  return number;
}

type Call = (...values: (number | bigint)[]) => number;

interface Exports extends Record<string, unknown> {
  readonly memory: WebAssembly.Memory;
}

export class Machine {
  constructor(private readonly exports: Exports) {}

  call(name: string, ...values: (number | bigint)[]): number {
    return (this.exports[name] as Call)(...values);
  }

  /** The same for a function that answers with a status. */
  ask(name: string, ...values: (number | bigint)[]): void {
    if (this.call(name, ...values) !== 0) throw new ForetouchError(inWordsOfJavaScript(this.text(this.call("ft_last_error"))));
  }

  /** Valid until memory grows, which any call may make it do. */
  view(): DataView {
    return new DataView(this.exports.memory.buffer);
  }

  /** A copy. */
  doubles(at: number, count: number): Float64Array {
    return new Float64Array(this.exports.memory.buffer, at, count).slice();
  }

  text(at: number): string {
    const memory = new Uint8Array(this.exports.memory.buffer);
    return new TextDecoder().decode(memory.subarray(at, memory.indexOf(0, at)));
  }

  /** Lends memory to a few calls, for what they are given and answer. */
  within<T>(use: (room: Room) => T): T {
    const room = new Room(this);
    try {
      return use(room);
    } finally {
      room.end();
    }
  }
}

/** Memory of the module, until end(). */
export class Room {
  private readonly taken: number[] = [];

  constructor(readonly machine: Machine) {}

  take(bytes: number): number {
    const at = this.machine.call("malloc", Math.max(1, bytes)) >>> 0;
    if (at === 0) throw new ForetouchError("expected memory for this, found none left");
    this.taken.push(at);
    return at;
  }

  end(): void {
    for (const at of this.taken) this.machine.call("free", at);
  }

  doubles(values: ArrayLike<number>): number {
    const at = this.take(8 * values.length);
    new Float64Array(this.machine.view().buffer, at, values.length).set(values);
    return at;
  }

  integers(values: ArrayLike<number>): number {
    const at = this.take(4 * values.length);
    new Int32Array(this.machine.view().buffer, at, values.length).set(values);
    return at;
  }

  bytes(values: ArrayLike<number>): number {
    const at = this.take(values.length);
    new Uint8Array(this.machine.view().buffer, at, values.length).set(values);
    return at;
  }

  /** The microseconds that a function writes where its last argument says. */
  instantOf(name: string, ...values: (number | bigint)[]): number {
    const at = this.doubles([0]);
    this.machine.ask(name, ...values, at);
    return Number(this.machine.view().getBigInt64(at, true));
  }

  /** With a zero after it, which `length` does not count. */
  text(text: string): { readonly at: number; readonly length: number } {
    const encoded = new TextEncoder().encode(text);
    const at = this.take(encoded.length + 1);
    const memory = new Uint8Array(this.machine.view().buffer, at, encoded.length + 1);
    memory.set(encoded);
    memory[encoded.length] = 0;
    return { at, length: encoded.length };
  }

  /** A struct, all zero but for its size. */
  zeroed<M extends Fields>(struct: Struct<M>): number {
    const at = this.take(struct.size);
    new Uint8Array(this.machine.view().buffer, at, struct.size).fill(0);
    if (struct.places.has("size")) this.machine.view().setUint32(at, struct.size, true);
    return at;
  }

  written<M extends Fields>(struct: Struct<M>, given: Writes<M>, what: string): number {
    const at = this.zeroed(struct);
    struct.write(this.machine.view(), at, given, what);
    return at;
  }

  /** Structs one after the other, each zero but for what is given. */
  array<M extends Fields>(struct: Struct<M>, given: readonly Writes<M>[], what: string): number {
    const at = this.take(struct.size * given.length);
    new Uint8Array(this.machine.view().buffer, at, struct.size * given.length).fill(0);
    const view = this.machine.view();
    given.forEach((one, i) => {
      const place = at + i * struct.size;
      if (struct.places.has("size")) view.setUint32(place, struct.size, true);
      struct.write(view, place, one, `${what}[${i}]`);
    });
    return at;
  }

  /** `name`: C's struct, whose defaults stay where nothing else is given. */
  options<M extends Fields>(name: string, struct: Struct<M>, given: Writes<M>): number {
    const at = this.take(struct.size);
    this.machine.ask(`${name}_init`, at, struct.size);
    struct.write(this.machine.view(), at, given, "options");
    return at;
  }

  read<M extends Fields>(struct: Struct<M>, at: number): Values<M> {
    return struct.read(this.machine.view(), at);
  }

  /** What a call writes into a place of a pointer or a number of 32 bits. */
  answered(name: string, ...values: (number | bigint)[]): number {
    const place = this.integers([0]);
    this.machine.ask(name, ...values, place);
    return this.machine.view().getInt32(place, true);
  }

  /** All that a call lists; its last three arguments are an array, its capacity and how many there are. */
  list<M extends Fields>(struct: Struct<M>, name: string, ...values: (number | bigint)[]): Values<M>[] {
    return this.listed(struct, (memory, at) => struct.read(memory, at), name, ...values);
  }

  /** The same, each read by `read`. */
  listed<M extends Fields, T>(struct: Struct<M>, read: (memory: DataView, at: number) => T, name: string, ...values: (number | bigint)[]): T[] {
    const count = this.answered(name, ...values, 0, 0);
    if (count === 0) return [];
    const array = this.take(count * struct.size);
    this.machine.view().setUint32(array, struct.size, true);
    this.machine.ask(name, ...values, array, count, 0);
    const memory = this.machine.view(), all: T[] = [];
    for (let i = 0; i < count; ++i) all.push(read(memory, array + i * struct.size));
    return all;
  }
}

const inCamelCase = (name: string): string => (name === "utime_us" ? "timeUs" : name.replace(/_(\w)/g, (_, letter: string) => letter.toUpperCase()));

/** A message without the name of the C function; arguments and other functions have their names here. */
function inWordsOfJavaScript(message: string): string {
  return message
    .replace(/^ftw?_\w+: /, "")
    .replace(/^[a-z0-9_]+(?=(\[\d+\])?:)/, inCamelCase)
    .replace(/\bft_[a-z]+_(\w+\(\))/g, (_, name: string) => inCamelCase(name));
}

/** Something that lives in the module until dispose(). What stands on others keeps them alive itself. */
export abstract class Held {
  constructor(
    /** For the classes beside this one. */
    readonly machine: Machine,
    private readonly kind: string,
    private held: number,
  ) {}

  /** For the classes beside this one. */
  get handle(): number {
    if (this.held === 0) throw new ForetouchError("expected something that was not disposed of");
    return this.held;
  }

  dispose(): void {
    this.machine.call(`ft_${this.kind}_destroy`, this.held);
    this.held = 0;
  }
}

/** The handle of what must be one of a class, and of this module. */
export function handleOf<T extends Held>(thing: T, type: abstract new (...given: never[]) => T, machine: Machine, name: string): number {
  if (!(thing instanceof type) || thing.machine !== machine) throw new ForetouchError(`${name}: expected one that this module has made`);
  return thing.handle;
}

/** The few things that the C library asks of its surroundings: none of them is there. */
function surroundings(): WebAssembly.Imports {
  const notThere = 52; // ENOSYS of WASI
  const absent = (): number => notThere;
  const stop = (): never => {
    throw new ForetouchError("expected the module to go on, but it stopped itself");
  };
  const known: Record<string, () => number> = { proc_exit: stop, emscripten_notify_memory_growth: () => 0 };
  const anything = new Proxy(known, { get: (target, name) => target[String(name)] ?? absent });
  return { wasi_snapshot_preview1: anything, env: anything } as unknown as WebAssembly.Imports;
}

/** What a server sends in its place is reported, not compiled. */
export async function moduleOf(answer: Response): Promise<ArrayBuffer> {
  const where = answer.url === "" ? "" : ` at ${answer.url}`;
  if (!answer.ok) throw new ForetouchError(`expected foretouch.wasm${where}, found ${`${answer.status} ${answer.statusText}`.trim()}: copy it there, or name where it is`);
  const bytes = await answer.arrayBuffer();
  const isModule = bytes.byteLength >= 4 && new DataView(bytes).getUint32(0) === 0x0061736d;
  if (!isModule) throw new ForetouchError(`expected foretouch.wasm${where}, found ${answer.headers.get("content-type") ?? "something else"}: copy it there, or name where it is`);
  return bytes;
}

export async function started(module: BufferSource | WebAssembly.Module): Promise<Machine> {
  const compiled = module instanceof WebAssembly.Module ? module : await WebAssembly.compile(module);
  const { exports } = await WebAssembly.instantiate(compiled, surroundings());
  if (typeof exports["ft_version"] !== "function") throw new ForetouchError("expected foretouch.wasm, found another module");
  (exports["_initialize"] as (() => void) | undefined)?.();
  return new Machine(exports as Exports);
}
