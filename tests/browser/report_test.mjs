// Reports: what `foretouch replay --report` writes, opened from disk.

import assert from "node:assert/strict";
import { join } from "node:path";
import { expectSameContact, readEveryContact } from "./contact_check.mjs";
import { unreachableControls, sidewaysScroll } from "./controls.mjs";
import { coloursOf, countAround, differenceAt, isAvatarColour, isContactColour, linkPlaces, pixelsOf } from "./pixels.mjs";
import { clips, reportOf, run } from "./programs.mjs";
import { shownNumbers } from "./shown_numbers.mjs";
import { clickBars } from "./timeline_clicks.mjs";
import { documentIn } from "./view_document.mjs";

export async function* casesOf(context) {
  for (const name of ["demo", "kick"]) {
    const report = new OpenedReport(context, name);
    yield [`${name} opens from disk, and draws`, () => report.open()];
    if (report.visit === null) continue;
    yield [`${name}: every contact is shown as the results have it`, () => report.everyContact()];
    yield [`${name}: the chosen contact is marked where it is`, () => report.markers()];
    yield [`${name}: scrubbing moves the avatar on the screen`, () => report.scrubbing()];
    yield [`${name}: a click on the timeline goes there`, () => report.timeline()];
    yield [`${name}: feet stand, slide and sink in as foretouch feet says`, () => report.feet()];
    yield [`${name}: keys go from contact to contact`, () => report.keys()];
    yield [`${name}: the check of the poses counts as the document and the summary do`, () => report.discreteCheck()];
    yield [`${name}: the histogram's percentiles are the summary's`, () => report.percentiles()];
    yield [`${name}: all controls can be reached`, () => report.controls()];
    yield [`${name}: dark`, () => report.dark()];
    yield [`${name}: nothing was complained of or asked for`, () => report.visit.end()];
    yield [`${name} on a phone`, () => report.phone()];
  }
}

class OpenedReport {
  visit = null;

  constructor({ setting, folder, browsing }, name) {
    Object.assign(this, { setting, folder, browsing, name });
  }

  get page() {
    return this.visit.page;
  }

  shot(what) {
    return join(this.setting.shots, `${this.name}-${what}.png`);
  }

  async open() {
    this.report = await reportOf(this.setting, this.folder, this.name);
    this.pixels = await pixelsOf(this.setting);
    const visit = await this.browsing.openFile(this.report.page);
    const state = await visit.page.evaluate(() => window.foretouch.state());
    assert.equal(state.error, null);
    assert.equal(state.has3D, true);
    const colours = coloursOf(await this.pixels.view(visit.page));
    assert.ok(colours > 60, `only ${colours} colours: nothing is drawn`);
    await this.pixels.whole(visit.page, this.shot("1400x900-light"));
    this.visit = visit;
  }

  async everyContact() {
    const results = new Map(this.report.results.contacts.map((contact) => [`${contact.step} ${contact.link}`, contact]));
    const shown = await readEveryContact(this.page);
    assert.equal(shown.length, results.size);
    let latest = -Infinity;
    shown.forEach((one, index) => {
      const key = `${one.held.step} ${one.held.linkName}`;
      assert.ok(results.has(key), `${key} is in the results, once`);
      expectSameContact(one, results.get(key));
      results.delete(key);
      assert.equal(one.selected, index);
      assert.ok(one.held.at >= latest, "in order of time");
      latest = one.held.at;
    });
    return `${shown.length} contacts`;
  }

  /** Of the contacts that a check at the poses misses, some. */
  async markers() {
    const indices = await this.page.evaluate(() => {
      const all = Array.from({ length: window.foretouch.state().contacts }, (_, i) => i);
      return all.filter((i) => window.foretouch.contact(i).missedByPoses === true);
    });
    for (const index of [0, 0.5, 1].map((share) => indices[Math.floor(share * (indices.length - 1))])) {
      await this.page.evaluate((i) => window.foretouch.selectContact(i), index);
      const image = await this.pixels.view(this.page, this.shot(`contact-${index}`));
      const place = await this.page.evaluate((i) => window.foretouch.screenOf(window.foretouch.contact(i).point), index);
      assert.ok(place !== null && place[0] > 0 && place[0] < image.width && place[1] > 0 && place[1] < image.height, "in sight");
      assert.ok(countAround(image, place, 8, isContactColour) > 40, `contact ${index} is marked at ${place}`);
    }
  }

