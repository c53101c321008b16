//! The setups that the oracle answers.

use super::{Exported, Setup};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::state::State;
use fixtures::hard::{DOUBLE, Extras, N, SINGLE, state};
use glam::DMat3;
use proptest::test_runner::TestRng;

use host_tests::random::{random_numbers, within};

pub fn exported() -> Vec<Exported> {
    let mut all: Vec<Exported> =
        (DOUBLE.iter()).map(|problem| arm(problem.case, problem.name).exported()).collect();
    all.push(reframed().exported());
    all.push(light_links().exported());
    for (straight, random) in [
        (chain::<8>(7, Stance::Straight).exported(), chain::<8>(7, Stance::Random).exported()),
        (chain::<16>(8, Stance::Straight).exported(), chain::<16>(8, Stance::Random).exported()),
        (chain::<32>(9, Stance::Straight).exported(), chain::<32>(9, Stance::Random).exported()),
        (chain::<64>(10, Stance::Straight).exported(), chain::<64>(10, Stance::Random).exported()),
    ] {
        all.extend([straight, random]);
    }
    all
}

/// An arm that the firmware has too.
pub fn arm(case: u32, name: &str) -> Setup<N> {
    let at = SINGLE.iter().position(|p| p.case == case && p.name == name);
    let at = at.unwrap_or_else(|| panic!("there is no arm {name:?} of case {case}"));
    let (double, single) = (&DOUBLE[at], &SINGLE[at]);
    let states = single.states.iter().map(state).collect();
    Setup::new(case, name, &double.arm, double.extras, states)
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stance {
    /// Stretched out, all axes parallel.
    Straight,
    /// Anyhow, its axes across and upright by turns.
    Random,
}

impl Stance {
    fn name(self) -> &'static str {
        match self {
            Self::Straight => "straight",
            Self::Random => "random",
        }
    }
}

/// K rods of 1 kg and 0.25 m.
pub fn chain<const K: usize>(case: u32, stance: Stance) -> Setup<K> {
    let random = stance == Stance::Random;
    let bodies = std::array::from_fn(|i| rod(i, 1.0, 0.25, random));
    let arm = ArmModel::new("rods", bodies);
    let mut rng = random_numbers();
    let states = (0..4).map(|_| {
        let mut state = drawn::<K>(&mut rng);
        if !random {
            state.q = [0.0; K];
        }
        state
    });
    let states = states.collect();
    Setup::new(case, stance.name(), &arm, Extras::NONE, states)
}

/// Ten rods of 1 g and 0.1 m with 1 kg of 0.1 m at their end.
pub fn light_links() -> Setup<11> {
    let bodies = std::array::from_fn(|i| rod(i, if i < 10 { 1e-3 } else { 1.0 }, 0.1, true));
    let mut rng = random_numbers();
    let states = (0..4).map(|_| drawn(&mut rng)).collect();
    let arm: ArmModel<f64, 11> = Model::new("light links", bodies);
    Setup::new(12, "1 kg on ten links of 1 g", &arm, Extras::NONE, states)
}

/// A rod along x on the one before, turning about y, or about z if it is an odd one of a chain in
/// space.
fn rod(i: usize, mass: f64, length: f64, in_space: bool) -> Body {
    let axis = match in_space && i % 2 == 1 {
        true => [0.0, 0.0, 1.0],
        false => [0.0, 1.0, 0.0],
    };
    let (parent, at) = if i == 0 { (BASE, 0.0) } else { (i - 1, length) };
    let across = mass * length * length / 12.0;
    Body::new("rod", parent, Joint::revolute(axis))
        .xyz([at, 0.0, 0.0])
        .mass(mass)
        .com([0.5 * length, 0.0, 0.0])
        .inertia([0.02 * across, 0.0, 0.0, across, 0.0, across])
}

/// Joints anywhere, within 3 rad/s and 10 rad/s².
fn drawn<const K: usize>(rng: &mut TestRng) -> State<f32, K, K> {
    State {
        q: within(rng, std::f64::consts::PI).map(|x| x as f32),
        qd: within(rng, 3.0).map(|x| x as f32),
        qdd: within(rng, 10.0).map(|x| x as f32),
    }
}

/// The UR5e of quarter turns, every link's frame turned about its joint's axis by an odd angle.
pub fn reframed() -> Setup<N> {
    let from = arm(17, "k π/2 ± 1 ulp"); // the plain arm
    let common = arm(1, "tip × 10⁶").states;
    let mut turned = from.double;
    let mut before = DMat3::IDENTITY;
    for (k, link) in turned.links.iter_mut().enumerate() {
        let own = DMat3::from_rotation_z(0.4 + 0.7 * k as f64);
        link.placement.rot = own * link.placement.rot * before.transpose();
        link.placement.pos = before * link.placement.pos;
        link.inertia.first_moment = own * link.inertia.first_moment;
        link.inertia.rotational = own * link.inertia.rotational * own.transpose();
        link.to_joint_frame = own * link.to_joint_frame;
        before = own;
    }
    Setup::new(43, "general frames", &turned, Extras::NONE, common)
}
