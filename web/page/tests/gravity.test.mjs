// SPDX-License-Identifier: MIT
// The body with torques beside the free one: what is drawn is what the core integrates, what the
// command line makes of the copied scenario, and what the theory of small swings says.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
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
const pulled = (page, t) =>
  page.evaluate((time) => {
    const { q, g } = window.explorer.driven.at(time);
    return [...q, ...g];
  }, t);

const POLHODE = fileURLToPath(new URL("../../../build/release/polhode", import.meta.url));

test("a small swing in the plane of the orbit has the period of theory", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "gravity-satellite");
  const found = await page.evaluate(() => {
    const { explorer } = window;
    const { period } = explorer.scene.gravity;
    const rate = (2 * Math.PI) / period;
    const half = 0.0005; // of the angle, rad: 1 mrad off the line to the planet, at rest to it
    explorer.change({
      state: { q: [Math.cos(half), 0, 0, Math.sin(half)], g: [0, 0, 100 * rate] },
      gravity: { ...explorer.scene.gravity, friction: 0 },
    });
    const angle = (t) => {
      const { q } = explorer.driven.at(t);
      const off = 2 * Math.atan2(q[3], q[0]) - rate * t;
      return Math.atan2(Math.sin(off), Math.cos(off));
    };
    // The first return through 0, upwards: three quarters of a swing.
    let [low, high] = [0.5 * period / 1.6, 0.95 * period / 1.6];
    for (let i = 0; i < 50; ++i) {
      const middle = (low + high) / 2;
      if (angle(middle) < 0) low = middle;
      else high = middle;
    }
    return { swing: low / 0.75, period, centre: explorer.driven.toCentre(period / 8) };
  });
  const expected = found.period / Math.sqrt((3 * (98 - 10)) / 100); // sqrt(3 (I2 - I1)/I3) n
  for (const [k, x] of [-Math.SQRT1_2, -Math.SQRT1_2, 0].entries()) {
    assert.ok(Math.abs(found.centre[k] - x) < 1e-12, `${found.centre}`);
  }
  assert.ok(Math.abs(found.swing / expected - 1) < 1e-6, `${found.swing}, ${expected}`);
  assert.deepEqual(errors, []);
  await page.close();
});

test("the copied scenario, run by polhode, ends where the page draws the body", async (t) => {
  if (!existsSync(POLHODE)) return t.skip("no build/release/polhode");
  const { page, errors } = await opened(browser);
  const folder = mkdtempSync(join(tmpdir(), "polhode-"));
  try {
    await choose(page, "hyperion-saturn");
    await page.evaluate(() => {
      const { explorer } = window;
      const { gravity } = explorer.scene;
      explorer.change({ gravity: { ...gravity, inclination: 20, node: 40, pericentre: 70, drag: 900, friction: 400 } });
      explorer.now = 12.5;
    });
    await page.click("#copies-open");
    await page.click("#copy-tabs [data-kind=toml]");
    const file = join(folder, "copied.toml");
    const toml = (await page.inputValue("#copy-text"))
      .replace("stop = 100.0", "stop = 30.0")
      .replace('["q", "omega", "g"]', '["q", "g"]');
    assert.match(toml, /gravity-gradient[\s\S]*internal-damping[\s\S]*"damping"/);
    writeFileSync(file, toml);
    execFileSync(POLHODE, ["run", file, "-o", join(folder, "out.csv")]);
    const last = readFileSync(join(folder, "out.csv"), "utf8").trim().split("\n").at(-1);
    const [, ...state] = last.split(",").map(Number);
    const found = await pulled(page, 42.5);
    const size = Math.hypot(...found.slice(4));
    const same = Math.sign(state[0] * found[0] + state[1] * found[1] + state[2] * found[2] + state[3] * found[3]);
    for (const [k, value] of found.entries()) {
      const off = k < 4 ? Math.abs(same * state[k] - value) : Math.abs(state[k] - value) / size;
      assert.ok(off < 1e-7, `${k}: ${state[k]}, ${value}`);
    }
    assert.deepEqual(errors, []);
  } finally {
    rmSync(folder, { recursive: true });
    await page.close();
  }
});

test("the link holds orbit and friction; the panel says what the body does, and where it ends", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "hyperion-saturn");
  await page.evaluate(() => (window.explorer.now = 40));
  await drawn(page);
  assert.match(await text(page, "#driven"), /-axis mode[\s\S]*off the line to the planet\s+[\d.]+°/);
  await page.click("#copies-open");
  const link = (await page.inputValue("#copy-text")).replace(/^[^#]*/, "");
  assert.match(link, /&orbit=21\.277,0\.1,0,0,0,0,0,0&/);
  const { page: other } = await opened(browser, { link });
  assert.deepEqual(await pulled(other, 40), await pulled(page, 40));
  await page.click("#copies [data-close]");
  await page.evaluate(() => (window.explorer.now = 1e9));
  await drawn(page);
  assert.match(await text(page, "#driven-mode"), /^followed to t = /);
  await page.evaluate(() => (window.explorer.now = -1));
  await drawn(page);
  assert.match(await text(page, "#driven-mode"), /^from t = 0 d on$/);
  const bad = link.replace(/orbit=[^&]*/, "orbit=21.277,1.5,0,0,0,0,0,0");
  await page.evaluate((hash) => (location.hash = hash), bad);
  await page.waitForFunction((l) => document.getElementById("link-field").value === l, bad);
  assert.match(await text(page, "#link-error"), /^got an eccentricity of 1.5; expected one from 0 to below 1$/);
  assert.deepEqual(errors, []);
  await page.close();
  await other.close();
});

test("gravity is switched by key and box, typed, and refused with a sentence", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "toutatis");
  const gravity = () => page.evaluate(() => window.explorer.scene.gravity);
  assert.equal(await gravity(), null);
  await page.keyboard.press("g");
  assert.equal(await page.isChecked("#gravity"), true);
  assert.ok((await gravity()).period > 0);
  const field = (place, k) => page.locator(`#${place} .field`).nth(k);
  await type(field("orbit", 1), "1.2");
  assert.match(await field("orbit", 1).locator(".error").innerText(), /eccentricity of 1\.2/);
  assert.equal((await gravity()).eccentricity, 0);
  await type(field("orbit", 1), "0.3");
  await type(field("brakes", 0), "50");
  const typed = await gravity();
  assert.deepEqual([typed.eccentricity, typed.friction], [0.3, 50]);
  await page.locator("#gravity").click();
  assert.equal(await gravity(), null);
  await drawn(page);
  assert.equal(await page.isVisible("#driven"), false);
  await page.locator("#gravity").click();
  assert.deepEqual(await gravity(), typed);
  await page.evaluate(() => window.explorer.changeState({ q: [1, 0, 0, 0], g: [1, 2, 3] }));
  assert.equal(await page.evaluate(() => window.explorer.driven !== null), true);
  await page.locator("#gravity").click();
  await page.evaluate(() => window.explorer.change({ moments: [1, 1, 1] })); // friction moves no ball
  await page.locator("#gravity").click();
  assert.notEqual(await text(page, "#gravity-trouble"), "");
  assert.equal(await page.isChecked("#gravity"), false);
  assert.deepEqual(errors, []);
  await page.close();
});