  /** At another time other pixels are the avatar's: those at its links, then and now. */
  async scrubbing() {
    const { start, end } = await this.page.evaluate(() => window.foretouch.state());
    const links = this.report.results.header.links.length;
    await this.page.evaluate((time) => window.foretouch.seek(time), start + 0.25 * (end - start));
    await this.page.keyboard.press("Escape");
    await this.page.keyboard.press("f");
    const images = [], places = [];
    for (const share of [0.25, 0.4]) {
      const time = start + share * (end - start);
      await this.page.evaluate((t) => window.foretouch.seek(t), time);
      images.push(await this.pixels.view(this.page));
      places.push(await linkPlaces(this.page, time, links));
    }
    const isInside = ([x, y]) => x >= 0 && y >= 0 && x < images[0].width - 1 && y < images[0].height - 1;
    const minApart = 25;
    const left = places[0].filter((place) => place !== null && isInside(place) && places[1].every((other) => other === null || distance(place, other) > minApart));
    const avatarThen = left.filter((place) => isAvatarColour(images[0].at(Math.round(place[0]), Math.round(place[1]))));
    const changed = avatarThen.filter((place) => differenceAt(images[0], images[1], place) > 20);
    assert.ok(left.length >= 3, `only ${left.length} links leave their places`);
    assert.ok(avatarThen.length >= left.length / 3, `${avatarThen.length} of ${left.length} links are drawn where they are`);
    assert.ok(changed.length >= 0.8 * avatarThen.length, `${changed.length} of ${avatarThen.length} are gone from there later`);
    return `${changed.length} of ${left.length} links seen to leave`;
  }

  async timeline() {
    const clicked = await clickBars(this.page);
    return `${clicked} bars clicked`;
  }

  /** The same count in the card and in the other command; a click on the worst shows it. */
  async feet() {
    const { page } = this, words = await clips[this.name](this.setting, this.folder);
    const told = JSON.parse(await run(this.setting.program, ["feet", ...words.scene, ...words.played, "--json", "--quiet"]));
    const shown = await page.evaluate(() => window.foretouch.feet().map(({ link, stances }) => ({ name: window.foretouch.linkName(link), stances })));
    const limbs = told.limbs.filter(({ name }) => shown.some((foot) => foot.name === name));
    assert.equal(limbs.length, shown.length);
    for (const { name, touches, worst_slide: slide, deepest } of limbs) {
      const met = shown.find((foot) => foot.name === name).stances.filter(({ kind }) => kind !== "hovers");
      assert.equal(met.length, touches, `${name} touches`);
      const most = (of) => met.reduce((a, b) => Math.max(a, of(b)), 0);
      assert.ok(Math.abs(most((stance) => stance.slide) - slide) < 1e-6, `${name} slides ${slide}`);
      assert.ok(Math.abs(most((stance) => stance.depth) - deepest) < 1e-6, `${name} is ${deepest} deep`);
      const deep = met.filter(({ depth }) => depth >= 0.002), stand = deep.filter(({ begin, end }) => end - begin >= 0.1).length;
      const told = [`${touches} touch`, stand === 0 ? "none stands" : `${stand} stands? too deep`, ...(deep.length > stand ? [`${deep.length - stand} pass(es)? too deep`] : [])];
      await page.getByText(new RegExp(`^${name}: ${touches === 0 ? "touches nothing" : told.join(".*; ")}`)).waitFor();
    }
    const all = shown.flatMap(({ stances }) => stances);
    await page.locator(".feet tbody button").first().click();
    const badness = ({ slide, depth, hover }) => (Math.max(slide, depth) >= 0.002 ? 1e3 : 0) + Math.max(slide, depth, hover ?? 0), chosen = await page.evaluate(() => window.foretouch.selectedStance());
    // Of those that stand and slide or sink in; if there are none, of all, also of a foot that only passes.
    const standing = all.filter(({ begin, end, slide, depth }) => end - begin >= 0.1 && Math.max(slide, depth) >= 0.002);
    assert.equal(badness(chosen), Math.max(...(standing.length > 0 ? standing : all).map(badness)), "the worst is the first");
    const { time } = await page.evaluate(() => window.foretouch.state());
    assert.ok(time >= chosen.begin && time <= chosen.end, "the place that is shown is the place that is said");
    await this.pixels.whole(page, this.shot("feet"));
    return `${all.length} stances`;
  }

