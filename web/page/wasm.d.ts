// SPDX-License-Identifier: MIT
// The core as gzipped bytes, put into the page by the bundler.
declare module "polhode/core.wasm" {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}
