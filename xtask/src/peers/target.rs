//! The Cortex-M4F's side: CasADi's f32 C and ours in one firmware, under one meter.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::Command;

use cycle_meter::{Sample, Summary};

use crate::callgraph::Reach;
use crate::elf::Image;
use crate::error::{Error, Result};
use crate::firmware;
use crate::meter;
use crate::peers::ALGORITHMS;
use crate::peers::build::Workshop;
use crate::peers::report::{M4F, Row};
use crate::peers::robots::Robot;
use crate::qemu::Run;
use crate::setup::Tools;
use crate::shell;
use crate::toolchain::RELEASE;
use crate::workspace::{self, Workspace};

/// The firmware's bin, and the feature that it is built with.
const BIN: &str = "peers";

/// Largest error relative to full scale of a function that is worth measuring: forward dynamics is
/// ill-conditioned.
fn bound(algorithm: &str) -> f64 {
    if algorithm == "aba" { 1e-3 } else { 1e-5 }
}

/// A way to compile the C.
struct Build {
    /// What it is called in the report.
    peer: &'static str,
    /// At the end of its symbols.
    suffix: &'static str,
    compiler: &'static str,
    flags: &'static [&'static str],
}

const BUILDS: [Build; 3] = [
    Build {
        peer: "casadi gcc",
        suffix: "gcc",
        compiler: "arm-none-eabi-gcc",
        flags: &["-mcpu=cortex-m4"],
    },
    Build {
        peer: "casadi gcc -ffp-contract=off",
        suffix: "off",
        compiler: "arm-none-eabi-gcc",
        flags: &["-mcpu=cortex-m4", "-ffp-contract=off"],
    },
    // The flags of `.cargo/config.toml`, in clang's words.
    Build {
        peer: "casadi clang",
        suffix: "clang",
        compiler: "clang",
        flags: &[
            "--target=thumbv7em-none-eabihf",
            "-mcpu=cortex-m7",
            "-ffp-contract=off",
            "-Xclang",
            "-target-feature",
            "-Xclang",
            "+slowfpvmlx",
        ],
    },
];

