// The library's module, which is part of the page: base64 of its bytes, compressed.

import { Refused } from "./engine.js";
import { bytesOfBase64 } from "../../src/data/base64.js";

export async function libraryModule(): Promise<ArrayBuffer> {
  const text = document.getElementById("foretouch-module")?.textContent?.trim() ?? "";
  if (text === "") throw new Refused("This page was built without the library in it. Build it with: ./run page");
  if (typeof DecompressionStream === "undefined" || typeof WebAssembly === "undefined") {
    throw new Refused("This browser is too old for this page: it needs WebAssembly and DecompressionStream (browsers since 2023).");
  }
  const bytes = bytesOfBase64(text);
  if (bytes === null) throw new Refused("This page is damaged: the library in it is not base64.");
  const packed = new Blob([bytes as Uint8Array<ArrayBuffer>]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(packed).arrayBuffer();
}
