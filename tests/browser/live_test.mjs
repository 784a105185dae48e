// The live view: service, sender and page together, in a network of their own.

import assert from "node:assert/strict";
import { join } from "node:path";
import { patience } from "./browsing.mjs";
import { delaysSeen, percentiles, watchDelays } from "./live_delays.mjs";
import { coloursOf, pixelsOf } from "./pixels.mjs";
import { liveClip, resultsIn, run } from "./programs.mjs";
import { serve, viewAddress } from "./service.mjs";
import { Skipped } from "./setting.mjs";

const address = `http://${viewAddress}/`;
/** What a browser says of a server that went away. */
const wentAway = /Failed to load resource: net::ERR_/;

export async function* casesOf(context) {
  const live = new LiveView(context);
  yield ["a stream that is watched", () => live.open()];
  if (live.visit === null) return;
  yield ["the avatar moves, and every contact comes to the page as a replay has it", () => live.watch()];
  yield ["after the service began anew, the page goes on by itself", () => live.restart()];
  yield ["nothing else was complained of or asked for", () => live.end()];
}

class LiveView {
  visit = null;
  service = null;

  constructor({ setting, folder, browsing }) {
    Object.assign(this, { setting, folder, browsing });
  }

  get page() {
    return this.visit.page;
  }

  async open() {
    if (process.env.FORETOUCH_PRIVATE_NETWORK === undefined) throw new Skipped("the system refused a network namespace");
    this.clip = liveClip(this.setting);
    this.expected = await this.replayed();
    this.service = await serve(this.setting, this.clip.served);
    const visit = await this.browsing.visit({ width: 800, height: 600, isOwn: (url) => url.startsWith(address) });
    await visit.page.goto(address);
    await visit.page.evaluate(() => window.foretouch.ready);
    await visit.page.getByText("Connected", { exact: true }).waitFor();
    this.visit = visit;
  }

  /** Contacts of the clip's replay, by what the stream has as well. */
  async replayed() {
    const output = join(this.folder, "live.jsonl");
    await run(this.setting.program, ["replay", ...this.clip.replayed, "--output", output]);
    return resultsIn(output).contacts.map(({ link, verdict, toi, point }) => keyOf(link, verdict, toi, point)).sort();
  }

  async watch() {
    await watchDelays(this.page);
    const sending = this.publish();
    const places = [];
    await this.page.waitForFunction(() => window.foretouch.state().end - window.foretouch.state().start > 1, undefined, { timeout: patience });
    for (let i = 0; i < 3; ++i) {
      places.push(await this.page.evaluate(() => window.foretouch.transformAt(0, 0, window.foretouch.state().time).slice(9)));
      await this.page.waitForTimeout(1000);
    }
    const pixels = await pixelsOf(this.setting);
    await this.page.screenshot({ path: join(this.setting.shots, "live-800x600.png"), timeout: patience });
    await sending;
    assert.ok(places.every((place, i) => i === 0 || Math.hypot(...place.map((x, k) => x - places[i - 1][k])) > 1e-3), `the avatar stands still: ${places}`);
    await this.expectContacts();
    assert.ok(coloursOf(await pixels.view(this.page)) > 40, "nothing is drawn");
    const { received, drawn } = await delaysSeen(this.page);
    return `${this.expected.length} contacts; from the pose's stamp to the page ${percentiles(received)}, to the screen ${percentiles(drawn)}`;
  }

  async publish() {
    await run(this.setting.program, ["publish", ...this.clip.published]);
  }

  async expectContacts() {
    await this.page.waitForFunction((count) => window.foretouch.state().contacts >= count, this.expected.length, { timeout: patience });
    const held = await this.page.evaluate(() => Array.from({ length: window.foretouch.state().contacts }, (_, i) => window.foretouch.contact(i)));
    const keys = held.map(({ linkName, verdict, toi, point }) => keyOf(linkName, verdict, toi, point)).sort();
    assert.deepEqual(keys, this.expected);
  }

  async restart() {
    await this.service.stop();
    this.service = null;
    await this.page.getByText("Connection lost").waitFor();
    this.service = await serve(this.setting, this.clip.served);
    await this.page.getByText("Connected", { exact: true }).waitFor();
    await this.publish();
    await this.expectContacts();
  }

  async end() {
    await this.service?.stop();
    await this.page.waitForTimeout(500);
    this.visit.complaints = this.visit.complaints.filter((complaint) => !wentAway.test(complaint));
    await this.visit.end();
  }
}

function keyOf(link, verdict, toi, point) {
  return [link, verdict, toi, ...(point ?? [])].join(" ");
}
