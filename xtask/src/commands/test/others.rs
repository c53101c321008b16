//! The steps about what is built elsewhere: by the oldest compiler, and as a project of its own.

use std::process::Command;

use super::Context;
use crate::kit::error::{Error, Result};
use crate::kit::workspace::BOARDS;
use crate::kit::{host_bin::SHARED, setup, shell, toolchain};

fn skip<T>(why: impl Into<String>) -> Result<T> {
    Err(Error::Skipped(why.into()))
}

/// The oldest compiler, as the library's manifest promises it.
const MSRV: &str = "1.88.0";

/// The library with the oldest compiler, which rustup installs if it is not there.
pub fn msrv(context: &Context) -> Result<String> {
    let list = shell::capture(Command::new("rustup").args(["toolchain", "list"]));
    let list = list.or_else(|_| skip("there is no rustup"))?;
    if !list.contains(MSRV) && !context.options.no_install {
        let install = "toolchain install --profile minimal --no-self-update".split(' ');
        shell::capture(Command::new("rustup").args(install).arg(MSRV))
            .or_else(|_| skip(format!("{MSRV} is not there")))?;
    }
    let check = "check --package dynamics-core --package motion-control --package joint-drivers \
        --package dynamics-c --package machine-link --all-features --target-dir target/msrv"
        .split(' ');
    let mut cargo = toolchain::rustup(MSRV, "cargo");
    shell::capture(cargo.current_dir(&context.workspace.root).args(check))?;
    Ok(format!("rustc {MSRV}"))
}

/// The target of the projects for a Pico 2; those for other boards have the firmware's.
const PICO_2: &str = "thumbv8m.main-none-eabihf";

/// The guide's programs, and the servo bus on a serial port of Embassy where the target of its chip
/// can be had.
pub fn guide(context: &Context) -> Result<()> {
    // By the profile and in the folder of the boards' images, whose macros are compiled once then.
    let place = format!("--manifest-path {BOARDS} --release --target-dir target/boards");
    let check = |words: &str| format!("clippy {place} {words} -- -D warnings");
    context.cargo(&[check(
        "--package guide-firmware --package nucleo-f446re --package nucleo-g474re --target \
         thumbv7em-none-eabihf",
    )])?;
    if !toolchain::native_has(PICO_2) {
        setup::for_cores(context.options, &[PICO_2], &[])
            .or_else(|_| skip(format!("no {PICO_2}")))?;
    }
    context.cargo(&[check(&format!("--package pico2-embassy --target {PICO_2}"))]).map(drop)
}

/// The projects that `robot-import new` writes: of an arm, two libraries for C in one program, and
/// firmware for each board.
pub fn projects(context: &Context) -> Result<String> {
    if setup::for_projects(context.options).is_err() {
        return skip("there is no arm-none-eabi-gcc, make, cmake or cc");
    }
    let lacks = || !toolchain::native_has(PICO_2);
    // Without it, the boards are left out.
    let _ = lacks().then(|| setup::for_cores(context.options, &[PICO_2], &[]));
    let boards = if lacks() { "" } else { "project::the_boards" };
    context.cargo(&[&format!(
        "test {} --test import -- --ignored --test-threads 1 project::an_arm \
         project::two_robots_in_c project::the_bench {boards}",
        SHARED.words(context.full)
    )])?;
    Ok(boards.to_owned())
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_oldest_compiler_is_the_one_that_the_manifest_promises() {
        let manifest = include_str!("../../../../dynamics-core/Cargo.toml");
        let promised = super::MSRV.trim_end_matches(".0");
        assert!(manifest.contains(&format!("rust-version = \"{promised}\"")));
    }
}