  async keys() {
    const { page } = this;
    const selected = () => page.evaluate(() => window.foretouch.selected());
    const count = await page.evaluate(() => (window.foretouch.selectContact(0), window.foretouch.state().contacts));
    const walk = Math.min(20, count - 1);
    for (let i = 1; i <= walk; ++i) {
      await page.keyboard.press("}");
      assert.equal(await selected(), i);
    }
    for (let i = walk - 1; i >= 0; --i) {
      await page.keyboard.press("{");
      assert.equal(await selected(), i);
    }
    await page.keyboard.press("{");
    assert.equal(await selected(), 0, "there is none before the first");
    const middle = await page.evaluate((i) => window.foretouch.contact(i).at, Math.floor(count / 2));
    await page.keyboard.press("Escape");
    assert.equal(await selected(), -1);
    await page.evaluate((time) => window.foretouch.seek(time - 1e-6), middle);
    await page.keyboard.press("}");
    assert.equal(await page.evaluate(() => window.foretouch.contact(window.foretouch.selected()).at), middle, "the next one from the time shown");
    await this.walkTouches();
  }

  /** Of a report without touches each contact is one. */
  async walkTouches() {
    const { page } = this;
    const count = await page.evaluate(() => (window.foretouch.selectTouch(0), window.foretouch.state().touches));
    for (let i = 1; i <= Math.min(10, count - 1); ++i) {
      await page.keyboard.press("]");
      assert.equal(await page.evaluate(() => window.foretouch.selectedTouch()), i);
    }
  }

  async discreteCheck() {
    const document = documentIn(this.report.page);
    const begun = document.avatars.flatMap(({ contacts }) => contacts).filter(({ verdict }) => verdict === "contact");
    const missed = begun.filter((contact) => contact.missed_by_poses).length;
    const touches = (document.touches ?? []).filter(({ other, ground }) => other === undefined && !ground);
    const words = document.touches === undefined
      ? `sees ${begun.length - missed} of ${begun.length} contacts`
      : `sees ${touches.filter((touch) => !touch.missed).length} of ${touches.length} touches`;
    await this.page.keyboard.press("d");
    assert.equal(await this.page.evaluate(() => window.foretouch.state().showsDiscrete), true);
    await this.page.getByText(words).waitFor();
    await this.pixels.whole(this.page, this.shot("discrete"));
    await this.page.getByRole("button", { name: "What a check of the poses alone would have seen, beside what happened (D)" }).click();
    assert.equal(await this.page.evaluate(() => window.foretouch.state().showsDiscrete), false);
    const row = this.page.locator("table.pairs tr", { has: this.page.getByText("missed by poses", { exact: true }) });
    assert.match(await row.locator("td").first().innerText(), new RegExp(`^${missed}\\b`));
  }

  async percentiles() {
    const printed = /latency of a step, us .* p50 (\S+) .* p99 (\S+) +max (\S+)/.exec(this.report.printed).slice(1).map(Number);
    const words = await this.page.getByText(/^Half of \d+ steps took at most/).innerText();
    const shown = / at most (.*), 99 in 100 at most (.*), the longest (.*)\.$/.exec(words).slice(1).map((text) => shownNumbers(text)[0]);
    const half = 0.05;  // of the last digit that the program prints, microseconds
    shown.forEach(({ value, slack }, i) => assert.ok(Math.abs(value - 1e-6 * printed[i]) <= slack + 1e-6 * half * (1 + 1e-6), `${words}; printed are ${printed}`));
  }

  async controls() {
    assert.equal(await sidewaysScroll(this.page), 0);
    assert.deepEqual(await unreachableControls(this.page), []);
  }

  async dark() {
    await this.page.locator("#theme").click();
    assert.equal(await this.page.evaluate(() => window.foretouch.state().theme), "dark");
    await this.page.evaluate(() => window.scrollTo(0, 0));
    await this.pixels.whole(this.page, this.shot("1400x900-dark"));
  }

  async phone() {
    const visit = await this.browsing.openFile(this.report.page, { width: 390, height: 844, theme: "dark" });
    await this.pixels.whole(visit.page, this.shot("390x844-dark"));
    assert.equal(await visit.page.evaluate(() => window.foretouch.state().theme), "dark", "as the system asks for");
    assert.equal(await sidewaysScroll(visit.page), 0);
    assert.deepEqual(await unreachableControls(visit.page), []);
    await visit.page.locator("#theme").click();
    await visit.page.evaluate(() => window.scrollTo(0, 0));
    await this.pixels.whole(visit.page, this.shot("390x844-light"));
    await visit.page.screenshot({ path: this.shot("390-whole-light"), fullPage: true });
    await visit.end();
  }
}

function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
