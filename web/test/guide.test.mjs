// SPDX-License-Identifier: MIT
// The block of docs/guide/explorer.md does what the page says.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

test("the guide's block prints what the guide says", () => {
  const guide = readFileSync(new URL("../../docs/guide/explorer.md", import.meta.url), "utf8");
  const [, block, output] = /```js\n(.*?)```\n\n```text\n(.*?)```/s.exec(guide);
  const cwd = fileURLToPath(new URL("..", import.meta.url));
  assert.equal(execFileSync(process.execPath, ["--input-type=module", "-e", block], { cwd, encoding: "utf8" }), output);
});
