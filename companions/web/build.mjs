// Writes the page: one file without any other, from the sources in page/, the library as
// WebAssembly and recorded figures.
// node companions/web/build.mjs [--out FOLDER]
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync, statSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { cases, recorded } from "./data.mjs";

const here = dirname(fileURLToPath(import.meta.url));
export const root = resolve(here, "../..");
export const target = resolve(root, process.env.CARGO_TARGET_DIR ?? "target", "web");

/// In the order of their dependence: a script uses those before it alone.
export const SCRIPTS = [
  "library.js", "words.js", "state.js", "camera.js", "shape.js", "meshes.js", "ground.js", "gl.js", "soft.js", "view.js",
  "bars.js", "recorded.js", "front.js", "rust.js", "move.js", "disturb.js", "cases.js", "main.js",
];

const run = (program, args, options = {}) => execFileSync(program, args, { stdio: ["ignore", "inherit", "inherit"], ...options });

/// As gzip, by the program whose search takes seconds and leaves 4 % less of the library.
function packed(bytes) {
  const file = join(target, "packed");
  mkdirSync(target, { recursive: true });
  writeFileSync(file, bytes);
  return execFileSync("zopfli", ["-c", file], { maxBuffer: 1e8 }).toString("base64");
}

/// Compiles for the browser; returns where a file of it is.
export function compiled(file, ...what) {
  run("cargo", ["build", "--locked", "--quiet", "--release", "--target", "wasm32-unknown-unknown", "--target-dir", target, ...what], { cwd: here });
  return join(target, "wasm32-unknown-unknown/release", file);
}

/// The library, compiled for size and optimised.
export function wasm() {
  const built = compiled("play.wasm", "--lib");
  const small = join(target, "play.wasm");
  // It takes longer than all else: what is newer than the module and this script is kept.
  const age = (file) => statSync(file, { throwIfNoEntry: false })?.mtimeMs ?? 0;
  if (age(small) > Math.max(age(built), age(fileURLToPath(import.meta.url)))) return readFileSync(small);
  // No option of these changes a number: the rounding of floats in WebAssembly is fixed.
  const features = ["bulk-memory", "nontrapping-float-to-int", "sign-ext", "mutable-globals", "reference-types", "multivalue"];
  run("wasm-opt", ["--duplicate-function-elimination", "--merge-similar-functions", "-Os", ...features.map((name) => `--enable-${name}`), "--strip-debug", "--strip-producers", built, "-o", small]);
  return readFileSync(small);
}

/// Modules as one script: each is a file of ES modules whose imports are those before it.
function joined() {
  const texts = SCRIPTS.map((name) => readFileSync(join(here, "page", name), "utf8"));
  const plain = texts.map((text) => text.replace(/^import .*;\n/gm, "").replace(/^export /gm, ""));
  return plain.join("\n");
}

/// The page of these parts; text that would end a script is refused rather than escaped.
export function page({ library, data, suite }) {
  const read = (name) => readFileSync(join(here, name), "utf8");
  const parts = {
    STYLE: read("page/style.css"),
    OGL: read("vendor/ogl.js"),
    SCRIPT: joined(),
    DATA: JSON.stringify(data),
    SUITE: packed(Buffer.from(suite)),
    LOADERS: packed(readFileSync(join(here, "vendor/three.js"))),
    LIBRARY: packed(library),
  };
  return read("page/index.html").replace(/<!-- (\w+) -->|\/\* (\w+) \*\//g, (whole, a, b) => {
    const part = parts[a ?? b];
    if (part === undefined) return whole;
    if (/<\/script|<\/style/i.test(part)) throw new Error(`${a ?? b} contains the end of its own element`);
    return part;
  });
}

export function build(out = target) {
  const html = page({ library: wasm(), data: recorded(root), suite: cases(root) });
  mkdirSync(out, { recursive: true });
  const file = join(out, "index.html");
  writeFileSync(file, html);
  const size = gzipSync(html, { level: 9 }).length;
  return { file, bytes: statSync(file).size, compressed: size };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const at = process.argv.indexOf("--out");
  const { file, bytes, compressed } = build(at > 0 ? resolve(process.argv[at + 1]) : undefined);
  console.log(`${file}: ${bytes} bytes, ${compressed} compressed by gzip`);
}
