//! A robot in states: the very same numbers in f32, in f64 and in the oracle's fifty digits.

pub mod list;

use std::path::PathBuf;

use dynamics_core::model::{ArmModel, BASE, JointKind, Link, Model, RobotModel};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::hard::{Answers, Extras, GRAVITY, Revolute, answers_to, scene};
use glam::{DMat3, Mat3, Vec3};
use serde::{Deserialize, Serialize};

/// A robot, its load, and the states at which it is evaluated.
#[derive(Clone, Debug)]
pub struct Setup<const N: usize> {
    pub case: u32,
    /// Its name within the case.
    pub name: String,
    /// In f32.
    pub single: ArmModel<f32, N>,
    /// The same numbers in f64, see [`same_in_f64`].
    pub double: ArmModel<f64, N>,
    pub extras: Extras<N>,
    /// The states at which it is evaluated.
    pub states: Vec<State<f32, N, N>>,
}

#[derive(Clone, Debug, Deserialize)]
pub struct Truth {
    name: String,
    inputs: String,
    /// κ(M), the largest over the states.
    pub condition: Option<f64>,
    pub states: Vec<TrueState>,
}

/// The oracle's results for one state.
#[derive(Clone, Debug, Deserialize)]
pub struct TrueState {
    /// Torques of the state's q̈.
    pub rnea: Vec<f64>,
    tau: Vec<String>,
    /// The acceleration under the same torques, rounded to f32; none if M is singular.
    pub qdd: Option<Vec<f64>>,
    /// Λ⁻¹ of the last body's origin.
    pub mobility: Option<Vec<f64>>,
}

impl<const N: usize> Setup<N> {
    /// From a description; states in f32.
    pub fn new(
        case: u32,
        name: impl Into<String>,
        arm: &ArmModel<f64, N>,
        extras: Extras<N>,
        states: Vec<State<f32, N, N>>,
    ) -> Self {
        let single = arm.to_f32();
        Self { case, name: name.into(), double: same_in_f64(arm, &single), single, extras, states }
    }

    /// Everything of each state, forward dynamics under the oracle's torques, in f32 and in f64.
    pub fn answers(&self, truth: &Truth) -> Vec<(Answers<f32, N>, Answers<f64, N>)> {
        let (single, double) = (scene(&self.extras), scene(&self.extras));
        let each = self.states.iter().enumerate().map(|(k, state)| {
            let tau = self.tau(truth, k);
            let (wide, wide_tau) = (widened(state), tau.map(f64::from));
            (
                answers_to(&turning(&self.single), state, &tau, &single),
                answers_to(&turning(&self.double), &wide, &wide_tau, &double),
            )
        });
        each.collect()
    }

    /// The torques of forward dynamics in state `k`.
    pub fn tau(&self, truth: &Truth, k: usize) -> [f32; N] {
        std::array::from_fn(|i| number(&truth.states[k].tau[i]))
    }

    /// The oracle's results for this setup.
    pub fn truth(&self) -> Truth {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        let path = root.join(format!("../recordings/hard/{}.json", self.case));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        let all: Vec<Truth> = serde_json::from_str(&text).expect("the oracle writes JSON");
        let truth = all.into_iter().find(|truth| truth.name == self.name);
        let truth = truth.unwrap_or_else(|| panic!("{path:?} lacks {:?}", self.name));
        let inputs = self.exported().inputs;
        assert_eq!(truth.inputs, inputs, "{path:?} is of other inputs: run oracle/hard.py");
        truth
    }

    /// The description that the oracle reads.
    pub fn exported(&self) -> Exported {
        let links = self.single.links.iter().map(exported_link).collect();
        let state = |state: &State<f32, N, N>| ExportedState {
            q: bits(&state.q),
            qd: bits(&state.qd),
            qdd: bits(&state.qdd),
        };
        let mut exported = Exported {
            case: self.case,
            name: self.name.clone(),
            inputs: String::new(),
            links,
            tip_frame: bits(&self.single.links[N - 1].to_joint_frame.to_cols_array()),
            gravity: bits(&[0.0, 0.0, -GRAVITY as f32]),
            rotors: bits(&self.extras.rotors),
            payload: bits(&[self.extras.payload]).remove(0),
            payload_at: bits(&self.extras.payload_at),
            payload_inertia: bits(&self.extras.payload_inertia),
            states: self.states.iter().map(state).collect(),
        };
        let text = serde_json::to_string(&exported).expect("strings");
        // FNV-1a: whether the recording is of these inputs.
        let digest = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        exported.inputs = format!("{digest:016x}");
        exported
    }
}

