// The picture of the front: largest error against cycles, both logarithmic, and microseconds above.
import { digits, grouped } from "./words.js";

/// Cycles of a microsecond at 168 MHz.
export const CLOCK = 168;
const EDGE = { left: 54, right: 16, top: 36, bottom: 38 };
const HEIGHT = 240;

/// The numbers of these heads between two bounds, of which no two are nearer than `gap` pixels.
function marks([low, high], place, gap, heads) {
  const powers = Array.from({ length: 40 }, (_, i) => i - 20);
  const all = powers.flatMap((power) => heads.map((head) => Number(`${head}e${power}`))).filter((value) => value >= low && value <= high);
  return all.reduce((kept, value) => (kept.some((other) => Math.abs(place(other) - place(value)) < gap) ? kept : [...kept, value]), []);
}

/// Draws the ways, cheapest first, in an SVG of its own width.
export function drawFront(svg, ways, chosen) {
  const width = Math.max(240, svg.clientWidth);
  const { left, right, top, bottom } = EDGE;
  const axis = (values, room, from, to) => {
    const [low, high] = [Math.min(...values) / room, Math.max(...values) * room];
    return [[low, high], (x) => from + ((to - from) * Math.log(x / low)) / Math.log(high / low)];
  };
  const [cycles, x] = axis(ways.map((way) => way.cycles), 1.08, left, width - right);
  const [errors, y] = axis(ways.map((way) => way.error), 2, HEIGHT - bottom, top);
  const text = (x, y, anchor, words) => `<text x="${x}" y="${y}" text-anchor="${anchor}">${words}</text>`;
  const line = (...p) => `<path d="M${p[0]} ${p[1]}L${p[2]} ${p[3]}"/>`;
  const heads = [1, 2, 3, 4, 5, 7];
  svg.setAttribute("viewBox", `0 0 ${width} ${HEIGHT}`);
  svg.setAttribute("height", HEIGHT);
  svg.innerHTML = [
    text(0, 12, "start", "error, N·m"), text(width, 12, "end", "µs at 168 MHz"), text(width, HEIGHT - 3, "end", "cycles"),
    ...marks(cycles, x, 40, heads).map((value) => line(x(value), top, x(value), HEIGHT - bottom) + text(x(value), HEIGHT - bottom + 15, "middle", grouped(value))),
    ...marks(cycles.map((value) => value / CLOCK), (time) => x(time * CLOCK), 40, heads).map((time) => line(x(time * CLOCK), top, x(time * CLOCK), top - 4) + text(x(time * CLOCK), top - 7, "middle", time)),
    ...marks(errors, y, 16, [1]).map((value) => line(left, y(value), width - right, y(value)) + text(left - 6, y(value) + 4, "end", digits(value, 1).replace("1·", ""))),
    ...ways.map((way) => `<circle cx="${x(way.cycles)}" cy="${y(way.error)}" r="${way === chosen ? 5 : 3}" class="${way === chosen ? "chosen" : "dot"}"/>`),
  ].join("");
}
