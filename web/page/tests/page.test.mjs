// SPDX-License-Identifier: MIT
// The explorer in a browser, from disk: what it shows, what it does when it is dragged, typed to and
// linked to, and what it says of what is wrong.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { gzipSync } from "node:zlib";
import { choose, drawn, FILE, launched, opened } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launched();
});
after(() => browser?.close());

const text = (page, selector) => page.locator(selector).innerText();
const state = (page) =>
  page.evaluate(() => {
    const { state, scene } = window.explorer;
    return { q: [...state.q], g: [...state.g], now: scene.now, moments: [...scene.moments] };
  });

/** Drags a dot of a canvas to a place given in parts of the canvas. */
async function drag(page, name, [u, v]) {
  const box = await page.locator(`#${name}`).boundingBox();
  const dot = await page.evaluate((n) => window[n].dot, name);
  await page.mouse.move(box.x + dot.x, box.y + dot.y);
  await page.mouse.down();
  const to = [box.x + u * box.width, box.y + v * box.height];
  await page.mouse.move((box.x + dot.x + to[0]) / 2, (box.y + dot.y + to[1]) / 2);
  await page.mouse.move(...to);
  await page.mouse.up();
  await drawn(page);
}

test("the page is at most 400 kB, gzipped", async () => {
  const bytes = gzipSync(await readFile(FILE), { level: 9 }).length;
  assert.ok(bytes <= 400_000, `${bytes} bytes`);
});

test("the wing nut turns over every 3.695488 s", async () => {
  const { page, errors } = await opened(browser);
  assert.equal(await text(page, "#mode"), "Long-axis mode");
  assert.match(await text(page, "#clocks"), /turns over every\s+3\.695488\s+s/);
  await page.click("#next");
  await page.click("#next");
  const between = await page.evaluate(() => {
    const { explorer } = window;
    const first = explorer.now;
    return explorer.flipFrom(first, 1) - first;
  });
  assert.ok(Math.abs(between - 3.695488) < 5e-7, `${between}`);
  assert.deepEqual(errors, []);
  await page.close();
});

test("every preset opens, and says its published periods", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "toutatis");
  assert.match(await text(page, "#clocks"), /5\.37\d*\s+d[\s\S]*7\.41\d*\s+d/);
  await choose(page, "apophis");
  assert.match(await text(page, "#clocks"), /263\s+h[\s\S]*30\.56\s+h[\s\S]*27\.37866\s+h/);
  await choose(page, "earth");
  assert.match(await text(page, "#clocks"), /303\.6284\s+d/);
  const ids = await page.$$eval("#preset optgroup option", (options) => options.map((o) => o.value));
  assert.ok(ids.length >= 12);
  for (const id of ids) {
    await choose(page, id);
    assert.notEqual(await text(page, "#about"), "", id);
  }
  assert.deepEqual(errors, []);
  await page.close();
});

test("dragged across the separatrix, the dot changes the mode; momentum stays in space", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "figure-1");
  const momentum = () => page.evaluate(() => [...window.explorer.model.motion.momentumDirection]);
  const before = await momentum();
  const mode = await text(page, "#mode");
  assert.match(mode, /-axis mode/);
  await drag(page, "sphere", mode.startsWith("Long") ? [0.5, 0.15] : [0.32, 0.58]);
  assert.notEqual(await text(page, "#mode"), mode);
  const after = await momentum();
  for (const k of [0, 1, 2]) assert.ok(Math.abs(before[k] - after[k]) < 1e-12);

  await drag(page, "plane", [0.78, 0.46]); // l = 90 deg, L = 0: within the shaded lobe
  assert.equal(await text(page, "#mode"), "Long-axis mode");
  await drag(page, "plane", [0.78, 0.08]);
  assert.equal(await text(page, "#mode"), "Short-axis mode");
  assert.deepEqual(errors, []);
  await page.close();
});

test("the link holds the state to the last bit", async () => {
  const { page } = await opened(browser);
  await choose(page, "apophis");
  await page.evaluate(() => (window.explorer.now = 123.456));
  await drag(page, "sphere", [0.4, 0.45]);
  await page.click("#copies-open");
  const link = await page.inputValue("#copy-text");
  const { page: other, errors } = await opened(browser, { link: link.slice(link.indexOf("#")) });
  assert.deepEqual(await state(other), await state(page));
  assert.equal(await text(other, "#clocks"), await text(page, "#clocks"));
  assert.equal(await other.evaluate(() => window.explorer.playing), false);
  assert.deepEqual(errors, []);
  await page.close();
  await other.close();
});

