// Bundles web/src/levade.js into the package's levade.js, and copies the two style sheets, minified: `npm ci && npm run build`, in
// web/. The first line of the script names the sources it was made of, which a test compares (tests/report/test_bundle.py); its
// last lines are the licence of three.js. The script is one for all pages, so that three.js is in the package once.

import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));

export function sourcesHash() {
  const hash = createHash("sha256");
  const sources = readdirSync(join(here, "src"), { recursive: true })
    .map((name) => `src/${name.replaceAll("\\", "/")}`)
    .filter((name) => /\.(js|css|html|json)$/.test(name));
  for (const name of [...sources, "package.json"].sort()) {
    const text = readFileSync(join(here, name), "utf8").replaceAll("\r\n", "\n");
    hash.update(`${name}\n${Buffer.byteLength(text)}\n${text}`);
  }
  return hash.digest("hex");
}

function licence(name) {
  return readFileSync(join(here, "node_modules", name, "LICENSE"), "utf8").trim();
}

const three = JSON.parse(readFileSync(join(here, "node_modules/three/package.json"), "utf8"));
const options = { absWorkingDir: here, minify: true, target: ["chrome109", "firefox115", "safari16"], logLevel: "info" };
const out = "../src/levade/report/web";
await build({
  ...options,
  entryPoints: ["src/levade.js"],
  outfile: `${out}/levade.js`,
  bundle: true,
  format: "iife",
  globalName: "levade",
  legalComments: "eof",
  footer: { js: `/*! three.js ${three.version}:\n${licence("three")}\n*/` },
  banner: { js: `/* levade's pages, made of web/ by its build.mjs; sources ${sourcesHash()} */` },
});
await build({ ...options, entryPoints: ["src/style.css", "src/live.css"], outdir: out });
