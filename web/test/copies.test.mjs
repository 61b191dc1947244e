// SPDX-License-Identifier: MIT
// Text of a motion for the command line, Python and C++.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { Body, FreeRotation, copies, rotorState } from "polhode";

const root = fileURLToPath(new URL("../..", import.meta.url));
const build = process.env.POLHODE_BUILD ?? join(root, "build/release");

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

// What was copied runs, where its program is built, and gives the state that was copied.
const COMMAND = join(build, "polhode");
const PYTHON = join(root, ".venv/bin/python");
const PACKAGE = join(build, "python");
const EXTENSION = existsSync(join(PACKAGE, "polhode"))
  ? readdirSync(join(PACKAGE, "polhode")).find((file) => /^_core\..*so$/.test(file))
  : undefined;
const LIBRARY = join(build, "src/libpolhode.a");
const without = (...files) => {
  const missing = files.find((file) => !existsSync(file));
  return missing === undefined ? false : `${missing} is not built`;
};
const nut = new Body(30.53, 83.87, 113.3);
const turned = rotorState(nut, [0.8, 0.1, -0.5, 0.3], [0.01, 6.28, 1e-7]);
const motion = new FreeRotation(nut, turned);

function near(found, expected, tolerance) {
  assert.equal(found.length, expected.length, `${found}`);
  found.forEach((x, i) => assert.ok(Math.abs(x - expected[i]) <= tolerance * Math.max(1, Math.abs(expected[i])), `${found} ${expected}`));
}
function inFolder(use) {
  const folder = mkdtempSync(join(tmpdir(), "polhode-"));
  try {
    return use(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
const run = (program, args, options = {}) => execFileSync(program, args, { encoding: "utf8", ...options });

for (const units of [{}, { title: 'a "body"', time: "s", moment: "kg m2" }])
  test(`the TOML runs: ${JSON.stringify(units)}`, { skip: without(COMMAND) }, () => {
    const csv = inFolder((folder) => {
      const file = join(folder, "copied.toml");
      writeFileSync(file, copies(nut, turned, units).toml);
      return run(COMMAND, ["run", file]);
    });
    const lines = csv.split("\n").filter((line) => line !== "" && !line.startsWith("#"));
    assert.equal(lines.length, 1 + 1001);
    for (const index of [0, 1, 500, 1000]) {
      const [t, ...row] = lines[1 + index].split(",").map(Number);
      const { q, g } = motion.at(t);
      near([...row.slice(0, 4), ...row.slice(7, 10)], [...q, ...g], 1e-12);
    }
  });

test("the Python runs", { skip: without(PYTHON, join(PACKAGE, "polhode", EXTENSION ?? "_core")) }, () => {
  const printed = run(PYTHON, ["-c", copies(nut, turned, { t0: 2.5 }).python], { env: { ...process.env, PYTHONPATH: PACKAGE } });
  near(printed.match(/-?\d[\d.e+-]*/g).map(Number), turned.q, 1e-7);
});

test("the C++ runs", { skip: without("/usr/bin/c++", LIBRARY) }, () => {
  const printed = inFolder((folder) => {
    const source = join(folder, "copied.cpp"), program = join(folder, "copied");
    writeFileSync(source, copies(nut, turned, { t0: 2.5 }).cpp);
    run("/usr/bin/c++", ["-std=c++20", "-ffp-contract=off", `-I${join(root, "include")}`, source, LIBRARY, "-pthread", "-o", program]);
    return run(program, []);
  });
  near(printed.trim().split(" ").map(Number), turned.q, 1e-15);
});
