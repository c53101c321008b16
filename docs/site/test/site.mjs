// Builds the site, opens its pages in headless Chromium and holds them to its checks; each check fails on a planted defect.
// node docs/site/test/site.mjs [--built]
import { execFileSync } from "node:child_process";
import { appendFileSync, cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { root, target } from "../../play/build.mjs";
import { accessible, excess, narrow } from "../../play/test/bars.mjs";
import { packages } from "../../play/test/packages.mjs";
import { build } from "../build.mjs";

const must = (holds, words) => {
  if (!holds) throw new Error(words);
};
const require = packages();
const puppeteer = require("puppeteer-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
const pictures = join(target, "site-pictures");
mkdirSync(pictures, { recursive: true });

const DESKTOP = { width: 1400, height: 900 };
const PHONE = { width: 360, height: 740, isMobile: true, hasTouch: true, deviceScaleFactor: 2 };
/// Written by others' programs: rustdoc's pages, and the page to play with, whose own test opens it.
const OTHERS = ["reference", "play"];

/// The pages that are this site's own.
function pages(site) {
  const all = readdirSync(site, { recursive: true }).filter((file) => file.endsWith(".html"));
  return all.filter((file) => !OTHERS.includes(file.split("/")[0]) || file === "reference/index.html").sort();
}

/// A page with what it asked for and what went wrong on it.
async function opened(browser, file, { screen = DESKTOP, dark = false, still = true } = {}) {
  const page = await browser.newPage();
  const [problems, requests] = [[], []];
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  page.on("request", (request) => requests.push(request.url()));
  page.on("requestfailed", (request) => problems.push(`${request.url()}: ${request.failure()?.errorText}`));
  await page.setViewport(screen);
  const features = { "prefers-color-scheme": dark ? "dark" : "light", "prefers-reduced-motion": still ? "reduce" : "no-preference" };
  await page.emulateMediaFeatures(Object.entries(features).map(([name, value]) => ({ name, value })));
  await page.goto(pathToFileURL(file).href);
  return { page, problems, requests };
}

/// What a page's text says of itself: its links, and the names that a link can lead to.
const facts = (page) =>
  page.evaluate(() => ({
    links: [...document.querySelectorAll("a[href]")].map((link) => link.href),
    names: [...document.querySelectorAll("[id]")].map((one) => one.id),
    lost: [...document.images].filter((image) => !image.complete || image.naturalWidth === 0).map((image) => image.src),
    images: document.images.length,
  }));

/// Opens pages of a site at the width of a phone and returns what does not hold, with the numbers of what does.
async function faults(browser, site, names = pages(site)) {
  const found = new Map();
  const wrong = [];
  const count = { pages: 0, links: 0, pictures: 0 };
  for (const name of names) {
    const { page, problems, requests } = await opened(browser, join(site, name), { screen: PHONE });
    const one = { ...(await facts(page)), excess: await excess(page) };
    await page.close();
    found.set(name, one);
    count.pages += 1;
    count.pictures += one.images;
    wrong.push(...problems.map((what) => `error: ${name}: ${what}`));
    wrong.push(...one.lost.map((src) => `picture: ${name}: ${src} is not shown`));
    const inside = (url) => url.startsWith("data:") || (url.startsWith("file:") && !relative(site, fileURLToPath(url)).startsWith(".."));
    wrong.push(...requests.filter((url) => !inside(url)).map((url) => `request: ${name}: ${url}`));
    try {
      narrow(one.excess, name);
    } catch (error) {
      wrong.push(`wide: ${error.message}`);
    }
  }
  for (const [name, { links }] of found) {
    for (const link of links) {
      const url = new URL(link);
      if (url.protocol !== "file:") continue;
      count.links += 1;
      const anchor = decodeURIComponent(url.hash.slice(1));
      url.hash = "";
      const path = fileURLToPath(url);
      const there = relative(site, path);
      if (there.startsWith("..") || !/\.\w+$/.test(path) || !existsSync(path)) wrong.push(`link: ${name}: ${there} does not exist`);
      else if (anchor && found.has(there) && !found.get(there).names.includes(anchor)) wrong.push(`link: ${name}: ${there} has no #${anchor}`);
    }
  }
  return { wrong, count };
}

/// axe on a page of each kind, by light and by dark, with pictures.
async function views(browser, site) {
  const shown = ["index.html", "guide/first-torque.html", "guide/index.html", "reports/accuracy.html", "reports/index.html"];
  let runs = 0;
  for (const name of shown) {
    for (const [size, screen] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
      for (const dark of [false, true]) {
        const theme = dark ? "dark" : "light";
        const { page } = await opened(browser, join(site, name), { screen, dark });
        await page.evaluate(axe);
        const { violations } = await page.evaluate(() => globalThis.axe.run(document));
        accessible(violations, `${name}, ${theme}, ${size}`);
        await page.screenshot({ path: join(pictures, `${name.replaceAll("/", "-").replace(".html", "")}-${theme}-${size}.png`), fullPage: name === "index.html" });
        await page.close();
        runs++;
      }
    }
  }
  return runs;
}

/// The film moves, and stands still where one asked for less motion: pictures of it at five times.
async function film(browser) {
  const frames = async (still) => {
    const { page } = await opened(browser, join(root, "docs/film.svg"), { screen: { width: 640, height: 540 }, still });
    const found = [];
    for (const second of [0, 2, 5, 7, 9]) {
      await page.evaluate((second) => document.getAnimations().forEach((one) => ((one.currentTime = second * 1000), one.pause())), second);
      found.push(Buffer.from(await page.screenshot()).toString("base64"));
      if (!still) writeFileSync(join(pictures, `film-${second}.png`), Buffer.from(found.at(-1), "base64"));
    }
    await page.close();
    return new Set(found).size;
  };
  const [moving, still] = [await frames(false), await frames(true)];
  must(moving === 5 && still === 1, `the film has ${moving} of 5 frames, ${still} with reduced motion`);
}

const replaced = (file, from, to) => {
  const text = readFileSync(file, "utf8");
  must(text.includes(from), `${file} has no ${from}`);
  writeFileSync(file, text.replace(from, to));
};

const DEFECTS = [
  ["link", "guide/first-torque.html", (_, file) => replaced(file, 'href="../guide/index.html"', 'href="../guide/indx.html"')],
  ["link", "guide/faq.html", (_, file) => appendFileSync(file, '<p><a href="tuning.html#no-such-heading">x</a></p>')],
  ["picture", "reports/costs.html", (copy) => rmSync(join(copy, "reports/costs.svg"))],
  ["error", "reports/scenes.html", (_, file) => appendFileSync(file, "<script>console.error('planted')</script>")],
  ["request", "index.html", (_, file) => appendFileSync(file, `<script src="${pathToFileURL(join(root, "docs/play/page/words.js")).href}"></script>`)],
  ["wide", "guide/glossary.html", (_, file) => appendFileSync(file, '<p style="width: 900px">wide</p>')],
];

/// A copy of the site with all defects: each must be found, as one of its kind and on its page.
async function planted(browser, site) {
  const copy = join(target, "site-planted");
  rmSync(copy, { recursive: true, force: true });
  cpSync(site, copy, { recursive: true });
  for (const [, name, defect] of DEFECTS) defect(copy, join(copy, name));
  // The anchor that is missing is one of the last page.
  const { wrong } = await faults(browser, copy, [...DEFECTS.map(([, name]) => name), "guide/tuning.html"]);
  for (const [kind, name] of DEFECTS) {
    const found = wrong.some((one) => one.startsWith(`${kind}: `) && one.includes(name));
    must(found, `the check "${kind}" does not find a defect of ${name}; found: ${wrong.join(" | ") || "nothing"}`);
  }
  rmSync(copy, { recursive: true });
}

/// axe finds a contrast that is too low.
async function seen(browser, site) {
  const { page } = await opened(browser, join(site, "index.html"));
  await page.addStyleTag({ content: "main p { color: #ccc !important }" });
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document));
  must(violations.some(({ id }) => id === "color-contrast"), "axe does not find a contrast that is too low");
  await page.close();
}

