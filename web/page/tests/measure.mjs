#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Times of the explorer in headless Chromium without a graphics card: first picture, what our own code
// and the processes of the browser take for a picture of a motion, ten thousand states.
//
//     node web/page/tests/measure.mjs [FILE]      GRAPHICS="--use-angle=swiftshader ..." for other flags
import { readdirSync, readFileSync } from "node:fs";
import { FILE, launched } from "./browser.mjs";

const file = process.argv[2] ?? FILE;
const FRAMES = 90;
const SIZES = {
  desktop: { viewport: { width: 1440, height: 900 } },
  phone: { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true },
};

/** Processor time in ms of the browser's processes, by kind: /proc counts in hundredths of a second. */
function processorTime() {
  const all = readdirSync("/proc")
    .filter((name) => /^\d+$/.test(name))
    .flatMap((pid) => {
      try {
        const stat = readFileSync(`/proc/${pid}/stat`, "utf8");
        const after = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
        const kind = readFileSync(`/proc/${pid}/cmdline`, "utf8").match(/--type=([\w-]+)/)?.[1] ?? "main";
        return [{ pid: Number(pid), parent: Number(after[1]), ms: 10 * (Number(after[11]) + Number(after[12])), kind }];
      } catch {
        return []; // it has ended
      }
    });
  const ours = new Set([process.pid]);
  for (let found = true; found; ) {
    found = false;
    for (const { pid, parent } of all) {
      if (ours.has(parent) && !ours.has(pid)) found = Boolean(ours.add(pid));
    }
  }
  const sum = { renderer: 0, "gpu-process": 0 };
  for (const { pid, kind, ms } of all) if (ours.has(pid) && kind in sum) sum[kind] += ms;
  return sum;
}

const show = (what, value, unit = "ms") => console.log(value.toFixed(2).padStart(10), unit.padEnd(5), what);

for (const [name, size] of Object.entries(SIZES)) {
  console.log(name);
  const browser = await launched();
  const context = await browser.newContext({ ...size, reducedMotion: "reduce" });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);
  await page.addInitScript(() => {
    const ask = window.requestAnimationFrame.bind(window);
    window.own = []; // ms of our own code, picture by picture
    window.raw = ask;
    window.requestAnimationFrame = (paint) =>
      ask((clock) => {
        const start = performance.now();
        paint(clock);
        window.own.push(performance.now() - start);
      });
  });
  await page.goto(`file://${file}`);
  await page.waitForSelector("html[data-ready]");
  const marks = await page.evaluate(() =>
    performance.getEntriesByType("mark").map((mark) => [mark.name, mark.startTime]),
  );
  for (const [what, at] of marks) show(`${what} there, after opening`, at);
  const atReady = processorTime();
  show("processor time until then, page", atReady.renderer);
  show("processor time until then, graphics", atReady["gpu-process"]);

  const playing = () =>
    page.evaluate(async (count) => {
      window.own.length = 0;
      const { explorer } = window;
      explorer.play(true);
      const interval = await new Promise((done) => {
        let [seen, first] = [0, 0];
        const step = (clock) => {
          if (seen === 0) first = clock;
          if (++seen > count) done((clock - first) / count);
          else window.raw(step);
        };
        window.raw(step);
      });
      explorer.play(false);
      const own = window.own.sort((a, b) => a - b);
      return { interval, median: own[own.length >> 1], most: own[Math.floor(0.9 * own.length)] };
    }, FRAMES);
  await playing(); // until the pace of drawing is found
  const session = await context.newCDPSession(page);
  await session.send("HeapProfiler.startSampling", {
    samplingInterval: 4096,
    includeObjectsCollectedByMinorGC: true,
    includeObjectsCollectedByMajorGC: true,
  });
  await playing();
  const { profile } = await session.send("HeapProfiler.stopSampling");
  const bytes = ({ selfSize, children }) => children.reduce((sum, child) => sum + bytes(child), selfSize);
  const before = processorTime();
  const { interval, median, most } = await playing();
  const after = processorTime();
  show("from one picture to the next", interval);
  show("our own code for a picture, median", median);
  show("our own code for a picture, 9 of 10 within", most);
  for (const kind of Object.keys(before)) {
    show(`processor time for a picture, ${kind === "renderer" ? "page" : "graphics"}`, (after[kind] - before[kind]) / FRAMES);
  }
  show("memory made for a picture", bytes(profile.head) / FRAMES / 1000, "kB");

  const more = await page.evaluate(() => {
    const { explorer } = window;
    const middle = (act, count = 41) => {
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
      "10,000 states on a grid": middle(() => motion.states(grid, out)),
      "another state, all prepared": middle(() => explorer.changeState(explorer.state)),
    };
    for (const [view, { draw }] of Object.entries(window.views)) {
      result[`calls that draw: ${view}`] = middle(() => draw.call(window.views[view], explorer));
    }
    return result;
  });
  for (const [what, ms] of Object.entries(more)) show(what, ms);
  await browser.close();
}
