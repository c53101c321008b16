// The grid on the ground: an outline of the page, which is drawn again only when the eye moves.
import { dot, minus } from "./camera.js";

/// Lines to each side of the middle, and the metres between them as a share of the robot's size.
const LINES = 10;
const STEP = 0.24;

export class Ground {
  constructor(path) {
    this.path = path;
  }

  /// Draws it for this eye in a view of this size, if it is not there already.
  draw(orbit, extent, [width, height]) {
    const key = [orbit.turn, orbit.tilt, orbit.distance, ...orbit.target, extent, width, height].join();
    if (key === this.key) return;
    this.key = key;
    const eye = orbit.position();
    const forward = orbit.axes()[2];
    const depth = (p) => dot(minus(p, eye), forward) - orbit.near;
    const words = (p) => orbit.project(p, width, height).slice(0, 2).map((x) => x.toFixed(1)).join();
    const line = (a, b) => {
      const [from, to] = [depth(a), depth(b)];
      if (from <= 0 && to <= 0) return "";
      // The part in front of the eye.
      const cut = a.map((x, i) => x + ((b[i] - x) * from) / (from - to));
      return `M${words(from < 0 ? cut : a)}L${words(to < 0 ? cut : b)}`;
    };
    const [step, end] = [extent * STEP, extent * STEP * LINES];
    const lines = Array.from({ length: 2 * LINES + 1 }, (_, i) => {
      const at = (i - LINES) * step;
      return line([at, -end, 0], [at, end, 0]) + line([-end, at, 0], [end, at, 0]);
    });
    this.path.setAttribute("d", lines.join(""));
  }
}
