// The robot as its meshes; a body without one as cylinders and balls: links from joint to joint, a
// drum along each joint's axis. A ball is at the hand.
import { length, minus, plus } from "./camera.js";

const WORLD = [1, 0, 0, 0, 1, 0, 0, 0, 1];
/// A point of a frame with this origin and these axes, as columns.
export const inFrame = (origin, axes, p) => origin.map((x, i) => x + axes[i] * p[0] + axes[3 + i] * p[1] + axes[6 + i] * p[2]);

export class Shape {
  /// The parts of a robot of this size; meshes are those of `meshes.js`.
  constructor(about, size, meshes = []) {
    const radius = (size * 0.045) / Math.sqrt(Math.max(1, about.bodies.length / 8));
    const children = about.bodies.map(() => []);
    about.bodies.forEach((body, i) => body.parent !== null && children[body.parent].push(i));
    const drums = new Set(about.joints.map((joint) => joint.body));
    this.radius = radius;
    this.parts = [];
    const shown = new Set(meshes.map((mesh) => mesh.body));
    const link = (from, to, r) => shown.has(from.body) || this.parts.push({ kind: "link", colour: "link", from, to, r });
    const joint = (of) => about.joints.findIndex(({ body }) => body === of);
    this.parts.push(...meshes.map((mesh) => ({ kind: "mesh", colour: "link", from: { body: mesh.body }, joint: joint(mesh.body), mesh })));
    about.bodies.forEach((body, i) => {
      if (body.parent === null) link({ body: null }, { body: i }, radius * 1.15);
      for (const child of children[i]) link({ body: i }, { body: child }, radius);
      if (children[i].length === 0) link({ body: i }, { body: i, at: body.com }, radius * 0.8);
      // In a drum it would not be seen.
      if (!drums.has(i) && !shown.has(i)) this.parts.push({ kind: "ball", colour: "link", from: { body: i }, r: radius });
    });
    about.joints.forEach((joint, number) => {
      if (!shown.has(joint.body)) this.parts.push({ kind: "drum", colour: "drum", from: { body: joint.body }, joint: number, axis: about.bodies[joint.body].axis, r: radius * 1.25 });
    });
    this.hand = about.bodies.map((_, i) => i).filter((i) => children[i].length === 0).at(-1);
    this.parts.push({ kind: "ball", colour: "hand", from: { body: this.hand }, r: radius * (shown.size ? 0.5 : 1.35) });
    this.arrow = [
      { kind: "link", colour: "push", r: radius * 0.3 },
      { kind: "ball", colour: "push", r: radius * 0.8 },
    ];
    this.parts.push(...this.arrow);
  }

  /// Puts all where the poses say: a ball at `a`, a cylinder from `a` to `b`. Loads are the shares
  /// of each joint's torque of its limit; `push` is the arrow's start and end, or none.
  place(poses, loads, push) {
    const point = ({ body, at }) => {
      if (body === null) return [0, 0, 0];
      return inFrame(poses[body].slice(0, 3), poses[body].slice(3), at ?? [0, 0, 0]);
    };
    for (const part of this.parts) {
      if (!part.from) continue;
      part.a = point(part.from);
      part.visible = true;
      if (part.kind === "mesh" || part.kind === "drum") part.load = Math.min(1, Math.abs(loads[part.joint] ?? 0));
      if (part.kind === "mesh") part.axes = part.from.body === null ? WORLD : poses[part.from.body].slice(3);
      if (part.kind === "link") {
        part.b = point(part.to);
        part.visible = length(minus(part.b, part.a)) > part.r * 0.2;
      } else if (part.kind === "drum") {
        const half = inFrame([0, 0, 0], poses[part.from.body].slice(3), part.axis).map((x) => x * part.r * 1.05);
        [part.a, part.b] = [minus(part.a, half), plus(part.a, half)];
        part.visible = length(half) > 0;
      }
    }
    const [shaft, tip] = this.arrow;
    shaft.visible = tip.visible = Boolean(push);
    if (push) [shaft.a, shaft.b, tip.a] = [push[0], push[1], push[1]];
  }

  /// Balls around the robot as it was placed, each with centre and radius.
  balls() {
    const robot = this.parts.filter((part) => part.from && part.visible);
    return robot.flatMap(({ a, b = a, r, axes, mesh }) => mesh?.corners.map((p) => [inFrame(a, axes, p), 0]) ?? [[a, r], [b, r]]);
  }
}

/// The colours of the theme as numbers from 0 to 1, by name.
export function palette(colour) {
  const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
  return Object.fromEntries(["link", "drum", "loaded", "hand", "push"].map((name) => [name, channels(colour(name))]));
}

/// The colour of a part: a drum's tends to that of a joint at its limit.
export function tint({ colour, load }, colours) {
  return load ? colours[colour].map((c, i) => c + (colours.loaded[i] - c) * load) : colours[colour];
}
