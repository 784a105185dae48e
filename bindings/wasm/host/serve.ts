// The worker's side of far_engine.ts.

import { Foretouch } from "../foretouch.js";
import { ForetouchError } from "../machine.js";
import { Engine } from "./engine.js";
import type { Far, Question, Reply } from "./far_engine.js";

/** Answers what comes from there, each question after the one before it. */
export function serve(port: Far): void {
  let engine: Engine | null = null, last: Promise<unknown> = Promise.resolve();
  const answer = async ({ name, given }: Question): Promise<unknown> => {
    if (name === "load") {
      const [module] = given;
      engine = new Engine(await Foretouch.load(typeof module === "string" ? fetch(module) : (module as BufferSource)));
      return null;
    }
    if (engine === null) throw new ForetouchError("expected load() before this");
    return (engine[name] as (...given: readonly unknown[]) => unknown)(...given);
  };
  port.onmessage = ({ data }: MessageEvent<Question>) => {
    last = last.then(async () => {
      let reply: Reply;
      try {
        reply = { id: data.id, answer: await answer(data) };
      } catch (reason) {
        reply = { id: data.id, error: reason instanceof Error ? reason.message : String(reason) };
      }
      port.postMessage(reply);
    });
  };
}
