// The tab "Move": joints, effects, torques, the front of accuracy, costs and Rust.
import { Bars, isBeyond } from "./bars.js";
import { CLOCK, drawFront } from "./front.js";
import { MOST_FILES, isRead, meshNames, pathOf, placed, triangles, visuals } from "./meshes.js";
import { everyWay, front, price, wayAbout, wayInWords } from "./recorded.js";
import { rust } from "./rust.js";
import { EFFECTS, chosen, enter, entered, has, motion, posture, range, say, state } from "./state.js";
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
  state.friction = { ...Object.fromEntries(["viscous", "coulomb", "armature"].map((name) => [name, about.joints.map(() => 0)])), width: 0.05, ...about.friction };
  state.load = { mass: about.bodies.reduce((sum, body) => sum + body.mass, 0) < 5 ? 0.2 : 1, at: [0, 0, 0] };
  move.way = front()?.find((way) => way.key === "default") ?? null;
  look();
  joints();
  effects();
  ways();
  code();
}

/// Shows the robot with all that its swing reaches in twenty seconds.
export function look() {
  const { clock } = state;
  const at = (time) => ((state.clock = time), compute().poses);
  state.view.show(state.robot.about, Array.from({ length: 40 }, (_, i) => at(clock + i / 2)), state.robot.meshes);
  at(clock);
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

/// A number that the user enters.
function field(label, value, step, take) {
  const input = element("input", { type: "number", "aria-label": label, min: step > 0 ? 0 : null, step: Math.abs(step), value: Number(value.toPrecision(4)) });
  return changed(input, "input", () => take(Math.min(1e4, Math.max(step > 0 ? 0 : -1e4, Number(input.value)))));
}

function changed(input, event, take) {
  input.addEventListener(event, () => (take(), code()));
  return input;
}

function effects() {
  by("effects").replaceChildren(...EFFECTS.map(({ name, title, about, unit, step }) => {
    const input = element("input", { type: "checkbox", id: `effect-${name}`, checked: state.on[name] });
    const fields = unit ? [field(`${title}, ${unit}`, entered(name), step, (x) => enter(name, x)), unit] : [];
    if (name === "payload") fields.push(" at ", ...["x", "y", "z"].map((axis, i) => field(`Payload, ${axis}, m`, 0, -0.01, (x) => (state.load.at[i] = x))), "m");
    return element("div", { class: "effect" }, changed(input, "change", () => (state.on[name] = input.checked)),
      element("label", { for: `effect-${name}` }, element("span", { class: `swatch of-${name}`, "aria-hidden": "true" }), title),
      element("span", { class: "entered" }, ...fields), element("span", { class: "note" }, about));
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
  by("ways").replaceChildren(...everyWay().map((way) => element("tr", {}, element("th", { scope: "row" }, wayInWords(way)),
    ...[grouped(way.cycles), digits(way.cycles / CLOCK), digits(way.error)].map((cell) => element("td", {}, cell)))));
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
  write(by("way-cycles"), `${grouped(move.way.cycles)}: ${digits(move.way.cycles / CLOCK)} µs`);
  write(by("way-error"), `${digits(move.way.error)} N·m`);
  drawFront(by("front-picture"), all, move.way);
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
  const share = found.why ? "" : ` ${digits(found.cycles / CLOCK)} µs at 168 MHz.`;
  const estimate = estimates?.cycles ? ` The importer estimates ${grouped(estimates.cycles)} cycles and ${grouped(estimates.flash ?? 0)} B.` : "";
  write(by("cost-note"), found.why ? found.why + estimate : `Modelled Cortex-M4F, worst of the recorded states, sines included; from ${found.from.join(" and ")}${sum}.${share}`);
}

/// The errors of f32 and of the way, and the numbers as a table.
function words() {
  const { single, double, parts } = state.computed;
  const error = Math.max(0, ...single.map((x, i) => Math.abs(x - double[i])));
  const beyond = state.robot.about.joints.flatMap(({ name, torque, prismatic }, i) => (isBeyond(single[i], torque) ? `${name} ${digits(Math.abs(single[i]))} of ${digits(torque)} ${prismatic ? "N" : "N·m"}` : []));
  write(by("beyond"), beyond.length ? `Above the limit of torque: ${beyond.join(", ")}.` : "");
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
    move.bars.draw(all, computed, move.colour);
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
    const found = state.library.call({ op: "import", text, date: new Date().toISOString().slice(0, 10) });
    take({ key: null, title: found.name, type: found.type, about: found.about, source: found.source, estimates: { cycles: found.cycles, flash: found.flash }, links: found.links, visuals: visuals(text), named: meshNames(text), files: new Map() });
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

/// Shows the meshes that the file's robot names, of files with their paths.
async function dress(given) {
  const { robot } = state;
  const { visuals: all = [], files: there, about, title } = robot;
  const wanted = [...new Set(all.map(({ file }) => file))];
  const of = (paths) => wanted.map((address) => pathOf(address, paths));
  const paths = given.map(({ path }) => path);
  const chosen = new Set(of([...there.keys(), ...paths]));
  for (const path of [...there.keys()]) if (!chosen.has(path)) there.delete(path);
  try {
    for (const { path, read } of given.filter(({ path }) => chosen.has(path)).slice(0, MOST_FILES)) {
      const file = await read();
      if (file.size > MOST_BYTES) throw new Error(`${file.name}: ${file.size} bytes are too many.`);
      there.delete(path);
      there.set(path, await triangles(file.name, await file.arrayBuffer(), [...there.values()]));
    }
  } catch (error) {
    return say(error.message, true);
  }
  if (given.length && !paths.some((path) => chosen.has(path))) {
    const [path] = paths;
    const isNamed = robot.named?.some((address) => pathOf(address, [path]));
    return say(`${path}: ${isNamed ? `${title} names it where other meshes are drawn.` : `${title} does not name it.`}`, true);
  }
  if (all.length === 0 || state.robot !== robot) return;
  const links = new Map(robot.links.map(([link, ...place]) => [link, place]));
  const found = new Map(wanted.map((address) => [address, there.get(pathOf(address, [...there.keys()]))]));
  robot.meshes = all.filter(({ link, file }) => links.has(link) && found.get(file)).map((one) => placed(found.get(one.file), one, ...links.get(one.link)));
  look();
  const lacking = wanted.filter((address) => !found.get(address));
  const missing = lacking.filter(isRead).map((address) => address.split("/").at(-1));
  const other = [...new Set(lacking.filter((file) => !isRead(file)).map((file) => file.split(".").at(-1).toUpperCase()))];
  say(`${title}: ${about.joints.length} joints, ${robot.meshes.length} of ${all.length} meshes.${missing.length ? ` Drop ${missing.slice(0, 4).join(", ")}${missing[4] ? " …" : ""} too.` : ""}${other.length ? ` Those in ${other.join(" and ")} are not read: STL, OBJ, DAE and GLB are.` : ""}`);
}

/// The largest file that is read, bytes: above the importer's own bound.
const MOST_BYTES = 64 << 20;
/// The most files of folders that are looked at.
const MOST_LISTED = 10_000;

/// A file with its path: that in its folder, or its name.
const loose = (file) => ({ path: file.webkitRelativePath || file.name, read: async () => file });

/// The files of a drop, with those in its folders.
async function dropped(items) {
  // A page from a disk reads files alone.
  const entries = [...items].map((item) => [item.webkitGetAsEntry?.()].find((entry) => entry?.isDirectory) ?? item.getAsFile());
  const found = [];
  while (entries.length && found.length < MOST_LISTED) {
    const entry = entries.shift();
    if (entry?.isDirectory) {
      const reader = entry.createReader();
      for (let some = [null]; some.length; entries.push(...some)) some = await new Promise((done, fail) => reader.readEntries(done, fail));
    } else if (entry) {
      found.push(entry.file ? { path: entry.fullPath.slice(1), read: () => new Promise((done, fail) => entry.file(done, fail)) } : loose(entry));
    }
  }
  return found;
}

/// A robot's file, its meshes, or both.
export async function files(list) {
  try {
    const robots = list.filter(({ path }) => /\.(urdf|xml|mjcf)$/i.test(path) && !/package\.xml$/i.test(path));
    const one = robots.find(({ path }) => /\.urdf$/i.test(path)) ?? robots[0] ?? list.find(({ path }) => !isRead(path) && !path.includes("/"));
    const file = await one?.read();
    if (file?.size > MOST_BYTES) return say(`${file.name}: ${file.size} bytes are too many.`, true);
    if (!file || load(file.name, await file.text())) await dress(list.filter(({ path }) => isRead(path)));
  } catch (error) {
    say(`The files cannot be read: ${error.message}`, true);
  }
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
    state.view.home();
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
  by("file").addEventListener("change", () => files([...by("file").files].map(loose)));
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
  document.addEventListener("drop", async (event) => {
    event.preventDefault();
    files(await dropped(event.dataTransfer.items));
  });
  new ResizeObserver(() => front() && drawFront(by("front-picture"), front(), move.way)).observe(by("front"));
}
