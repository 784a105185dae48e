// One HTML file with everything in it: no other file, no network. The same sources give the same
// bytes; a stamp in the file says which sources these were (tests/house/viewer_bundle.cmake).

import { readdirSync, readFileSync } from "node:fs";
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";
import { sha256, singlePage } from "./single_page.js";

const single = ["index.html", "package-lock.json", "package.json", "single_page.ts", "tsconfig.json", "vite.config.ts"];

function filesUnder(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = `${folder}/${entry.name}`;
    return entry.isDirectory() ? filesUnder(path) : [path];
  });
}

/** Of the lines "HASH  PATH", in order of the paths. */
function stamp(): string {
  const paths = [...single, ...filesUnder("src")].sort();
  return sha256(paths.map((path) => `${sha256(readFileSync(path))}  ${path}\n`).join(""));
}

/** Nothing is loaded from anywhere but the page's own server. */
const page = singlePage({
  packages: ["three", "uplot"],
  folder: "node_modules",
  fileName: "viewer.html",
  isPacked: false,
  scripts: "",
  policies: "connect-src 'self'",
  head: `<meta name="foretouch-sources" content="${stamp()}">`,
  filled: (html) => html,
});

export default defineConfig({
  plugins: [viteSingleFile(), page],
  build: { target: "es2022", modulePreload: false, reportCompressedSize: false },
});