test("a link that was cut is named, and the last good picture stays", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "toutatis");
  const good = await state(page);
  await page.click("#copies-open");
  const link = (await page.inputValue("#copy-text")).replace(/^[^#]*/, "");
  await page.click("#copies [data-close]");
  const cuts = [
    [link.slice(0, link.indexOf("&g=") + 9), /^(g|epoch): /],
    [link.slice(0, -8), /^end: missing; expected "all": the link was cut$/],
    [link.replace(/I=[^&]*/, "I=1,2,9"), /^I: .*\(1, 2, 9\).*/],
    [link.replace(/epoch=[^&]*/, "epoch=soon"), /^epoch: got "soon"; expected a finite number$/],
    ["#nonsense", /^v: missing; expected 1/],
    [
      link.replace(/units=[^&]*/, `units=s;${encodeURIComponent("<img src=x onerror=hit=1>")}`),
      /^units: got .*expected names of a unit of time and one of moment/,
    ],
  ];
  for (const [cut, expected] of cuts) {
    await page.evaluate((hash) => (location.hash = hash), cut);
    await page.waitForFunction((l) => document.getElementById("link-field").value === l, cut);
    assert.match(await text(page, "#link-error"), expected);
    assert.deepEqual(await state(page), good);
  }
  assert.equal(await page.evaluate(() => "hit" in window || document.querySelector("img") !== null), false);
  await page.fill("#link-field", link);
  await page.click("#link-try");
  assert.equal(await page.isVisible("#link-trouble"), false);
  assert.deepEqual(errors, []);
  await page.close();
});

test("osculating elements go over the ends of a turn without a stroke across the plane", async () => {
  const { page, errors } = await opened(browser);
  for (const id of ["figure-1", "toutatis", "wing-nut"]) {
    await choose(page, id);
    const widest = await page.evaluate(() => {
      const { explorer, plane } = window;
      const rate = 0.2 / explorer.model.turn;
      explorer.change({ precession: { axis: [1, 0.3, 1], rate } });
      const rows = plane.osculating;
      let widest = 0;
      for (let i = 2; i < rows.length; i += 2) widest = Math.max(widest, Math.abs(rows[i] - rows[i - 2]));
      return widest;
    });
    assert.ok(widest <= Math.PI, `${id}: ${widest}`);
  }
  assert.deepEqual(errors, []);
  await page.close();
});

test("moments that no body has: the library's sentence beside the field", async () => {
  const { page, errors } = await opened(browser);
  const field = page.locator("#moments .field").nth(2);
  await field.locator("input").fill("500");
  await field.locator("input").press("Enter");
  assert.match(await field.locator(".error").innerText(), /^Body: moments \(30\.53, 83\.87, 500\)/);
  assert.equal(await field.locator("input").inputValue(), "500");
  assert.deepEqual((await state(page)).moments, [30.53, 83.87, 113.3]);
  await field.locator("input").press("Escape");
  assert.equal(await field.locator("input").inputValue(), "113.3");
  assert.equal(await field.locator(".error").isVisible(), false);
  await field.locator("input").fill("a lot");
  await field.locator("input").press("Enter");
  assert.equal(await field.locator(".error").innerText(), 'got "a lot"; expected a number');
  assert.deepEqual(errors, []);
  await page.close();
});

test("typed periods of a tumbler make its state; impossible ones are refused", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "apophis");
  await page.click("#tab-tumbler");
  const rotation = page.locator("#chart .field").nth(1);
  await rotation.locator("input").fill("300");
  await rotation.locator("input").press("Enter");
  await drawn(page);
  assert.match(await text(page, "#clocks"), /300\s+h[\s\S]*30\.56\s+h/);
  await rotation.locator("input").fill("100");
  await rotation.locator("input").press("Enter");
  assert.match(await rotation.locator(".error").innerText(), /TumblerState: P_psi\/P_phi = .* impossible/);
  assert.match(await text(page, "#clocks"), /300\s+h/);
  assert.deepEqual(errors, []);
  await page.close();
});

test("keys: play, flips, the dot; reduced motion waits to be asked", async () => {
  const { page, errors } = await opened(browser);
  const playing = () => page.evaluate(() => window.explorer.playing);
  assert.equal(await playing(), false);
  await page.keyboard.press("Space");
  assert.equal(await playing(), true);
  await page.keyboard.press("Space");
  await page.keyboard.press("Home");
  assert.equal((await state(page)).now, 0);
  await page.keyboard.press(".");
  const { now, g } = await state(page);
  assert.ok(now > 0 && Math.abs(g[1]) < 1e-6 * Math.hypot(...g), `g2 = ${g[1]} at ${now}`);
  await page.focus("#sphere");
  await page.keyboard.press("ArrowLeft");
  const moved = await state(page);
  assert.notDeepEqual(moved.g, g);
  assert.equal(moved.now, now);
  await page.locator("#sphere").blur();
  await page.keyboard.press("r");
  const again = await state(page);
  assert.deepEqual([again.now, ...again.moments], [0, 30.53, 83.87, 113.3]);
  assert.match(await text(page, "#clocks"), /3\.695488/);
  assert.deepEqual(errors, []);
  await page.close();
});

