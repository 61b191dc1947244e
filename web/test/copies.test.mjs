// SPDX-License-Identifier: MIT
// Text of a motion for the command line, Python and C++.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Body, copies } from "polhode";

const body = new Body(1, 2, 2.5);
const state = { q: [0.6, 0, 0.8, -0], g: [1e-7, 1e21, 0.1] };

test("numbers keep their bits and are decimal", () => {
  const { toml, python, cpp } = copies(body, state, { title: 'a "body"', time: "s", moment: "kg m2" });
  assert.match(toml, /^schema = 1\ntitle = "a \\"body\\""\n\n\[units\]\ntime = "s"\nmoment = "kg m2"\n/);
  for (const text of [toml, python, cpp]) {
    assert.ok(text.includes("1.0, 2.0, 2.5"), text);
    assert.ok(text.includes("0.6, 0.0, 0.8, -0.0"), text);
    assert.ok(text.includes("1e-7, 1e+21, 0.1"), text);
  }
});

test("what is not finite has no text", () => {
  assert.throws(() => copies(body, { ...state, g: [NaN, 0, 0] }), RangeError);
});
