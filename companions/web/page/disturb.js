// The tab "Disturb me": a scene's plant and control loop at 1 kHz, which the page pushes and
// spoils.
import { minus } from "./camera.js";
import { say, state } from "./state.js";
import { by, colours, digits, element, grouped, inMemory, write } from "./words.js";

const disturb = { key: null, push: null, errors: [], events: [], owed: 0, ticks: 0, worst: 0, colour: null, text: 0 };

/// Newtons for each metre that the pointer is away, and the most, as shares of the arm's size.
const SPRING = 400;
const STRONGEST = 150;
/// The number of ticks that are shown.
const SHOWN = 4000;

export const open = () => {
  if (!state.scenes.has(state.robot.key)) {
    by("scene-robot").value = "ur5e";
  } else {
    by("scene-robot").value = state.robot.key;
  }
  begin(by("scene-robot").value);
};

/// Starts the scene of a robot.
function begin(key) {
  state.library.call({ op: "start", robot: key });
  Object.assign(disturb, { key, push: null, errors: [], events: [], owed: 0, ticks: 0, worst: 0 });
  if (state.robot.key !== key) state.select(key);
  const shown = tick(1);
  state.view.show(state.robot.about, [shown.poses]);
  by("fault-joint").replaceChildren(...state.robot.about.joints.map((joint, i) => element("option", { value: i }, joint.name)));
  by("fault-joint").value = Math.min(2, state.robot.about.joints.length - 1);
  const recorded = state.data.scenes[state.scenes.get(key)];
  write(by("scene-cost"), recorded
    ? `A tick of this loop takes ${grouped(recorded.cycles)} cycles, ${recorded.share} of its period, and ${grouped(recorded.code)} B of code (docs/scenes.md).`
    : "The cost of this scene is not recorded.");
  write(by("events"), "");
}

function tick(ticks) {
  const force = disturb.push ? forceOf(disturb.push) : [0, 0, 0];
  return state.library.call({ op: "tick", by: { ticks, feedforward: by("feedforward").checked, body: disturb.push?.body ?? 0, force } });
}

function forceOf({ body, to }) {
  const pull = minus(to, state.view.point(body)).map((x) => (x * SPRING) / Math.max(0.2, state.view.extent));
  const size = Math.hypot(...pull);
  return size > STRONGEST ? pull.map((x) => (x * STRONGEST) / size) : pull;
}

/// A body is pulled towards a point, or released.
export function pull(body, to) {
  disturb.push = to && { body, to };
}

/// A frame: as many ticks as time has passed.
export function disturbFrame(seconds) {
  disturb.owed = Math.min(100, disturb.owed + seconds * 1000);
  const ticks = Math.floor(disturb.owed);
  if (ticks === 0) return;
  disturb.owed -= ticks;
  const shown = tick(ticks);
  disturb.ticks += shown.errors.length;
  disturb.errors.push(...shown.errors);
  if (disturb.errors.length > SHOWN) disturb.errors.splice(0, disturb.errors.length - SHOWN);
  state.view.place(shown.poses, shown.torque.map((torque, i) => torque / shown.limits[i]));
  for (const [at, mode, fault] of shown.events) disturb.events.unshift(`${(at / 1000).toFixed(3)} s: ${mode}${fault ? `, ${named(fault)}` : ""}`);
  state.shown = shown;
  chart();
  write(by("mode"), shown.mode);
  by("mode").dataset.mode = shown.mode;
  write(by("fault"), shown.fault ? named(shown.fault) : "no fault");
  write(by("brake"), shown.brake ? "holds" : "open");
  if (performance.now() - disturb.text > 150) {
    disturb.text = performance.now();
    const force = disturb.push ? Math.hypot(...forceOf(disturb.push)) : 0;
    write(by("pushed"), `${digits(force)} N`);
    const recent = disturb.errors.slice(-1000);
    write(by("tracking"), `${digits(1000 * Math.max(0, ...recent))} mrad`);
    if (shown.events.length || by("events").childElementCount !== Math.min(8, disturb.events.length)) {
      by("events").replaceChildren(...disturb.events.slice(0, 8).map((text) => element("li", {}, text)));
    }
  }
}

/// A fault with its joint's name in place of the number.
const named = (fault) => fault.replace(/joint (\d+)/, (number, i) => state.robot.about.joints[i]?.name ?? number);

/// The tracking error of the last seconds, on a logarithmic scale.
function chart() {
  const canvas = by("error-chart");
  const width = canvas.parentElement.clientWidth;
  const height = 120;
  const ratio = Math.min(2, devicePixelRatio);
  if (canvas.width !== Math.round(width * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = height * ratio;
  }
  const context = inMemory(canvas);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  const [low, high] = [-2, 3];
  const y = (mrad) => height - 16 - ((Math.log10(Math.max(mrad, 0.01)) - low) / (high - low)) * (height - 26);
  context.font = "12px system-ui, sans-serif";
  context.fillStyle = disturb.colour("muted");
  context.strokeStyle = disturb.colour("track");
  for (let power = low; power <= high; power++) {
    context.beginPath();
    context.moveTo(66, y(10 ** power));
    context.lineTo(width, y(10 ** power));
    context.stroke();
    if (power % 2 === 0) context.fillText(`${10 ** power} mrad`, 0, y(10 ** power) + 4);
  }
  context.strokeStyle = disturb.colour("accent");
  context.lineWidth = 1.5;
  context.beginPath();
  const step = (width - 66) / SHOWN;
  const from = SHOWN - disturb.errors.length;
  // As many points as pixels: each the largest of its ticks.
  const each = Math.max(1, Math.floor(1 / step));
  for (let i = 0; i < disturb.errors.length; i += each) {
    let most = 0;
    for (let j = i; j < Math.min(i + each, disturb.errors.length); j++) most = Math.max(most, disturb.errors[j]);
    context.lineTo(66 + (from + i) * step, y(1000 * most));
  }
  context.stroke();
}

export function startDisturb() {
  disturb.colour = colours();
  by("scene-robot").replaceChildren(...[...state.scenes].map(([key, name]) => element("option", { value: key }, `${state.listed.find((robot) => robot.key === key).title} (scene ${name})`)));
  by("scene-robot").addEventListener("change", () => begin(by("scene-robot").value));
  by("again").addEventListener("click", () => begin(disturb.key));
  for (const button of document.querySelectorAll("[data-inject]")) {
    button.addEventListener("click", () => {
      const ticks = Number(by("fault-ticks").value);
      state.library.call({ op: "inject", what: button.dataset.inject, joint: Number(by("fault-joint").value), ticks });
    });
  }
  by("reset").addEventListener("click", () => {
    try {
      state.library.call({ op: "reset" });
      say("Restarted.");
    } catch (error) {
      say(`No restart: ${error.message}.`, true);
    }
  });
}
