//! The figures of `docs/boards.md`, for the build scripts of the boards whose `replay` prints them.

use std::{error::Error, fs};

/// The path of the page, from the folder of a board.
const PAGE: &str = "../../docs/boards.md";

/// Makes the number of ticks of the scene `ur5e` and the digest of their torques the environment variables `TICKS` and
/// `DIGEST` of the compiler; returns the page.
///
/// # Errors
/// The page has no line for the scene.
pub fn torques() -> Result<String, Box<dyn Error>> {
    println!("cargo:rerun-if-changed={PAGE}");
    let page = fs::read_to_string(PAGE)?;
    // "- `ur5e`, 6,700 ticks: digest `…`"
    let scene = row(&page, "- `ur5e`, ").ok_or("docs/boards.md has no digest of ur5e")?;
    let digest = scene.rsplit('`').nth(1).ok_or("no digest")?;
    let ticks: String = (scene.split(" ticks").next().unwrap_or_default())
        .chars()
        .filter(char::is_ascii_digit)
        .skip(1) // that of "ur5e"
        .collect();
    println!("cargo:rustc-env=DIGEST={digest}");
    println!("cargo:rustc-env=TICKS={ticks}");
    Ok(page)
}

/// The line of a page that begins with some text.
pub fn row<'a>(page: &'a str, start: &str) -> Option<&'a str> {
    page.lines().find(|line| line.starts_with(start))
}
