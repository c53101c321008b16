// The Rust for what is chosen.
import { state, EFFECTS, has } from "./state.js";

/// A number as f32 in Rust: with a point, and with the fewest digits that are the same f32.
function real(x) {
  let text = String(x);
  for (let count = 1; count < 10; count++) {
    const short = Number(x.toPrecision(count));
    if (Math.fround(short) === Math.fround(x)) {
      text = String(short);
      break;
    }
  }
  return /[.e]/.test(text) ? text : `${text}.0`;
}
const list = (numbers) => {
  const same = numbers.every((x) => x === numbers[0]);
  return same ? `[${real(numbers[0])}; ${numbers.length}]` : `[${numbers.map(real).join(", ")}]`;
};

/// The type and the value of each effect.
function tuple(on, about) {
  const { friction, load } = state;
  const v = about.sizes[2];
  // Coordinates of a free base come first, and have neither friction nor rotors.
  const all = (numbers) => list([...Array(v - numbers.length).fill(0), ...numbers]);
  const forms = {
    gravity: ["Gravity", "Gravity::EARTH"],
    inertia: ["Inertia", "Inertia"],
    coriolis: ["Coriolis", "Coriolis"],
    payload: [`Payload<f32, ${about.bodies.length - 1}>`, `Payload::from_inertia(BodyInertia { mass: ${real(load.mass)}, com: ${list(load.at)}, inertia: [0.0; 6] })`],
    viscous: [`Viscous<f32, ${v}>`, `Viscous(${all(friction.viscous)})`],
    coulomb: [`Coulomb<f32, ${v}>`, `Coulomb { torque: ${all(friction.coulomb)}, width: Width::f32(${real(friction.width)}) }`],
    armature: [`Armature<f32, ${v}>`, `Armature(${all(friction.armature)})`],
  };
  return EFFECTS.filter(({ name }) => on[name] && has(name)).map(({ name }) => forms[name]);
}

/// The lines for the robot, its effects and the way of its front.
export function rust(on, way) {
  const { about, type, module, source } = state.robot;
  const [, q, v] = about.sizes;
  const effects = tuple(on, about);
  if (effects.length === 0) return "// No effect is on: there is no torque to compute.\n";
  const load = effects.find(([kind]) => kind.startsWith("Payload"));
  const names = effects.map(([kind]) => kind.replace(/<.*/, ""));
  if (names.includes("Coulomb")) names.push("Width");
  const axes = way?.axes ?? {};
  const kernel = axes.trig && axes.trig !== "table3" ? state.data.names.trig[axes.trig]?.rust : null;
  const pruned = /^pruned(\d+)$/.exec(axes.model ?? "")?.[1];
  const scalar = axes.arith === "f64" ? "f64" : "f32";
  const form = axes.form === "core" ? "Core" : "Engine";
  const uses = [
    `use dynamics_core::effects::{${[...new Set(names)].sort().join(", ")}};`,
    load || pruned ? `use dynamics_core::model::{${[load && "BodyInertia", pruned && "Pruned"].filter(Boolean).join(", ")}};` : "",
    source ? `use crate::robot::${type}; // the file below` : `use ${module}::${type};`,
    `use dynamics_core::${form};`,
    "use dynamics_core::state::State;",
    kernel ? `use dynamics_core::trig::${kernel.replace(/<.*/, "")};` : "",
  ].filter(Boolean);
  const arm = pruned ? `Pruned<${type}, ${pruned}>` : type;
  const call = `${form}::<${arm}${kernel ? `, ${kernel}` : ""}>::rnea(reference, &${load ? "scene" : "SCENE"})`;
  const flat = (text) => (scalar === "f64" ? text.replaceAll("f32", "f64") : text);
  const kinds = effects.map(([kind]) => kind).join(", ");
  const values = effects.map(([, value]) => `    ${value},`).join("\n");
  const comma = effects.length === 1 ? "," : "";
  const scene = load ? `let scene: (${kinds}${comma}) = (\n${values}\n);` : `const SCENE: (${kinds}${comma}) = (\n${values}\n);`;
  const signature = `pub fn feed_forward(reference: &State<${scalar}, ${q}, ${v}>) -> [${scalar}; ${v}] {`;
  const body = load ? `${scene.split("\n").map((line) => `    ${line}`).join("\n")}\n    ${call}` : `    ${call}`;
  const lines = [...uses.sort(), "", ...(load ? [] : [flat(scene), ""]), signature, flat(body), "}"];
  return `${lines.join("\n")}\n${source ? `\n// src/robot.rs\n${source}` : ""}`;
}
