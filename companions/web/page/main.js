// Starts the page, and runs it frame by frame.
import { Library, unpacked } from "./library.js";
import { Gl } from "./gl.js";
import { Soft } from "./soft.js";
import { View } from "./view.js";
import { say, state } from "./state.js";
import { by, element } from "./words.js";
import { files, frame, load, look, reach, select, start } from "./move.js";
import { disturbFrame, open, pull, startDisturb } from "./disturb.js";
import { openCases, runCase, startCases } from "./cases.js";

const TABS = ["move", "disturb", "hard"];

function show(tab) {
  const before = state.tab;
  state.tab = tab;
  document.body.dataset.tab = tab;
  say("");
  for (const name of TABS) {
    const chosenTab = name === tab;
    by(`tab-${name}`).setAttribute("aria-selected", String(chosenTab));
    by(`tab-${name}`).tabIndex = chosenTab ? 0 : -1;
    by(`panel-${name}`).hidden = !chosenTab;
  }
  if (tab === "disturb") open();
  if (tab === "hard") openCases();
  if (before === "disturb" && tab === "move") look();
}

function tabs() {
  TABS.forEach((name, i) => {
    by(`tab-${name}`).addEventListener("click", () => show(name));
    by(`tab-${name}`).addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!way) return;
      const next = TABS[(i + way + TABS.length) % TABS.length];
      show(next);
      by(`tab-${next}`).focus();
    });
  });
}

/// The times that a test reads: the work of each frame, ms, and the moments.
const times = { work: [], frames: [], firstTorque: null };

/// Draws a frame after so many seconds, and returns its work, ms.
function step(seconds) {
  const begin = performance.now();
  if (state.tab === "move") frame(seconds);
  else if (state.tab === "disturb") disturbFrame(seconds);
  if (state.tab !== "hard") state.view.render();
  times.firstTorque ??= performance.now();
  return performance.now() - begin;
}

function loop(before) {
  requestAnimationFrame((now) => {
    if (!times.measuring) {
      const interval = Math.max(0, now - before);
      if (state.tab !== "hard") state.view.adapt(interval);
      times.work.push(step(interval / 1000));
      times.frames.push(now);
      if (times.work.length > 600) {
        times.work.shift();
        times.frames.shift();
      }
    }
    loop(now);
  });
}

/// The work of so many frames of a sixtieth of a second, whichever rate the screen has, ms.
async function work(count) {
  const before = times.measuring;
  times.measuring = true;
  const all = [];
  for (let i = 0; i < count; i++) {
    all.push(step(1 / 60));
    await new Promise((done) => setTimeout(done));
  }
  times.measuring = before;
  return all;
}

async function main() {
  state.data = JSON.parse(by("recorded").textContent);
  state.library = await Library.load(await unpacked("library"));
  const { robots, scenes } = state.library.call({ op: "robots" });
  state.listed = robots;
  state.scenes = new Map(scenes);
  state.select = select;
  by("robot").append(...robots.map(({ key, title }) => element("option", { value: key }, title)));
  state.view = new View(by("view"), (body, to) => {
    if (state.tab === "disturb") pull(body, to);
    else if (state.tab === "move") reach(body, to);
  });
  tabs();
  start();
  startDisturb();
  startCases();
  state.swinging = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  by("swing").setAttribute("aria-pressed", String(state.swinging));
  select("ur5e");
  document.body.dataset.ready = "";
  loop(performance.now());
}

// For the tests, and for whoever opens the console.
globalThis.play = { state, times, work, files, load, select, reach, pull, runCase, show, cases: () => gallery.all, disturb, Gl, Soft };
main().catch((error) => {
  by("said").hidden = false;
  by("said").classList.add("wrong");
  by("said").textContent = `This page needs a browser with WebAssembly and DecompressionStream (${error.message}).`;
});
