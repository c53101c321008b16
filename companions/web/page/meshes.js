// Meshes that a URDF names, read by three.js's loaders, as triangles in the frames of their bodies.
// The files are hostile: sizes and counts are bounded, and nothing is asked for.
import { cross, dot, minus, unit } from "./camera.js";
import { unpacked } from "./library.js";
import { inFrame } from "./shape.js";

/// The most files, and the most triangles of all of them.
export const MOST_FILES = 200;
const MOST_FACES = 500_000;
/// Meshes of more triangles are coarser where there is no graphics processor: with one corner in
/// each cell, of which so many are as long as the mesh.
const [FINE, CELLS] = [2_000, 32];

/// The loaders, which are decoded when the first mesh is read.
async function loaders() {
  if (!globalThis.three) {
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(await unpacked("loaders"));
    document.head.append(script);
  }
  return globalThis.three;
}

/// The object of a file, by the end of its name.
const READ = {
  stl(three, bytes) {
    const [count] = bytes.byteLength < 84 ? [Infinity] : new Uint32Array(bytes.slice(80, 84));
    const isText = /^\s{0,4}solid/.test(new TextDecoder().decode(bytes.slice(0, 9)));
    return isText || 84 + 50 * count <= bytes.byteLength ? new three.Mesh(new three.STLLoader().parse(bytes)) : null;
  },
  obj: (three, bytes) => new three.OBJLoader().parse(new TextDecoder().decode(bytes)),
  dae(three, bytes) {
    const text = new TextDecoder().decode(bytes);
    // Each may double what is in the others.
    if (text.split("<instance_node").length > 16) throw new Error("too many parts are parts of others");
    return new three.ColladaLoader().parse(text, "")?.scene;
  },
  glb: async (three, bytes) => (await new three.GLTFLoader().parseAsync(bytes, "")).scene,
};

/// The corners of all triangles of an object, in the frame of the file: like RViz, without the
/// turn of a file whose axis upwards is another.
function corners(three, object, most) {
  const parts = [];
  object?.quaternion.identity();
  object?.updateMatrixWorld(true);
  object?.traverse((part) => part.isMesh && part.geometry.attributes.position && parts.push(part));
  const size = ({ geometry: { index, attributes } }) => 3 * Math.floor((index ?? attributes.position).count / 3);
  const faces = parts.reduce((sum, part) => sum + size(part) / 3, 0);
  if (faces > most) throw new Error(`with it there are ${MOST_FACES - most + faces} triangles, and at most ${MOST_FACES} are shown`);
  const [found, point] = [new Float32Array(9 * faces), new three.Vector3()];
  let at = 0;
  for (const part of parts) {
    const { geometry: { index, attributes: { position } }, matrixWorld } = part;
    // A mirrored part has its corners the other way round.
    const order = matrixWorld.determinant() < 0 ? [2, 1, 0] : [0, 1, 2];
    for (let i = 0; i < size(part); i++, at += 3) {
      const corner = i - (i % 3) + order[i % 3];
      point.fromBufferAttribute(position, index ? index.getX(corner) : corner).applyMatrix4(matrixWorld).toArray(found, at);
    }
  }
  return found;
}

/// The corners of a file's triangles, nine numbers each, beside those of others.
export async function triangles(file, bytes, others) {
  const most = MOST_FACES - others.reduce((sum, one) => sum + one.length / 9, 0);
  const three = await loaders();
  try {
    const found = corners(three, await READ[ending(file)](three, bytes), most);
    if (!found.length || !found.every((x) => Math.abs(x) < 1e9)) throw new Error("it has no triangles, or corners that are no numbers");
    return found;
  } catch (error) {
    throw new Error(`${file}: ${error.message}.`);
  }
}

const ending = (name) => name.split(".").at(-1).toLowerCase();

/// Whether a mesh of this name can be read.
export const isRead = (name) => Object.hasOwn(READ, ending(name));

const folders = (path) => path.toLowerCase().split(/[\\/]+/).reverse();

