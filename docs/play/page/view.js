// The view of the robot: it draws, turns, and says which body a pointer or the keyboard drags where.
import { Orbit, length, minus } from "./camera.js";
import { Drawn } from "./scene.js";
import { by, colours } from "./words.js";

/// How near a pointer has to be to a body, pixels; a finger is wider than a mouse.
const NEAR = { mouse: 26, pen: 30, touch: 44 };

export class View {
  /// `dragged(body, point)` is called as a body is dragged to a point, and with a point of null at its end.
  constructor(canvas, dragged) {
    this.canvas = canvas;
    this.dragged = dragged;
    this.orbit = new Orbit();
    this.poses = null;
    this.pointers = new Map();
    this.drag = null;
    this.colour = colours();
    try {
      this.renderer = new ogl.Renderer({ canvas, alpha: true, antialias: true, dpr: Math.min(2, devicePixelRatio) });
      this.drawn = new Drawn(this.renderer.gl);
      this.camera = new ogl.Camera(this.renderer.gl, { fov: this.orbit.field });
      this.camera.up.set(0, 0, 1);
    } catch (error) {
      // Without WebGL the torques are computed all the same.
      this.renderer = null;
      by("no-webgl").hidden = false;
    }
    this.listen();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
  }

  recolour() {
    this.colour = colours();
    this.drawn?.recolour(this.colour);
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.size = [clientWidth, clientHeight];
    if (!this.renderer || clientWidth === 0) return;
    this.renderer.setSize(clientWidth, clientHeight);
    this.stale = true;
  }

  /// Takes a robot in a pose.
  show(about, poses) {
    const points = [[0, 0, 0], ...poses.map((p) => [p[0], p[1], p[2]])];
    const low = [0, 1, 2].map((i) => Math.min(...points.map((p) => p[i])));
    const high = [0, 1, 2].map((i) => Math.max(...points.map((p) => p[i])));
    const size = Math.max(0.2, length(minus(high, low)));
    this.orbit.frame(low.map((x, i) => (x + high[i]) / 2), size);
    this.extent = size;
    this.about = about;
    if (this.drawn) {
      this.drawn.build(about, size, this.colour);
      this.drawn.ground(size * 1.2, this.colour("grid"));
    }
    const parents = new Set(about.bodies.map((body) => body.parent));
    this.hand = about.bodies.map((_, i) => i).filter((i) => !parents.has(i)).at(-1);
    this.drag = null;
    this.place(poses, []);
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

  /// Draws with fewer pixels where frames take long: a phone without a fast GPU, or software.
  adapt(interval) {
    this.pace = 0.95 * (this.pace ?? 16) + 0.05 * Math.min(200, interval);
    if (!this.renderer || this.pace < 28 || this.renderer.dpr < 0.6) return;
    this.pace = 16;
    this.renderer.dpr *= 0.75;
    this.resize();
  }

  render() {
    if (!this.renderer || !this.stale || !this.poses) return;
    this.stale = false;
    const [width, height] = this.size ?? [1, 1];
    const eye = this.orbit.position();
    this.camera.perspective({ fov: this.orbit.field, aspect: width / height, near: this.orbit.near, far: this.orbit.far });
    this.camera.position.set(...eye);
    this.camera.lookAt(this.orbit.target);
    this.drawn.place(this.poses, this.loads, this.colour, eye);
    this.drawn.point(this.drag && this.point(this.drag.body), this.drag?.to);
    for (const mesh of this.drawn.arrow ?? []) mesh.program.uniforms.eye.value = eye;
    this.renderer.render({ scene: this.drawn.root, camera: this.camera });
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
    const canvas = this.canvas;
    const at = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      const [x, y] = at(event);
      this.pointers.set(event.pointerId, [x, y]);
      const body = this.pointers.size === 1 ? this.under(x, y, event.pointerType) : null;
      if (body !== null) this.begin(body);
    });
    canvas.addEventListener("pointermove", (event) => {
      const [x, y] = at(event);
      const before = this.pointers.get(event.pointerId);
      if (!before) {
        canvas.style.cursor = this.under(x, y, event.pointerType) === null ? "" : "grab";
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
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.orbit.zoomed(Math.exp(event.deltaY * 0.001));
      this.stale = true;
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("keyup", (event) => event.key.startsWith("Arrow") && this.drag?.keys && this.end());
    canvas.addEventListener("blur", () => this.drag?.keys && this.end());
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

  /// Arrows move the hand across the view, with shift away from it; plus, minus and the letters a and d turn and zoom.
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
    } else {
      return;
    }
    this.stale = true;
  }
}
