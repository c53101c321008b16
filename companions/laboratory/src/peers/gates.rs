//! CasADi's f32 C and ours on the gates of a RISC-V core, for floating-point units of 0, 1 and 2
//! stages; the core's own counters count both.

use std::path::PathBuf;
use std::time::Duration;

use xtask::kit::error::{Result, refuse_if};
use xtask::kit::progress::Spinner;
use xtask::kit::qemu::Qemu;
use xtask::kit::shell;
use xtask::kit::workspace::Workspace;
use xtask::studies::study::Bench;

use crate::cores::{Core, risc_v, set_up};
use crate::peers::FORMS;
use crate::peers::build::Workshop;
use crate::peers::report::{GATES, Row};
use crate::peers::robots::Robot;
use crate::peers::target::{self, Way};
use crate::peers::ways::{ALGORITHMS, INSIDE, ROBOTS, WAYS};
use crate::rtl::Build;
use crate::rtl::row::{self, Row as Counted, Said};
use crate::rtl::simulator::Simulators;

const BIN: &str = "gates-peers";
/// The time limit of a program in QEMU.
const LIMIT: Duration = Duration::from_secs(300);
const COMPILER: &str = "riscv64-unknown-elf-gcc";
/// Functions begin at words, as ours do in this image and in `gates`.
const COMMON: &str = "-c -march=rv32imfc -mabi=ilp32f -falign-functions=4 -O3 -frename-registers";

/// Whether a product and a sum become one instruction: the end of the symbols and of the names of
/// peers, what says so to the compiler of the C, and how ours is built.
const ARITHMETICS: [(&str, &str, Build); 2] =
    [("fused", "fast", Build::Fused), ("separate", "off", Build::Scheduled)];

/// Runs the C, each robot's in an image, and the images of the study `rtl`.
///
/// # Errors
/// Among others, a result is wrong, or a row is missing.
pub fn measure(bench: &Bench<'_>, shop: &Workshop<'_>, robots: &[Robot]) -> Result<Vec<Row>> {
    let (workspace, options) = (bench.workspace, bench.options);
    let core = risc_v()?;
    set_up(options, &[core], &[])?;
    let simulators = Simulators::find(workspace, options)?;
    let spinner = Spinner::start("compiling a core's source by Verilator");
    simulators.make()?;
    let mut rows = Vec::new();
    for (arithmetic, _, build) in ARITHMETICS {
        spinner.say(format!("compiling ours for the gates: {arithmetic}"));
        let said = simulators.run_all(&build.image(workspace, core)?)?;
        let said: Vec<Said> = said.iter().map(|text| Said::read(text)).collect::<Result<_>>()?;
        rows.extend(ours(&row::joined(&said, build)?, arithmetic));
    }
    drop(spinner);
    for robot in robots.iter().filter(|robot| ROBOTS.contains(&&*robot.name)) {
        let made = target::compile(shop, robot, &ALGORITHMS, &ways())?;
        let _spinner = Spinner::start("counting CasADi's C on the gates");
        let elf = image(workspace, core, made)?;
        let emulated =
            Qemu::first(core.qemu().0)?.text(BIN, &core.machine_arguments(), &elf, LIMIT)?;
        rows.extend(best(&theirs(&emulated, &simulators.run_all(&elf)?)?));
    }
    complete(&rows)?;
    Ok(rows)
}

fn ways() -> Vec<Way> {
    let ways = WAYS.iter().flat_map(|way| ARITHMETICS.map(|arithmetic| (way, arithmetic)));
    let ways = ways.map(|((way, flags), (arithmetic, contract, _))| Way {
        mark: format!("{way}_{arithmetic}"),
        compiler: COMPILER,
        flags: format!("{COMMON} {flags} -ffp-contract={contract}"),
    });
    ways.collect()
}

/// The image with this C and the engine, which checks it.
fn image(
    workspace: &Workspace,
    core: &Core,
    (objects, table): (Vec<PathBuf>, PathBuf),
) -> Result<PathBuf> {
    let (mut command, folder) = Build::Scheduled.cargo("rustc", workspace, core);
    command.args(["--features", "peers", "--bin", BIN, "--"]).env("PEERS_TABLE", table);
    command.args(objects.iter().map(|object| format!("-Clink-arg={}", object.display())));
    shell::capture(&mut command)?;
    Ok(folder.join(BIN))
}

/// What the image printed, if all that it counted is right.
fn read(text: &str) -> Result<Said> {
    let (errors, rows): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|line| line.starts_with("error "));
    let counted: Vec<&&str> = rows.iter().filter(|row| row.starts_with("row ")).collect();
    refuse_if!(counted.len() != errors.len(), "the image did not check all that it counted");
    for (row, error) in counted.iter().zip(&errors) {
        let algorithm = row.split(' ').nth(2).unwrap_or_default();
        let error = error["error ".len()..].parse().unwrap_or(f64::NAN);
        let is_wrong = error.is_nan() || error > target::bound(algorithm);
        refuse_if!(is_wrong, "off by {error:.1e} of full scale on the gates: {row}");
    }
    Said::read(&rows.join("\n"))
}

/// The rows of the C, whose results must have the same bits in QEMU and on each core.
fn theirs(emulated: &str, counted: &[String]) -> Result<Vec<Counted>> {
    let emulated = read(emulated)?;
    let counted: Vec<Said> = counted.iter().map(|text| read(text)).collect::<Result<_>>()?;
    for said in &counted {
        row::same_bits("the core", said, "QEMU's RV32", &emulated)?;
    }
    row::joined(&counted, Build::Scheduled)
}

