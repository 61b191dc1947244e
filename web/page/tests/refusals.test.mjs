// SPDX-License-Identifier: MIT
// What the explorer refuses, and what it lets be typed one after another.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { choose, drawn, launched, opened } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launched();
});
after(() => browser?.close());

const text = (page, selector) => page.locator(selector).innerText();
const type = async (field, value) => {
  await field.locator("input").fill(value);
  await field.locator("input").press("Enter");
};

test("what a view refuses leaves all as it was, with the sentence where it was asked for", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "figure-1");
  const good = await page.evaluate(() => window.explorer.scene);
  const same = async () => {
    assert.deepEqual(await page.evaluate(() => window.explorer.scene), good);
    assert.equal(await page.evaluate(() => window.explorer.state.g.every(Number.isFinite)), true);
  };
  await page.click("#copies-open");
  const link = (await page.inputValue("#copy-text")).replace(/^[^#]*/, "");
  await page.click("#copies [data-close]");
  for (const bad of [
    link.replace("&end=", "&frame=0,0,0,0.1&end="),
    link.replace(/I=[^&]*/, "I=1,1,1").replace("friction=off", "friction=on"),
  ]) {
    await page.evaluate((hash) => (location.hash = hash), bad);
    await page.waitForFunction((l) => document.getElementById("link-field").value === l, bad);
    assert.notEqual(await text(page, "#link-error"), "");
    await same();
  }
  await page.click("#link-drop");
  await page.evaluate(() => window.explorer.change({ moments: [1, 1, 1] }));
  await page.locator("#friction").click();
  await page.waitForSelector("#body-trouble:not([hidden])");
  assert.equal(await page.isChecked("#friction"), false);
  await page.evaluate((moments) => window.explorer.change({ moments }), good.moments);
  await page.locator("#friction").click();
  assert.equal(await page.isChecked("#friction"), true);
  assert.equal(await page.isVisible("#body-trouble"), false);
  assert.deepEqual(errors, []);
  await page.close();
});

test("no script but the page's own runs in it", async () => {
  const { page, errors } = await opened(browser);
  await page.evaluate(() => {
    document.body.insertAdjacentHTML("beforeend", '<img src="data:," onerror="window.hit = 1">');
    const script = document.createElement("script");
    script.textContent = "window.hit = 2";
    document.body.append(script);
  });
  await page.waitForTimeout(200);
  assert.equal(await page.evaluate(() => "hit" in window), false);
  assert.ok(errors.every((error) => /Content Security Policy/.test(error)) && errors.length >= 2);
  await page.close();
});

test("moments that fit only together are typed one after another", async () => {
  const { page, errors } = await opened(browser);
  const field = (k) => page.locator("#moments .field").nth(k);
  for (const k of [0, 1]) {
    await type(field(k), ["3", "4"][k]);
    assert.equal(await field(k).locator(".error").isVisible(), true);
  }
  await type(field(2), "6");
  assert.deepEqual(await page.evaluate(() => window.explorer.scene.moments), [3, 4, 6]);
  assert.equal(await page.locator("#moments .error:visible").count(), 0);
  assert.match(await text(page, "#about"), /of your own, begun from Wing nut/);
  assert.equal(await page.inputValue("#preset"), "");
  await type(field(2), "60");
  await choose(page, "toutatis"); // what was refused was of the last body
  assert.equal(await page.locator("#moments .error:visible").count(), 0);
  assert.deepEqual(errors, []);
  await page.close();
});

test("a steady spin becomes a tumbler by its two periods and a mode", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "figure-1");
  await page.evaluate(() => window.explorer.changeState({ q: [1, 0, 0, 0], g: [0, 0, 1] }));
  await page.click("#tab-tumbler");
  await page.selectOption("#chart select[aria-label=mode]", "long_axis");
  const field = (k) => page.locator("#chart .field").nth(k);
  await type(field(0), "30");
  assert.match(await field(0).locator(".error").innerText(), /type both/);
  await type(field(1), "200");
  await drawn(page);
  assert.equal(await text(page, "#mode"), "Long-axis mode");
  assert.match(await text(page, "#clocks"), /200\s[\s\S]*30\s/);
  assert.deepEqual(errors, []);
  await page.close();
});

