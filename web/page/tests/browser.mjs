// SPDX-License-Identifier: MIT
// A page of the built explorer in the Chromium of the distribution, opened from disk.
import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const FILE = fileURLToPath(new URL("../../dist/page/index.html", import.meta.url));

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";

// As on a machine without a graphics card: pages are put together by the processor, WebGL is emulated.
const GRAPHICS = (process.env.GRAPHICS ?? "--disable-gpu --enable-unsafe-swiftshader").split(" ");

export async function launched() {
  for (const needed of [FILE, CHROMIUM]) {
    if (!existsSync(needed)) throw new Error(`${needed}: not there; run make web`);
  }
  return chromium.launch({
    executablePath: CHROMIUM,
    args: [
      "--no-sandbox",
      "--no-first-run",
      "--disable-background-networking",
      ...GRAPHICS,
    ],
  });
}

/** The explorer, with its first picture drawn; `errors` gathers what it says to the console. */
export async function opened(browser, { link = "", width = 1440, height = 900, dark = false, still = true, touch = false } = {}) {
  const page = await browser.newPage({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    hasTouch: touch,
    reducedMotion: still ? "reduce" : "no-preference",
  });
  page.setDefaultTimeout(60_000);
  const errors = [];
  page.on("console", (said) => said.type() === "error" && errors.push(said.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(`file://${FILE}${link}`);
  await page.waitForSelector("html[data-ready]");
  return { page, errors };
}

/** Until the page has drawn what changed. */
export const drawn = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

export async function choose(page, id) {
  await page.selectOption("#preset", id);
  await drawn(page);
}
