// SPDX-License-Identifier: MIT
// Everything, ready when it is imported.
import { load } from "./core.js";

export * from "./core.js";

await load();
