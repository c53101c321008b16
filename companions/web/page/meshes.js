// Meshes that a URDF names, STL or OBJ, as triangles in the frames of their bodies. The files are
// hostile: sizes and counts are bounded, and nothing is asked for.
import { cross, dot, minus, unit } from "./camera.js";
import { inFrame } from "./shape.js";

/// The most files, and the most triangles of all of them.
export const MOST_FILES = 200;
const MOST_FACES = 500_000;
/// Meshes of more triangles are coarser where there is no graphics processor: with one corner in
/// each cell, of which so many are as long as the mesh.
const [FINE, CELLS] = [2_000, 32];

/// The name of a file without its folders, by which it is matched.
export const base = (path) => path.split(/[\\/]/).at(-1).toLowerCase();

function stl(bytes) {
  const view = new DataView(bytes);
  const count = bytes.byteLength < 84 ? 0 : view.getUint32(80, true);
  const text = new TextDecoder().decode(bytes.byteLength === 84 + 50 * count ? new Uint8Array() : bytes);
  if (text.startsWith("solid")) return Array.from(text.matchAll(/vertex\s+(\S+)\s+(\S+)\s+(\S+)/g), ([, ...p]) => p.map(Number)).flat();
  return Float32Array.from({ length: bytes.byteLength < 84 + 50 * count ? 0 : 9 * count }, (_, i) => view.getFloat32(96 + 50 * Math.floor(i / 9) + 4 * (i % 9), true));
}

function obj(bytes) {
  const [points, found] = [[], []];
  for (const line of new TextDecoder().decode(bytes).split("\n")) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === "v") points.push(words.slice(0, 3).map(Number));
    if (kind !== "f") continue;
    const corners = words.map((word) => points.at(Number.parseInt(word, 10) - (word.startsWith("-") ? 0 : 1)));
    for (let i = 2; i < corners.length; i++) found.push(...[0, i - 1, i].flatMap((k) => corners[k] ?? [NaN]));
  }
  return found;
}

/// The corners of a file's triangles, nine numbers each, beside those of others.
export function triangles(file, bytes, others) {
  const found = /\.obj$/i.test(file) ? obj(bytes) : stl(bytes);
  const faces = [found, ...others].reduce((sum, one) => sum + one.length / 9, 0);
  if (faces > MOST_FACES) throw new Error(`${file}: with it there are ${faces} triangles, and at most ${MOST_FACES} are shown.`);
  if (!found.length || found.length % 9 || !found.every((x) => Math.abs(x) < 1e9)) throw new Error(`${file}: it has no triangles, or corners that are no numbers.`);
  return found;
}

/// Whether a mesh of this name can be read.
export const isRead = (name) => /\.(stl|obj)$/i.test(name);

/// The names of all meshes of a URDF.
export const meshNames = (text) => new Set(Array.from(parsed(text).querySelectorAll("mesh[filename]"), (mesh) => base(mesh.getAttribute("filename"))));

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
    return { link: visual.parentNode.getAttribute("name"), file: base(mesh.getAttribute("filename")), xyz: numbers(origin, "xyz", 0), axes: axes.map((x, i) => x * scale[Math.floor(i / 3)]) };
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
