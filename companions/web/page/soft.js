// The picture by the processor alone, where there is no graphics processor: convex faces with a
// depth for each sample, four samples for each pixel. A browser's software for WebGL takes ten
// times as long.
import { along, cross, dot, minus, plus, scaled, unit } from "./camera.js";
import { inFrame, tint } from "./shape.js";
import { inMemory } from "./words.js";

/// Faces around a cylinder, and around and along a ball.
const AROUND = 48;
const RING = Array.from({ length: AROUND }, (_, i) => (2 * Math.PI * i) / AROUND);
const BALL = [32, 20];
/// The canvas has a multiple of so many pixels.
const GRAIN = 64;
const SUN = unit([0.5, -0.6, 1]);

export class Soft {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = inMemory(canvas);
  }

  size(width, height, ratio) {
    const [w, h] = [width, height].map((x) => Math.max(1, Math.round(x * ratio)));
    this.ratio = ratio;
    [this.wide, this.high] = [2 * w, 2 * h];
    /// 1 / distance of each sample's face, of which zero is none, and the face's colour.
    this.near = new Float32Array(this.wide * this.high);
    this.colour = new Uint32Array(this.wide * this.high);
    /// Left and right end of a face in each row, and 1 / distance there.
    this.ends = Array.from({ length: 4 }, () => new Float32Array(this.high));
    this.box = [0, 0, 0, 0];
    this.fit(GRAIN, GRAIN);
  }

  /// Gives the canvas a size, pixels: that of the robot rather than of the view, since every pixel
  /// of it is copied.
  fit(width, height) {
    const { canvas } = this;
    Object.assign(canvas, { width, height });
    Object.assign(canvas.style, { width: `${width / this.ratio}px`, height: `${height / this.ratio}px` });
    this.image = this.context.createImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
  }

  take() {}

  draw({ parts }, orbit, colours) {
    const [x0, y0, x1, y1] = this.box;
    for (let y = y0; y < y1; y++) this.near.fill(0, y * this.wide + x0, y * this.wide + x1);
    this.box = [this.wide, this.high, 0, 0];
    this.orbit = orbit;
    this.eye = orbit.position();
    this.axes = orbit.axes();
    this.scale = this.high / 2 / Math.tan((orbit.field * Math.PI) / 360);
    for (const part of parts) {
      if (!part.visible) continue;
      this.tint = tint(part, colours);
      if (part.mesh) this.mesh(part);
      else if (part.kind === "ball") this.ball(part);
      else this.cylinder(part);
    }
    this.show();
  }

  /// The place of a point: its sample, and 1 / distance.
  point(p) {
    const d = minus(p, this.eye);
    const inverse = 1 / dot(d, this.axes[2]);
    const scale = this.scale * inverse;
    return [this.wide / 2 + dot(d, this.axes[0]) * scale, this.high / 2 - dot(d, this.axes[1]) * scale, inverse];
  }

  /// The colour of a face of this normal, whose light is that of `gl.js`; `half` is between the sun
  /// and the eye.
  lit(n, half) {
    const shade = 0.45 + 0.125 * (1 + n[2]) + 0.45 * Math.max(0, dot(n, SUN));
    const gloss = 0.35 * Math.max(0, dot(n, half)) ** 40;
    const [r, g, b] = this.tint.map((c) => Math.min(255, Math.round(255 * (c * shade + gloss))));
    return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
  }

  half(at) {
    return unit(plus(SUN, unit(minus(this.eye, at))));
  }

  cylinder({ a, b, r }) {
    const [x, y, z] = along(a, b);
    const half = this.half(a);
    const spoke = (angle) => plus(scaled(x, Math.cos(angle)), scaled(z, Math.sin(angle)));
    const rim = RING.map((angle) => scaled(spoke(angle), r));
    const [low, high] = [a, b].map((end) => rim.map((p) => this.point(plus(end, p))));
    RING.forEach((angle, i) => {
      const next = (i + 1) % AROUND;
      this.face([low[i], high[i], high[next], low[next]], () => this.lit(spoke(angle + Math.PI / AROUND), half));
    });
    this.face(low, () => this.lit(scaled(y, -1), half));
    this.face(high.reverse(), () => this.lit(y, half));
  }

  mesh({ a, axes, mesh }) {
    const half = this.half(a);
    for (const corners of mesh.coarse) {
      const [p, q, r] = corners.map((corner) => inFrame(a, axes, corner));
      this.face([p, q, r].map((corner) => this.point(corner)), () => this.lit(unit(cross(minus(q, p), minus(r, p))), half));
    }
  }

  ball({ a, r }) {
    const half = this.half(a);
    const normal = (i, j) => {
      const [turn, tilt] = [(2 * Math.PI * i) / BALL[0], (Math.PI * j) / BALL[1]];
      return [Math.sin(tilt) * Math.cos(turn), Math.sin(tilt) * Math.sin(turn), Math.cos(tilt)];
    };
    const rows = Array.from({ length: BALL[1] + 1 }, (_, j) => Array.from({ length: BALL[0] + 1 }, (_, i) => this.point(plus(a, scaled(normal(i, j), r)))));
    for (let j = 0; j < BALL[1]; j++) {
      for (let i = 0; i < BALL[0]; i++) {
        this.face([rows[j][i], rows[j + 1][i], rows[j + 1][i + 1], rows[j][i + 1]], () => this.lit(normal(i + 0.5, j + 0.5), half));
      }
    }
  }

  /// Colours the samples of a convex face that nothing nearer covers; its corners go round against
  /// the clock.
  face(corners, colour) {
    let [area, low, high] = [0, Infinity, -Infinity];
    for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
      const [p, q] = [corners[j], corners[i]];
      // Beside or behind the eye.
      if (!(q[2] > 0 && q[2] * this.orbit.near < 1)) return;
      area += p[0] * q[1] - q[0] * p[1];
      if (q[1] < low) low = q[1];
      if (q[1] > high) high = q[1];
    }
    if (area >= 0) return;
    const [top, bottom] = [Math.max(0, Math.ceil(low - 0.5)), Math.min(this.high, Math.ceil(high - 0.5))];
    if (top >= bottom) return;
    const [left, right, nearLeft, nearRight] = this.ends;
    left.fill(Infinity, top, bottom);
    right.fill(-Infinity, top, bottom);
    for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
      const [p, q] = corners[j][1] < corners[i][1] ? [corners[j], corners[i]] : [corners[i], corners[j]];
      const slope = (q[0] - p[0]) / (q[1] - p[1]);
      const rise = (q[2] - p[2]) / (q[1] - p[1]);
      const last = Math.min(bottom, Math.ceil(q[1] - 0.5));
      for (let y = Math.max(top, Math.ceil(p[1] - 0.5)); y < last; y++) {
        const down = y + 0.5 - p[1];
        const x = p[0] + down * slope;
        const near = p[2] + down * rise;
        if (x < left[y]) {
          left[y] = x;
          nearLeft[y] = near;
        }
        if (x > right[y]) {
          right[y] = x;
          nearRight[y] = near;
        }
      }
    }
    const painted = colour();
    const { box, wide, near: nearest, colour: colours } = this;
    for (let y = top; y < bottom; y++) {
      const from = Math.max(0, Math.ceil(left[y] - 0.5));
      const to = Math.min(wide, Math.ceil(right[y] - 0.5));
      if (from >= to) continue;
      if (from < box[0]) box[0] = from;
      if (to > box[2]) box[2] = to;
      const rise = (nearRight[y] - nearLeft[y]) / (right[y] - left[y]);
      let near = nearLeft[y] + (from + 0.5 - left[y]) * rise;
      const end = y * wide + to;
      for (let at = y * wide + from; at < end; at++, near += rise) {
        if (near > nearest[at]) {
          nearest[at] = near;
          colours[at] = painted;
        }
      }
    }
    if (top < box[1]) box[1] = top;
    if (bottom > box[3]) box[3] = bottom;
  }

  /// Writes the pixels, each the mean of its four samples, and puts the canvas where the robot is.
  show() {
    const [x0, y0, x1, y1] = this.box.map((sample, i) => (i < 2 ? sample >> 1 : (sample + 1) >> 1));
    const { near, colour, wide, canvas } = this;
    const [w, h] = [x1 - x0, y1 - y0].map((size) => Math.ceil(Math.max(1, size) / GRAIN) * GRAIN);
    // It grows at once, and shrinks late.
    if (w > canvas.width || h > canvas.height || w < canvas.width - 2 * GRAIN || h < canvas.height - 2 * GRAIN) this.fit(w, h);
    const { pixels } = this;
    for (let y = 0; y < canvas.height; y++) {
      const row = y * canvas.width;
      const to = y < y1 - y0 ? x1 - x0 : 0;
      for (let x = 0; x < to; x++) {
        const at = 2 * (y + y0) * wide + 2 * (x + x0);
        const one = colour[at];
        const covered = near[at] !== 0 && near[at + 1] !== 0 && near[at + wide] !== 0 && near[at + wide + 1] !== 0;
        // Most pixels are of one face.
        if (covered && colour[at + 1] === one && colour[at + wide] === one && colour[at + wide + 1] === one) {
          pixels[row + x] = one;
          continue;
        }
        let count = 0;
        let even = 0;
        let odd = 0;
        for (let k = 0; k < 4; k++) {
          const i = at + (k & 1) + (k >> 1) * wide;
          if (near[i] === 0) continue;
          count += 1;
          even += colour[i] & 0xff00ff;
          odd += (colour[i] >> 8) & 0xff;
        }
        pixels[row + x] = count === 0 ? 0 : (((255 * count) >> 2) << 24) | (((even >> 16) / count) << 16) | ((odd / count) << 8) | ((even & 0xffff) / count);
      }
      pixels.fill(0, row + Math.max(0, to), row + canvas.width);
    }
    this.context.putImageData(this.image, 0, 0);
    canvas.style.transform = `translate(${x0 / this.ratio}px, ${y0 / this.ratio}px)`;
  }
}
