//! The Cortex-M4F's side: CasADi's f32 C and ours in one firmware, under one meter.

use std::path::PathBuf;
use std::process::Command;

use xtask::kit::error::{Result, bail, check};
use xtask::kit::progress::Spinner;
use xtask::kit::rows::{Row as MeasuredRow, run_all};
use xtask::kit::shell;
use xtask::kit::workspace;
use xtask::studies::study::Bench;

use crate::firmware;
use crate::peers::build::{Workshop, words};
use crate::peers::report::{Build, M4F, Row};
use crate::peers::robots::Robot;
use crate::peers::{ALGORITHMS, FORMS, forms};

/// The firmware's bin, and the feature that it is built with.
const BIN: &str = "peers";

/// Largest error relative to full scale of a function that is worth measuring: forward dynamics and
/// Λ⁻¹ are ill-conditioned.
pub fn bound(algorithm: &str) -> f64 {
    match algorithm {
        "aba" | "osim" => 1e-3,
        _ => 1e-5,
    }
}

/// Ways to compile the C: what each is called at the end of its symbols, in the report, the
/// compiler and its flags; of clang those of `.cargo/config.toml` in its words.
const BUILDS: [[&str; 4]; 3] = [
    ["gcc", "gcc", "arm-none-eabi-gcc", "-mcpu=cortex-m4"],
    ["off", "gcc -ffp-contract=off", "arm-none-eabi-gcc", "-mcpu=cortex-m4 -ffp-contract=off"],
    ["clang", "clang", "clang", CLANG],
];
const CLANG: &str = "--target=thumbv7em-none-eabihf -mcpu=cortex-m7 -ffp-contract=off -Xclang \
    -target-feature -Xclang +slowfpvmlx";
const COMMON: &str = "-c -O3 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard";

/// Further flags of a build, with what they add to the symbols: the best of all is the peer. The
/// compiler may know that inputs and output do not overlap, and gcc may leave the order of a
/// function that is one block.
const VARIANTS: [(&str, &str); 4] = [
    ("", ""),
    ("-DRESTRICT=restrict", "_r"),
    ("-fno-schedule-insns", "_n"),
    ("-fno-schedule-insns -DRESTRICT=restrict", "_nr"),
];

/// Compiles the C and the firmwares, and runs them under the meter: one of each robot on a fixed
/// base, and of each function of a free base. Returns the seconds of the builds of those, too.
pub fn measure(
    bench: &Bench<'_>,
    shop: &Workshop<'_>,
    robots: &[Robot],
) -> Result<(Vec<Row>, Vec<Build>)> {
    let (mut found, mut builds) = (Vec::new(), Vec::new());
    for robot in robots.iter().filter(|robot| robot.is_on_target()) {
        let most = if robot.is_free() { 1 } else { ALGORITHMS.len() };
        for algorithms in robot.algorithms().chunks(most) {
            // All builds of a humanoid's forward dynamics are twice as large as the flash.
            let ways = ways();
            let at_once = if robot.is_free() { 3 } else { ways.len() };
            for (image, ways) in ways.chunks(at_once).enumerate() {
                let made = compile(shop, robot, algorithms, ways)?;
                let (rows, seconds) = run(bench, made)?;
                rows.into_iter().for_each(|row| keep(&mut found, row));
                if let ([algorithm], true, 0) = (algorithms, robot.is_free(), image) {
                    builds.push((format!("{}, {algorithm}", robot.name), seconds));
                }
            }
        }
    }
    Ok((found, builds))
}

/// Rows of a firmware with these objects and the table of their functions, and the seconds of
/// processor time of its build, over a library that is built.
fn run(bench: &Bench<'_>, (objects, table): (Vec<PathBuf>, PathBuf)) -> Result<(Vec<Row>, f64)> {
    let spinner = Spinner::start("compiling a firmware of the peers");
    let objects = objects.iter().map(|object| format!("-Clink-arg={}", object.display()));
    let (mut command, elf) = firmware(bench, "rustc", BIN)?;
    command.arg("--").args(objects);
    // The shell says at last what its children took: wall time would depend on what else runs here.
    let mut timed = Command::new("sh");
    timed.args(["-c", r#""$@" && times"#, "sh"]).env("PEERS_TABLE", &table);
    timed.arg(command.get_program()).args(command.get_args());
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => timed.env(name, value),
            None => timed.env_remove(name),
        };
    }
    let seconds = processor_time(&shell::capture(&mut timed)?)?;
    drop(spinner);
    let (measured, lines) = run_all(bench.workspace, bench.tools()?, &[BIN], &[elf])?;
    Ok((rows(measured, &lines)?, seconds))
}

/// The seconds in the last line of a shell's `times`, which is of its children: `1m2.5s 0m0.5s`, of
/// the user and the system.
fn processor_time(said: &str) -> Result<f64> {
    let seconds = |word: &str| {
        let (minutes, seconds) = word.strip_suffix('s')?.split_once('m')?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
    };
    let last = said.lines().last().unwrap_or_default();
    let sum = last.split_whitespace().map(seconds).sum::<Option<f64>>();
    sum.ok_or_else(|| check!("the shell says of its children's time: {last:?}"))
}

/// A way to compile the C: the end of its symbols, the compiler and its flags.
pub struct Way {
    pub mark: String,
    pub compiler: &'static str,
    pub flags: String,
}

