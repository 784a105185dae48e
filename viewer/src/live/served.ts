// The document of a page that is served: beside it, on the server that it came from.

import { Malformed } from "../data/reader.js";

const address = "view.json";

export async function servedDocument(): Promise<string> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Malformed("", `could not be had from the server (${answer.status})`);
  return answer.text();
}
