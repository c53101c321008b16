// The tab "Hard cases": all cases of docs/hard-cases.md with their recorded errors and the naive
// ways that fail, and those that are files run here, in f32 and f64.
import { unpacked } from "./library.js";
import { state } from "./state.js";
import { by, digits, element, write } from "./words.js";

const gallery = { all: null, rows: null };
const QUANTITIES_OF = ["τ", "M", "q̈ by M", "q̈ by bodies"];

/// A share of a bound with its bar.
function share(most) {
  const bar = element("span", { class: "meter", "aria-hidden": "true" });
  bar.style.setProperty("--share", String(Math.min(1, most)));
  return [element("span", { class: most > 1 ? "beyond" : "" }, most === Infinity ? "no answer" : digits(most, 2)), bar];
}

function row(number, title, [single, double, naive], files) {
  const { further } = state.data.hard;
  const notes = [files[0]?.reason, further.case === number && further.words].filter(Boolean).map((words) => element("span", { class: "note" }, words));
  if (naive) notes.push(element("span", { class: "note naive" }, `fails: ${naive.way}, ${digits(naive.share, 2)} × the bound`));
  const here = element("td", { class: "here" });
  const button = element("button", { type: "button", "aria-label": `Run case ${number}: ${title}` }, "Run");
  button.addEventListener("click", () => files.forEach(({ at }) => runCase(at)));
  here.append(files.length ? button : "–");
  files.forEach(({ at }) => (gallery.rows[at] = { here, files: files.length }));
  const recorded = [single, double].map((most) => element("td", {}, ...(most === undefined ? ["–"] : share(most))));
  return element("tr", {}, element("th", { scope: "row" }, `${number}. ${title}`, ...notes), ...recorded, here);
}

export async function openCases() {
  if (gallery.all) return;
  const { cases, totals } = state.data.hard;
  gallery.all = JSON.parse(new TextDecoder().decode(await unpacked("suite"))).map((one, at) => ({ ...one, at }));
  gallery.rows = [];
  const of = (number) => gallery.all.filter((one) => one.case === number);
  const more = [...new Set(gallery.all.map((one) => one.case))].filter((number) => number > cases.length);
  by("cases").replaceChildren(...cases.map((one) => row(one.case, one.title, [one.f32, one.f64, one.naive], of(one.case))),
    ...more.map((number) => row(number, of(number)[0].title, [], of(number))));
  write(by("case-count"), `${totals} ${more.length} further cases, from ${more[0]} on, are files only.`);
}

/// Runs a file of a case and shows its errors as shares of the bound; returns those that it has, in
/// f32 and f64: null is no answer where there should be one.
export function runCase(i) {
  const found = state.library.call({ op: "case", case: gallery.all[i] });
  const { here, files } = gallery.rows[i];
  if (files === 1 || here.querySelectorAll("p").length >= 2 * files) here.querySelectorAll("p").forEach((line) => line.remove());
  return ["f32", "f64"].map((kind) => {
    const shares = found[kind]?.map((x) => x ?? Infinity);
    const words = shares?.flatMap((x, k) => (x === undefined ? [] : [element("span", { class: x > 1 ? "beyond" : "" }, `${QUANTITIES_OF[k]} ${x === Infinity ? "no answer" : digits(x, 2)}`), " "]));
    here.append(element("p", {}, `${kind}: `, ...(words ?? ["lacks the numbers"])));
    return shares ?? [];
  });
}

export function startCases() {
  by("all-cases").addEventListener("click", async () => {
    by("all-cases").disabled = true;
    let within = 0;
    const beyond = [];
    for (let i = 0; i < gallery.all.length; i++) {
      const [single, double] = runCase(i);
      within += [...single, ...double].filter((x) => x <= 1).length;
      beyond.push(...[...single.entries()].filter(([, x]) => !(x <= 1)).map(([k]) => `${QUANTITIES_OF[k]} of case ${gallery.all[i].case} in f32`));
      beyond.push(...[...double.entries()].filter(([, x]) => !(x <= 1)).map(([k]) => `${QUANTITIES_OF[k]} of case ${gallery.all[i].case} in f64`));
      write(by("case-sum"), `${i + 1} of ${gallery.all.length} files run here: ${within} figures within their bounds, ${beyond.length} beyond${beyond.length ? `: ${beyond.join(", ")}` : ""}.`);
      await new Promise((done) => setTimeout(done));
    }
    by("all-cases").disabled = false;
  });
}
