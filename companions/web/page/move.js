// The tab "Move": joints, effects, torques, the front of accuracy, costs and Rust.
import { Bars } from "./bars.js";
import { front, price, wayAbout, wayInWords } from "./recorded.js";
import { rust } from "./rust.js";
import { EFFECTS, chosen, has, motion, posture, range, say, state } from "./state.js";
import { by, colours, digits, element, grouped, write } from "./words.js";

const move = { bars: null, inputs: [], numbers: [], way: null, quantity: "q", text: 0, shown: 0, colour: null };

/// The limits and the unit of what the sliders set.
const QUANTITIES = {
  q: { title: "Position", unit: (joint) => (joint.prismatic ? "m" : "rad"), range },
  qd: { title: "Velocity", unit: (joint) => (joint.prismatic ? "m/s" : "rad/s"), range: (joint) => [-1, 1].map((s) => s * Math.min(10, joint.velocity ?? 3)) },
  qdd: { title: "Acceleration", unit: (joint) => (joint.prismatic ? "m/s²" : "rad/s²"), range: () => [-20, 20] },
};

/// Takes the robot of `about` as the present one.
export function take(robot) {
  const { about } = robot;
  state.robot = robot;
  state.q = posture(robot);
  state.qd = state.q.map(() => 0);
  state.qdd = state.q.map(() => 0);
  state.clock = 0;
  move.way = front()?.find((way) => way.key === "default") ?? null;
  state.view.show(about, compute().poses);
  joints();
  effects();
  ways();
  code();
}

/// Computes the state of now.
export function compute() {
  state.moved = motion();
  state.computed = state.library.call({ op: "compute", motion: state.moved, on: chosen() });
  return state.computed;
}

/// The sliders of the joints.
function joints() {
  const of = QUANTITIES[move.quantity];
  const at = by("joints");
  const { joints: all, held } = state.robot.about;
  move.inputs = [];
  move.numbers = [];
  at.replaceChildren(...all.map((joint, i) => {
    const [lower, upper] = of.range(joint);
    const input = element("input", { type: "range", id: `joint-${i}`, min: lower, max: upper, step: "any", value: state[move.quantity][i] });
    const output = element("output", { for: `joint-${i}` });
    input.addEventListener("input", () => {
      rest();
      state[move.quantity][i] = Number(input.value);
      input.setAttribute("aria-valuetext", `${digits(Number(input.value))} ${of.unit(joint)}`);
    });
    // "any" leaves the arrow keys without a step of their own.
    input.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
      if (!way) return;
      event.preventDefault();
      input.value = Number(input.value) + (way * (upper - lower)) / 100;
      input.dispatchEvent(new Event("input"));
    });
    move.inputs.push(input);
    move.numbers.push(output);
    return element("div", { class: "joint" }, element("label", { for: `joint-${i}`, title: joint.name }, joint.name), input, output);
  }));
  if (held > 0) at.append(element("p", { class: "note" }, `${held} coordinates of a free base stay at zero: their forces are not shown.`));
}

/// Keeps the joints where the swing has them.
function rest() {
  if (state.swinging || state.clock !== 0) {
    const now = motion();
    [state.q, state.qd, state.qdd] = [now.q, now.qd, now.qdd];
    state.swinging = false;
    state.clock = 0;
    by("swing").setAttribute("aria-pressed", "false");
  }
}

/// A body is dragged to a point: the joints follow.
export function reach(body, target) {
  if (!target) return;
  rest();
  state.q = state.library.call({ op: "reach", body, q: state.q, target });
  state.qd = state.q.map(() => 0);
  state.qdd = state.q.map(() => 0);
}

function effects() {
  by("effects").replaceChildren(...EFFECTS.map(({ name, title, about }) => {
    const there = has(name);
    const input = element("input", { type: "checkbox", id: `effect-${name}`, checked: state.on[name] && there, disabled: !there });
    input.addEventListener("change", () => {
      state.on[name] = input.checked;
      code();
    });
    const words = there ? about : "no numbers of this robot in the repository";
    return element("div", { class: "effect" }, input,
      element("label", { for: `effect-${name}` }, element("span", { class: `swatch of-${name}`, "aria-hidden": "true" }), title),
      element("span", { class: "note" }, words));
  }));
}

