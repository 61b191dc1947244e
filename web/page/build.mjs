#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Builds the explorer as one file that needs no server: scripts, styles and the core are in it.
//
//     node web/page/build.mjs [OUT]      into web/dist/page, and a copy into OUT; prints the sizes
import { createHash } from "node:crypto";
import { copyFile, mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const web = dirname(here);
const LIMIT = 400_000; // bytes, gzipped

export async function page({
  out = resolve(web, "dist/page"),
  core = resolve(web, "dist/core.js"),
  wasm = resolve(web, "dist/polhode.wasm"),
} = {}) {
  const script = await build({
    entryPoints: [resolve(here, "main.ts")],
    bundle: true,
    format: "iife", // a page of a disk loads no modules
    target: "es2022",
    minify: true,
    write: false,
    legalComments: "eof",
    define: { "import.meta.url": '"about:blank"' }, // the page gives the core its bytes
    alias: { "polhode/core": core },
    plugins: [compressed(wasm)],
  });
  const style = await build({
    entryPoints: [resolve(here, "style.css")],
    minify: true,
    write: false,
  });
  // A script ends at the first "</script", wherever it stands.
  const code = script.outputFiles[0].text.replaceAll("</script", "<\\/script");
  const html = (await readFile(resolve(here, "index.html"), "utf8"))
    .replace("/* style.css */", () => style.outputFiles[0].text)
    .replace("/* main.ts */", () => code)
    .replace("POLICY", policy(code));
  await mkdir(out, { recursive: true });
  const file = resolve(out, "index.html");
  await writeFile(file, html);
  return { file, bytes: html.length, gzipped: gzipSync(html, { level: 9 }).length };
}

/** The page runs this one script and asks no server for anything: what a link brings cannot run. */
function policy(code) {
  const hash = createHash("sha256").update(code).digest("base64");
  return [
    "default-src 'none'",
    `script-src 'sha256-${hash}' 'wasm-unsafe-eval'`,
    "style-src 'unsafe-inline'",
    "img-src data:",
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
}

/** The core as gzipped bytes: as text they would grow by a third, and shrink no more. */
const compressed = (wasm) => ({
  name: "compressed",
  setup(build) {
    build.onResolve({ filter: /^polhode\/core\.wasm$/ }, () => ({ path: wasm, namespace: "gzip" }));
    build.onLoad({ filter: /./, namespace: "gzip" }, async ({ path }) => ({
      contents: gzipSync(await readFile(path), { level: 9 }),
      loader: "binary",
    }));
  },
});

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { file, bytes, gzipped } = await page();
  const [, , copy] = process.argv;
  if (copy) {
    await mkdir(copy, { recursive: true });
    await copyFile(file, resolve(copy, "index.html"));
  }
  console.log(`${file}: ${bytes} bytes, ${gzipped} gzipped`);
  if (gzipped > LIMIT) {
    console.error(`expected at most ${LIMIT} bytes gzipped`);
    process.exit(1);
  }
}
