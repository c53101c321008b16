// The processor time of a browser and all its processes, and of the whole machine, from Linux's
// /proc.
import { existsSync, readFileSync, readdirSync } from "node:fs";

/// Milliseconds of one of the kernel's ticks, whose rate every Linux gives as 100 a second.
const TICK = 10;
export const measurable = existsSync("/proc/stat");

/// Processor time of a process and its descendants so far, ms.
function spent(root) {
  const all = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const text = readFileSync(`/proc/${pid}/stat`, "utf8");
      // The name of the program, which may have spaces, ends with the last bracket.
      const fields = text.slice(text.lastIndexOf(")") + 2).split(" ").map(Number);
      all.set(Number(pid), { parent: fields[1], time: (fields[11] + fields[12]) * TICK });
    } catch {
      // It has ended.
    }
  }
  const tree = [root];
  for (const one of tree) for (const [pid, { parent }] of all) if (parent === one) tree.push(pid);
  return tree.reduce((sum, pid) => sum + (all.get(pid)?.time ?? 0), 0);
}

/// The time in which the machine's processors were busy so far, and all of it, both in ticks of the
/// kernel.
function machine() {
  const fields = readFileSync("/proc/stat", "utf8").split("\n")[0].split(/\s+/).slice(1, 9).map(Number);
  const all = fields.reduce((a, b) => a + b, 0);
  return { busy: all - fields[3] - fields[4], all };
}

/// Runs something and returns what it returns, the processor time that the process `root` and its
/// descendants took for it, ms, and the share of the machine's processors that something else had.
export async function during(root, run) {
  if (!measurable) return { result: await run(), processor: NaN, others: NaN };
  const [time, before] = [spent(root), machine()];
  const result = await run();
  const [processor, after] = [spent(root) - time, machine()];
  return { result, processor, others: (after.busy - before.busy - processor / TICK) / (after.all - before.all) };
}
