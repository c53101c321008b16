// The bars of the page, each a function that throws if it is missed: the test calls it on the page,
// and on one that is wrong.
import { gzipSync } from "node:zlib";

export const BARS = {
  /// Bytes of the file by gzip.
  compressed: 1_000_000,
  /// From opening to the first torque, ms.
  firstTorque: 2_000,
  /// A frame's work, ms: the mean, and that of one in twenty.
  work: 8,
  workOfOneIn20: 16,
  /// The processor time of all of the browser's processes for a frame, ms: two cores, sixty times a
  /// second.
  processor: 33,
  /// The least number of frames a second.
  rate: 55,
  /// The share of the machine's processors that other programs may have where times on the wall are
  /// held to their bars: with more they say nothing of the page.
  others: 0.1,
  /// The share of the robot's pixels in which the picture without WebGL may differ from that with
  /// it: edges, and highlights.
  pixels: 0.1,
};

const miss = (holds, words) => {
  if (!holds) throw new Error(`missed: ${words}`);
};

export function small(html) {
  const size = gzipSync(html, { level: 9 }).length;
  miss(size <= BARS.compressed, `${size} bytes compressed, at most ${BARS.compressed}`);
  return size;
}

/// The lines of two machines are the same, and enough of them.
export function sameBits(here, there) {
  miss(there.length > 40 && here.length === there.length, `${here.length} digests in WebAssembly, ${there.length} on the host`);
  here.forEach((line, i) => miss(line === there[i], `WebAssembly has \`${line}\`, the host \`${there[i]}\``));
  return here.length;
}

/// Each of the page's lines is one of the host's.
export function ownBits(here, there) {
  miss(here.length > 0, "no digest of the page's own module");
  for (const line of here) miss(there.includes(line), `the page's own module has \`${line}\`, which the host has not`);
  return here.length;
}

/// The time from opening to the first torque, ms: on a calm machine by the clock, on a busy one the
/// processor time of all of the browser's processes, on two cores.
export function prompt(wall, processor, held) {
  const [found, most] = held ? [wall, BARS.firstTorque] : [processor, 2 * BARS.firstTorque];
  miss(found <= most, `the first torque after ${found} ms${held ? "" : " of processor time"}, at most ${most}`);
  return `${found.toFixed(0)} ms${held ? "" : " of processor time: the machine is busy"}`;
}

/// The work of frames, ms, of which the slowest of twenty counts too; `held` to the bars.
export function fluent(work, held) {
  miss(work.length >= 100, `${work.length} frames are too few`);
  const sorted = [...work].sort((a, b) => a - b);
  const mean = work.reduce((a, b) => a + b, 0) / work.length;
  const late = sorted[Math.floor(sorted.length * 0.95)];
  miss(!held || mean <= BARS.work, `a frame's work takes ${mean.toFixed(2)} ms on average, at most ${BARS.work}`);
  miss(!held || late <= BARS.workOfOneIn20, `one frame in twenty takes ${late.toFixed(2)} ms, at most ${BARS.workOfOneIn20}`);
  return { mean, late };
}

/// Processor time of the browser for a frame, ms.
export function cheap(processor) {
  miss(processor > 0 && processor <= BARS.processor, `a frame takes ${processor.toFixed(1)} ms of processor time, at most ${BARS.processor}`);
  return processor;
}

/// Whether times on the wall are held to their bars.
export const calm = (others) => others <= BARS.others;

export function steady(rate) {
  miss(rate >= BARS.rate, `${rate.toFixed(1)} frames a second, at least ${BARS.rate}`);
}

/// Whether two pictures of a robot are alike: `differ` of its `of` pixels are not.
export function alike({ differ, of }, where) {
  miss(of > 1_000 && differ <= BARS.pixels * of, `${differ} of ${of} pixels of the robot differ without WebGL, ${where}`);
  return differ / of;
}

/// Whether the accessibility checker axe finds nothing.
export function accessible(violations, where) {
  const words = violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.target} ${node.failureSummary}`).join("; ")}`);
  miss(violations.length === 0, `axe, ${where}: ${words.join(" | ")}`);
}

/// Whether no request left the page: `requests` are the addresses that were asked for.
export function alone(requests) {
  const others = requests.filter((url) => !/^(file|data|blob):/.test(url));
  miss(others.length === 0, `loaded from elsewhere: ${others.join(", ")}`);
}

/// By how many pixels something on a page is wider than the viewport that the test set. Not
/// `innerWidth`: a phone's grows with what is too wide; nor `screen`: its width on a desktop is
/// that of the browser's own screen.
export const excess = (page) => page.evaluate((width) => document.documentElement.scrollWidth - width, page.viewport().width);

/// Whether nothing is wider than the screen.
export function narrow(excess, where) {
  miss(excess <= 0, `the page is ${excess} px wider than the screen, ${where}`);
}

/// Whether all points are in a picture of this size.
export function whole(points, [width, height], where) {
  const out = points.filter(([x, y]) => !(x >= 0 && y >= 0 && x <= width && y <= height));
  miss(points.length > 0 && out.length === 0, `${out.length} of ${points.length} points of the robot are outside the picture, ${where}`);
}

/// Whether no label covers another one or a dot: boxes as the browser gives them.
export function apart(labels, dots, where) {
  const cover = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  const covered = labels.filter((a, i) => [...labels.slice(i + 1), ...dots].some((b) => cover(a, b)));
  miss(labels.length > 8 && dots.length > 4 && covered.length === 0, `${labels.length} labels; covered: ${covered.map(({ words }) => words)}, ${where}`);
}

/// Fails unless a check fails.
export function refused(name, check) {
  let failed = false;
  try {
    check();
  } catch {
    failed = true;
  }
  miss(failed, `the check "${name}" does not fail where it should`);
}