/// An arm all of whose joints turn.
pub fn turning<R: Real, const N: usize>(arm: &ArmModel<R, N>) -> Revolute<'_, R, N> {
    arm.as_all_revolute().expect("every joint turns")
}

pub fn widened<const Q: usize, const V: usize>(state: &State<f32, Q, V>) -> State<f64, Q, V> {
    State { q: state.q.map(f64::from), qd: state.qd.map(f64::from), qdd: state.qdd.map(f64::from) }
}

/// The f32 numbers in f64, except that rotations are replaced by the nearest orthonormal ones: a
/// general rotation is no longer one after rounding, and has no exact result.
pub fn same_in_f64<const B: usize, const Q: usize, const V: usize>(
    arm: &Model<f64, B, Q, V>,
    single: &Model<f32, B, Q, V>,
) -> Model<f64, B, Q, V> {
    let mut wide = literally_in_f64(arm, single);
    for link in &mut wide.links {
        link.placement.rot = nearest_rotation(link.placement.rot);
        link.to_joint_frame = nearest_rotation(link.to_joint_frame);
    }
    wide
}

/// The f32 numbers in f64, rotations too.
pub fn literally_in_f64<const B: usize, const Q: usize, const V: usize>(
    arm: &Model<f64, B, Q, V>,
    single: &Model<f32, B, Q, V>,
) -> Model<f64, B, Q, V> {
    let mut wide = *arm;
    for (link, rounded) in std::iter::zip(&mut wide.links, &single.links) {
        link.to_joint_frame = rounded.to_joint_frame.as_dmat3();
        link.placement.rot = rounded.placement.rot.as_dmat3();
        link.placement.pos = rounded.placement.pos.as_dvec3();
        link.inertia.mass = rounded.inertia.mass.into();
        link.inertia.first_moment = rounded.inertia.first_moment.as_dvec3();
        link.inertia.rotational = rounded.inertia.rotational.as_dmat3();
    }
    wide
}

/// By Newton's iteration; a signed permutation stays what it is.
fn nearest_rotation(mut m: DMat3) -> DMat3 {
    for _ in 0..4 {
        m = (m + m.inverse().transpose()) * 0.5;
    }
    m
}

/// A problem as `oracle/hard.py` reads it: every number by the bits of its f32.
#[derive(Clone, Debug, Serialize)]
pub struct Exported {
    case: u32,
    name: String,
    inputs: String,
    links: Vec<ExportedLink>,
    tip_frame: Vec<String>,
    gravity: Vec<String>,
    rotors: Vec<String>,
    payload: String,
    payload_at: Vec<String>,
    payload_inertia: Vec<String>,
    states: Vec<ExportedState>,
}

#[derive(Clone, Debug, Serialize)]
struct ExportedLink {
    parent: i64,
    kind: &'static str,
    rot: Vec<String>,
    pos: Vec<String>,
    mass: String,
    #[serde(rename = "moment")]
    first_moment: Vec<String>,
    inertia: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
struct ExportedState {
    q: Vec<String>,
    qd: Vec<String>,
    qdd: Vec<String>,
}

fn exported_link(link: &Link<f32>) -> ExportedLink {
    let (matrix, vector) = (|m: &Mat3| bits(&m.to_cols_array()), |v: Vec3| bits(&v.to_array()));
    ExportedLink {
        parent: if link.parent == BASE { -1 } else { link.parent as i64 },
        kind: match link.joint.kind {
            JointKind::Prismatic => "prismatic",
            _ => "revolute",
        },
        rot: matrix(&link.placement.rot),
        pos: vector(link.placement.pos),
        mass: bits(&[link.inertia.mass]).remove(0),
        first_moment: vector(link.inertia.first_moment),
        inertia: matrix(&link.inertia.rotational),
    }
}

fn bits(values: &[f32]) -> Vec<String> {
    let bits = values.iter().map(|x| format!("{:08x}", x.to_bits()));
    bits.collect()
}

fn number(bits: &str) -> f32 {
    f32::from_bits(u32::from_str_radix(bits, 16).expect("the oracle writes bits"))
}
