// The digests of the host's bin `bits`, computed in WebAssembly by node.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { compiled, root } from "../build.mjs";

/// The lines that the host prints.
export function hostBits() {
  const printed = execFileSync("cargo", ["run", "--quiet", "--package", "host-reports", "--bin", "bits"], { cwd: root, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });
  return printed.split("\n").filter((line) => line.startsWith("bits "));
}

/// The states and results that the oracle recorded of a robot.
function recorded(robot) {
  return JSON.parse(gunzipSync(readFileSync(join(root, `host-tests/recordings/${robot}.json.gz`))));
}

/// Flips the lowest bit of an angle of a recorded state, the first that is not zero.
function spoil(module) {
  const { q } = recorded("ur5e");
  const state = Buffer.from(Float32Array.from(q[1]).buffer);
  const at = module.indexOf(state);
  if (at < 0) throw new Error("the recorded state is not in the module");
  // The second joint: a turn about the vertical changes no torque.
  module[at + 4] ^= 1;
}

/// The lines; of a module with one wrong bit if `spoilt`.
export async function bits(spoilt = false) {
  const module = readFileSync(compiled("examples/bits.wasm", "--example", "bits"));
  if (spoilt) spoil(module);
  const { exports } = (await WebAssembly.instantiate(module, {})).instance;
  const length = exports.compute();
  return new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.lines(), length)).trim().split("\n");
}

/// The same digests by the page's own module, of the quantities that its ways to compute a torque
/// are: its lines. `spoilt` has one bit of a torque wrong.
export async function pageBits(page, spoilt = false) {
  const lines = [];
  for (const robot of ["ur5e", "panda"]) {
    const { q, qd, qdd } = recorded(robot);
    for (const [key, quantity] of Object.entries({ default: "engine rnea", "trig=table3x4,form=core": "core rnea" })) {
      const motions = q.map((_, i) => ({ q: q[i], qd: qd[i], qdd: qdd[i] }));
      const torques = await page.evaluate((robot, key, motions) => motions.map((motion) => play.state.library.call({ op: "way", robot, key, motion }).torque), robot, key, motions);
      const bytes = Buffer.from(Float32Array.from(torques.flat()).buffer);
      if (spoilt) bytes[0] ^= 1;
      // FNV-1a, as `firmware_demo::digest`.
      const digest = bytes.reduce((hash, byte) => ((hash ^ BigInt(byte)) * 0x100000001b3n) & 0xffffffffffffffffn, 0xcbf29ce484222325n);
      lines.push(`bits ${robot} ${quantity} ${digest.toString(16).padStart(16, "0")}`);
    }
  }
  return lines;
}
