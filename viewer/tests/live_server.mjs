// A server of a live view for tests: the page, a document, and steps at a rate.
//   node tests/live_server.mjs PORT

import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { live, pageWith, stepEvent } from "./fixture.mjs";

const stepSeconds = 0.1, guestId = 7;

function documentWith(hasGuest) {
  const document = live();
  if (hasGuest) document.avatars.push({ ...document.avatars[0], id: guestId });
  return document;
}

/** Listens on 127.0.0.1; port 0 takes a free one. close() also ends the streams. */
export async function serveLive(port = 0) {
  const template = readFileSync(new URL("../dist/viewer.html", import.meta.url), "utf8");
  const streams = new Set();
  const events = Array.from({ length: 40 }, (_, i) => stepEvent(i * stepSeconds, (i + 1) * stepSeconds, i));
  // Between poses that are not numbered nothing is decided.
  const guests = [{ link: 3, verdict: "undecided", reason: "gap", free_until: 0 }];
  let sequence = 0, hasGuest = false;
  const timer = setInterval(() => {
    const shift = 4 * Math.floor(sequence / 40), event = events[sequence % 40];
    const contacts = event.contacts.map((contact) => ({ ...contact, time: contact.time + shift }));
    const step = { ...event, sequence, t0: sequence * stepSeconds, t1: (sequence + 1) * stepSeconds, contacts };
    ++sequence;
    const status = { answered: sequence, rejected: 0, lost: 2, gaps: 1, waiting: 0, query_p50_us: 8.1, query_p99_us: 31, answer_p50_us: 64, answer_p99_us: 180, viewers: streams.size };
    for (const stream of streams) {
      stream.write(`event: step\ndata: ${JSON.stringify(step)}\n\n`);
      if (hasGuest) stream.write(`event: step\ndata: ${JSON.stringify({ ...step, avatar: guestId, contacts: guests })}\n\n`);
      if (sequence % 10 === 0) stream.write(`event: status\ndata: ${JSON.stringify(status)}\n\n`);
    }
  }, 1000 * stepSeconds);
  const server = createServer((request, response) => {
    if (request.url === "/events") {
      response.writeHead(200, { "content-type": "text/event-stream" });
      response.flushHeaders();
      streams.add(response);
      request.on("close", () => streams.delete(response));
    } else if (request.url === "/view.json") {
      response.writeHead(200, { "content-type": "application/json" }).end(JSON.stringify(documentWith(hasGuest)));
    } else {
      response.writeHead(200, { "content-type": "text/html" }).end(pageWith(template, ""));
    }
  });
  await new Promise((resolve) => server.listen(port, "127.0.0.1", resolve));
  const drop = () => streams.forEach((stream) => stream.destroy());
  return {
    address: `http://127.0.0.1:${server.address().port}/`,
    drop,
    /** One more avatar comes. */
    join: () => (hasGuest = true),
    /** What a server that sends something malformed would. */
    send: (text) => streams.forEach((stream) => stream.write(text)),
    close: () => {
      clearInterval(timer);
      drop();
      server.closeAllConnections();
      server.close();
    },
  };
}

if (process.argv[1]?.endsWith("live_server.mjs")) {
  process.stdout.write(`${(await serveLive(Number(process.argv[2] ?? 8000))).address}\n`);
}
