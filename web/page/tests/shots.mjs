#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Pictures of the explorer to look at: wide and narrow, light and dark.
//
//     node web/page/tests/shots.mjs FOLDER [NAME ...]
import { mkdir } from "node:fs/promises";
import { resolve } from "node:path";
import { choose, drawn, launched, opened } from "./browser.mjs";

const WIDE = {};
const PHONE = { width: 390, height: 844 };
const now = (page, t) => page.evaluate((time) => (window.explorer.now = time), t);
const SHOTS = {
  "wing-nut": [WIDE, (page) => now(page, 5.3)],
  "wing-nut-dark": [{ dark: true }, (page) => now(page, 5.3)],
  toutatis: [WIDE, (page) => choose(page, "toutatis")],
  apophis: [{ dark: true }, (page) => choose(page, "apophis")],
  hyperion: [WIDE, (page) => choose(page, "hyperion")],
  "figure-6": [{ dark: true }, (page) => choose(page, "figure-6")],
  envisat: [WIDE, (page) => choose(page, "envisat")],
  earth: [{ dark: true }, (page) => choose(page, "earth")],
  "figure-2": [WIDE, (page) => choose(page, "figure-2")],
  "figure-3": [WIDE, (page) => choose(page, "figure-3")],
  "figure-5": [WIDE, (page) => choose(page, "figure-5")],
  friction: [
    WIDE,
    async (page) => {
      await choose(page, "toutatis");
      await page.check("#friction");
    },
  ],
  large: [WIDE, (page) => page.click("#pane-sphere .expand")],
  tour: [WIDE, (page) => page.keyboard.press("t")],
  copies: [WIDE, (page) => page.click("#copies-open")],
  cut: [WIDE, (page) => page.evaluate(() => (location.hash = "#v=1&name=Toutatis&units=d;1&I=1,2.9"))],
  refused: [
    WIDE,
    async (page) => {
      await page.locator("#moments input").nth(2).fill("500");
      await page.locator("#moments input").nth(2).press("Enter");
    },
  ],
  small: [{ width: 1280, height: 720 }, (page) => now(page, 5.3)],
  tablet: [{ width: 820, height: 1180 }, (page) => choose(page, "apophis")],
  "gravity-satellite": [
    WIDE,
    async (page) => {
      await choose(page, "gravity-satellite");
      await now(page, 9000);
    },
  ],
  "hyperion-saturn": [
    { dark: true },
    async (page) => {
      await choose(page, "hyperion-saturn");
      await now(page, 60);
    },
  ],
  keys: [WIDE, (page) => page.click("#keys-open")],
  phone: [PHONE, (page) => now(page, 5.3)],
  "phone-dark": [{ ...PHONE, dark: true }, (page) => page.locator("#pane-sphere").scrollIntoViewIfNeeded()],
  "phone-gravity": [
    PHONE,
    async (page) => {
      await choose(page, "gravity-satellite");
      await now(page, 9000);
    },
  ],
  "phone-numbers": [PHONE, (page) => page.locator("#pane-numbers").scrollIntoViewIfNeeded()],
  "phone-settings": [{ ...PHONE, dark: true }, (page) => page.locator("#frame").scrollIntoViewIfNeeded()],
  "phone-tour": [PHONE, (page) => page.click("#tour-open")],
};

const [folder, ...names] = process.argv.slice(2);
if (!folder) throw new Error("usage: shots.mjs FOLDER [NAME ...]");
await mkdir(folder, { recursive: true });
const browser = await launched();
for (const name of names.length > 0 ? names : Object.keys(SHOTS)) {
  const [look, act] = SHOTS[name];
  const { page, errors } = await opened(browser, look);
  await act(page);
  await drawn(page);
  await page.waitForTimeout(600); // what stands still is drawn in full
  await drawn(page);
  await page.screenshot({ path: resolve(folder, `${name}.png`), timeout: 120_000 });
  for (const error of errors) console.log(`${name}: ${error}`);
  await page.close();
}
await browser.close();
