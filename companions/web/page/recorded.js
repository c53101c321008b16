// The costs of the chosen effects, from the recorded figures; nothing else is estimated here.
import { state } from "./state.js";

/// The rows of docs/costs.md by which of gravity, inertia and velocity products act.
const RIGID = { "gravity inertia coriolis": "full", "gravity coriolis": "bias", gravity: "gravity", "gravity inertia": "no_coriolis" };

/// The ways of the robot's front that its picture has; in double precision a microcontroller
/// computes a hundred times as long: the table has it.
export const front = () => everyWay()?.filter((way) => way.axes.arith !== "f64") ?? null;
export const everyWay = () => (state.robot?.key && state.data.fronts[state.robot.key]) || null;

/// Cycles and code of the effects that are on, with where they are from; null where something is
/// not recorded.
export function price(on, way) {
  const { key } = state.robot;
  const costs = state.data.costs[key];
  const prices = state.data.effects[key];
  if (!costs) return { why: "No costs of this robot are recorded." };
  const rigid = ["gravity", "inertia", "coriolis"].filter((name) => on[name]).join(" ");
  let base = costs[RIGID[rigid]];
  const from = ["docs/costs.md"];
  if (rigid === "inertia coriolis" && prices) {
    base = { cycles: costs.full.cycles - prices.gravity.cycles, code: costs.full.code - prices.gravity.code };
    from.push("docs/effects.md");
  }
  if (way && rigid === "gravity inertia coriolis") {
    base = { cycles: way.cycles, code: way.key === "default" ? base.code : null };
    from[0] = "docs/accuracy.md";
  } else if (way && way.key !== "default") {
    return { why: "The ways of the front are recorded with all three rigid-body effects." };
  }
  if (!base) return { why: "This combination of rigid-body effects is not recorded." };
  let { cycles, code } = base;
  let added = 0;
  for (const name of ["payload", "viscous", "coulomb", "armature"]) {
    if (!on[name]) continue;
    if (!prices?.[name]) return { why: `The price of ${name} is not recorded for this robot.` };
    cycles += prices[name].cycles;
    code = code === null ? null : code + prices[name].code;
    added += 1;
    if (!from.includes("docs/effects.md")) from.push("docs/effects.md");
  }
  return { cycles, code, added, from };
}

/// The words that describe a way of computing.
export function wayInWords(way) {
  const { names } = state.data;
  const words = ["arith", "trig", "model", "form"].map((axis) => {
    const value = way.axes[axis];
    if (axis === "trig" && (value === "table3" || way.axes.arith === "f64")) return "";
    return names[axis]?.[value]?.name ?? "";
  });
  return words.filter(Boolean).join(", ") || "the library's default";
}

/// Sentences that say what a way of computing gives up.
export function wayAbout(way) {
  const { names } = state.data;
  const about = ["arith", "trig", "model", "form"].filter((axis) => !(axis === "trig" && way.axes.trig === "table3"));
  return about.map((axis) => names[axis]?.[way.axes[axis]]?.about ?? "").filter(Boolean).join(" ");
}