/// The path, of these, of the file that an address names: its name, and most of its last folders.
export function pathOf(address, paths) {
  const wanted = folders(address);
  const same = (path) => folders(path).concat("").findIndex((word, i) => word !== wanted[i]);
  const all = paths.filter((path) => same(path) > 0);
  return all.reduce((best, path) => (best === undefined || same(path) >= same(best) ? path : best), undefined);
}

/// The addresses of all meshes of a URDF.
export const meshNames = (text) => Array.from(parsed(text).querySelectorAll("mesh[filename]"), (mesh) => mesh.getAttribute("filename"));

const parsed = (text) => new DOMParser().parseFromString(text, "application/xml");

/// The meshes of a link that are drawn: the visual ones, or those of collisions where no visual one
/// can be read.
function drawn(link) {
  const of = (kind) => [...link.querySelectorAll(`:scope > ${kind} > geometry > mesh[filename]`)];
  const some = (meshes) => meshes.some((mesh) => isRead(mesh.getAttribute("filename")));
  const [seen, touched] = [of("visual"), of("collision")];
  return !some(seen) && some(touched) ? touched : seen;
}

/// The meshes that are drawn of a URDF: link, file, and the place of the mesh in the link.
export function visuals(text) {
  const all = [...parsed(text).querySelectorAll("robot > link")].flatMap(drawn);
  const numbers = (at, name, otherwise) => [0, 1, 2].map((i) => Number((at?.getAttribute(name) ?? "").trim().split(/\s+/)[i] || otherwise) || 0);
  return all.slice(0, MOST_FILES).map((mesh) => {
    const visual = mesh.closest("visual, collision");
    const origin = visual.querySelector(":scope > origin");
    const [[r, p, y], scale] = [numbers(origin, "rpy", 0), numbers(mesh, "scale", 1)];
    const [a, b, c, d, e, f] = [Math.cos(r), Math.sin(r), Math.cos(p), Math.sin(p), Math.cos(y), Math.sin(y)];
    const axes = [e * c, f * c, -d, e * d * b - f * a, f * d * b + e * a, c * b, e * d * a + f * b, f * d * a - e * b, c * a];
    return { link: visual.parentNode.getAttribute("name"), file: mesh.getAttribute("filename"), xyz: numbers(origin, "xyz", 0), axes: axes.map((x, i) => x * scale[Math.floor(i / 3)]) };
  });
}

/// A mesh in the frame of its body, which has its link at `pose`.
export function placed(found, { xyz, axes }, body, pose) {
  const turn = pose.slice(3);
  const whole = [0, 3, 6].flatMap((i) => inFrame([0, 0, 0], turn, axes.slice(i, i + 3)));
  const origin = inFrame(pose.slice(0, 3), turn, xyz);
  const points = Array.from({ length: found.length / 3 }, (_, i) => inFrame(origin, whole, found.slice(3 * i, 3 * i + 3)));
  const [low, high] = [Math.min, Math.max].map((most) => [0, 1, 2].map((i) => points.reduce((x, p) => most(x, p[i]), points[0][i])));
  const cell = Math.max(...minus(high, low)) / CELLS;
  const cells = new Map();
  const kept = (p, key = p.map((x) => Math.floor(x / cell)).join()) => cells.get(key) ?? (cells.set(key, p), p);
  const faces = (points) => Array.from({ length: points.length / 3 }, (_, i) => points.slice(3 * i, 3 * i + 3)).filter(([a, b, c]) => a !== b && b !== c && c !== a);
  const fine = faces(points);
  // A mirrored mesh has its corners the other way round.
  if (dot(cross(axes.slice(0, 3), axes.slice(3, 6)), axes.slice(6)) < 0) fine.forEach((face) => face.reverse());
  return {
    body,
    corners: [0, 1, 2, 3, 4, 5, 6, 7].map((k) => low.map((x, i) => ((k >> i) & 1 ? high[i] : x))),
    positions: new Float32Array(fine.flat(2)),
    normals: new Float32Array(fine.flatMap(([a, b, c]) => [a, b, c].flatMap(() => unit(cross(minus(b, a), minus(c, a)))))),
    coarse: fine.length > FINE ? faces(fine.flat().map((p) => kept(p))) : fine,
  };
}