async function main() {
  const site = process.argv.includes("--built") ? join(target, "site") : build();
  const executablePath = process.env.CHROMIUM ?? execFileSync("sh", ["-c", "command -v chromium || command -v chromium-browser || command -v google-chrome"], { encoding: "utf8" }).trim();
  const browser = await puppeteer.launch({ executablePath, args: ["--no-sandbox", "--allow-file-access-from-files"] });
  try {
    for (const name of ["play", ...["dynamics_core", "motion_control", "joint_drivers", "robot_import"].map((crate) => `reference/${crate}`)])
      must(existsSync(join(site, name, "index.html")), `there is no ${name}/index.html`);
    const { wrong, count } = await faults(browser, site);
    must(wrong.length === 0, `${wrong.length} faults:\n${wrong.join("\n")}`);
    must(count.pages > 60 && count.links > 2_000 && count.pictures > 20, `too little was checked: ${JSON.stringify(count)}`);
    const runs = await views(browser, site);
    await film(browser);
    await planted(browser, site);
    await seen(browser, site);
    console.log(`${count.pages} pages, ${count.links} links, ${count.pictures} pictures; axe finds nothing in ${runs} views; ${DEFECTS.length + 1} planted defects are found`);
  } finally {
    await browser.close();
  }
}
await main();
