// One HTML file with everything in it: licences, and a policy by which only the script and the style
// that were built run. Packed, the script is compressed, and a few lines unpack it.

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { join } from "node:path";
import type { Plugin } from "vite";

export function sha256(data: string | Uint8Array, encoding: "hex" | "base64" = "hex"): string {
  return createHash("sha256").update(data).digest(encoding);
}

function licences(names: readonly string[], folder: string): string {
  const text = names.map((name) => {
    const { version } = JSON.parse(readFileSync(join(folder, name, "package.json"), "utf8")) as { version: string };
    return `${name} ${version}\n\n${readFileSync(join(folder, name, "LICENSE"), "utf8").trim()}`;
  });
  return `<!--\nThis page contains:\n\n${text.join("\n\n")}\n-->`;
}

const scriptPattern = /<script type="module"[^>]*>([\s\S]*?)<\/script>/;

/** What unpacks the page's script, and says so where a browser cannot. */
const unpacking = `
const packed = document.getElementById("packed-script").textContent;
(async () => {
  const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
  const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  document.head.append(Object.assign(document.createElement("script"), { type: "module", textContent: text }));
})().catch((reason) => {
  document.getElementById("headline").textContent = "This browser is too old for this page: it needs DecompressionStream (browsers since 2023). " + reason;
});
`;

/** The page with its script compressed, and the hash of that script, which runs all the same. */
function pack(html: string): { html: string; hash: string } {
  const found = scriptPattern.exec(html);
  if (found === null) throw new Error("the page has no script");
  const text = gzipSync(found[1], { level: 9 }).toString("base64");
  const parts = `<script type="application/octet-stream" id="packed-script">${text}</script>\n<script>${unpacking}</script>`;
  const start = html.slice(0, found.index) + html.slice(found.index + found[0].length);
  return { html: start.replace("</body>", () => `${parts}\n</body>`), hash: `'sha256-${sha256(found[1], "base64")}'` };
}

/** `more`: directives beside those of scripts, styles and pictures. */
function policy(html: string, scripts: string, more: string): string {
  const hashOf = (pattern: RegExp): string => {
    const found = pattern.exec(html);
    if (found === null) throw new Error(`nothing inlined matches ${pattern}`);
    return `'sha256-${sha256(found[1], "base64")}'`;
  };
  const script = hashOf(html.includes(unpacking) ? /<script>([\s\S]*?)<\/script>/ : scriptPattern);
  const style = hashOf(/<style[^>]*>([\s\S]*?)<\/style>/);
  const content = `default-src 'none'; script-src ${script}${scripts}; style-src ${style}; img-src data: blob:; ${more}; base-uri 'none'; form-action 'none'`;
  return `<meta http-equiv="Content-Security-Policy" content="${content}">`;
}

export interface SinglePage {
  /** Packages in the page, and the folder that they are in. */
  readonly packages: readonly string[];
  readonly folder: string;
  readonly fileName: string;
  readonly isPacked: boolean;
  /** Sources of scripts beside the built one, with a blank before each. */
  readonly scripts: string;
  /** Directives of the policy, "connect-src" among them. */
  readonly policies: string;
  /** Further lines of the head; "" for none. */
  readonly head: string;
  /** The last change to what was built. */
  readonly filled: (html: string) => string;
}

export function singlePage(page: SinglePage): Plugin {
  return {
    name: "foretouch-finish",
    enforce: "post",
    generateBundle: {
      order: "post",
      handler(_, bundle) {
        const built = bundle["index.html"];
        if (built?.type !== "asset") throw new Error("no page was built");
        const unpacked = String(built.source).replaceAll("\r\n", "\n");
        const { html, hash } = page.isPacked ? pack(unpacked) : { html: unpacked, hash: "" };
        const head = [policy(html, `${hash === "" ? "" : ` ${hash}`}${page.scripts}`, page.policies), page.head].filter((line) => line !== "").join("\n");
        built.source = page.filled(html
          .replace("<!doctype html>", () => `<!doctype html>\n${licences(page.packages, page.folder)}`)
          .replace('<meta charset="utf-8">', (charset) => `${charset}\n${head}`));
        built.fileName = page.fileName;
      },
    },
  };
}
