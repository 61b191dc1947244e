// SPDX-License-Identifier: MIT
// Every golden case in the browser: its states have the bits that the library gives on this machine
// (web/test/answers.cpp writes them), as they have in Node (web/test/golden.test.mjs).
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { launched } from "./browser.mjs";

const path = (name) => fileURLToPath(new URL(name, import.meta.url));
const ANSWERS = process.env.POLHODE_WEB_ANSWERS ?? path("../../../build/web/answers.json");

test("states of every golden case, in Chromium, have the bits of the library", async () => {
  assert.ok(existsSync(ANSWERS), `${ANSWERS}: not there; make web writes it`);
  const number = (_, x) => (typeof x === "string" && (x === "NaN" || !isNaN(Number(x))) ? Number(x) : x);
  const { cases } = JSON.parse(readFileSync(ANSWERS, "utf8"), number);
  assert.ok(cases.length >= 43, `${cases.length} cases`);
  const { outputFiles } = await build({
    stdin: { contents: 'export * from "./dist/core.js"', resolveDir: path("../..") },
    bundle: true,
    format: "iife",
    globalName: "polhode",
    write: false,
    define: { "import.meta.url": '"about:blank"' },
  });
  const browser = await launched();
  try {
    const page = await browser.newPage();
    await page.addScriptTag({ content: outputFiles[0].text });
    const wasm = readFileSync(path("../../dist/polhode.wasm")).toString("base64");
    // Bits travel as text: JSON has neither -0 nor NaN.
    const found = await page.evaluate(
      async ([core, asked]) => {
        const { Body, FreeRotation, load, rotorState } = window.polhode;
        await load(Uint8Array.from(atob(core), (c) => c.charCodeAt(0)));
        const bits = (numbers) =>
          [...new BigUint64Array(Float64Array.from(numbers).buffer)].map((b) => b.toString(16)).join();
        return asked.map(({ moments, q0, omega0, times }) => {
          const body = new Body(...moments);
          const motion = new FreeRotation(body, rotorState(body, q0, omega0));
          const at = times.flatMap((t) => Object.values(motion.at(t)).flatMap((part) => [...part]));
          return {
            at: bits(at),
            rows: bits(motion.states(times)),
            grid: bits(motion.states({ start: 0.25, step: 0.375, count: 300 })),
          };
        });
      },
      [wasm, cases.map(({ moments, q0, omega0, times }) => ({ moments, q0, omega0, times }))],
    );
    const bits = (numbers) =>
      [...new BigUint64Array(Float64Array.from(numbers).buffer)].map((b) => b.toString(16)).join();
    for (const [index, golden] of cases.entries()) {
      for (const name of ["at", "rows", "grid"]) {
        assert.ok(found[index][name] === bits(golden[name]), `${golden.name}: ${name}`);
      }
    }
  } finally {
    await browser.close();
  }
});
