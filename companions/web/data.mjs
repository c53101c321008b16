// The recorded figures that the page shows: read from the generated pages of docs/, none typed
// here.
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

const number = (text) => {
  const plain = text.replaceAll(",", "").replace("−", "-").replaceAll("*", "").trim();
  return plain === "" || !Number.isFinite(Number(plain)) ? null : Number(plain);
};

/// The rows of all tables of a page, each with the heading above it and the names of its columns.
function rows(text) {
  const found = [];
  let heading = "";
  let columns = null;
  for (const line of text.split("\n")) {
    if (line.startsWith("#")) heading = line.replace(/^#+ /, "");
    if (!line.startsWith("|")) {
      columns = null;
      continue;
    }
    const cells = line.split("|").slice(1, -1).map((cell) => cell.trim());
    if (!columns) columns = cells;
    else if (!/^[-:]+$/.test(cells[0])) found.push({ heading, columns, cells });
  }
  return found;
}

const refuse = (holds, why) => {
  if (!holds) throw new Error(`recorded figures: ${why}`);
};

/// Inverse dynamics of the engine by robot and effects: cycles of the longest state, code in bytes.
function costs(json) {
  const costs = {};
  for (const row of JSON.parse(json).rows) {
    if (row.algorithm !== "rnea" || row.form !== "engine" || !row.trig || !/^(full|bias|gravity|no_coriolis)$/.test(row.inputs)) continue;
    (costs[row.robot] ??= {})[row.inputs] = { cycles: row.cycles, code: row.code_bytes };
  }
  refuse(costs.ur5e?.full?.cycles > 0, "docs/costs.json has no inverse dynamics of the UR5e");
  return costs;
}

/// The costs that each effect adds to those of the rigid body, by robot.
function effects(text) {
  const effects = {};
  for (const { columns, cells } of rows(text)) {
    const name = /^(\w+) (\w+)$/.exec(cells[0]);
    if (!name || columns[0] !== "effect, robot") continue;
    // cycles: core, engine; code: core, engine; torque
    (effects[name[2]] ??= {})[name[1]] = { cycles: number(cells[2]), code: number(cells[4]) };
  }
  refuse(effects.ur5e?.gravity && effects.ur5e.coulomb.cycles > 0, "docs/effects.md has no prices of the UR5e");
  return effects;
}

/// The ticks of the scenes, by name.
function scenes(text) {
  const scenes = {};
  for (const { columns, cells } of rows(text)) {
    const name = /^\*\*(\w+)\*\*$/.exec(cells[0]);
    if (!name || !columns[1]?.startsWith("tick")) continue;
    const [share, code] = ["of its period", "tick's code, B"].map((column) => cells[columns.indexOf(column)]);
    refuse(share?.endsWith("%") && number(code) > 0, `docs/scenes.md has no share or code of ${name[1]}`);
    scenes[name[1]] = { cycles: number(cells[1]), share, code: number(code) };
  }
  refuse(scenes.ur5e?.cycles > 0, "docs/scenes.md has no scene ur5e");
  return scenes;
}

/// The front of each robot, as its picture and README.md have it: the ways that compute in every
/// tick, cheapest first, each much more accurate than the one before, and the default.
function fronts(json, source) {
  const step = Number(/const STEP: f64 = ([\d.]+);/.exec(source)?.[1]);
  refuse(step > 0 && step < 1, "the accuracy page's step cannot be read");
  const fronts = {};
  for (const way of JSON.parse(json)) {
    if (way.kind !== "inverse" || !way.front || way.configuration.rate !== "1") continue;
    (fronts[way.robot] ??= []).push({
      key: way.key.replace(/,?opt=\w+/, "") || "default",
      axes: { trig: way.configuration.trig, model: way.configuration.model, form: way.configuration.form, arith: way.configuration.arith },
      cycles: way.cycles,
      error: way.error_max,
    });
  }
  for (const [robot, front] of Object.entries(fronts)) {
    const steps = [];
    for (const way of front.sort((a, b) => a.cycles - b.cycles)) if (way.key === "default" || !(way.error > step * steps.at(-1)?.error)) steps.push(way);
    fronts[robot] = steps;
  }
  refuse(fronts.ur5e?.length > 3, "docs/accuracy.json has no front of the UR5e");
  return fronts;
}

/// The hard cases of the page and its totals, among which 71 to 94 are left to the suite; the one
/// further figure that the page knows to be beyond its bound.
function hard(page) {
  const totals = /^\d+ cases: \d+ figures within .* shown\.$/m.exec(page)?.[0];
  const row = /^(\d+)\. (.*) \| (\S+) \| (\S+) \| (?:(.*): (\S+))?$/gm;
  const cases = [...page.matchAll(row)].map(([, number, title, single, double, way, times]) => ({
    case: Number(number), title, f32: Number(single), f64: Number(double), naive: way && { way, share: Number(times) },
  }));
  const [, words, number] = /One figure of a further case\s+is beyond its bound, ([^(]*case (\d+)[^(]*) \(\[/.exec(page) ?? [];
  refuse(totals?.startsWith(`${cases.length} cases:`) && cases.every((one, i) => one.case === (i < 70 ? i + 1 : i + 25) && one.f64 >= 0), "docs/hard-cases.md cannot be read");
  refuse(number && cases.every((one) => one.case !== Number(number)), "docs/hard-cases.md has no further case that is beyond its bound");
  return { totals, cases, further: { case: Number(number), words: `Known to be beyond its bound: ${words.replaceAll("`", "")}.` } };
}

/// The names of what a way is along each axis, and the Rust for it.
function names(source) {
  const names = {};
  const row = /\("(\w+)", "(\w+)", (?:None|Some\("([^"]*)"\)), "([^"]*)", "((?:[^"\\]|\\.)*)"\)/g;
  for (const [, axis, value, rust, name, about] of source.matchAll(row)) {
    (names[axis] ??= {})[value] = { rust: rust ?? null, name, about: about.replaceAll('\\"', '"') };
  }
  refuse(names.trig?.table?.rust, "the names of the ways cannot be read");
  return names;
}

/// All that is recorded, from the root of the repository.
export function recorded(root) {
  const read = (path) => readFileSync(join(root, path), "utf8");
  return {
    costs: costs(read("docs/costs.json")),
    effects: effects(read("docs/effects.md")),
    scenes: scenes(read("docs/scenes.md")),
    fronts: fronts(read("docs/accuracy.json"), read("xtask/src/studies/accuracy/page.rs")),
    hard: hard(read("docs/hard-cases.md")),
    names: names(read("xtask/src/studies/accuracy/names.rs")),
  };
}

/// The hard cases: a list of their files, by name; an answer has the fewest digits from which f64,
/// in which errors are measured, reads the same number.
export function cases(root) {
  const folder = join(root, "companions/hard-case-suite/cases");
  const files = readdirSync(folder).filter((name) => name.endsWith(".json")).sort();
  const shorter = (whole, digits) => {
    const short = String(Number(digits));
    refuse(Number.isFinite(Number(digits)), `${digits} of a case is no number`);
    return `"${short}"`;
  };
  const texts = files.map((name) => readFileSync(join(folder, name), "utf8").replace(/"(-?[0-9][0-9.e+-]{20,})"/gi, shorter));
  return `[${texts.join(",\n")}]`;
}