/// The slider along the front.
function ways() {
  const all = front();
  by("front").hidden = !all;
  by("no-front").hidden = Boolean(all);
  if (!all) return;
  const slider = by("way");
  slider.max = all.length - 1;
  slider.value = Math.max(0, all.indexOf(move.way));
  chose();
}

function chose() {
  const all = front();
  if (!all) return;
  move.way = all[Number(by("way").value)];
  const words = wayInWords(move.way);
  by("way").setAttribute("aria-valuetext", `${words}, ${move.way.cycles} cycles`);
  write(by("way-name"), words);
  write(by("way-about"), wayAbout(move.way));
  write(by("way-cycles"), grouped(move.way.cycles));
  write(by("way-error"), `${digits(move.way.error)} N·m`);
  const most = Math.log(all.at(-1).cycles);
  const least = Math.log(all[0].cycles);
  const errors = all.map((way) => Math.log(way.error));
  const [low, high] = [Math.min(...errors), Math.max(...errors)];
  const dots = all.map((way, i) => {
    const x = 36 + (250 * (Math.log(way.cycles) - least)) / (most - least || 1);
    const y = 74 - (62 * (Math.log(way.error) - low)) / (high - low || 1);
    const chosenOne = way === move.way;
    return `<circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${chosenOne ? 6 : 3.5}" class="${chosenOne ? "chosen" : "dot"}"/>`;
  });
  by("front-picture").innerHTML = `<text x="4" y="11">error</text><text x="296" y="80" text-anchor="end">cycles</text>${dots.join("")}`;
  code();
}

/// Rust and costs of what is chosen.
function code() {
  write(by("rust"), rust(state.on, move.way));
  const on = Object.fromEntries(EFFECTS.map(({ name }) => [name, state.on[name] && has(name)]));
  const { key, estimates } = state.robot;
  const found = key ? price(on, move.way) : { why: "Costs of a file's robot are not recorded: `cargo xtask import` measures them." };
  write(by("cycles"), found.why ? "not recorded" : grouped(found.cycles));
  write(by("flash"), found.why || found.code === null ? "not recorded" : `${grouped(found.code)} B`);
  const sum = found.added > 0 ? `, the sum of a rigid body's cost and of ${found.added} recorded prices` : "";
  const share = found.why ? "" : ` ${digits(found.cycles / 168, 3)} µs at 168 MHz.`;
  const estimate = estimates?.cycles ? ` The importer estimates ${grouped(estimates.cycles)} cycles and ${grouped(estimates.flash ?? 0)} B.` : "";
  write(by("cost-note"), found.why ? found.why + estimate : `Modelled Cortex-M4F, worst of the recorded states, sines included; from ${found.from.join(" and ")}${sum}.${share}`);
}

/// The errors of f32 and of the way, and the numbers as a table.
function words() {
  const { single, double, parts } = state.computed;
  const error = Math.max(0, ...single.map((x, i) => Math.abs(x - double[i])));
  const scale = Math.max(1e-9, ...double.map(Math.abs));
  write(by("error"), `${digits(error)} N·m`);
  write(by("error-share"), `${digits(error / scale)} of the largest torque`);
  if (front() && move.way) {
    try {
      const { torque, exact } = state.library.call({ op: "way", robot: state.robot.key, key: move.way.key, motion: state.moved });
      write(by("way-now"), `${digits(Math.max(...torque.map((x, i) => Math.abs(x - exact[i]))))} N·m`);
    } catch {
      write(by("way-now"), "not on this page");
    }
  }
  if (by("numbers").open) {
    const heads = ["joint", ...EFFECTS.map(({ title }) => title), "f32", "f64"];
    const rows = state.robot.about.joints.map((joint, i) => [joint.name, ...parts.map((part) => digits(part[i])), digits(single[i], 7), digits(double[i], 7)]);
    by("table").replaceChildren(
      element("thead", {}, element("tr", {}, ...heads.map((head) => element("th", { scope: "col" }, head)))),
      element("tbody", {}, ...rows.map(([name, ...cells]) => element("tr", {}, element("th", { scope: "row" }, name), ...cells.map((cell) => element("td", {}, cell))))),
    );
  }
  by("bars").setAttribute("aria-label", `Torques: ${state.robot.about.joints.map((joint, i) => `${joint.name} ${digits(single[i])}`).join(", ")}. The table below has all numbers.`);
}

