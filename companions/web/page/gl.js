// The picture by a graphics processor, through OGL.
import { along, length, minus } from "./camera.js";
import { tint } from "./shape.js";

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
/// The light is that of `soft.js`.
const FRAGMENT = `
precision highp float;
uniform vec3 colour, eye;
varying vec3 at; varying vec3 facing;
void main() {
  vec3 n = normalize(facing), toEye = normalize(eye - at);
  vec3 sun = normalize(vec3(0.5, -0.6, 1.0));
  float sky = 0.5 + 0.5 * n.z, light = max(dot(n, sun), 0.0);
  float gloss = pow(max(dot(n, normalize(sun + toEye)), 0.0), 40.0) * 0.35;
  gl_FragColor = vec4(colour * (0.45 + 0.25 * sky + 0.45 * light) + gloss, 1.0);
}`;

/// The names of the software renderers of OpenGL and the browsers, which are slower than `soft.js`.
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/// Whether WebGL is there and is no software.
export function hasGraphics() {
  const gl = document.createElement("canvas").getContext("webgl");
  if (!gl) return false;
  const masked = gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(masked ? masked.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !SOFTWARE.test(name);
}

export class Gl {
  constructor(canvas) {
    this.renderer = new ogl.Renderer({ canvas, alpha: true, antialias: true });
    const { gl } = this.renderer;
    this.camera = new ogl.Camera(gl);
    this.camera.up.set(0, 0, 1);
    this.geometries = {
      ball: new ogl.Sphere(gl, { radius: 1, widthSegments: 20, heightSegments: 14 }),
      cylinder: new ogl.Cylinder(gl, { radiusTop: 1, radiusBottom: 1, height: 1, radialSegments: 20, heightSegments: 1 }),
    };
  }

  /// Takes a view of this size with so many pixels for each of the page's.
  size(width, height, ratio) {
    this.renderer.dpr = ratio;
    this.renderer.setSize(width, height);
    this.aspect = width / height;
  }

  /// Takes the parts of a robot.
  take({ parts }) {
    const { gl } = this.renderer;
    this.root = new ogl.Transform();
    this.meshes = parts.map(({ kind, mesh: given }) => {
      const own = given && new ogl.Geometry(gl, { position: { size: 3, data: given.positions }, normal: { size: 3, data: given.normals } });
      const uniforms = { colour: { value: [0, 0, 0] }, eye: { value: [0, 0, 0] } };
      const program = new ogl.Program(gl, { vertex: VERTEX, fragment: FRAGMENT, uniforms, cullFace: false });
      const mesh = new ogl.Mesh(gl, { geometry: own ?? this.geometries[kind === "ball" ? "ball" : "cylinder"], program, frustumCulled: false });
      mesh.matrixAutoUpdate = false;
      mesh.setParent(this.root);
      return mesh;
    });
  }

  draw({ parts }, orbit, colours) {
    const eye = orbit.position();
    this.camera.perspective({ fov: orbit.field, aspect: this.aspect, near: orbit.near, far: orbit.far });
    this.camera.position.set(...eye);
    this.camera.lookAt(orbit.target);
    parts.forEach((part, i) => {
      const { a, b, r, kind, visible, axes } = part;
      const mesh = this.meshes[i];
      mesh.visible = visible;
      if (!visible) return;
      mesh.program.uniforms.eye.value = eye;
      mesh.program.uniforms.colour.value = tint(part, colours);
      if (kind === "ball") return void mesh.matrix.set(r, 0, 0, 0, 0, r, 0, 0, 0, 0, r, 0, ...a, 1);
      if (axes) return void mesh.matrix.set(...axes.slice(0, 3), 0, ...axes.slice(3, 6), 0, ...axes.slice(6), 0, ...a, 1);
      const [x, y, z] = along(a, b);
      const l = length(minus(b, a));
      const m = a.map((p, k) => (p + b[k]) / 2);
      mesh.matrix.set(x[0] * r, x[1] * r, x[2] * r, 0, y[0] * l, y[1] * l, y[2] * l, 0, z[0] * r, z[1] * r, z[2] * r, 0, ...m, 1);
    });
    this.renderer.render({ scene: this.root, camera: this.camera });
  }
}
