// The worker, as promises.

import type { Answer, Ask, Name, Question, Reply } from "./messages.js";
import LibraryWorker from "./worker.js?worker&inline";

/** What was asked cannot be answered: the message says why, for a person. */
export class Refused extends Error {}

export class Engine {
  private readonly worker = new LibraryWorker();
  private readonly waiting = new Map<number, { resolve: (value: never) => void; reject: (reason: Error) => void }>();
  private asked = 0;

  constructor() {
    this.worker.addEventListener("message", ({ data }: MessageEvent<Reply>) => {
      const waits = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if ("error" in data) waits?.reject(new Refused(data.error));
      else waits?.resolve(data.answer as never);
    });
    // A script that does not start answers nothing: what waits must not wait for ever.
    this.worker.addEventListener("error", (event) => {
      for (const { reject } of this.waiting.values()) reject(new Refused(`The library stopped: ${event.message}`));
      this.waiting.clear();
    });
  }

  ask<N extends Name>(name: N, ask: Ask<N>, transfer: Transferable[] = []): Promise<Answer<N>> {
    const id = ++this.asked;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, name, ask } satisfies Question<N>, transfer);
    });
  }
}