/// Draws a frame after so many seconds.
export function frame(seconds) {
  if (state.swinging) state.clock += Math.min(0.1, seconds);
  const computed = compute();
  const all = state.robot.about.joints;
  state.view.place(computed.poses, all.map((joint, i) => (joint.torque ? computed.single[i] / joint.torque : 0)));
  const of = QUANTITIES[move.quantity];
  const now = state.moved[move.quantity];
  // Bars and sliders change in every other frame, because software in place of a graphics processor
  // draws the whole rectangle around everything that changes.
  if (performance.now() - move.shown > 30) {
    move.shown = performance.now();
    move.bars.draw(all.map((joint) => joint.name), computed, move.colour);
    all.forEach((_, i) => {
      if (document.activeElement !== move.inputs[i] || state.swinging) move.inputs[i].value = now[i];
    });
  }
  // Nobody reads faster.
  if (performance.now() - move.text > 100) {
    move.text = performance.now();
    all.forEach((joint, i) => write(move.numbers[i], `${digits(now[i])} ${of.unit(joint)}`));
    words();
  }
}

/// A robot of the repository.
export function select(key) {
  const listed = state.listed.find((robot) => robot.key === key);
  const about = state.library.call({ op: "select", key });
  take({ ...listed, about });
  by("robot").value = key;
}

/// A robot of a file, or the reason why not.
export function load(name, text) {
  const before = state.robot;
  try {
    const found = state.library.call({ op: "import", text });
    take({ key: null, title: found.name, type: found.type, about: found.about, source: found.source, estimates: { cycles: found.cycles, flash: found.flash } });
    const option = by("robot").querySelector("[value='']") ?? by("robot").appendChild(element("option", { value: "" }));
    option.textContent = `${found.name} (your file)`;
    by("robot").value = "";
    say(`${name}: ${found.about.joints.length} joints.`);
    return true;
  } catch (error) {
    // After a trap the library has no robot any more.
    if (before?.key) state.library.call({ op: "select", key: before.key });
    say(`${name}: ${error.message}`, true);
    return false;
  }
}

/// The largest file that is read, bytes: above the importer's own bound.
const MOST_BYTES = 64 << 20;

async function files(list) {
  const [file] = list;
  if (!file) return;
  if (file.size > MOST_BYTES) return say(`${file.name}: ${file.size} bytes are too many.`, true);
  load(file.name, await file.text());
}

export function start() {
  move.bars = new Bars(by("bars"));
  move.colour = colours();
  by("swing").addEventListener("click", () => {
    if (state.swinging) rest();
    else state.swinging = true;
    by("swing").setAttribute("aria-pressed", String(state.swinging));
  });
  by("amount").addEventListener("input", () => (state.amount = Number(by("amount").value)));
  by("home").addEventListener("click", () => {
    rest();
    state.q = posture(state.robot);
    state.qd = state.q.map(() => 0);
    state.qdd = state.q.map(() => 0);
  });
  for (const input of document.querySelectorAll("[name=quantity]")) {
    input.addEventListener("change", () => {
      move.quantity = input.value;
      joints();
    });
  }
  by("way").addEventListener("input", chose);
  by("robot").addEventListener("change", () => by("robot").value && select(by("robot").value));
  by("file").addEventListener("change", () => files(by("file").files));
  by("copy").addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(by("rust").textContent);
      say("Copied.");
    } catch {
      getSelection().selectAllChildren(by("rust"));
      say("Selected: copy it with your keyboard.");
    }
  });
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    files(event.dataTransfer.files);
  });
}
