// The structs that JavaScript reads and writes are those of the C headers, field by field: their names
// in camelCase, their kinds and their order.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { known as told } from "../machine.js";
import * as structs from "../structs.js";

const headers = new URL("../../c/include/foretouch/", import.meta.url);
const own = new URL("../foretouch_wasm.cpp", import.meta.url);
const kinds = { int32_t: "i32", uint32_t: "u32", int64_t: "i64", uint64_t: "u64", double: "f64", size_t: "u32" };
const inCamelCase = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

/** By name: [field, kind or the name of a struct] in order. */
function declared(text) {
  const all = new Map();
  for (const [, name, body] of text.replace(/\/\*[^]*?\*\//g, "").matchAll(/struct (ftw?_\w+) \{([^}]*)\}/g)) {
    const fields = [];
    for (const statement of body.split(";").map((line) => line.trim()).filter((line) => line !== "")) {
      const [, type, pointers, names] = /^(?:const )?(?:std::)?(\w+)((?:\s*\*\s*(?:const)?)*)\s*([^]*)$/.exec(statement);
      for (const declarator of names.split(",")) {
        const [, field, length] = /^\s*(\w+)(?:\[(\w+)\])?$/.exec(declarator);
        if (pointers !== "") fields.push([inCamelCase(field), "pointer"]);
        else if (type === "double" && length === "3") fields.push([inCamelCase(field), "point"]);
        else if (length !== undefined) for (let i = 0; i < Number(length); ++i) fields.push([`${inCamelCase(field)}${i}`, type]);
        else fields.push([inCamelCase(field), kinds[type] ?? type]);
      }
    }
    all.set(name, fields);
  }
  return all;
}

const known = declared([...readdirSync(headers).map((name) => new URL(name, headers)), own].map((path) => readFileSync(path, "utf8")).join("\n"));
const names = new Map(Object.entries(structs).map(([name, struct]) => [struct, name]));

test("every struct is as the headers have it", () => {
  assert.ok(names.size > 20);
  for (const [struct, name] of names) {
    const here = Object.entries(struct.fields).map(([field, kind]) => [field, typeof kind === "string" ? kind : names.get(kind)]);
    assert.deepEqual(here, known.get(name), name);
  }
});

test("fields lie where a compiler puts them", () => {
  const places = Object.fromEntries(Array.from(structs.ft_event.places, ([name, { at }]) => [name, at]));
  assert.equal(places.timeUs, 16);
  assert.equal(places.normal, 64);
  assert.equal(places.a, 144);
  assert.equal(places.points1 - places.points0, 56);
  assert.equal(structs.ft_scene_arrays.size, 36);
});

test("what C does not know is null, and no depth", () => {
  assert.equal(told(NaN), null);
  assert.equal(told(0), 0);
  assert.equal(told(0.04), 0.04);
});
