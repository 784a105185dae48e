// How long after a pose was sent what it touched is in the page, and on the screen. The page is
// watched from beside it: a second listener to the same events says which pose a contact came with.

import assert from "node:assert/strict";

/** Starts to look, frame by frame. */
export async function watchDelays(page) {
  await page.evaluate(() => {
    const seen = { received: [], arrived: [], drawn: [], stampOf: new Map(), known: 0 };
    window.delaysSeen = seen;
    new EventSource("/events").addEventListener("step", ({ data }) => {
      const { t1, utime, contacts } = JSON.parse(data);
      seen.stampOf.set(t1, utime[1] / 1000);
      if (contacts.length > 0) seen.received.push([t1, Date.now()]);
    });
    // What a frame finds new in the page is drawn in that frame, which is over when the next begins.
    let fresh = [];
    const look = () => {
      const now = Date.now(), { foretouch } = window;
      for (const t1 of fresh) seen.drawn.push([t1, now]);
      const { contacts } = foretouch.state();
      fresh = [];
      for (let i = seen.known; i < contacts; ++i) fresh.push(foretouch.contact(i).span.t1);
      for (const t1 of fresh) seen.arrived.push([t1, now]);
      seen.known = contacts;
      requestAnimationFrame(look);
    };
    look();
  });
}

/** Milliseconds from the stamp of the pose to when the page was told of its contacts, had them at a frame, had drawn them. */
export async function delaysSeen(page) {
  const delays = await page.evaluate(() => {
    const { received, arrived, drawn, stampOf } = window.delaysSeen;
    const since = (list) => list.filter(([t1]) => stampOf.has(t1)).map(([t1, now]) => now - stampOf.get(t1));
    return { received: since(received), arrived: since(arrived), drawn: since(drawn) };
  });
  assert.ok(delays.drawn.length > 0, "no contact was seen to come");
  return delays;
}

export function percentiles(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))].toFixed(0);
  return `p50 ${at(0.5)} ms, p99 ${at(0.99)} ms (${sorted.length})`;
}
