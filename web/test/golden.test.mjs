// SPDX-License-Identifier: MIT
// Every golden case: what WebAssembly answers, held against what the same interface answers on this
// machine (answers.cpp), bit by bit, and against the exact states. Twice: with the sines of this
// machine's C library, and with those of WebAssembly's, compiled for it (tools/musl-functions).
import assert from "node:assert/strict";
import { test } from "node:test";
import * as polhode from "polhode";
import { BACK, CHARTS, FLOW, RATES, STATES, answers, perturbed } from "./tools/answers.mjs";
import { compared, written } from "./tools/bits.mjs";

const at = (name) => new URL(`../../build/web/${name}`, import.meta.url);
const native = written(process.env.POLHODE_WEB_ANSWERS ?? at("answers.json"));
const musl = written(process.env.POLHODE_WEB_ANSWERS_MUSL ?? at("answers_musl.json"));
const found = native.cases.map((golden) => answers(polhode, golden));

function against(of, expected, names) {
  const total = compared(found, expected, names);
  console.log(`${of}: ${total.different} of ${total.numbers} differ, by ${total.ulps} ulp at most. ${total.where}`);
  return total;
}

test("states of every golden case have the bits of the library", () => {
  assert.equal(native.cases.length, 43);
  const states = against("states", native.cases, STATES);
  assert.ok(states.numbers > 100_000, `${states.numbers}`);
  assert.equal(states.different, 0);
});

test("what follows from states by arithmetic has the bits of the library", () => {
  assert.equal(against("rates", native.cases, RATES).different, 0);
});

test("charts differ by what sines and angles of two C libraries differ by", () => {
  const charts = against("charts", native.cases, CHARTS);
  assert.ok(charts.ulps <= 2, charts.where);
});

test("periods, brightness, flow charts and curves as well", () => {
  const flow = against("summary, brightness, flow charts, curves", native.cases, FLOW);
  assert.ok(flow.numbers > 6000, `${flow.numbers}`);
  assert.ok(flow.ulps <= 4, flow.where);
});

test("with the same sines, all numbers have the bits of the library", () => {
  assert.equal(musl.cases.length, native.cases.length);
  const all = [...STATES, ...RATES, ...CHARTS, ...FLOW, ...BACK];
  assert.deepEqual(Object.keys(found[0]).sort(), [...all].sort());
  assert.equal(against("all, with the same sines", musl.cases, all).different, 0);
});

test("states are exact", () => {
  let worst = 0;
  native.cases.forEach(({ times, exact }, k) =>
    times.forEach((_, i) => {
      const q = found[k].at.slice(7 * i, 7 * i + 4), e = exact.slice(7 * i, 7 * i + 4);
      const away = (sign) => Math.hypot(...q.map((x, c) => x - sign * e[c]));
      worst = Math.max(worst, Math.min(away(1), away(-1)));
    }),
  );
  console.log(`q of golden cases: ${worst.toExponential(1)} from exact`);
  assert.ok(worst < 1e-15);
});

test("perturbed motion is that of the library to rounding, with the same sines to the last bit", () => {
  const rows = perturbed(polhode, native.problem);
  assert.equal(rows.length, 25 * 22);
  assert.deepEqual(rows, musl.perturbed);
  let worst = 0;
  for (let i = 0; i < 25; ++i)
    for (let k = 1; k < 8; ++k)
      worst = Math.max(worst, Math.abs(rows[22 * i + k] - native.perturbed[22 * i + k]) / (k < 5 ? 1 : 1000));
  console.log(`perturbed motion: ${worst.toExponential(1)} from the library's`);
  assert.ok(worst < 1e-9);
});
