// One browser for all pages: no network, every request beyond the page's own and every complaint of
// its console kept.

import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";
import { playwrightOf } from "./setting.mjs";

/** WebGL by software: machines that test have no graphics card. */
const softwareWebGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
/** What a browser does by itself where there is no graphics card: a processor draws, and puts the page together without WebGL. */
export const noGraphicsCard = ["--enable-unsafe-swiftshader"];
export const noWebGL = ["--disable-gpu", "--disable-3d-apis"];
/** Long enough for a loaded machine: nothing here is judged by the clock. */
export const patience = 60000;
/** What the software renderer says about reading its own pixels is no complaint of the page. */
const harmless = /GPU stall due to ReadPixels/;

export class Browsing {
  static async start(setting, flags = softwareWebGL) {
    const { chromium } = playwrightOf(setting);
    return new Browsing(await chromium.launch({ executablePath: setting.chromium, args: ["--no-sandbox", ...flags], timeout: patience }));
  }

  constructor(browser) {
    this.browser = browser;
  }

  /** A page from disk, shown and at rest. */
  async openFile(path, options = {}) {
    const address = pathToFileURL(path).href;
    const visit = await this.visit({ ...options, isOwn: (url) => url === address });
    await visit.page.goto(address);
    await ready(visit.page);
    await settled(visit.page);
    return visit;
  }

  /** An empty page that may ask only for what `isOwn` says. */
  async visit({ width = 1400, height = 900, theme = "light", isOwn }) {
    const context = await this.browser.newContext({ viewport: { width, height }, colorScheme: theme });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    return new Visit(context, page, isOwn);
  }

  async end() {
    await this.browser.close();
  }
}

class Visit {
  /** Everything that a page that works does not do. */
  complaints = [];

  constructor(context, page, isOwn) {
    this.context = context;
    this.page = page;
    page.on("pageerror", (error) => this.complaints.push(error.message));
    page.on("console", (message) => {
      if (["error", "warning"].includes(message.type()) && !harmless.test(message.text())) this.complaints.push(message.text());
    });
    page.on("request", (request) => {
      const url = request.url();
      if (!isOwn(url) && !/^(data|blob):/.test(url)) this.complaints.push(`asked for ${url}`);
    });
  }

  expectNoComplaint() {
    assert.deepEqual(this.complaints, []);
  }

  async end() {
    await this.context.close();
    this.expectNoComplaint();
  }
}

/** Until the page's script is there (a packed one unpacks itself first), and has shown what it has. */
export async function ready(page) {
  await page.waitForFunction(() => window.foretouch !== undefined, null, { timeout: patience });
  await page.evaluate(() => window.foretouch.ready);
}

/** Until no more frames are drawn: nothing moves on the page. */
export async function settled(page) {
  const quietMs = 400, deadline = Date.now() + patience;
  let before = -1;
  while (Date.now() < deadline) {
    const { frames, isAtRest } = await page.evaluate(() => window.foretouch.state());
    if (frames === before && isAtRest) return;
    before = frames;
    await page.waitForTimeout(quietMs);
  }
  assert.fail("the page never comes to rest");
}
