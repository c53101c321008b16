// The tab "Hard cases": all cases of docs/hard-cases.md with their recorded errors and the naive
// ways that fail, and those that are files run here, in f32 and f64.
import { unpacked } from "./library.js";
import { state } from "./state.js";
import { by, digits, element, write } from "./words.js";

const gallery = { all: null, rows: null };
const QUANTITIES_OF = ["τ", "M", "q̈", "q̈ aba"];

const shareInWords = (x) => (x === Infinity ? "no answer" : digits(x, 2));

/// A share of a bound with its bar.
function share(most) {
  const bar = element("span", { class: "meter", "aria-hidden": "true" });
  bar.style.setProperty("--share", String(Math.min(1, most)));
  return [element("span", { class: most > 1 ? "beyond" : "" }, shareInWords(most)), bar];
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
  const more = [...new Set(gallery.all.map((one) => one.case))].filter((number) => !cases.some((one) => one.case === number));
  by("cases").replaceChildren(...cases.map((one) => row(one.case, one.title, [one.f32, one.f64, one.naive], of(one.case))),
    ...more.map((number) => row(number, of(number)[0].title, [], of(number))));
  write(by("case-count"), `${totals} ${more.length} further cases, from ${more[0]} on, are files only.`);
}

/// Runs a file of a case and shows its errors as shares of the bound, which it returns; infinity is
/// no answer where there should be one.
export function runCase(i) {
  const one = gallery.all[i];
  const found = state.library.call({ op: "case", case: one });
  // A long chain has no answer of M.
  const there = (k) => k !== 1 || one.answers.some(({ M }) => M);
  const { here, files } = gallery.rows[i];
  if (here.childElementCount > 2 * files) here.replaceChildren(here.firstChild);
  for (const kind of ["f32", "f64"]) {
    found[kind] = found[kind]?.map((x, k) => (there(k) ? (x ?? Infinity) : undefined)) ?? [];
    const figures = found[kind].flatMap((x, k) => x !== undefined && [element("span", { class: x > 1 ? "beyond" : "" }, `${QUANTITIES_OF[k]} ${shareInWords(x)}`), " "]).filter(Boolean);
    here.append(element("p", {}, `${kind}: `, ...(figures.length ? figures : ["lacks the numbers"])));
  }
  return found;
}

export function startCases() {
  by("all-cases").addEventListener("click", async () => {
    by("all-cases").disabled = true;
    let within = 0;
    const beyond = [];
    for (const [i, { case: number }] of gallery.all.entries()) {
      for (const [kind, shares] of Object.entries(runCase(i))) {
        within += shares.filter((x) => x <= 1).length;
        beyond.push(...shares.flatMap((x, k) => (x > 1 ? [`${QUANTITIES_OF[k]} of case ${number} in ${kind}`] : [])));
      }
      write(by("case-sum"), `${i + 1} of ${gallery.all.length} files run here: ${within} figures within their bounds, ${beyond.length} beyond${beyond.length ? `: ${beyond.join(", ")}` : ""}.`);
      await new Promise((done) => setTimeout(done));
    }
    by("all-cases").disabled = false;
  });
}
