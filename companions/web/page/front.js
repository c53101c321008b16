// The picture of the front: largest error against cycles, both logarithmic, and microseconds above.
import { digits, grouped } from "./words.js";

/// Cycles of a microsecond at 168 MHz.
export const CLOCK = 168;
const EDGE = { left: 54, right: 16, top: 36, bottom: 38 };
const HEIGHT = 210;

/// The numbers of these heads between two bounds that have so many pixels between them.
function marks([low, high], place, gap, heads) {
  const found = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    for (const value of heads.map((head) => Number(`${head}e${power}`))) {
      if (value >= low && value <= high && found.every((other) => Math.abs(place(other) - place(value)) > gap)) found.push(value);
    }
  }
  return found;
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
  const text = (x, y, anchor, words) => `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}">${words}</text>`;
  const line = (...p) => `<path d="M${p[0]} ${p[1]}L${p[2]} ${p[3]}"/>`;
  const parts = [
    text(0, 12, "start", "error, N·m"), text(width, 12, "end", "µs at 168 MHz"), text(width, HEIGHT - 3, "end", "cycles"),
    ...marks(cycles, x, 40, [1, 2, 5, 3, 7, 4]).map((value) => line(x(value), top, x(value), HEIGHT - bottom) + text(x(value), HEIGHT - bottom + 15, "middle", grouped(value))),
    ...marks(cycles.map((value) => value / CLOCK), (time) => x(time * CLOCK), 40, [1, 2, 5, 3, 7, 4]).map((time) => line(x(time * CLOCK), top, x(time * CLOCK), top - 4) + text(x(time * CLOCK), top - 7, "middle", String(time))),
    ...marks(errors, y, 16, [1]).map((value) => line(left, y(value), width - right, y(value)) + text(left - 6, y(value) + 4, "end", digits(value, 1).replace("1·", ""))),
    ...ways.map((way) => `<circle cx="${x(way.cycles).toFixed(1)}" cy="${y(way.error).toFixed(1)}" r="${way === chosen ? 5 : 3}" class="${way === chosen ? "chosen" : "dot"}"/>`),
  ];
  svg.setAttribute("viewBox", `0 0 ${width} ${HEIGHT}`);
  svg.setAttribute("height", HEIGHT);
  svg.innerHTML = parts.join("");
}
