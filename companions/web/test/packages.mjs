// The packages of npm that the test uses, fetched into the target folder once, at these versions.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { target } from "../build.mjs";

const PACKAGES = { "axe-core": "4.14.1", "puppeteer-core": "25.16.0" };

/// Fetches what is missing; returns where a package's file is.
export function packages() {
  const folder = join(target, "npm");
  mkdirSync(folder, { recursive: true });
  const present = ([name, version]) => {
    const file = join(folder, "node_modules", name, "package.json");
    return existsSync(file) && JSON.parse(readFileSync(file, "utf8")).version === version;
  };
  const missing = Object.entries(PACKAGES).filter((one) => !present(one));
  if (missing.length > 0) {
    writeFileSync(join(folder, "package.json"), JSON.stringify({ private: true, dependencies: PACKAGES }));
    execFileSync("npm", ["install", "--no-package-lock", "--no-audit", "--no-fund", "--ignore-scripts", "--silent"], { cwd: folder, stdio: ["ignore", "inherit", "inherit"] });
  }
  return createRequire(join(folder, "package.json"));
}
