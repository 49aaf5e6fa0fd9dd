// Bundles web/src/report.js and live.js into the package's report.js and live.js: `npm ci && npm run build`, in web/. Their first
// lines say of which sources they were made, which a test compares (tests/report/test_bundle.py), and their last ones are the
// licence of three.js.

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
const [entry, outfile] = process.argv.slice(2);
const bundles = entry
  ? [[entry, outfile]]
  : ["report", "live"].map((name) => [`src/${name}.js`, `../src/levade/report/web/${name}.js`]);
for (const [from, to] of bundles) {
  await build({
    absWorkingDir: here,
    entryPoints: [from],
    outfile: to,
    bundle: true,
    minify: true,
    format: "iife",
    target: ["chrome109", "firefox115", "safari16"],
    legalComments: "eof",
    footer: { js: `/*! three.js ${three.version}:\n${licence("three")}\n*/` },
    banner: { js: `/* levade report, made of web/ by its build.mjs; sources ${sourcesHash()} */` },
    logLevel: "info",
  });
}