const COMMON: [&str; 4] = ["-O3", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"];

/// Whether the compiler may know that inputs and output do not overlap, with what it adds to the
/// symbols: the better of the two is the peer.
const OVERLAP: [(&str, &str); 2] = [("", ""), ("restrict", "_r")];

/// Objects that [`measure`] makes.
pub fn steps(robots: &[Robot]) -> usize {
    let small = robots
        .iter()
        .filter(|robot| !robot.has_subtree_functions())
        .count();
    small * ALGORITHMS.len() * BUILDS.len() * OVERLAP.len()
}

/// Compiles the C and the firmware, and runs it under the meter.
pub fn measure(
    workspace: &Workspace,
    shop: &Workshop<'_>,
    tools: &Tools,
    robots: &[Robot],
) -> Result<Vec<Row>> {
    shop.progress.doing("building CasADi's C for the target");
    let (objects, table) = compile(shop, robots)?;
    shop.progress.doing("compiling the firmware");
    let mut command = tools.toolchain.firmware(workspace, "rustc");
    command
        .args(["--release", "--features", BIN, "--bin", BIN, "--"])
        .args(
            objects
                .iter()
                .map(|object| format!("-Clink-arg={}", object.display())),
        )
        .env("PEERS_TABLE", &table);
    shell::capture(&mut command)?;
    let elf = tools.toolchain.elf(workspace, RELEASE, BIN);
    let plugin = firmware::build_meter(workspace)?;
    let regions = shop.built.join("regions.txt");
    shop.progress.doing("running the firmware in QEMU");
    let run = Run {
        name: BIN,
        elf: &elf,
        meter: Some((&plugin, &regions)),
        logs: true,
    };
    let mut lines = Vec::new();
    tools.qemu.run(&run, |line| {
        lines.push(line.to_owned());
        Ok(())
    })?;
    rows(&lines, &meter::read(&regions)?, &Image::read(&elf)?)
}

/// Objects, and the table of their functions for the firmware.
fn compile(shop: &Workshop<'_>, robots: &[Robot]) -> Result<(Vec<PathBuf>, PathBuf)> {
    let (mut objects, mut externs, mut table) = (Vec::new(), String::new(), String::new());
    for robot in robots.iter().filter(|robot| !robot.has_subtree_functions()) {
        for algorithm in ALGORITHMS {
            let name = format!("{}_{algorithm}_cs_f32", robot.name);
            let builds = BUILDS
                .iter()
                .flat_map(|build| OVERLAP.map(|overlap| (build, overlap)));
            for (build, (keyword, mark)) in builds {
                let suffix = format!("{}{mark}", build.suffix);
                let symbol = format!("{name}_{suffix}");
                let object = shop.built.join(format!("{symbol}.o"));
                let source = shop.code.join(format!("{name}.c"));
                let mut command = Command::new(build.compiler);
                command
                    .args(build.flags)
                    .args(COMMON)
                    .arg(format!("-DPEER(name)=name##_{suffix}"))
                    .arg(format!("-DRESTRICT={keyword}"))
                    .arg("-c")
                    .arg(&source)
                    .arg("-o")
                    .arg(&object);
                shop.make(&object, &[&source], &mut command)?;
                objects.push(object);
                // Writing to a string does not fail.
                let _ = writeln!(
                    externs,
                    "    fn {symbol}({}_: *mut f32);",
                    "_: *const f32, ".repeat(4)
                );
                let _ = writeln!(
                    table,
                    "    Peer {{ robot: {:?}, algorithm: {algorithm:?}, build: {:?}, run: {symbol} }},",
                    robot.name, build.peer
                );
            }
        }
    }
    let text = format!(
        "unsafe extern \"C\" {{\n{externs}}}\nstatic PEERS: [Peer; {}] = [\n{table}];\n",
        objects.len()
    );
    let path = shop.built.join("peers.rs");
    // Written anew each time: cargo then links anew, and does not look at the objects itself.
    workspace::write(&path, text)?;
    Ok((objects, path))
}

/// What the firmware said, in the order of the meter's samples; of two forms of a build the better.
fn rows(lines: &[String], samples: &[Sample], image: &Image) -> Result<Vec<Row>> {
    let mut samples = samples.iter();
    let mut rows: Vec<Row> = Vec::new();
    for line in lines {
        let words: Vec<&str> = line.splitn(7, ' ').collect();
        let ["peer", robot, algorithm, states, address, error, peer] = *words.as_slice() else {
            continue;
        };
        let bad = || Error::check(format!("the firmware's line {line:?} cannot be understood"));
        let states: usize = states.parse().map_err(|_| bad())?;
        let address: u64 = address.parse().map_err(|_| bad())?;
        let error: f64 = error.parse().map_err(|_| bad())?;
        if error.is_nan() || error > bound(algorithm) {
            return Err(Error::check(format!(
                "{algorithm} of {robot} by {peer} is off by {error:.1e} of full scale on the target"
            )));
        }
        let mine: Vec<Sample> = samples.by_ref().take(states).copied().collect();
        let worst = |values: Option<Summary>| {
            let short = || Error::check("the cycle meter saw fewer calls than the firmware made");
            values.map(|summary| summary.max).ok_or_else(short)
        };
        let row = Row {
            target: M4F,
            robot: robot.into(),
            algorithm: algorithm.into(),
            peer: peer.into(),
            precision: "f32".into(),
            cycles: Some(worst(Summary::cycles(&mine, 0))?),
            instructions: Some(worst(Summary::instructions(&mine, 0))?),
            code_bytes: Some(code_bytes(image, address)?),
            ..Row::default()
        };
        let key = |row: &Row| [&row.robot, &row.algorithm, &row.peer].map(String::clone);
        match rows.iter_mut().find(|other| key(other) == key(&row)) {
            Some(other) if other.cycles <= row.cycles => {}
            Some(other) => *other = row,
            None => rows.push(row),
        }
    }
    match samples.next() {
        None if !rows.is_empty() => Ok(rows),
        _ => Err(Error::check(
            "the cycle meter saw more calls than the firmware reported",
        )),
    }
}

/// Instructions and literals of the function at an address and of all that it calls.
fn code_bytes(image: &Image, address: u64) -> Result<u64> {
    let function = image
        .functions
        .iter()
        .find(|function| function.address == address);
    let function = function
        .ok_or_else(|| Error::check(format!("the firmware has no function at {address:#x}")))?;
    let reach = Reach::of(image, |f| f.address == function.address)?;
    Ok(reach
        .functions()
        .map(|(function, _)| function.bytes.len() as u64)
        .sum())
}

/// `--version` of the compilers, first lines.
pub fn compilers() -> Vec<String> {
    ["gcc", "clang", "arm-none-eabi-gcc"]
        .iter()
        .filter_map(|program| shell::capture(Command::new(program).arg("--version")).ok())
        .filter_map(|text| text.lines().next().map(str::to_owned))
        .collect()
}
