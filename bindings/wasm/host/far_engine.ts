// An Engine in a worker, for scenes whose questions would make a page wait. One answer per question, in
// order.

import { ForetouchError } from "../machine.js";
import type { EngineLike } from "./engine.js";

type Name = keyof EngineLike;
export type Question = { readonly id: number; readonly name: Name; readonly given: readonly unknown[] } | { readonly id: number; readonly name: "load"; readonly given: readonly [string | BufferSource | WebAssembly.Module] };
export type Reply = { readonly id: number; readonly answer: unknown } | { readonly id: number; readonly error: string };

/** What is used of a Worker, or of a MessagePort. */
export interface Far {
  postMessage(message: unknown): void;
  onmessage: ((event: MessageEvent) => void) | null;
  onerror?: unknown;
}

export class FarEngine implements EngineLike {
  private readonly waiting = new Map<number, { resolve(answer: never): void; reject(reason: Error): void }>();
  private asked = 0;

  private constructor(private readonly worker: Far) {
    worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      const waits = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if ("error" in data) waits?.reject(new ForetouchError(data.error));
      else waits?.resolve(data.answer as never);
    };
    // A script that does not start answers nothing: what waits must not wait for ever.
    worker.onerror = (event: { message?: string }) => {
      for (const { reject } of this.waiting.values()) reject(new ForetouchError(`expected a worker with Foretouch in it, but it stopped: ${event.message ?? "its script is not there"}`));
      this.waiting.clear();
    };
  }

  /** `module`: where foretouch.wasm is, or what is in it; `worker`: a module worker of `foretouch/worker`, if its place is not found by itself. */
  static async start(module: string | URL | BufferSource | WebAssembly.Module, worker: Far = new Worker(new URL("./worker.js", import.meta.url), { type: "module" })): Promise<FarEngine> {
    const far = new FarEngine(worker);
    const isAddress = typeof module === "string" || module instanceof URL;
    await far.ask("load", [isAddress ? new URL(module, typeof document === "undefined" ? import.meta.url : document.baseURI).href : module]);
    return far;
  }

  readonly fit: EngineLike["fit"] = (...given) => this.ask("fit", given);
  readonly stands: EngineLike["stands"] = (...given) => this.ask("stands", given);
  readonly shape: EngineLike["shape"] = (...given) => this.ask("shape", given);
  readonly forget: EngineLike["forget"] = (...given) => this.ask("forget", given);
  readonly begin: EngineLike["begin"] = (...given) => this.ask("begin", given);
  readonly join: EngineLike["join"] = (...given) => this.ask("join", given);
  readonly tick: EngineLike["tick"] = (...given) => this.ask("tick", given);
  readonly dispose: EngineLike["dispose"] = (...given) => this.ask("dispose", given);

  private ask<T>(name: Name | "load", given: readonly unknown[]): Promise<T> {
    const id = ++this.asked;
    return new Promise<T>((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, name, given });
    });
  }
}
