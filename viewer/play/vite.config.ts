// The page that one reaches into: one HTML file, the library as WebAssembly in it. From disk, without
// network. FORETOUCH_MODULE names foretouch.wasm; FORETOUCH_PAGE where the page is written.

import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";
import { singlePage } from "../single_page.js";

const { FORETOUCH_MODULE: module, FORETOUCH_PAGE: out } = process.env;
if (module === undefined || out === undefined) throw new Error("expected FORETOUCH_MODULE and FORETOUCH_PAGE; ./run page sets them");

const library = gzipSync(readFileSync(module), { level: 9 }).toString("base64");
const place = '<script type="application/octet-stream" id="foretouch-module">';

/** The library runs in a worker made of the page itself; textures of a dropped scene are read from it. */
const page = singlePage({
  packages: ["three"],
  folder: fileURLToPath(new URL("../node_modules", import.meta.url)),
  fileName: "foretouch.html",
  isPacked: true,
  scripts: " 'wasm-unsafe-eval' blob:",
  policies: "worker-src blob: data:; connect-src blob: data:",
  head: "",
  filled: (html) => html.replace(place, () => place + library),
});

export default defineConfig({
  plugins: [viteSingleFile(), page],
  // A script, no module: browsers do not load modules from a blob of a page that is a file.
  worker: { format: "iife" },
  build: { target: "es2022", modulePreload: false, reportCompressedSize: false, outDir: dirname(out), emptyOutDir: false },
});
