// The tab "Hard cases": the suite's files, run here in f32 and f64.
import { unpacked } from "./library.js";
import { state } from "./state.js";
import { by, digits, element, write } from "./words.js";

const gallery = { all: null, rows: [] };
const QUANTITIES_OF = ["τ", "M", "q̈ by M", "q̈ by bodies"];

/// Figures that are known to be beyond their bounds, by case, and why: as in README.md and
/// docs/decisions/0002-bars.md.
const KNOWN = {
  87: "Beyond its bound in f32, as is known: at 20,000 rad/s the accelerations that articulated bodies (aba) add are 2·10⁴ m/s², of which f32 keeps seven digits. "
    + "The joints' accelerations by M (forward_dynamics) take a ninth of the bound.",
};

/// The largest of some shares; null is no answer where there should be one.
const worst = (shares) => (shares === null ? undefined : shares.some((x) => x === null) ? Infinity : Math.max(...shares));
const share = (x) => (x === undefined ? "f32 lacks the numbers" : x === Infinity ? "no answer" : digits(x, 2));

export async function openCases() {
  if (gallery.all) return;
  gallery.all = JSON.parse(new TextDecoder().decode(await unpacked("suite")));
  by("cases").replaceChildren(...gallery.all.map((one, i) => {
    const [single, double] = [element("td", {}, "–"), element("td", {}, "–")];
    const button = element("button", { type: "button", "aria-label": `Run case ${one.case}: ${one.title}` }, "Run");
    button.addEventListener("click", () => runCase(i));
    gallery.rows.push({ single, double });
    return element("tr", {}, element("th", { scope: "row" }, `${one.case}. ${one.title}`, element("span", { class: "note" }, one.reason),
      ...(KNOWN[one.case] ? [element("span", { class: "note" }, KNOWN[one.case])] : [])),
      element("td", {}, String(one.robot.links.length)), single, double, element("td", {}, button));
  }));
  write(by("case-count"), `${gallery.all.length} robots, with answers that were computed in 50 digits.`);
}

/// Runs a case and shows its errors as shares of their bounds.
export function runCase(i) {
  const found = state.library.call({ op: "case", case: gallery.all[i] });
  const rows = gallery.rows[i];
  for (const [cell, shares] of [[rows.single, found.f32], [rows.double, found.f64]]) {
    const most = worst(shares);
    const bar = element("span", { class: "meter", "aria-hidden": "true" });
    bar.style.setProperty("--share", String(most === undefined ? 0 : Math.min(1, most)));
    const title = shares?.map((x, k) => `${QUANTITIES_OF[k]} ${share(x === null ? Infinity : x)}`).join(", ");
    cell.replaceChildren(element("span", { title, class: most > 1 ? "beyond" : "" }, share(most)), bar);
  }
  return [worst(found.f32), worst(found.f64)];
}

export function startCases() {
  by("all-cases").addEventListener("click", async () => {
    by("all-cases").disabled = true;
    let within = 0;
    const beyond = [];
    for (let i = 0; i < gallery.all.length; i++) {
      for (const most of runCase(i)) {
        if (most === undefined) continue;
        if (most <= 1) within++;
        else beyond.push(gallery.all[i].case);
      }
      write(by("case-sum"), `${i + 1} of ${gallery.all.length} run: ${within} within their bounds, ${beyond.length} beyond${beyond.length ? `: case ${beyond.join(", ")}` : ""}.`);
      await new Promise((done) => setTimeout(done));
    }
    by("all-cases").disabled = false;
  });
}
