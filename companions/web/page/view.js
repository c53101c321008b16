// The view of the robot: it draws, turns, and says which body a pointer or the keyboard drags
// where.
import { Orbit, length } from "./camera.js";
import { Gl, hasGraphics } from "./gl.js";
import { Ground } from "./ground.js";
import { Shape, palette } from "./shape.js";
import { Soft } from "./soft.js";
import { by, colours, element } from "./words.js";

/// The greatest distance from a pointer to a body that it takes hold of, pixels; a finger is wider
/// than a mouse.
const NEAR = { mouse: 26, pen: 30, touch: 44 };

/// Frames that take longer than SLOW, ms, on average get fewer pixels, those that take less than
/// QUICK more.
const [SLOW, QUICK] = [22, 18];
/// The fewest pixels for each of the page's, and what more or fewer is.
const [LEAST, FEWER] = [0.5, 0.75];

export class View {
  /// `dragged(body, point)` is called as a body is dragged to a point, and with a point of null at
  /// its end.
  constructor(at, dragged) {
    this.at = at;
    this.dragged = dragged;
    this.orbit = new Orbit();
    this.poses = null;
    this.pointers = new Map();
    this.drag = null;
    this.ground = new Ground(by("ground"));
    this.recolour();
    // A test may want either.
    this.draws(location.hash === "#webgl" || (location.hash !== "#software" && hasGraphics()) ? Gl : Soft);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(at);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
  }

  /// Draws by `Gl` or `Soft` from now on.
  draws(By) {
    this.canvas?.remove();
    this.canvas = this.at.appendChild(element("canvas"));
    this.picture = new By(this.canvas);
    Object.assign(this, { ratio: this.finest, pace: 16, calm: 0, patience: 5 });
    if (this.size) this.resize();
    if (this.shape) this.picture.take(this.shape);
  }

  get finest() {
    return Math.min(2, devicePixelRatio);
  }

  recolour() {
    this.colour = colours();
    this.palette = palette(this.colour);
    this.stale = true;
  }

  resize() {
    const { clientWidth, clientHeight } = this.at;
    this.size = [clientWidth, clientHeight];
    if (clientWidth * clientHeight === 0) return;
    if (this.whole) this.frame();
    this.picture.size(clientWidth, clientHeight, this.ratio);
    this.stale = true;
  }

  /// Takes a robot, with the poses between which it moves, from that of now on; the meshes of its
  /// bodies, where there are any.
  show(about, motion, meshes) {
    const [poses] = motion;
    const spans = [0, 1, 2].map((i) => Math.max(0, ...poses.map((p) => p[i])) - Math.min(0, ...poses.map((p) => p[i])));
    this.extent = Math.max(0.2, length(spans));
    this.shape = new Shape(about, this.extent, meshes);
    this.picture.take(this.shape);
    this.hand = this.shape.hand;
    this.drag = null;
    this.balls = motion.flatMap((poses) => (this.shape.place(poses, []), this.shape.balls()));
    this.place(poses, []);
    this.home();
  }

  /// Looks at all of the robot, wherever it moves, until someone turns the view.
  home() {
    this.orbit.front();
    this.whole = true;
    if (this.size?.[1]) this.frame();
  }

  frame() {
    this.orbit.frame(this.balls, this.size, this.extent);
    this.stale = true;
  }

  place(poses, loads) {
    this.poses = poses;
    this.loads = loads;
    this.stale = true;
  }

  point(body) {
    const p = this.poses[body];
    return [p[0], p[1], p[2]];
  }

  /// Draws with fewer pixels where frames take long, and after some calm seconds with more, later
  /// each time that was too much; what is still slow with the fewest is drawn by the processor.
  /// `interval` is what the last frame took, ms.
  adapt(interval) {
    this.pace = 0.95 * this.pace + 0.05 * Math.min(200, interval);
    this.calm = this.pace < QUICK ? this.calm + interval / 1000 : 0;
    if (this.pace > SLOW && this.ratio > LEAST) {
      this.ratio = Math.max(LEAST, this.ratio * FEWER);
      this.patience *= 2;
    } else if (this.pace > SLOW && this.picture instanceof Gl) {
      return this.draws(Soft);
    } else if (this.calm > this.patience && this.ratio < this.finest) {
      this.ratio = Math.min(this.finest, this.ratio / FEWER);
    } else {
      return;
    }
    [this.pace, this.calm] = [16, 0];
    this.resize();
  }

