// The robot as capsules and drums in OGL: links from joint to joint, a drum along each joint's axis.

const VERTEX = `
attribute vec3 position; attribute vec3 normal;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
varying vec3 at; varying vec3 facing;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  at = world.xyz;
  facing = mat3(modelMatrix) * normal;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;
const FRAGMENT = `
precision highp float;
uniform vec3 colour, eye; uniform float shine;
varying vec3 at; varying vec3 facing;
void main() {
  vec3 n = normalize(facing), toEye = normalize(eye - at);
  vec3 sun = normalize(vec3(0.5, -0.6, 1.0));
  float sky = 0.5 + 0.5 * n.z, light = max(dot(n, sun), 0.0);
  float gloss = pow(max(dot(n, normalize(sun + toEye)), 0.0), 40.0) * shine;
  gl_FragColor = vec4(colour * (0.45 + 0.25 * sky + 0.45 * light) + gloss, 1.0);
}`;
const FLAT_VERTEX = `
attribute vec3 position; uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
void main() { gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0); }`;
const FLAT_FRAGMENT = `
precision highp float; uniform vec3 colour; uniform float opacity;
void main() { gl_FragColor = vec4(colour, opacity); }`;

/// A colour "#rrggbb" as three numbers.
const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);

/// Columns of a matrix that takes y to the direction from a to b.
function along(a, b) {
  const y = unit(minus(b, a));
  const x = unit(cross(y, Math.abs(y[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  return [x, y, cross(x, y)];
}

export class Drawn {
  constructor(gl) {
    this.gl = gl;
    this.root = new ogl.Transform();
    this.cylinder = new ogl.Cylinder(gl, { radiusTop: 1, radiusBottom: 1, height: 1, radialSegments: 20, heightSegments: 1 });
    this.sphere = new ogl.Sphere(gl, { radius: 1, widthSegments: 20, heightSegments: 14 });
    this.robot = null;
  }

  /// A mesh in a colour of its own that lies where its matrix says.
  mesh(geometry, colour, { flat = false, mode, opacity = 1 } = {}) {
    const uniforms = { colour: { value: channels(colour) }, eye: { value: [0, 0, 0] }, shine: { value: 0.35 }, opacity: { value: opacity } };
    const program = new ogl.Program(this.gl, {
      vertex: flat ? FLAT_VERTEX : VERTEX, fragment: flat ? FLAT_FRAGMENT : FRAGMENT, uniforms,
      transparent: opacity < 1, cullFace: false,
    });
    const mesh = new ogl.Mesh(this.gl, { geometry, program, mode, frustumCulled: false });
    mesh.matrixAutoUpdate = false;
    mesh.setParent(this.root);
    return mesh;
  }

  /// A grid on the ground.
  ground(size, colour) {
    this.grid?.setParent(null);
    const step = size / 5;
    const points = [];
    for (let i = -10; i <= 10; i++) points.push(i * step, -10 * step, 0, i * step, 10 * step, 0, -10 * step, i * step, 0, 10 * step, i * step, 0);
    const geometry = new ogl.Geometry(this.gl, { position: { size: 3, data: new Float32Array(points) } });
    this.grid = this.mesh(geometry, colour, { flat: true, mode: this.gl.LINES, opacity: 0.6 });
  }

  /// The meshes of a robot of this size.
  build(about, size, colour) {
    for (const part of this.robot?.parts ?? []) part.mesh.setParent(null);
    const radius = (size * 0.045) / Math.sqrt(Math.max(1, about.bodies.length / 8));
    const parts = [];
    const children = about.bodies.map(() => []);
    about.bodies.forEach((body, i) => body.parent !== null && children[body.parent].push(i));
    const link = (from, to, r) => {
      parts.push({ kind: "link", from, to, r, mesh: this.mesh(this.cylinder, colour("link")) });
    };
    about.bodies.forEach((body, i) => {
      if (body.parent === null) link({ body: null }, { body: i }, radius * 1.15);
      for (const child of children[i]) link({ body: i }, { body: child }, radius);
      if (children[i].length === 0) link({ body: i }, { body: i, at: body.com }, radius * 0.8);
      parts.push({ kind: "ball", body: i, r: radius, mesh: this.mesh(this.sphere, colour("link")) });
    });
    about.joints.forEach((joint, number) => {
      parts.push({ kind: "drum", body: joint.body, joint: number, axis: about.bodies[joint.body].axis, r: radius * 1.25, mesh: this.mesh(this.cylinder, colour("drum")) });
    });
    const tips = about.bodies.map((_, i) => i).filter((i) => children[i].length === 0);
    const hand = this.mesh(this.sphere, colour("hand"));
    parts.push({ kind: "hand", body: tips.at(-1), r: radius * 1.35, mesh: hand });
    this.robot = { about, parts, radius, hand: tips.at(-1) };
    this.arrow ??= [this.mesh(this.cylinder, colour("push")), this.mesh(this.sphere, colour("push"))];
  }

  /// Puts all where the poses say; loads are the shares of each joint's torque of its limit.
  place(poses, loads, colour, eye) {
    const point = ({ body, at }) => {
      if (body === null) return [0, 0, 0];
      const p = poses[body];
      if (!at) return [p[0], p[1], p[2]];
      return [0, 1, 2].map((i) => p[i] + p[3 + i] * at[0] + p[6 + i] * at[1] + p[9 + i] * at[2]);
    };
    const calm = channels(colour("drum"));
    const loaded = channels(colour("loaded"));
    for (const part of this.robot.parts) {
      const { mesh, r } = part;
      mesh.program.uniforms.eye.value = eye;
      if (part.kind === "link") {
        const [a, b] = [point(part.from), point(part.to)];
        mesh.visible = length(minus(b, a)) > r * 0.2;
        this.span(mesh, a, b, r);
      } else if (part.kind === "drum") {
        const p = point(part);
        const axis = [0, 1, 2].map((i) => poses[part.body][3 + i] * part.axis[0] + poses[part.body][6 + i] * part.axis[1] + poses[part.body][9 + i] * part.axis[2]);
        const half = r * 1.05;
        this.span(mesh, p.map((x, i) => x - axis[i] * half), p.map((x, i) => x + axis[i] * half), r);
        const share = Math.min(1, Math.abs(loads[part.joint] ?? 0));
        mesh.program.uniforms.colour.value = calm.map((c, i) => c + (loaded[i] - c) * share);
      } else {
        const [x, y, z] = point(part);
        mesh.matrix.set(r, 0, 0, 0, 0, r, 0, 0, 0, 0, r, 0, x, y, z, 1);
      }
    }
  }

  span(mesh, a, b, r) {
    const [x, y, z] = along(a, b);
    const l = length(minus(b, a));
    const m = a.map((p, i) => (p + b[i]) / 2);
    mesh.matrix.set(x[0] * r, x[1] * r, x[2] * r, 0, y[0] * l, y[1] * l, y[2] * l, 0, z[0] * r, z[1] * r, z[2] * r, 0, m[0], m[1], m[2], 1);
  }

  /// The arrow of a push or of a drag, or none.
  point(from, to) {
    if (!this.arrow) return;
    const [shaft, tip] = this.arrow;
    shaft.visible = tip.visible = Boolean(to);
    if (!to) return;
    const r = this.robot.radius;
    this.span(shaft, from, to, r * 0.3);
    tip.matrix.set(r * 0.8, 0, 0, 0, 0, r * 0.8, 0, 0, 0, 0, r * 0.8, 0, ...to, 1);
  }

  recolour(colour) {
    for (const { kind, mesh } of this.robot?.parts ?? []) {
      mesh.program.uniforms.colour.value = channels(colour(kind === "hand" ? "hand" : kind === "drum" ? "drum" : "link"));
    }
    for (const mesh of this.arrow ?? []) mesh.program.uniforms.colour.value = channels(colour("push"));
    if (this.grid) this.grid.program.uniforms.colour.value = channels(colour("grid"));
  }
}
