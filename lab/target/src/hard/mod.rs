//! Hard cases on arms of six bodies, and on linkages ([`loops`]), as numbers that the host tests
//! and the firmware share.
//!
//! The host compares the results with 50-digit oracles and closed forms (`host-tests/src/hard`);
//! the firmware's bin `bits` shows that a microcontroller computes the same bits.

mod arms;
mod compute;
pub mod loops;
mod states;

pub use arms::{COUNT, EXCESS, RENUMBERING};
pub use compute::{Answers, GRAVITY, OnLast, Revolute, Scene, answers_to, scene};
pub use states::{counts, remainder};

use dynamics_core::model::{ArmModel, RobotModel};
use dynamics_core::state::State;
use firmware_demo::digest::Digest;

/// Bodies of an arm.
pub const N: usize = 6;

/// Additions to the arm itself.
#[derive(Clone, Copy, Debug)]
pub struct Extras<const N: usize> {
    /// Rotor inertia at each joint, kg·m².
    pub rotors: [f32; N],
    /// Mass of the payload, kg.
    pub payload: f32,
    /// Its centre of mass in the last body's frame, m.
    pub payload_at: [f32; 3],
    /// Its inertia about that, xx, xy, xz, yy, yz, zz, kg·m².
    pub payload_inertia: [f32; 6],
}

impl<const N: usize> Extras<N> {
    pub const NONE: Self = Self {
        rotors: [0.0; N],
        payload: 0.0,
        payload_at: [0.0; 3],
        payload_inertia: [0.0; 6],
    };
}

/// A state as it is written: q, q̇, q̈.
pub type Numbers = [[f32; N]; 3];

/// One problem of a hard case, with the arm's numbers in the scalar of `A`.
#[derive(Clone, Copy, Debug)]
pub struct Problem<A> {
    /// The number of the case that it belongs to.
    pub case: u32,
    pub name: &'static str,
    pub arm: A,
    /// The states at which it is evaluated.
    pub states: &'static [Numbers],
    pub extras: Extras<N>,
}

/// The problems as they are described, in f64.
pub static DOUBLE: &[Problem<ArmModel<f64, N>>; COUNT] = &arms::LIST;

/// The same in f32: what is computed with.
pub static SINGLE: [Problem<ArmModel<f32, N>>; COUNT] = {
    let first = single_of(&arms::LIST[0]);
    let (mut all, mut i) = ([first; COUNT], 1);
    while i < COUNT {
        all[i] = single_of(&arms::LIST[i]);
        i += 1;
    }
    all
};

const fn single_of(problem: &Problem<ArmModel<f64, N>>) -> Problem<ArmModel<f32, N>> {
    Problem {
        case: problem.case,
        name: problem.name,
        arm: problem.arm.to_f32(),
        states: problem.states,
        extras: problem.extras,
    }
}

/// The numbers of the cases of which there are digests.
pub fn cases() -> impl Iterator<Item = u32> {
    let linkages = loops::PROBLEMS.iter().map(|problem| problem.case);
    let arms = SINGLE.iter().map(|problem| problem.case);
    arms.chain(linkages).chain([loops::RIG.case])
}

/// The f32 state of these numbers.
pub fn state(&[q, qd, qdd]: &Numbers) -> State<f32, N, N> {
    State { q, qd, qdd }
}

mod torques {
    include!(concat!(env!("OUT_DIR"), "/torques.rs"));
}

/// Calls `report` with each problem's case and name, and the digest of all that is computed of it:
/// forward dynamics under the oracle's torques.
pub fn digests(mut report: impl FnMut(u32, &'static str, Digest)) {
    for problem in &SINGLE {
        let mut torques = torques::TORQUES.iter();
        let given = torques.find(|given| (given.0, given.1) == (problem.case, problem.name));
        let taus = given.map(|given| given.2).unwrap_or_default();
        let mut digest = Digest::EMPTY;
        let scene = scene(&problem.extras);
        if let Some(arm) = problem.arm.as_all_revolute() {
            for (numbers, tau) in problem.states.iter().zip(taus) {
                let tau = tau.map(f32::from_bits);
                answers_to(&arm, &state(numbers), &tau, &scene).digest(&mut digest);
            }
        }
        report(problem.case, problem.name, digest);
    }
    loops::digests(report);
}
