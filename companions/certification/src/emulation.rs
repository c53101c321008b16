//! The program's functions in QEMU, at states of the box: their cycles by the meter, and the bits
//! of their results.

use std::process::{Command, Stdio};

use cycle_meter::Sample;
use fastrand::Rng;
use object::{Object, ObjectSection};

use crate::error::{Error, Result};
use crate::image::Image;
use crate::program::{self, Program};
use crate::sines;
use crate::state_box::Robot;

const QEMU: &str = "qemu-system-arm";
/// As `cargo xtask costs` starts it.
const OPTIONS: &str = "-machine netduinoplus2 -nographic -audiodev none,id=silent -monitor none -serial none \
                       -icount shift=3,sleep=off -semihosting-config enable=on,target=native";

/// The observations of a program that ran in the emulator.
#[derive(Clone, Debug)]
pub struct Emulation {
    /// The states: q, q̇, q̈ of each, numbers of f32.
    pub states: Vec<Vec<f64>>,
    /// For each call, the function's name, its cost and the bits of its results.
    calls: Vec<(String, Sample, Vec<u32>)>,
}

impl Emulation {
    /// Combines the lines that a program printed, one for each call, with the costs of its calls;
    /// `None` if there are none or their numbers differ.
    pub fn read(states: Vec<Vec<f64>>, said: &str, samples: Vec<Sample>) -> Option<Self> {
        let is_whole = !samples.is_empty() && samples.len() == said.lines().count();
        let calls = said.lines().zip(samples).map(|(line, sample)| call(line, sample));
        is_whole.then(|| Self { states, calls: calls.collect() })
    }

    /// The cost of each call of a function, and the bits of its results, in the order of the
    /// states.
    pub fn of<'a>(&'a self, function: &'a str) -> impl Iterator<Item = (Sample, &'a [u32])> {
        let mine = self.calls.iter().filter(move |call| call.0 == function);
        mine.map(|call| (call.1, &*call.2))
    }
}

/// Runs a program at random states of a robot's box.
///
/// # Errors
/// [`Error::Program`] if there is no QEMU that takes the meter, [`Error::Missing`] if the program
/// is not one that runs.
pub fn run(program: &Program, robot: &Robot) -> Result<Emulation> {
    let image = Image::read(&program.elf)?;
    let n = robot.joints.len();
    let (at, words) = image.variable("CERTIFIED_STATES")?;
    let trigs = image.variable("CERTIFIED_TRIGS")?.0;
    let states = draw(robot, words.len() / (3 * n));
    let mut words = Vec::new();
    for (k, state) in (0..).zip(&states) {
        let of_state = (at + 12 * k * n as u32..).step_by(4);
        words.extend(of_state.zip(state).map(|(at, x)| (at, *x as f32)));
        for (i, joint) in robot.joints.iter().enumerate() {
            let [stride, sine, cosine, position] = robot.trig;
            let at = trigs + stride * (k * n as u32 + i as u32);
            let q = state[i] as f32;
            // The coordinate of a joint that slides has no angle.
            let (s, c) = if joint.turns { sines::pair(joint, q) } else { (0.0, 1.0) };
            words.extend([(at + sine, s), (at + cosine, c), (at + position, q)]);
        }
    }
    let folder = tempfile::tempdir()
        .map_err(|source| Error::File { path: "a temporary folder".into(), source })?;
    let (elf, regions) = (folder.path().join("program"), folder.path().join("regions"));
    let written = patched(&program.elf, &words)?;
    std::fs::write(&elf, written).map_err(|source| Error::File { path: elf.clone(), source })?;
    let meter = program::meter()?;
    let mut command = Command::new(QEMU);
    command.args(OPTIONS.split_whitespace()).arg("-plugin");
    command.arg(format!("{},out={}", meter.display(), regions.display()));
    command.arg("-kernel").arg(&elf).stdin(Stdio::null());
    let said = program::capture(&mut command)?;
    let failed = |said: String| Error::Program { program: QEMU.to_owned(), said };
    let samples = std::fs::read_to_string(&regions).map_err(|e| failed(e.to_string()))?;
    let samples = cycle_meter::parse_samples(&samples).map_err(|e| failed(e.to_string()))?;
    let other = || failed("it printed another number of calls than it made".to_owned());
    Emulation::read(states, &said, samples).ok_or_else(other)
}

/// A line of the program: a name and words in hexadecimal.
fn call(line: &str, sample: Sample) -> (String, Sample, Vec<u32>) {
    let mut words = line
        .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty());
    let name = words.next().unwrap_or_default().to_owned();
    let bits = words.filter_map(|word| u32::from_str_radix(word, 16).ok());
    (name, sample, bits.collect())
}

/// Random states: positions within the joints' ranges, speeds and accelerations within theirs.
fn draw(robot: &Robot, states: usize) -> Vec<Vec<f64>> {
    let mut rng = Rng::with_seed(1);
    let mut number = |low: f64, high: f64| f64::from((low + rng.f64() * (high - low)) as f32);
    let mut state = || {
        let joints = &robot.joints;
        let mut state: Vec<f64> = Vec::new();
        state.extend(joints.iter().map(|one| number(one.position.low, one.position.high)));
        state.extend(joints.iter().map(|one| number(-one.speed, one.speed)));
        state.extend(joints.iter().map(|one| number(-one.acceleration, one.acceleration)));
        state
    };
    (0..states).map(|_| state()).collect()
}

/// A program with other numbers at some addresses.
fn patched(elf: &[u8], words: &[(u32, f32)]) -> Result<Vec<u8>> {
    let file = object::File::parse(elf).map_err(|e| Error::Elf(e.to_string()))?;
    let mut bytes = elf.to_vec();
    for (at, word) in words {
        let place = file.sections().find_map(|section| {
            let (start, size) = section.file_range()?;
            let within = u64::from(*at).checked_sub(section.address())?;
            (within + 4 <= size).then_some((start + within) as usize)
        });
        let place = place.and_then(|place| bytes.get_mut(place..place + 4));
        let place = place.ok_or_else(|| Error::Missing(format!("number at {at:#x}")))?;
        place.copy_from_slice(&word.to_bits().to_le_bytes());
    }
    Ok(bytes)
}
