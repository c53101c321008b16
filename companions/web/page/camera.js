// A camera that pointers turn, with z up, and where points of the scene are on the screen.

/// The part of a view, from its middle, that a robot may fill.
const FILLED = 0.95;

export class Orbit {
  constructor() {
    this.field = 35;
    this.front();
  }

  /// Looks from where every robot is first seen.
  front() {
    [this.turn, this.tilt, this.distance, this.target] = [-0.9, 0.42, 3, [0, 0, 0.4]];
  }

  /// Moves to where balls [centre, radius] fill a view of this size, in the direction of now.
  frame(balls, [width, height], extent) {
    [this.near, this.far] = [extent * 0.02, extent * 30];
    const up = FILLED * Math.tan((this.field * Math.PI) / 360);
    const slopes = [(up * width) / height, up];
    const axes = this.axes();
    const at = balls.map(([p, r]) => [...axes.map((axis) => dot(p, axis)), r]);
    // A ball is on the inner side of the plane at an edge if x - ex + r √(1 + s²) ≤ s (z - ez), with
    // the eye at (ex, ez) and the edge's slope s: that and the other edge bound ex and ez.
    const bounds = slopes.map((slope, k) => [
      Math.max(...at.map((p) => p[k] + p[3] * Math.hypot(1, slope) - slope * p[2])),
      Math.min(...at.map((p) => p[k] - p[3] * Math.hypot(1, slope) + slope * p[2])),
    ]);
    const [ex, ey] = bounds.map(([high, low]) => (high + low) / 2);
    const ez = Math.min(...bounds.map(([high, low], k) => -(high - low) / 2 / slopes[k]));
    const middle = at.reduce((sum, p) => sum + p[2], 0) / at.length;
    this.distance = middle - ez;
    this.target = [0, 1, 2].map((i) => ex * axes[0][i] + ey * axes[1][i] + middle * axes[2][i]);
  }

  position() {
    const [x, y, z] = this.target;
    const c = Math.cos(this.tilt) * this.distance;
    return [x + c * Math.cos(this.turn), y + c * Math.sin(this.turn), z + Math.sin(this.tilt) * this.distance];
  }

  turned(dx, dy) {
    this.turn -= dx * 0.008;
    this.tilt = Math.max(-0.2, Math.min(1.5, this.tilt + dy * 0.008));
  }

  zoomed(factor) {
    this.distance = Math.max(this.near * 8, Math.min(this.far / 4, this.distance * factor));
  }

  /// Right, up and forward of the camera.
  axes() {
    const from = this.position();
    const forward = unit(this.target.map((x, i) => x - from[i]));
    const right = unit(cross(forward, [0, 0, 1]));
    return [right, cross(right, forward), forward];
  }

  /// The place of a point in a view of this size: x, y in pixels, and its depth.
  project(point, width, height) {
    const from = this.position();
    const d = point.map((x, i) => x - from[i]);
    const [right, up, forward] = this.axes();
    const depth = dot(d, forward);
    const scale = height / 2 / Math.tan((this.field * Math.PI) / 360) / depth;
    return [width / 2 + dot(d, right) * scale, height / 2 - dot(d, up) * scale, depth];
  }

  /// The point at a depth under a pixel.
  unproject(x, y, depth, width, height) {
    const from = this.position();
    const [right, up, forward] = this.axes();
    const scale = (depth * Math.tan((this.field * Math.PI) / 360)) / (height / 2);
    const [a, b] = [(x - width / 2) * scale, (height / 2 - y) * scale];
    return from.map((p, i) => p + forward[i] * depth + right[i] * a + up[i] * b);
  }
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(...a);
export const unit = (a) => {
  const size = length(a) || 1;
  return a.map((x) => x / size);
};
export const minus = (a, b) => a.map((x, i) => x - b[i]);
export const plus = (a, b) => a.map((x, i) => x + b[i]);
export const scaled = (a, factor) => a.map((x) => x * factor);

/// Columns of a matrix that takes y to the direction from a to b.
export function along(a, b) {
  const y = unit(minus(b, a));
  const x = unit(cross(y, Math.abs(y[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  return [x, y, cross(x, y)];
}
