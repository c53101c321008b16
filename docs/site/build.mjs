// Writes the site into target/site: the page to play with, the documentation of the crates, and all pages of docs/.
// node docs/site/build.mjs
import { execFileSync } from "node:child_process";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build as play, root, target } from "../play/build.mjs";

/// The crates that are shipped, each after those that it uses.
export const CRATES = ["dynamics-core", "motion-control", "joint-drivers", "robot-import"];

const cargo = (...words) => execFileSync("cargo", words, { cwd: root, stdio: ["ignore", "inherit", "inherit"] });

/// Returns the folder.
export function build() {
  play();
  const [out, doc] = [join(target, "site"), join(target, "site-reference")];
  // A folder of its own: the one of `cargo doc` has other crates too. One by one, since rustdoc links only to what is written.
  for (const name of CRATES) cargo("doc", "--no-deps", "--quiet", "--target-dir", doc, "--package", name);
  cargo("run", "--quiet", "--package", "site", "--bin", "site", "--", root, out, "--doc", join(doc, "doc"));
  cargo("run", "--quiet", "--package", "site", "--bin", "links", "--", out);
  return out;
}

if (process.argv[1] && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) console.log(join(build(), "index.html"));