  render() {
    if (!this.stale || !this.poses || !this.size?.[1]) return;
    this.stale = false;
    this.ground.draw(this.orbit, this.extent, this.size);
    this.shape.place(this.poses, this.loads, this.drag && [this.point(this.drag.body), this.drag.to]);
    // A robot that moves, is dragged or is pushed out of the picture is brought back.
    const balls = this.whole && !this.drag ? this.shape.balls() : [];
    if (balls.some(([p]) => this.orbit.project(p, ...this.size).slice(0, 2).some((x, k) => x < 0 || x > this.size[k]))) {
      this.balls.push(...balls);
      this.frame();
    }
    this.picture.draw(this.shape, this.orbit, this.palette);
  }

  /// The body under a pointer.
  under(x, y, kind) {
    if (!this.poses) return null;
    let found = null;
    let nearest = NEAR[kind] ?? 26;
    this.poses.forEach((_, body) => {
      const [px, py] = this.orbit.project(this.point(body), ...this.size);
      const distance = Math.hypot(px - x, py - y) - (body === this.hand ? 8 : 0);
      if (distance < nearest) [found, nearest] = [body, distance];
    });
    return found;
  }

  listen() {
    const view = this.at;
    const at = (event) => {
      const box = view.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    view.addEventListener("pointerdown", (event) => {
      view.setPointerCapture(event.pointerId);
      const [x, y] = at(event);
      this.pointers.set(event.pointerId, [x, y]);
      const body = this.pointers.size === 1 ? this.under(x, y, event.pointerType) : null;
      if (body !== null) this.begin(body);
      else this.whole = false;
    });
    view.addEventListener("pointermove", (event) => {
      const [x, y] = at(event);
      const before = this.pointers.get(event.pointerId);
      if (!before) {
        view.style.cursor = this.under(x, y, event.pointerType) === null ? "" : "grab";
        return;
      }
      const spread = () => {
        const [a, b] = [...this.pointers.values()];
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
      };
      if (this.drag) {
        const depth = this.drag.depth;
        this.move(this.orbit.unproject(x, y, depth, ...this.size));
        this.pointers.set(event.pointerId, [x, y]);
      } else if (this.pointers.size === 2) {
        const old = spread();
        this.pointers.set(event.pointerId, [x, y]);
        this.orbit.zoomed(old / Math.max(1, spread()));
      } else {
        this.pointers.set(event.pointerId, [x, y]);
        this.orbit.turned(x - before[0], y - before[1]);
      }
      this.stale = true;
    });
    const end = (event) => {
      this.pointers.delete(event.pointerId);
      if (this.drag && this.pointers.size === 0) this.end();
    };
    view.addEventListener("pointerup", end);
    view.addEventListener("pointercancel", end);
    view.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.orbit.zoomed(Math.exp(event.deltaY * 0.001));
      [this.whole, this.stale] = [false, true];
    }, { passive: false });
    view.addEventListener("dblclick", () => this.home());
    view.addEventListener("keydown", (event) => this.key(event));
    view.addEventListener("keyup", (event) => event.key.startsWith("Arrow") && this.drag?.keys && this.end());
    view.addEventListener("blur", () => this.drag?.keys && this.end());
  }

  begin(body) {
    const to = this.point(body);
    const [, , depth] = this.orbit.project(to, ...this.size);
    this.drag = { body, to, depth };
  }

  move(to) {
    this.drag.to = to;
    this.dragged(this.drag.body, to);
    this.stale = true;
  }

  end() {
    const { body } = this.drag;
    this.drag = null;
    this.dragged(body, null);
    this.stale = true;
  }

  /// Arrows move the hand across the view, with shift away from it; plus, minus and the letters a
  /// and d turn and zoom, 0 shows the whole arm.
  key(event) {
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = ways[event.key];
    if (way && this.poses) {
      event.preventDefault();
      if (!this.drag) {
        this.begin(this.hand);
        this.drag.keys = true;
      }
      const [right, up, forward] = this.orbit.axes();
      const step = this.extent * 0.02;
      const across = event.shiftKey ? forward : up;
      this.move(this.drag.to.map((x, i) => x + step * (way[0] * right[i] + way[1] * across[i])));
    } else if (event.key === "+" || event.key === "-") {
      this.orbit.zoomed(event.key === "+" ? 0.9 : 1.1);
    } else if (event.key === "a" || event.key === "d") {
      this.orbit.turned(event.key === "a" ? 20 : -20, 0);
    } else if (event.key === "0") {
      this.home();
    } else {
      return;
    }
    this.whole &&= Boolean(way) || event.key === "0";
    this.stale = true;
  }
}
