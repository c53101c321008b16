//! A machine in states: the very same numbers in f32, in f64 and in the oracle's fifty digits.

use std::path::PathBuf;

use dynamics_core::loops::{LoopError, Loops, Moving, Stabilisation, assemble, forward_dynamics};
use dynamics_core::model::{Model, RobotModel};
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};
use fixtures::hard::GRAVITY;
use fixtures::hard::loops::{LoopProblem, scene};
use host_tests::export::{Robot, robot};
use host_tests::hard::Row;
use serde::{Deserialize, Serialize};

use super::outcome::{Outcome, demands, rows};
use crate::export::{Loop, loops};

/// A machine, and the states at which it is evaluated.
#[derive(Clone, Debug)]
pub struct Setup<
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
> {
    pub case: u32,
    /// Its name within the case.
    pub name: &'static str,
    /// In f64.
    pub tree: Model<f64, B, Q, V>,
    /// In f32.
    pub single: Model<f32, B, Q, V>,
    /// The joints that close it, and its motors.
    pub loops: Loops<L, C, A>,
    /// The coordinates that are given: the others follow.
    pub held: &'static [usize],
    /// The coordinates that assembly moves.
    pub moving: Moving,
    /// q, q̇ and q̈ of the coordinates that are held, and a guess of the others.
    pub starts: Vec<State<f64, Q, V>>,
}

/// A planar linkage, and what it is driven by.
pub type Planar<const N: usize, const A: usize> = Setup<N, N, N, 1, 5, A>;

#[derive(Clone, Debug, Deserialize)]
pub struct Truth {
    name: String,
    inputs: String,
    pub states: Vec<TrueState>,
}

/// The oracle's results for one state.
#[derive(Clone, Debug, Deserialize)]
pub struct TrueState {
    /// Positions with closed loops.
    pub q: Vec<f64>,
    /// Velocities with closed loops.
    pub qd: Vec<f64>,
    /// Accelerations with closed loops.
    pub qdd: Vec<f64>,
    /// The motors' torques; none where they do not determine the motion.
    pub tau: Option<Vec<f64>>,
    /// The torques of forward dynamics, exactly representable in f32.
    pub given: Vec<f64>,
    pub forward: Vec<f64>,
}

/// A problem as `oracle/loops_precise.py` reads it.
#[derive(Clone, Debug, Serialize)]
pub struct Exported {
    pub(super) case: u32,
    pub(super) name: String,
    pub(super) inputs: String,
    pub(super) robot: Robot,
    pub(super) loops: Vec<Loop>,
    /// Each coordinate's polynomials of the independent ones, instead of loops.
    pub(super) gamma: Vec<Vec<Vec<f64>>>,
    pub(super) actuated: Vec<usize>,
    pub(super) held: Vec<usize>,
    pub(super) gravity: [f64; 3],
    pub(super) states: Vec<Start>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Start {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
}

impl Start {
    pub fn of<const Q: usize, const V: usize>(state: &State<f64, Q, V>) -> Self {
        let State { q, qd, qdd } = state;
        Self { q: q.to_vec(), qd: qd.to_vec(), qdd: qdd.to_vec() }
    }
}

/// Weight as the scene has it.
pub(super) const WEIGHT: [f64; 3] = [0.0, 0.0, -GRAVITY];

impl Exported {
    /// The same with a digest of all of it (FNV-1a): whether a recording is of these inputs.
    pub(super) fn digested(mut self) -> Self {
        let text = serde_json::to_string(&self).expect("plain data");
        let digest = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        self.inputs = format!("{digest:016x}");
        self
    }

