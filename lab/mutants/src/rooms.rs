//! The parts of the workspace that are changed, and the number of changes of each.

use std::collections::{BTreeMap, BTreeSet};

use crate::site::Site;
use crate::suite::{OPTIMISED, OWN, UNOPTIMISED};

/// A part of the workspace.
pub struct Room {
    pub name: &'static str,
    /// Changes that are drawn, or [`ALL`]; those that do not compile are left out afterwards.
    draws: usize,
    /// The beginnings of its paths; a file belongs to the first room that has one.
    places: &'static [&'static str],
}

const fn room(name: &'static str, draws: usize, places: &'static [&'static str]) -> Room {
    Room {
        name,
        draws,
        places,
    }
}

/// Every change, and every statement among them.
const ALL: usize = usize::MAX;

/// The rooms. What is missing is data (robots, trajectories), what only the target or an emulator runs (`target.rs`,
/// the meter's plugin), and what measures for a report.
#[rustfmt::skip]
pub const ROOMS: [Room; 18] = [
    room("safety", ALL, &["motion-control/src/safety/"]),
    room("motion", ALL, &["motion-control/src/motion/"]),
    room("estimate", ALL, &["motion-control/src/estimate/"]),
    room("control", 90, &["motion-control/src/"]),
    room("control loop and plant", 35, &[
        "drivers/src/control_loop.rs", "firmware-demo/src/plant", "firmware-demo/src/sim_io.rs",
    ]),
    room("drivers", 50, &["drivers/src/"]),
    room("budgets and bars", 30, &["xtask/src/studies/budgets", "xtask/src/kit/bars.rs"]),
    room("tolerances", 20, &["host-tests/src/tolerances.rs", "host-tests/src/measured.rs", "host-tests/src/hard/row.rs"]),
    room("document checks", 30, &["xtask/src/kit/docs.rs", "xtask/src/kit/docs/"]),
    room("other checks", 40, &[
        "xtask/src/kit/callgraph.rs", "xtask/src/kit/sources.rs", "xtask/src/commands/weight.rs", "xtask/src/commands/layers.rs", "xtask/src/kit/same_code.rs",
        "xtask/src/kit/meter.rs", "xtask/src/commands/test/functions.rs", "xtask/src/commands/test/others.rs", "xtask/src/studies/accuracy/join.rs",
    ]),
    room("cycle meter", 45, &[
        "lab/meter/src/block.rs", "lab/meter/src/decode",
        "lab/meter/src/insn.rs", "lab/meter/src/meter.rs",
        "lab/meter/src/model.rs", "lab/meter/src/samples.rs",
    ]),
    room("algorithms", 50, &["dynamics-core/src/algorithms/", "dynamics-core/src/textbook"]),
    room("engine", 35, &["dynamics-core/src/engine/"]),
    room("vectors and states", 40, &[
        "dynamics-core/src/spatial/", "dynamics-core/src/state/", "dynamics-core/src/trig/", "dynamics-core/src/math/",
        "dynamics-core/src/scalar/",
    ]),
    room("model and effects", 50, &["dynamics-core/src/model/", "dynamics-core/src/effects/"]),
    room("loops and clusters", 45, &["dynamics-core/src/loops/", "dynamics-core/src/clusters/"]),
    room("flexible links and drivetrain", 30, &["dynamics-core/src/flexible/", "dynamics-core/src/drivetrain/"]),
    room("integrators", 20, &["dynamics-core/src/sim/"]),
];

/// The room whose code the compiler specialises for each robot, in functions of many thousand operations: with switches
/// at each of them, optimising takes hours, so that its changes have a build of their own that is not optimised.
const NOT_OPTIMISED: &str = "engine";

/// The largest share of a room that one operator may have, in per cent.
const SHARE: usize = 30;

/// The room of a file, if it is in one and holds no tests.
pub fn room_of(file: &str) -> Option<&'static Room> {
    let is_test = file.split(['/', '.']).any(|part| part == "tests");
    let has = |room: &&Room| room.places.iter().any(|place| file.starts_with(place));
    ROOMS
        .iter()
        .find(has)
        .filter(|_| !is_test && file.ends_with(".rs"))
}

/// Whether every change of a file is taken.
pub fn is_whole(file: &str) -> bool {
    room_of(file).is_some_and(|room| room.draws == ALL)
}

/// The build of the changes of a file.
pub fn build_of(file: &str) -> &'static str {
    match room_of(file) {
        Some(room) if room.draws == ALL => OWN,
        Some(room) if room.name == NOT_OPTIMISED => UNOPTIMISED,
        _ => OPTIMISED,
    }
}

/// The sites that are drawn, numbered from 0 by file and place. The order of the draw depends on a site's key alone, so
/// that a change to the code leaves the draw elsewhere as it is.
pub fn drawn(mut sites: Vec<Site>) -> Vec<Site> {
    let mut drawn = Vec::new();
    sites.sort_by_cached_key(|site| (hash(&site.key()), site.line));
    // One reason is for one change: of several with the same words in a function, the first is drawn, or they are numbered.
    let mut keys = BTreeSet::new();
    sites.retain_mut(|site| {
        let words = site.change.clone();
        let mut number = 1;
        while !keys.insert(site.key()) {
            if !is_whole(&site.file) {
                return false;
            }
            number += 1;
            site.change = format!("{words}, place {number}");
        }
        true
    });
    for room in &ROOMS {
        let mut of_operator: BTreeMap<&str, usize> = BTreeMap::new();
        let mut is_drawn = |site: &&Site| {
            let is_here = room_of(&site.file).is_some_and(|of| of.name == room.name);
            let count = of_operator.entry(site.operator).or_default();
            *count += usize::from(is_here);
            is_here && (room.draws == ALL || *count <= (room.draws * SHARE).div_ceil(100))
        };
        let of_room = sites.iter().filter(|site| is_drawn(site));
        drawn.extend(of_room.take(room.draws).cloned());
    }
    drawn.sort_by(|a, b| {
        (&a.file, a.bytes.start, a.bytes.end).cmp(&(&b.file, b.bytes.start, b.bytes.end))
    });
    for (number, site) in drawn.iter_mut().enumerate() {
        site.number = number as u32;
    }
    drawn
}

/// A number that looks random, the same on every machine: FNV-1a from one below its usual beginning, its bits mixed.
fn hash(key: &str) -> u64 {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    let hash = key.bytes().fold(0xcbf2_9ce4_8422_2324, step);
    let mixed = (hash ^ (hash >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    mixed ^ (mixed >> 33)
}
