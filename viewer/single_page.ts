// One HTML file with everything in it: licences, and a policy by which only the script and the style
// that were built run.

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
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

/** `more`: directives beside those of scripts, styles and pictures. */
function policy(html: string, scripts: string, more: string): string {
  const hashOf = (pattern: RegExp): string => {
    const found = pattern.exec(html);
    if (found === null) throw new Error(`nothing inlined matches ${pattern}`);
    return `'sha256-${sha256(found[1], "base64")}'`;
  };
  const script = hashOf(/<script type="module"[^>]*>([\s\S]*?)<\/script>/);
  const style = hashOf(/<style[^>]*>([\s\S]*?)<\/style>/);
  const content = `default-src 'none'; script-src ${script}${scripts}; style-src ${style}; img-src data: blob:; ${more}; base-uri 'none'; form-action 'none'`;
  return `<meta http-equiv="Content-Security-Policy" content="${content}">`;
}

export interface SinglePage {
  /** Packages in the page, and the folder that they are in. */
  readonly packages: readonly string[];
  readonly folder: string;
  readonly fileName: string;
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
        const html = String(built.source).replaceAll("\r\n", "\n");
        const head = [policy(html, page.scripts, page.policies), page.head].filter((line) => line !== "").join("\n");
        built.source = page.filled(html
          .replace("<!doctype html>", () => `<!doctype html>\n${licences(page.packages, page.folder)}`)
          .replace('<meta charset="utf-8">', (charset) => `${charset}\n${head}`));
        built.fileName = page.fileName;
      },
    },
  };
}
