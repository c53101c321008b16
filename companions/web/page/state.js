// The state of the page: the robot, the motion of its joints, and the effects that are on.
import { by } from "./words.js";

/// The effects in the order of the library, with their words and their Rust.
export const EFFECTS = [
  { name: "gravity", title: "Gravity", about: "the weight of the links" },
  { name: "inertia", title: "Inertia", about: "M(q) q̈" },
  { name: "coriolis", title: "Coriolis", about: "Coriolis and centrifugal torques" },
  { name: "payload", title: "Payload", about: "a point mass", unit: "kg", step: 0.1 },
  { name: "viscous", title: "Viscous", about: "friction that grows with speed", unit: "N·m·s/rad", step: 0.01 },
  { name: "coulomb", title: "Coulomb", about: "friction of constant size", unit: "N·m", step: 0.01 },
  { name: "armature", title: "Armature", about: "inertia of the motors' rotors", unit: "kg·m²", step: 0.001 },
];

export const state = {
  library: null,
  data: null,
  listed: [],
  scenes: new Map(),
  /// The robot: key (null of a file), title, type, module, about, source and estimates of a file.
  robot: null,
  q: [],
  qd: [],
  qdd: [],
  /// Friction and rotors by joint, and the load: its mass, kg, and its place in the last body, m.
  friction: {},
  load: null,
  on: { gravity: true, inertia: true, coriolis: true, viscous: true, coulomb: true, armature: true, payload: false },
  /// Whether the joints swing, by what share of what they may, and since when, s.
  swinging: false,
  amount: 0.5,
  clock: 0,
  computed: null,
  tab: "move",
};

/// The limits of a joint's slider, rad or m.
export function range(joint) {
  const free = joint.prismatic ? 0.5 : Math.PI;
  const lower = joint.lower === null || joint.lower < -2 * free ? -free : joint.lower;
  const upper = joint.upper === null || joint.upper > 2 * free ? free : joint.upper;
  return [Math.min(lower, upper), Math.max(lower, upper)];
}

/// The postures in which robots show most, by key; the others start in the middle of their ranges.
const POSTURES = {
  ur5e: [0, -1.5, 1.5, -1.6, -1.57, 0],
  panda: [0, -0.5, 0, -2.1, 0, 1.7, 0.8],
  iiwa14: [0, 0.6, 0, -1.4, 0, 0.9, 0],
  gen3: [0, 0.5, 0, 1.4, 0, 0.9, 0],
  xarm7: [0, -0.4, 0, 1.2, 0, 1.0, 0],
  z1: [0, 1.3, -1.1, -0.3, 0, 0, -0.5],
  so101: [0, -0.6, 0.7, 0.6, 0, 0.6],
  a1_leg: [0, 0.8, -1.6],
  scara: [-0.5, 1.1, -0.3],
  two_link: [0.6, 0.8],
};

export function posture(robot) {
  const joints = robot.about.joints;
  const given = POSTURES[robot.key];
  return joints.map((joint, i) => {
    const [lower, upper] = range(joint);
    if (given) return Math.min(upper, Math.max(lower, given[i] ?? 0));
    return lower <= 0 && upper >= 0 ? 0 : (lower + upper) / 2;
  });
}

/// The speed of a joint for a swing of the whole amount, rad/s or m/s.
const speed = (joint) => Math.min(joint.velocity ?? 2, joint.prismatic ? 0.4 : 2.5);

/// Position, velocity and acceleration now: the sliders', and those of the swing.
export function motion() {
  const { q, qd, qdd, swinging, amount, clock, robot } = state;
  const moved = { q: [...q], qd: [...qd], qdd: [...qdd] };
  if (!swinging && clock === 0) return moved;
  robot.about.joints.forEach((joint, i) => {
    const [lower, upper] = range(joint);
    const omega = 1.3 + 0.37 * (i % 5);
    const size = Math.max(0, Math.min((amount * speed(joint)) / omega, 0.45 * (upper - lower), joint.prismatic ? 0.2 : 0.6));
    // About the nearest place with so much room, from where the joint is.
    const middle = Math.min(Math.max(q[i], lower + size), upper - size);
    const phase = omega * clock + (size > 0 ? Math.asin(Math.min(1, Math.max(-1, (q[i] - middle) / size))) : 0);
    moved.q[i] = middle + size * Math.sin(phase);
    moved.qd[i] += size * omega * Math.cos(phase);
    moved.qdd[i] -= size * omega * omega * Math.sin(phase);
  });
  return moved;
}

/// The number of an effect that the user enters: of joints the largest.
export const entered = (name) => (name === "payload" ? state.load.mass : Math.max(...(state.friction[name] ?? [1])));

/// Enters it: joints keep the proportions that the repository or the file gives them.
export function enter(name, x) {
  if (name === "payload") return void (state.load.mass = x);
  const given = state.robot.about.friction?.[name] ?? [];
  const most = Math.max(0, ...given);
  state.friction[name] = state.friction[name].map((_, i) => (most > 0 ? (given[i] / most) * x : x));
}

/// The request's form of the effects.
export const chosen = () => ({ ...state.on, payload: state.on.payload ? state.load.mass : 0, at: state.load.at, friction: state.friction });

/// Whether an effect has a number.
export const has = (name) => entered(name) > 0;

/// Says something that a screen reader reads, too.
export const say = (text, wrong = false) => {
  const at = by("said");
  clearTimeout(state.saying);
  if (!wrong) state.saying = setTimeout(() => (at.hidden = true), 6000);
  at.textContent = text;
  at.classList.toggle("wrong", wrong);
  at.hidden = text === "";
};
