// SPDX-License-Identifier: MIT
// Every golden case in the browser: its states have the bits that the library gives on this machine
// (web/test/answers.cpp writes them), and with the same sines all numbers, as in Node
// (web/test/golden.test.mjs).
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { BACK, CHARTS, FLOW, RATES, STATES } from "../../test/tools/answers.mjs";
import { compared, written } from "../../test/tools/bits.mjs";
import { launched } from "./browser.mjs";

const path = (name) => fileURLToPath(new URL(name, import.meta.url));
const answersOf = (file) => {
  assert.ok(existsSync(file), `${file}: not there; make web writes it`);
  return written(file);
};

test("every golden case, in Chromium, has the bits of the library", async () => {
  const native = answersOf(process.env.POLHODE_WEB_ANSWERS ?? path("../../../build/web/answers.json"));
  const musl = answersOf(process.env.POLHODE_WEB_ANSWERS_MUSL ?? path("../../../build/web/answers_musl.json"));
  assert.ok(native.cases.length >= 43, `${native.cases.length} cases`);
  const { outputFiles } = await build({
    stdin: {
      contents: 'export * as polhode from "./dist/core.js"; export * from "./test/tools/answers.mjs"',
      resolveDir: path("../.."),
    },
    bundle: true,
    format: "iife",
    globalName: "asked",
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
      async ([core, cases, problem]) => {
        const { polhode, answers, perturbed } = window.asked;
        await polhode.load(Uint8Array.from(atob(core), (c) => c.charCodeAt(0)));
        const bits = (numbers) =>
          [...new BigUint64Array(Float64Array.from(numbers).buffer)].map((b) => b.toString(16)).join();
        const all = cases.map((golden) => answers(polhode, golden));
        return [...all, { perturbed: perturbed(polhode, problem) }].map((named) =>
          Object.fromEntries(Object.entries(named).map(([name, numbers]) => [name, bits(numbers)])),
        );
      },
      [wasm, native.cases.map(({ moments, q0, omega0, times }) => ({ moments, q0, omega0, times })), native.problem],
    );
    const numbers = (text) =>
      text === "" ? [] : [...new Float64Array(BigUint64Array.from(text.split(","), (b) => BigInt(`0x${b}`)).buffer)];
    const answers = found.map((named) =>
      Object.fromEntries(Object.entries(named).map(([name, bits]) => [name, numbers(bits)])),
    );
    const states = compared(answers, native.cases, [...STATES, ...RATES]);
    assert.ok(states.numbers > 100_000, `${states.numbers}`);
    assert.equal(states.different, 0, states.where);
    const all = compared(answers, musl.cases, [...STATES, ...RATES, ...CHARTS, ...FLOW, ...BACK]);
    console.log(`Chromium, all, with the same sines: ${all.different} of ${all.numbers} differ`);
    assert.equal(all.different, 0, all.where);
    assert.deepEqual(answers.at(-1).perturbed, musl.perturbed);
  } finally {
    await browser.close();
  }
});
