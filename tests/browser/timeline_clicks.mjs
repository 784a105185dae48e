// Clicks on the timeline, found as a person finds them: by the time axis and the rows' order.

import assert from "node:assert/strict";

const wanted = 6;
/** A whole pixel is in the middle of such a bar. */
const minBarPixels = 1.8;

/** Clicks the bars of some touches that are wide enough to be hit; returns how many. */
export async function clickBars(page) {
  await page.keyboard.press("Escape");
  await page.getByLabel("Rows of the timeline").selectOption("link");
  await drawn(page);
  const axis = await axisOf(page);
  const touches = await page.evaluate(() => Array.from({ length: window.foretouch.state().touches }, (_, index) => {
    const { link, avatar, begin, end, moment } = window.foretouch.touch(index);
    return { index, row: 1e6 * avatar + link, begin, end, at: moment >= 0 ? window.foretouch.contact(moment).at : begin };
  }));
  const rows = [...new Set(touches.map(({ row }) => row))].sort((a, b) => a - b);
  const middleOf = ({ begin, end }) => 0.5 * (begin + end);
  const isAlone = (one) => touches.every((other) => other === one || other.row !== one.row || other.begin > middleOf(one) || other.end < middleOf(one));
  const wide = touches.filter((touch) => touch.end - touch.begin > minBarPixels * axis.secondsPerPixel && isAlone(touch));
  assert.ok(wide.length > 0, "no bar is wide enough");
  const chosen = new Set(Array.from({ length: wanted }, (_, i) => wide[Math.floor(((i + 0.5) * wide.length) / wanted)]));
  for (const touch of chosen) {
    await clickRow(page, rows.indexOf(touch.row), rows.length, Math.round(axis.xOf(middleOf(touch))));
    assert.equal(await page.evaluate(() => window.foretouch.selectedTouch()), touch.index);
    assert.equal(await page.evaluate(() => window.foretouch.state().time), touch.at);
  }
  return chosen.size;
}

/** Where a time is on the axis: two clicks say, a third must agree. */
async function axisOf(page) {
  const box = await page.locator("canvas.axis").boundingBox();
  const clickAt = async (x) => {
    await page.mouse.click(box.x + x, box.y + 0.5 * box.height);
    return page.evaluate(() => window.foretouch.state().time);
  };
  const [x0, x1, x2] = [0.4, 0.8, 0.55].map((share) => Math.round(share * box.width));
  const t0 = await clickAt(x0), t1 = await clickAt(x1), t2 = await clickAt(x2);
  const secondsPerPixel = (t1 - t0) / (x1 - x0);
  assert.ok(secondsPerPixel > 0);
  assert.ok(Math.abs(t0 + (x2 - x0) * secondsPerPixel - t2) < 1e-6, "time goes evenly along the axis");
  return { secondsPerPixel, xOf: (time) => x0 + (time - t0) / secondsPerPixel };
}

/** Rows have their places once they are drawn, which waits for the frame of the 3D view. */
const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

async function clickRow(page, row, rows, x) {
  await drawn(page);
  const bars = page.locator("canvas.bars");
  const y = await bars.evaluate((canvas, [row, rows]) => {
    const y = ((row + 0.5) * canvas.clientHeight) / rows;
    canvas.parentElement.scrollTop = y - canvas.parentElement.clientHeight / 2;
    return y;
  }, [row, rows]);
  await bars.click({ position: { x, y }, force: true });
}