fn ways() -> Vec<Way> {
    let variants = |compiler: &str| &VARIANTS[..if compiler == "clang" { 2 } else { 4 }];
    let ways = BUILDS.iter().flat_map(|build| variants(build[2]).iter().map(move |of| (build, of)));
    let ways = ways.map(|(&[build, _, compiler, flags], (more, mark))| Way {
        mark: format!("{build}{mark}"),
        compiler,
        flags: format!("{flags} {COMMON} {more}"),
    });
    ways.collect()
}

/// Objects, and the table of their functions for a program that calls ours of the same.
pub fn compile(
    shop: &Workshop<'_>,
    robot: &Robot,
    algorithms: &[&str],
    ways: &[Way],
) -> Result<(Vec<PathBuf>, PathBuf)> {
    let spinner = Spinner::start("building CasADi's C for the target");
    let (mut objects, mut externs, mut calls) = (Vec::new(), String::new(), String::new());
    let inputs = "_: *const f32, ".repeat(4);
    for algorithm in algorithms {
        let mut peers = String::new();
        let forms = forms(algorithm).iter();
        for ([form, _], way) in forms.flat_map(|form| ways.iter().map(move |way| (form, way))) {
            let Way { mark, compiler, flags } = way;
            let name = format!("{}_{algorithm}{form}_cs_f32", robot.name);
            let (source, symbol) = (shop.code.join(format!("{name}.c")), format!("{name}_{mark}"));
            spinner.say(format!("compiling {symbol}"));
            let peer = format!("-DPEER(name)=name##_{mark}");
            let args: [&[&str]; 2] = [&words(flags), &[&peer]];
            objects.push(shop.make(&format!("{symbol}.o"), compiler, &args, &[&source])?);
            externs += &format!("    fn {symbol}({inputs}_: *mut f32);\n");
            let build = format!("{form}{mark}");
            peers += &format!("Peer {{ build: {build:?}, run: {symbol} }}, ");
        }
        let [bodies, positions, velocities] = robot.size();
        let tip = match *algorithm {
            "osim" => format!(", {}", bodies - 1),
            _ => String::new(),
        };
        let of = format!("{}, {bodies}, {positions}, {velocities}{tip}", robot.type_name());
        calls += &format!("    {algorithm}::<{of}>(&[{peers}]);\n");
    }
    let text = format!("unsafe extern \"C\" {{\n{externs}}}\nfn run() {{\n{calls}}}\n");
    let path = shop.built.join("peers.rs");
    // Written anew each time: cargo then links anew, and does not look at the objects itself.
    workspace::write(&path, text)?;
    Ok((objects, path))
}

/// The form of the algorithm and the way of a build, from the end of its symbols.
pub fn parts(build: &str) -> ([&'static str; 2], &str) {
    let [plain, links] = FORMS;
    build.strip_prefix(links[0]).map_or((plain, build), |way| (links, way))
}

/// The name of a peer whose row is of this build.
fn peer(build: &str) -> String {
    let ([_, author], way) = parts(build);
    let (way, _) = way.split_once('_').unwrap_or((way, ""));
    let flags = BUILDS.iter().find(|build| build[0] == way);
    flags.map_or(build.to_owned(), |[_, flags, ..]| format!("{author} {flags}"))
}

/// The firmware's measurements with its errors in the same order; of all variants of a build the
/// best.
fn rows(measured: Vec<MeasuredRow>, lines: &[String]) -> Result<Vec<Row>> {
    let errors = lines.iter().filter_map(|line| line.strip_prefix("error "));
    let errors: Vec<f64> = errors.map(|error| error.parse().unwrap_or(f64::NAN)).collect();
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
        let row = Row {
            target: M4F,
            peer: peer(&form),
            robot,
            algorithm,
            precision: "f32".into(),
            cycles: Some(cost.cycles.max),
            instructions: Some(cost.instructions.max),
            code_bytes: Some(cost.code_bytes),
            ..Row::default()
        };
        keep(&mut rows, row);
    }
    Ok(rows)
}

/// Adds a row, or keeps the better one of two variants of a build.
fn keep(rows: &mut Vec<Row>, row: Row) {
    let key = |row: &Row| [&row.robot, &row.algorithm, &row.peer].map(String::clone);
    match rows.iter_mut().find(|other| key(other) == key(&row)) {
        Some(other) if other.cycles <= row.cycles => {}
        Some(other) => *other = row,
        None => rows.push(row),
    }
}

#[cfg(test)]
mod tests {
    use super::{peer, processor_time, rows};
    use xtask::kit::rows::Row;

    #[test]
    fn a_function_off_by_more_than_its_bound_is_refused() {
        let measured = || {
            let of = ["ur5e", "aba", "gcc", "full"];
            vec![Row::sample(of, 100)]
        };
        let found = rows(measured(), &["error 0.0009".into()]).expect("a row");
        assert_eq!(found[0].peer, "casadi gcc");
        for error in ["error 0.0011", "error NaN", "no error"] {
            assert!(rows(measured(), &[error.into()]).is_err());
        }
    }

    #[test]
    fn peers_are_named_by_their_build() {
        assert_eq!(peer("core"), "core");
        assert_eq!(peer("off_nr"), "casadi gcc -ffp-contract=off");
        assert_eq!(peer("linksclang"), "casadi links clang");
    }

    #[test]
    fn the_time_of_a_build_is_its_childrens() {
        let said = "built\n0m0.001s 0m0.002s\n1m2.500s 0m0.250s\n";
        assert_eq!(processor_time(said).expect("a time"), 62.75);
        processor_time("62.75").expect_err("another shell");
    }
}