test("without reduced motion it plays, and a billion turns on it goes on", async () => {
  const { page, errors } = await opened(browser, { still: false });
  await page.waitForFunction(() => window.explorer.now > 0);
  await page.evaluate(() => {
    const slide = document.getElementById("slide");
    slide.value = slide.max;
    slide.dispatchEvent(new Event("input"));
  });
  await drawn(page);
  const { now, q } = await state(page);
  const turn = await page.evaluate(() => window.explorer.model.turn);
  assert.ok(Math.abs(now / turn / 1e9 - 1) < 1e-12);
  assert.ok(Math.abs(Math.hypot(...q) - 1) < 1e-15);
  assert.match(await text(page, "#turns"), /1 × 10⁹ turns/);
  assert.deepEqual(errors, []);
  await page.close();
});

test("the copies name the state shown", async () => {
  const { page, errors } = await opened(browser);
  await page.click("#copies-open");
  for (const [kind, expected] of [
    ["toml", /\[body\][\s\S]*moments = \[30\.53, 83\.87, 113\.3\]/],
    ["python", /polhode\.Body\(30\.53, 83\.87, 113\.3\)/],
    ["cpp", /Body [a-z]+[({]30\.53, 83\.87, 113\.3[)}]/],
  ]) {
    await page.click(`#copy-tabs [data-kind=${kind}]`);
    assert.match(await page.inputValue("#copy-text"), expected);
  }
  assert.deepEqual(errors, []);
  await page.close();
});

test("friction takes energy, not momentum: from the long-axis mode to spin about b3", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "toutatis");
  await page.check("#friction");
  await drawn(page);
  const path = await page.evaluate(() => [...window.sphere.friction]);
  assert.ok(Math.abs(path[0]) > Math.abs(path.at(-3)), "it leaves the long axis");
  assert.ok(Math.abs(path.at(-1)) > 0.99, `ends at ${path.slice(-3)}`);
  for (let i = 0; i < path.length; i += 3) {
    assert.ok(Math.abs(Math.hypot(...path.slice(i, i + 3)) - 1) < 1e-6);
  }
  assert.deepEqual(errors, []);
  await page.close();
});

test("osculating elements in a precessing frame are those of I (omega - mu)", async () => {
  const { page, errors } = await opened(browser);
  await choose(page, "figure-5");
  const [found, scene] = await page.evaluate(() => [
    [...window.plane.osculating.slice(0, 2)],
    window.explorer.scene,
  ]);
  const { axis, rate } = scene.precession;
  const mu = axis.map((a) => (rate * a) / Math.hypot(...axis));
  // mu along the body axes: the rows of the rotation matrix of q, transposed
  const [w, x, y, z] = scene.state.q;
  const rows = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
  const g = rows.map(
    (row, k) => scene.state.g[k] - scene.moments[k] * row.reduce((sum, r, i) => sum + r * mu[i], 0),
  );
  assert.ok(Math.abs(found[1] - g[2]) < 1e-12, `L: ${found[1]}, ${g[2]}`);
  assert.ok(Math.abs(found[0] - Math.atan2(g[0], g[1])) < 1e-12, `l: ${found[0]}`);
  assert.deepEqual(errors, []);
  await page.close();
});

test("the tour goes through six steps", async () => {
  const { page, errors } = await opened(browser);
  await page.keyboard.press("t");
  const titles = [];
  for (let k = 0; k < 6; ++k) {
    titles.push(await text(page, "#tour-title"));
    assert.equal(await text(page, "#tour-count"), `${k + 1} of 6`);
    await page.click("#tour-next");
  }
  assert.equal(new Set(titles).size, 6);
  assert.equal(await page.isVisible("#tour"), false);
  assert.deepEqual(errors, []);
  await page.close();
});

test("axe finds nothing serious, light and dark, wide and narrow", async () => {
  const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  for (const look of [{}, { dark: true }, { width: 390, height: 844 }]) {
    const { page } = await opened(browser, look);
    await page.evaluate(axe); // the page itself would let no other script in
    const serious = async () => {
      const { violations } = await page.evaluate(() => window.axe.run());
      return violations
        .filter(({ impact }) => impact === "serious" || impact === "critical")
        .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target).join(", ")}`);
    };
    assert.deepEqual(await serious(), []);
    await page.click("#copies-open");
    assert.deepEqual(await serious(), []);
    await page.click("#copies [data-close]");
    await page.evaluate(() => (location.hash = "#cut"));
    await page.waitForSelector("#link-trouble:not([hidden])");
    assert.deepEqual(await serious(), []);
    await page.close();
  }
});

test("nothing is wider than a phone", async () => {
  const { page } = await opened(browser, { width: 390, height: 844 });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.close();
});
