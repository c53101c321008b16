// The state of the page: the robot, the motion of its joints, and the effects that are on.
import { by } from "./words.js";

/// The effects in the order of the library, with their words and their Rust.
export const EFFECTS = [
  { name: "gravity", title: "Gravity", about: "the weight of the links" },
  { name: "inertia", title: "Inertia", about: "M(q) q̈" },
  { name: "coriolis", title: "Coriolis", about: "Coriolis and centrifugal torques" },
  { name: "payload", title: "Payload", about: "a point mass of 1 kg at the last body's origin" },
  { name: "viscous", title: "Viscous", about: "friction that grows with speed" },
  { name: "coulomb", title: "Coulomb", about: "friction of constant size" },
  { name: "armature", title: "Armature", about: "inertia of the motors' rotors" },
];
export const PAYLOAD = 1;

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
    const room = Math.min(upper - q[i], q[i] - lower);
    const size = Math.max(0, Math.min(amount * speed(joint) / omega, 0.9 * room, joint.prismatic ? 0.2 : 0.6));
    const phase = omega * clock;
    moved.q[i] += size * Math.sin(phase);
    moved.qd[i] += size * omega * Math.cos(phase);
    moved.qdd[i] -= size * omega * omega * Math.sin(phase);
  });
  return moved;
}

/// The request's form of the effects.
export const chosen = () => ({ ...state.on, payload: state.on.payload ? PAYLOAD : 0 });

/// Whether the robot has numbers for an effect.
export const has = (name) => !["viscous", "coulomb", "armature"].includes(name) || state.robot?.about.friction != null;

/// Says something that a screen reader reads, too.
export const say = (text, wrong = false) => {
  const at = by("said");
  at.textContent = text;
  at.classList.toggle("wrong", wrong);
  at.hidden = text === "";
};
