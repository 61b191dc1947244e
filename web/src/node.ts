// SPDX-License-Identifier: MIT
// Everything, ready when it is imported, in Node: without waiting, so that require() takes it, too.
import { readFileSync } from "node:fs";
import { loadSync } from "./core.js";

export * from "./core.js";

loadSync(readFileSync(new URL("./polhode.wasm", import.meta.url)));