    /// The oracle's results for this problem.
    pub(super) fn truth(&self) -> Truth {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        let path = root.join(format!("../recordings/hard/loops/{}.json", self.case));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        let all: Vec<Truth> = serde_json::from_str(&text).expect("the oracle writes JSON");
        let truth = all.into_iter().find(|truth| truth.name == self.name);
        let truth = truth.unwrap_or_else(|| panic!("{path:?} lacks {:?}", self.name));
        assert_eq!(
            truth.inputs, self.inputs,
            "{path:?} is of other inputs: run oracle/loops_precise.py"
        );
        truth
    }
}

impl TrueState {
    /// The state with closed loops, rounded.
    pub fn state<R: Real, const Q: usize, const V: usize>(&self) -> State<R, Q, V> {
        State { q: rounded(&self.q), qd: rounded(&self.qd), qdd: rounded(&self.qdd) }
    }
}

/// Inverse dynamics as it is by default, where it is damped.
const DAMPED: &str = "damped inverse dynamics";

pub(super) fn rounded<R: Real, const N: usize>(values: &[f64]) -> [R; N] {
    let values: [f64; N] = values.try_into().expect("a row of this robot");
    values.map(|x| R::select(x, x as f32))
}

impl<const N: usize, const A: usize> Planar<N, A> {
    /// A problem that the firmware has too.
    pub fn of(problem: &LoopProblem<N, A>) -> Self {
        let starts = problem.starts.iter().map(|numbers| {
            let [q, qd, qdd] = numbers.map(|row| row.map(f64::from));
            State { q, qd, qdd }
        });
        Self {
            case: problem.case,
            name: problem.name,
            tree: *problem.tree,
            single: *problem.single,
            loops: *problem.loops,
            held: problem.held,
            moving: problem.moving,
            starts: starts.collect(),
        }
    }
}

impl<const B: usize, const Q: usize, const V: usize, const L: usize, const C: usize, const A: usize>
    Setup<B, Q, V, L, C, A>
{
    /// The description that the oracle reads.
    pub fn exported(&self) -> Exported {
        let exported = Exported {
            case: self.case,
            name: self.name.into(),
            inputs: String::new(),
            robot: robot(&self.tree),
            loops: loops(&self.loops),
            gamma: Vec::new(),
            actuated: self.loops.actuated().to_vec(),
            held: self.held.to_vec(),
            gravity: WEIGHT,
            states: self.starts.iter().map(Start::of).collect(),
        };
        exported.digested()
    }

    /// The oracle's results for this problem.
    pub fn truth(&self) -> Truth {
        self.exported().truth()
    }

    pub fn rows(&self) -> Vec<Row> {
        self.rows_against(&self.truth())
    }

    pub fn rows_against(&self, truth: &Truth) -> Vec<Row> {
        let (single, double) =
            (self.outcomes(&self.single, truth), self.outcomes(&self.tree, truth));
        let states = &truth.states;
        let of = |values: fn(&TrueState) -> Option<&[f64]>| states.iter().map(values).collect();
        let truths: [Vec<Option<&[f64]>>; 4] = [
            of(|state| Some(&state.q)),
            of(|state| state.tau.as_deref()),
            of(|state| state.tau.as_deref()),
            of(|state| Some(&state.forward)),
        ];
        let quantities = ["assembly (rad, m)", "inverse dynamics", DAMPED, "forward dynamics"];
        let mut all = Vec::new();
        for (k, quantity) in quantities.into_iter().enumerate() {
            let measured = match k {
                0 => self.moving == Moving::Passive,
                2 => self.is_damped(),
                _ => true,
            };
            if measured {
                let name = format!("{quantity}, {}", self.name);
                all.extend(rows(self.case, &name, [&single[k], &double[k]], &truths[k]));
            }
        }
        all
    }

    /// Whether this is in the range that is damped by default: what is demanded there has a bound
    /// of its own.
    fn is_damped(&self) -> bool {
        demands(self.case, &format!("{DAMPED}, {}", self.name)).is_some()
    }

    /// The outcomes of assembly, inverse dynamics, the same with the default damping, and forward
    /// dynamics, by states.
    ///
    /// In the damped range the first of inverse dynamics are with the least damping there is, which
    /// leaves torques exact up to where elimination loses a pivot.
    fn outcomes<R: Real>(
        &self,
        robot: &impl RobotModel<R, B, Q, V>,
        truth: &Truth,
    ) -> [Vec<Outcome>; 4] {
        let mut all = [const { Vec::new() }; 4];
        let least = match self.is_damped() {
            true => self.loops.damped_below(0.0),
            false => self.loops,
        };
        for (start, truth) in self.starts.iter().zip(&truth.states) {
            let guess = rounded(&start.q);
            let closed = assemble(robot, &self.loops, &guess, self.moving);
            all[0].push(match closed {
                Ok(closed) => Outcome::of(&closed.q, false).with_whole_turns_of(&truth.q),
                Err(_) => Outcome::NOTHING,
            });
            let state: State<R, Q, V> = truth.state();
            all[1].push(self.inverse(robot, &least, &state));
            all[2].push(self.inverse(robot, &self.loops, &state));
            let tau = rounded(&truth.given);
            let none = Stabilisation::NONE;
            let found = forward_dynamics(robot, &self.loops, &state, &tau, none, &scene());
            all[3].push(match found {
                Ok(found) => {
                    let named = found.rows.rank() < self.regular_rank();
                    Outcome::of(&found.qdd, named && all_finite(&found.lambda))
                }
                Err(LoopError::NotPositiveDefinite(_)) => Outcome::REFUSED,
                Err(_) => Outcome::NOTHING,
            });
        }
        all
    }

    /// The rank of K but in singular configurations: a planar loop has three of its five rows too
    /// many.
    fn regular_rank(&self) -> usize {
        if L == 1 && C == 5 { 2 } else { C }
    }
}