test("no link freezes the page: brakes have a least time, and steps a number", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "hyperion-saturn");
  const good = await page.evaluate(() => window.explorer.scene);
  for (const brake of ["friction", "drag"]) {
    const said = await page.evaluate((name) => {
      const { explorer } = window;
      try {
        explorer.change({ gravity: { ...explorer.scene.gravity, [name]: 1e-12 } });
      } catch (error) {
        return error.message;
      }
      return "";
    }, brake);
    assert.match(said, new RegExp(`got a time of 1e-12 for ${brake}; expected 0 for none, or [\\d.e-]+ or more`));
    assert.deepEqual(await page.evaluate(() => window.explorer.scene), good);
  }
  // The shortest of both, and a pericentre that is passed in no time: each ends, and says why, or is
  // followed to the last sample.
  const found = await page.evaluate(() => {
    const { explorer } = window;
    const { gravity } = explorer.scene;
    const shorter = 64 * explorer.driven.step;
    return [
      { friction: 0.0101 * shorter },
      { drag: 0.0101 * shorter },
      { eccentricity: 0.9999999 },
    ].map((change) => {
      const begun = performance.now();
      let refused = "";
      let least = 0;
      try {
        explorer.change({ gravity: { ...gravity, ...change } });
        const { driven } = explorer;
        driven.at(driven.time(19_999));
        least = driven.count;
        refused = driven.ended;
      } catch (error) {
        refused = error.message;
      }
      const took = performance.now() - begun;
      explorer.change({ gravity });
      return { change, took, least, refused };
    });
  });
  for (const { change, took, least, refused } of found) {
    assert.ok(refused !== "" || least === 20_000, JSON.stringify(change));
    assert.ok(took < 20_000, `${JSON.stringify(change)}: ${took} ms`); // on a loaded machine
  }
  if (process.env.SHOW) console.log(found);
  assert.deepEqual(errors, []);
  await page.close();
});

test("at rest nothing is dragged, every chart opens, and keys say why they do nothing", async () => {
  const { page, errors } = await opened(browser);
  await page.evaluate(() => window.explorer.changeState({ q: [1, 0, 0, 0], g: [0, 0, 0] }));
  await drawn(page);
  for (const name of ["sphere", "plane"]) {
    await page.focus(`#${name}`);
    await page.keyboard.press("ArrowUp");
    assert.notEqual(await text(page, "#refusal"), "", name);
  }
  for (const tab of await page.locator("#chart-tabs button").all()) {
    await tab.click();
    await drawn(page);
  }
  assert.equal(await page.isVisible("#fatal"), false);
  await choose(page, "toutatis");
  assert.equal(await text(page, "#refusal"), "");
  assert.deepEqual(errors, []);
  await page.close();
});

test("the axis of the frame is typed before its rate, and outlives rate 0", async () => {
  const { page, errors } = await opened(browser);
  const field = (k) => page.locator("#frame .field").nth(k);
  const frame = () => page.evaluate(() => window.explorer.scene.precession);
  await type(field(1), "1");
  assert.equal(await frame(), null);
  await type(field(0), "2");
  assert.deepEqual((await frame()).axis, [1, 0, 1]);
  await type(field(0), "0");
  assert.equal(await frame(), null);
  await type(field(0), "3");
  assert.deepEqual((await frame()).axis, [1, 0, 1]);
  assert.deepEqual(errors, []);
  await page.close();
});

test("other orders of the moments: words name the axes, and a plate has no light curve", async () => {
  const { page, errors } = await opened(browser);
  for (const [moments, g, said] of [
    [[6, 4, 3], [1, 0.1, 0.1], /greatest moment, b₁/],
    [[6, 3, 4], [0.1, 1, 0.1], /least moment, b₂/],
    [[4, 3, 6], [0.1, 1, 0.1], /least moment, b₂/],
    [[1, 2, 3], [0.1, 0.1, 1], /greatest moment, b₃/],
  ]) {
    await page.evaluate(([m, momentum]) => {
      window.explorer.change({ moments: m, state: { q: [1, 0, 0, 0], g: momentum } });
    }, [moments, g]);
    await drawn(page);
    assert.match(await text(page, "#sentence"), said);
    assert.equal(await page.isVisible("#fatal"), false);
  }
  assert.equal(await page.evaluate(() => window.views.light.dark), true);
  assert.deepEqual(errors, []);
  await page.close();
});

test("the tour and a link give back what was shown", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "toutatis");
  await page.evaluate(() => (window.explorer.now = 3));
  const scene = () => page.evaluate(() => window.explorer.scene);
  const before = await scene();
  await page.click("#tour-open");
  await page.click("#tour-next");
  await page.click("#tour-end");
  assert.deepEqual(await scene(), before);
  assert.equal(await page.inputValue("#preset"), "toutatis");
  await page.evaluate(() => window.explorer.changeState({ q: [1, 0, 0, 0], g: [1, -0, 2] }));
  await page.click("#copies-open");
  const link = (await page.inputValue("#copy-text")).replace(/^[^#]*/, "");
  const { page: other } = await opened(browser, { link });
  assert.equal(await other.inputValue("#preset"), "");
  assert.equal(await text(other, "#about"), "A state from a link.");
  const linked = await other.evaluate(() => window.explorer.scene.state);
  assert.ok(Object.is(linked.g[1], -0));
  await other.keyboard.press("r");
  assert.deepEqual(await other.evaluate(() => window.explorer.scene.state), linked);
  assert.deepEqual(errors, []);
  await page.close();
  await other.close();
});