/// A row for each number of stages.
fn by_stages(
    [robot, algorithm, peer]: [&str; 3],
    found: impl Fn(usize) -> (u64, String),
) -> [Row; 3] {
    std::array::from_fn(|stages| {
        let (cycles, way) = found(stages);
        Row {
            target: GATES[stages],
            robot: robot.to_owned(),
            algorithm: algorithm.to_owned(),
            peer: peer.to_owned(),
            precision: "f32".into(),
            cycles: Some(cycles),
            way,
            ..Row::default()
        }
    })
}

/// The engine's rows of what is compared, and the xArm7's with sines inside.
fn ours(rows: &[Counted], arithmetic: &str) -> Vec<Row> {
    let rows = rows.iter().filter_map(|Counted { name, cycles, .. }| {
        let [robot, algorithm, form, sines] = &name[..] else { return None };
        let algorithm = if algorithm == "forward_dynamics" { "aba" } else { algorithm };
        let inside = match (&**form, &**sines, &**robot, algorithm) {
            ("engine", "outside", ..) => "",
            (_, "inside", "xarm7", "rnea") => INSIDE,
            _ => return None,
        };
        let peer = format!("{form} {arithmetic}{inside}");
        let of = [robot, algorithm, &peer];
        ALGORITHMS.contains(&algorithm).then(|| by_stages(of, |k| (cycles[k], String::new())))
    });
    rows.flatten().collect()
}

/// The better of all ways for each number of stages.
fn best(rows: &[Counted]) -> Vec<Row> {
    let mut found = Vec::new();
    let forms = || FORMS.iter().flat_map(|form| ALGORITHMS.map(|algorithm| (form, algorithm)));
    for (arithmetic, _, _) in ARITHMETICS {
        for (form, algorithm) in forms() {
            let is_its = |row: &&Counted| {
                let (found, way) = target::parts(&row.name[2]);
                row.name[1] == algorithm && found == *form && way.ends_with(arithmetic)
            };
            let of: Vec<&Counted> = rows.iter().filter(is_its).collect();
            let Some(first) = of.first() else { continue };
            let peer = format!("{} {arithmetic}", form[1]);
            found.extend(by_stages([&first.name[0], algorithm, &peer], |stages| {
                let best = of.iter().min_by_key(|row| row.cycles[stages]).unwrap_or(first);
                let (_, way) = target::parts(&best.name[2]);
                let (way, _) = way.split_once('_').unwrap_or((way, ""));
                (best.cycles[stages], way.to_owned())
            }));
        }
    }
    found
}

/// Fails unless every function was counted for each number of stages, ours and the C.
fn complete(rows: &[Row]) -> Result<()> {
    let peers = ["engine", FORMS[0][1], FORMS[1][1]];
    let peers = peers.map(|peer| ARITHMETICS.map(|(a, ..)| format!("{peer} {a}")));
    for (robot, algorithm) in ROBOTS.iter().flat_map(|robot| ALGORITHMS.map(|a| (robot, a))) {
        for peer in peers.as_flattened() {
            let is_its =
                |row: &&Row| (&*row.robot, &*row.algorithm, &row.peer) == (robot, algorithm, peer);
            let count = rows.iter().filter(is_its).count();
            refuse_if!(count != GATES.len(), "{count} rows of {robot} {algorithm} by {peer}");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{ALGORITHMS, GATES, ROBOTS, best, by_stages, complete, theirs};

    const TEXT: &str = "row ur5e rnea p_fused outside 12 10 00ff\nerror 1e-7\n\
                        row ur5e rnea n_fused outside 13 10 00ff\nerror 1e-7\ndone\n";

    #[test]
    fn another_result_of_the_c_is_refused() {
        let other = [TEXT.replace("n_fused outside 13", "n_fused outside 11"), TEXT.to_owned()];
        let rows = best(&theirs(TEXT, &[&other[..], &other[1..]].concat()).expect("the same bits"));
        let found: Vec<_> = rows.iter().map(|row| (row.cycles, &*row.way)).collect();
        assert_eq!(found, [(Some(11), "n"), (Some(12), "p"), (Some(12), "p")]);
        assert_eq!((&*rows[0].peer, rows[2].target), ("casadi fused", GATES[2]));
        for bad in ["error 1e-4", "error NaN", "error -", ""] {
            let text = TEXT.replacen("error 1e-7", bad, 1);
            assert!(theirs(&text, &[]).is_err(), "{bad}");
        }
        theirs(TEXT, &[TEXT.replacen("00ff", "00fe", 1)]).expect_err("another bit");
    }

    #[test]
    fn a_missing_row_is_refused() {
        let names = ROBOTS.iter().flat_map(|robot| ALGORITHMS.map(|a| (robot, a)));
        let rows = names.flat_map(|(robot, algorithm)| {
            let peers = ["engine", "casadi", "casadi links"]
                .map(|peer| ["fused", "separate"].map(|arithmetic| format!("{peer} {arithmetic}")));
            let row = |peer: &String| by_stages([robot, algorithm, peer], |_| (1, String::new()));
            peers.as_flattened().iter().map(row).collect::<Vec<_>>()
        });
        let mut rows: Vec<_> = rows.flatten().collect();
        complete(&rows).expect("all");
        rows.pop();
        complete(&rows).expect_err("one less");
    }
}
