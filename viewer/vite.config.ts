// One HTML file with everything in it: no other file, no network. The same sources give the same
// bytes; a stamp in the file says which sources these were (tests/house/viewer_bundle.cmake).

import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const single = ["index.html", "package-lock.json", "package.json", "tsconfig.json", "vite.config.ts"];

function sha256(data: string | Uint8Array, encoding: "hex" | "base64" = "hex"): string {
  return createHash("sha256").update(data).digest(encoding);
}

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

function licences(): string {
  const text = ["three", "uplot"].map((name) => {
    const { version } = JSON.parse(readFileSync(join("node_modules", name, "package.json"), "utf8")) as { version: string };
    return `${name} ${version}\n\n${readFileSync(join("node_modules", name, "LICENSE"), "utf8").trim()}`;
  });
  return `<!--\nThis page contains:\n\n${text.join("\n\n")}\n-->`;
}

/** Only the script and the style that were built run; nothing is loaded from anywhere but the page's own server. */
function policy(html: string): string {
  const hashOf = (pattern: RegExp): string => {
    const found = pattern.exec(html);
    if (found === null) throw new Error(`nothing inlined matches ${pattern}`);
    return `'sha256-${sha256(found[1], "base64")}'`;
  };
  const script = hashOf(/<script type="module"[^>]*>([\s\S]*?)<\/script>/);
  const style = hashOf(/<style[^>]*>([\s\S]*?)<\/style>/);
  const content = `default-src 'none'; script-src ${script}; style-src ${style}; img-src data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'`;
  return `<meta http-equiv="Content-Security-Policy" content="${content}">`;
}

function finish(): Plugin {
  return {
    name: "foretouch-finish",
    enforce: "post",
    generateBundle: {
      order: "post",
      handler(_, bundle) {
        const page = bundle["index.html"];
        if (page?.type !== "asset") throw new Error("no page was built");
        const html = String(page.source).replaceAll("\r\n", "\n");
        const head = `${policy(html)}\n<meta name="foretouch-sources" content="${stamp()}">`;
        page.source = html
          .replace("<!doctype html>", () => `<!doctype html>\n${licences()}`)
          .replace('<meta charset="utf-8">', (charset) => `${charset}\n${head}`);
        page.fileName = "viewer.html";
      },
    },
  };
}

export default defineConfig({
  plugins: [viteSingleFile(), finish()],
  build: { target: "es2022", modulePreload: false, reportCompressedSize: false },
});
