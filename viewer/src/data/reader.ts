// A value of a JSON document together with its place, so that whatever is wrong can be named.
// Nothing of the document is trusted: a reader gives a value of the type asked for, or throws.

import { bytesOfBase64 } from "./base64.js";
import type { Vector } from "./geometry.js";

/** What is wrong with a document, as one sentence for the person who opened it. */
export class Malformed extends Error {
  constructor(place: string, expectation: string) {
    super(`${place === "" ? "The document" : place} ${expectation}.`);
    this.name = "Malformed";
  }
}

const typedArrays = {
  f64: { size: 8, make: (buffer: ArrayBuffer) => new Float64Array(buffer) },
  f32: { size: 4, make: (buffer: ArrayBuffer) => new Float32Array(buffer) },
  u32: { size: 4, make: (buffer: ArrayBuffer) => new Uint32Array(buffer) },
  u16: { size: 2, make: (buffer: ArrayBuffer) => new Uint16Array(buffer) },
} as const;
type TypedKey = keyof typeof typedArrays;
type TypedOf<K extends TypedKey> = ReturnType<(typeof typedArrays)[K]["make"]>;

export class Reader {
  constructor(
    readonly value: unknown,
    readonly place: string,
  ) {}

  fail(expectation: string): never {
    throw new Malformed(this.place, expectation);
  }

  /** The field, which must be there. */
  field(name: string): Reader {
    return this.optional(name) ?? this.fail(`has no "${name}"`);
  }

  /** The field, or null where it is absent. */
  optional(name: string): Reader | null {
    const value = this.value;
    if (typeof value !== "object" || value === null || Array.isArray(value)) {
      return this.fail("is not an object");
    }
    if (!Object.hasOwn(value, name)) return null;
    const place = this.place === "" ? name : `${this.place}.${name}`;
    return new Reader((value as Record<string, unknown>)[name], place);
  }

  text(): string {
    return typeof this.value === "string" ? this.value : this.fail("is not a text");
  }

  oneOf<T extends string>(choices: readonly T[]): T {
    const found = choices.find((choice) => choice === this.value);
    return found ?? this.fail(`is none of ${choices.join(", ")}`);
  }

  flag(): boolean {
    return typeof this.value === "boolean" ? this.value : this.fail("is neither true nor false");
  }

  number(low = -Infinity, high = Infinity): number {
    const value = this.value;
    if (typeof value !== "number" || !Number.isFinite(value)) return this.fail("is not a number");
    if (value < low || value > high) return this.fail(`is ${value}, not in ${low} to ${high}`);
    return value;
  }

  /** A whole number from `low` to below `end`. */
  index(end: number, low = 0): number {
    const value = this.value;
    if (!Number.isSafeInteger(value)) return this.fail("is not a whole number");
    if ((value as number) < low || (value as number) >= end) {
      return this.fail(`is ${value as number}, but there are ${end}`);
    }
    return value as number;
  }

  count(): number {
    return this.index(Number.MAX_SAFE_INTEGER);
  }

  items(): Reader[] {
    const value = this.value;
    if (!Array.isArray(value)) return this.fail("is not a list");
    return value.map((item: unknown, i) => new Reader(item, `${this.place}[${i}]`));
  }

  vector(): Vector {
    const items = this.items();
    if (items.length !== 3) return this.fail("is not three numbers");
    return [items[0].number(), items[1].number(), items[2].number()];
  }

  /** A packed array of numbers; `length` where it is known what it must be. */
  typed<K extends TypedKey>(key: K, length?: number): TypedOf<K> {
    const bytes = bytesOfBase64(this.field(key).text());
    if (bytes === null) return this.field(key).fail("is not base64");
    const { size, make } = typedArrays[key];
    if (bytes.byteLength % size !== 0) this.field(key).fail(`ends within a number of ${size} bytes`);
    const array = make(bytes.buffer as ArrayBuffer) as TypedOf<K>;
    if (length !== undefined && array.length !== length) {
      this.fail(`has ${array.length} numbers, but ${length} are needed`);
    }
    if (key.startsWith("f")) this.requireFinite(array);
    return array;
  }

  /** As typed(), each below `end`. */
  typedIndices<K extends "u32" | "u16">(key: K, end: number, length?: number): TypedOf<K> {
    const array = this.typed(key, length);
    for (let i = 0; i < array.length; ++i) {
      if (array[i] >= end) this.fail(`names number ${array[i]}, but there are ${end}`);
    }
    return array;
  }

  private requireFinite(array: ArrayLike<number>): void {
    for (let i = 0; i < array.length; ++i) {
      if (!Number.isFinite(array[i])) this.fail(`has something that is no number at ${i}`);
    }
  }
}

/** The field, or null where it is absent or null: writers may give null for what is not known. */
export function present(item: Reader, name: string): Reader | null {
  const field = item.optional(name);
  return field === null || field.value === null ? null : field;
}
