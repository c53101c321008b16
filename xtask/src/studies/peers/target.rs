//! The Cortex-M4F's side: CasADi's f32 C and ours in one firmware, under one meter.

use std::path::PathBuf;
use std::process::Command;

use crate::kit::error::{Result, bail};
use crate::kit::progress::Spinner;
use crate::kit::rows::{Row as MeasuredRow, run_all};
use crate::kit::setup::Tools;
use crate::kit::shell;
use crate::kit::toolchain::RELEASE;
use crate::kit::workspace::{self, LAB, Workspace};
use crate::studies::peers::ALGORITHMS;
use crate::studies::peers::build::{Workshop, words};
use crate::studies::peers::report::{M4F, Row};
use crate::studies::peers::robots::Robot;

/// The firmware's bin, and the feature that it is built with.
const BIN: &str = "peers";

/// Largest error relative to full scale of a function that is worth measuring: forward dynamics is
/// ill-conditioned.
fn bound(algorithm: &str) -> f64 {
    if algorithm == "aba" { 1e-3 } else { 1e-5 }
}

/// Ways to compile the C: what each is called at the end of its symbols, in the report, the compiler and its flags; of
/// clang those of `.cargo/config.toml` in its words.
const BUILDS: [[&str; 4]; 3] = [
    ["gcc", "casadi gcc", "arm-none-eabi-gcc", "-mcpu=cortex-m4"],
    [
        "off",
        "casadi gcc -ffp-contract=off",
        "arm-none-eabi-gcc",
        "-mcpu=cortex-m4 -ffp-contract=off",
    ],
    ["clang", "casadi clang", "clang", CLANG],
];
const CLANG: &str = "--target=thumbv7em-none-eabihf -mcpu=cortex-m7 -ffp-contract=off -Xclang -target-feature \
    -Xclang +slowfpvmlx";
const COMMON: &str = "-c -O3 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard";

/// Whether the compiler may know that inputs and output do not overlap, with what it adds to the
/// symbols: the better of the two is the peer.
const OVERLAP: [(&str, &str); 2] = [("", ""), ("restrict", "_r")];

/// Compiles the C and the firmware, and runs it under the meter.
pub fn measure(
    workspace: &Workspace,
    shop: &Workshop<'_>,
    tools: &Tools,
    robots: &[Robot],
) -> Result<Vec<Row>> {
    let (objects, table) = compile(shop, robots)?;
    let spinner = Spinner::start("compiling the firmware of the peers");
    let objects = objects
        .iter()
        .map(|object| format!("-Clink-arg={}", object.display()));
    let mut command = tools.toolchain.cargo(workspace, "rustc");
    command
        .args([
            "--package",
            LAB,
            "--release",
            "--features",
            BIN,
            "--bin",
            BIN,
            "--",
        ])
        .args(objects)
        .env("PEERS_TABLE", &table);
    shell::capture(&mut command)?;
    let elf = tools.toolchain.elf(workspace, RELEASE, BIN);
    drop(spinner);
    let (measured, lines) = run_all(workspace, tools, &[BIN], &[elf])?;
    rows(measured, &lines)
}

/// Objects, and the table of their functions for the firmware.
fn compile(shop: &Workshop<'_>, robots: &[Robot]) -> Result<(Vec<PathBuf>, PathBuf)> {
    let spinner = Spinner::start("building CasADi's C for the target");
    let (mut objects, mut externs, mut table) = (Vec::new(), String::new(), String::new());
    let inputs = "_: *const f32, ".repeat(4);
    for robot in robots.iter().filter(|robot| !robot.has_subtree_functions()) {
        let robot = &robot.name;
        for algorithm in ALGORITHMS {
            let name = format!("{robot}_{algorithm}_cs_f32");
            let source = shop.code.join(format!("{name}.c"));
            let builds = BUILDS
                .iter()
                .flat_map(|build| OVERLAP.map(|overlap| (build, overlap)));
            for (&[build, _, compiler, flags], (keyword, mark)) in builds {
                let suffix = format!("{build}{mark}");
                let symbol = format!("{name}_{suffix}");
                spinner.say(format!("compiling {symbol}"));
                let peer = format!("-DPEER(name)=name##_{suffix}");
                let restrict = format!("-DRESTRICT={keyword}");
                let args: [&[&str]; 3] = [&words(flags), &words(COMMON), &[&peer, &restrict]];
                objects.push(shop.make(&format!("{symbol}.o"), compiler, &args, &[&source])?);
                externs += &format!("    fn {symbol}({inputs}_: *mut f32);\n");
                table += &format!(
                    "    Peer {{ robot: {robot:?}, algorithm: {algorithm:?}, build: {build:?}, run: {symbol} }},\n"
                );
            }
        }
    }
    let count = objects.len();
    let text = format!(
        "unsafe extern \"C\" {{\n{externs}}}\nstatic PEERS: [Peer; {count}] = [\n{table}];\n"
    );
    let path = shop.built.join("peers.rs");
    // Written anew each time: cargo then links anew, and does not look at the objects itself.
    workspace::write(&path, text)?;
    Ok((objects, path))
}

/// The firmware's measurements with its errors in the same order; of two forms of a build the better.
fn rows(measured: Vec<MeasuredRow>, lines: &[String]) -> Result<Vec<Row>> {
    let errors = lines.iter().filter_map(|line| line.strip_prefix("error "));
    let errors: Vec<f64> = errors
        .map(|error| error.parse().unwrap_or(f64::NAN))
        .collect();
    if errors.len() != measured.len() {
        bail!("the firmware did not check all that it measured");
    }
    let mut rows: Vec<Row> = Vec::new();
    for (cost, error) in measured.into_iter().zip(errors) {
        let (robot, algorithm, form) = (cost.robot, cost.algorithm, cost.form);
        if error.is_nan() || error > bound(&algorithm) {
            bail!(
                "{algorithm} of {robot} by {form} is off by {error:.1e} of full scale on the target"
            );
        }
        let build = BUILDS.iter().find(|build| build[0] == form);
        let row = Row {
            target: M4F,
            peer: build.map_or(form, |build| build[1].to_owned()),
            robot,
            algorithm,
            precision: "f32".into(),
            cycles: Some(cost.cycles.max),
            instructions: Some(cost.instructions.max),
            code_bytes: Some(cost.code_bytes),
            ..Row::default()
        };
        let key = |row: &Row| [&row.robot, &row.algorithm, &row.peer].map(String::clone);
        match rows.iter_mut().find(|other| key(other) == key(&row)) {
            Some(other) if other.cycles <= row.cycles => {}
            Some(other) => *other = row,
            None => rows.push(row),
        }
    }
    Ok(rows)
}

/// `--version` of the compilers, first lines.
pub fn compilers() -> Vec<String> {
    ["gcc", "clang", "arm-none-eabi-gcc"]
        .iter()
        .filter_map(|program| shell::capture(Command::new(program).arg("--version")).ok())
        .filter_map(|text| text.lines().next().map(str::to_owned))
        .collect()
}
