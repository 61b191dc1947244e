// SPDX-License-Identifier: MIT
// Fingers and keys: zoom, pace, bodies and flips; and which pictures they let be drawn.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { build } from "esbuild";
import { fileURLToPath } from "node:url";
import { choose, drawn, launched, opened } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launched();
});
after(() => browser?.close());

/** Two fingers on a canvas, so far apart at first and in the end, px. */
async function pinch(page, id, from, to) {
  const session = await page.context().newCDPSession(page);
  const box = await page.locator(id).boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const touch = (type, apart) =>
    session.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: type === "touchEnd" ? [] : [-1, 1].map((k) => ({ x: x + (k * apart) / 2, y, id: k + 1 })),
    });
  await touch("touchStart", from);
  for (let i = 1; i <= 4; ++i) await touch("touchMove", from + ((to - from) * i) / 4);
  await touch("touchEnd");
  await drawn(page);
}

test("two fingers bring the body nearer, and show less of the time line", async () => {
  const { page, errors } = await opened(browser, { width: 390, height: 844, touch: true });
  const views = () =>
    page.evaluate(() => {
      const { body, strip } = window.views;
      return { closer: body.closer, swings: strip.swings, now: window.explorer.now };
    });
  const before = await views();
  await page.evaluate(() => document.getElementById("pane-body").scrollIntoView());
  await pinch(page, "#body-labels", 60, 120);
  const near = await views();
  assert.ok(Math.abs(near.closer / before.closer - 0.5) < 0.01, `${near.closer}`);
  await pinch(page, "#strip", 160, 80);
  const wide = await views();
  assert.ok(Math.abs(wide.swings / before.swings - 2) < 0.02, `${wide.swings}`);
  assert.equal(wide.now, before.now); // the line was not dragged
  assert.deepEqual(errors, []);
  await page.close();
});

test("a phone has pace and zoom within reach of a thumb", async () => {
  const { page } = await opened(browser, { width: 390, height: 844, touch: true });
  for (const id of ["pace", "closer", "wider", "slide", "play"]) {
    const box = await page.locator(`#${id}`).boundingBox();
    assert.ok(box && box.x >= 0 && box.x + box.width <= 390 && box.y + box.height <= 844, id);
  }
  await page.close();
});

test("keys go through the bodies, and change pace and zoom", async () => {
  const { page, errors } = await opened(browser);
  const shown = () => page.inputValue("#preset");
  const ids = await page.$$eval("#preset optgroup option", (options) => options.map((o) => o.value));
  for (const id of [...ids.slice(1), ids[0]]) {
    await page.keyboard.press("n");
    assert.equal(await shown(), id);
  }
  await page.keyboard.press("p");
  assert.equal(await shown(), ids.at(-1));
  const pace = () => page.evaluate(() => window.explorer.scene.pace);
  const first = await pace();
  await page.keyboard.press("]");
  assert.equal(await pace(), 2 * first);
  await page.keyboard.press("[");
  await page.keyboard.press("[");
  assert.equal(await pace(), first / 2);
  const zooms = () => page.evaluate(() => [window.views.strip.swings, window.views.body.closer]);
  const before = await zooms();
  await page.keyboard.press("+");
  await page.focus("#body-labels");
  await page.keyboard.press("-");
  const after = await zooms();
  assert.ok(after[0] < before[0] && after[1] > before[1], `${before}; ${after}`);
  await page.keyboard.press("0");
  assert.ok(Math.abs((await zooms())[1] - 1) < 1e-12);
  assert.deepEqual(errors, []);
  await page.close();
});

test("only what changed is drawn, and only what is in sight", async () => {
  const { page, errors } = await opened(browser);
  const counted = (act) =>
    page.evaluate(async (name) => {
      const counts = {};
      const kept = Object.entries(window.views).map(([key, view]) => [view, view.draw, key]);
      for (const [view, draw, key] of kept) {
        counts[key] = 0;
        view.draw = function (e) {
          ++counts[key];
          draw.call(this, e);
        };
      }
      if (name === "turn") window.views.body.orbit(0.1, 0);
      else window.explorer.now += 0.1;
      await new Promise((done) => setTimeout(done, 700));
      for (const [view] of kept) delete view.draw;
      return counts;
    }, act);
  await page.waitForTimeout(700);
  const { body, ...others } = await counted("turn");
  assert.ok(body >= 1);
  assert.deepEqual(others, { sphere: 0, plane: 0, light: 0, strip: 0 });
  for (const count of Object.values(await counted("time"))) assert.ok(count >= 1);
  await page.click("#pane-sphere .expand");
  await page.waitForTimeout(300);
  const large = await counted("time");
  assert.deepEqual([large.body, large.plane, large.light], [0, 0, 0]);
  assert.ok(large.sphere >= 1 && large.strip >= 1);
  assert.deepEqual(errors, []);
  await page.close();
});

test("what stands still is drawn in full, what moves on a slow machine in fewer pixels", async () => {
  const { page, errors } = await opened(browser);
  const part = () => page.evaluate(() => window.views.body.part);
  const full = async () => {
    for (let i = 0; i < 100 && (await part()) !== 2; ++i) await page.waitForTimeout(100);
    assert.equal(await part(), 2);
  };
  await full();
  await page.evaluate(() => window.explorer.play(true));
  await drawn(page);
  assert.ok((await part()) < 2); // here WebGL is emulated, and known to be
  await page.evaluate(() => window.explorer.play(false));
  await full();
  assert.deepEqual(errors, []);
  await page.close();
});

test("the pace of drawing: down after slow pictures in a row, up again after many fast ones", async () => {
  const { outputFiles } = await build({
    entryPoints: [fileURLToPath(new URL("../pacing.ts", import.meta.url))],
    bundle: true,
    format: "esm",
    write: false,
  });
  const { Pacing } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
  const pacing = new Pacing(false);
  const fineness = () => pacing.at(0, true).fineness;
  assert.equal(fineness(), 2);
  for (let i = 0; i < 100; ++i) pacing.after(i % 4 === 0 ? 16 : 40); // never eight in a row
  assert.equal(fineness(), 2);
  for (let i = 0; i < 8; ++i) pacing.after(40);
  assert.equal(fineness(), 1);
  for (let i = 0; i < 80; ++i) pacing.after(40);
  assert.equal(fineness(), 0.5);
  for (let i = 0; i < 200; ++i) pacing.after(16.7);
  assert.equal(fineness(), 0.75);
  for (let i = 0; i < 200; ++i) pacing.after(16.7); // it takes longer each time
  assert.equal(fineness(), 0.75);
  assert.equal(pacing.at(1000, false).fineness, 2); // nothing moves
  assert.equal(pacing.at(1100, false).fineness, 0.75); // a hand turns it
  assert.equal(new Pacing(true).at(0, true).fineness, 1);
});

test("names of figures: the one that was asked for, though two show the same motion", async () => {
  const { page } = await opened(browser);
  for (const id of ["figure-3", "figure-6", "hyperion-saturn"]) {
    await choose(page, id);
    assert.equal(await page.inputValue("#preset"), id);
  }
  await page.close();
});
