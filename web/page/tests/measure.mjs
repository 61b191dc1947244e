#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Times of the explorer in headless Chromium, WebGL in software: first picture, a frame of each
// view, ten thousand states.
//
//     node web/page/tests/measure.mjs
import { launched, opened } from "./browser.mjs";

const browser = await launched();
const { page } = await opened(browser);
const times = await page.evaluate(async () => {
  const { explorer } = window;
  const median = (act, count = 41) => {
    const all = Array.from({ length: count }, () => {
      const start = performance.now();
      act();
      return performance.now() - start;
    });
    return all.sort((a, b) => a - b)[(count - 1) / 2];
  };
  const out = new Float64Array(7e4);
  const { turn, motion } = explorer.model;
  const grid = { start: explorer.now, step: turn / 100, count: 1e4 };
  const result = {
    "10,000 states on a grid (ms)": median(() => motion.states(grid, out)),
    "another state, all prepared (ms)": median(() => explorer.changeState(explorer.state)),
  };
  for (const [name, view] of Object.entries(window.views)) {
    result[`picture: ${name} (ms)`] = median(() => view.draw(explorer));
  }
  explorer.play(true);
  const frames = await new Promise((done) => {
    let [count, first] = [0, 0];
    const step = (clock) => {
      if (count === 0) first = clock;
      if (++count > 60) done((clock - first) / 60);
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
  explorer.play(false);
  result["playing, one frame of the screen (ms)"] = frames;
  return result;
});
await page.close();
const first = await opened(browser);
const marks = await first.page.evaluate(() =>
  performance.getEntriesByType("mark").map(({ name, startTime }) => [name, startTime]),
);
for (const [name, at] of marks) times[`${name} there, after opening (ms)`] = at;
for (const [what, ms] of Object.entries(times)) console.log(ms.toFixed(2).padStart(9), what);
await browser.close();
