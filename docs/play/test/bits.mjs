// The digests of the step `bits`, computed in WebAssembly by node: prints the lines that the host's bin `bits` prints.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { root, target } from "../build.mjs";

export async function bits() {
  execFileSync("cargo", ["build", "--package", "play", "--example", "bits", "--profile", "play", "--target", "wasm32-unknown-unknown", "--quiet"], { cwd: root, stdio: ["ignore", "inherit", "inherit"] });
  const module = readFileSync(join(target, "wasm32-unknown-unknown/play/examples/bits.wasm"));
  const { exports } = (await WebAssembly.instantiate(module, {})).instance;
  const length = exports.compute();
  return new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.lines(), length)).trim().split("\n");
}

if (process.argv[1] && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) console.log((await bits()).join("\n"));
