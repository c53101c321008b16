//! Each ancestor against today's core, in f64, relative to full scale: the largest torque of the
//! state.

use dynamics_core::algorithms::{crba, rnea};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::state;
use history::chain::Rods;
use history::composite_bodies::method_3;
use history::walker_orin::{method_1, method_2, solve};
use history::{
    Chain, State, balafoutis_patel, hollerbach_3, hollerbach_4, luh_walker_paul, uicker_kahn,
    waters,
};

const STATES: u64 = 60;
const BOUND: f64 = 1e-12;

/// Numbers from −1 to 1, by Knuth's linear congruence.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn array<const N: usize>(&mut self, scale: f64) -> [f64; N] {
        std::array::from_fn(|_| scale * self.next())
    }
}

fn random<const N: usize>(seed: u64) -> state::State<f64, N, N> {
    let mut numbers = Numbers(seed);
    numbers.next();
    state::State { q: numbers.array(3.0), qd: numbers.array(4.0), qdd: numbers.array(10.0) }
}

/// The largest difference of two lists of numbers, relative to the largest of the second.
fn error(ours: &[f64], oracle: &[f64]) -> f64 {
    assert_eq!(ours.len(), oracle.len());
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let apart = largest(&mut std::iter::zip(ours, oracle).map(|(a, b)| (a - b).abs()));
    assert!(ours.iter().all(|x| x.is_finite()));
    apart / largest(&mut oracle.iter().map(|x| x.abs()))
}

type Torques<const N: usize> = fn(&Chain<f64, N>, &State<f64, N>) -> [f64; N];
type Inertia<const N: usize> = fn(&Chain<f64, N>, &State<f64, N>) -> [[f64; N]; N];

/// The largest error of an ancestor's torques over all states.
fn torque_error<const N: usize>(ancestor: Torques<N>) -> f64 {
    let chain = Chain::default();
    let errors = (0..STATES).map(|seed| {
        let state = random::<N>(seed);
        let oracle = rnea(&Rods::<N>::MODEL, &state, &RIGID_BODY);
        error(&ancestor(&chain, &State::new(&state.q, &state.qd, &state.qdd)), &oracle)
    });
    errors.fold(0.0, f64::max)
}

fn all_torques<const N: usize>() {
    let ancestors: [(&str, Torques<N>); 6] = [
        ("Uicker, Kahn", uicker_kahn::torques),
        ("Waters", waters::torques),
        ("Hollerbach 4 × 4", hollerbach_4::torques),
        ("Hollerbach 3 × 3", hollerbach_3::torques),
        ("Luh, Walker, Paul", luh_walker_paul::torques),
        ("Balafoutis, Patel", balafoutis_patel::torques),
    ];
    for (name, ancestor) in ancestors {
        let error = torque_error(ancestor);
        println!("{name}, n = {N}: {error:.1e}");
        assert!(error <= BOUND, "{name}, n = {N}: {error:e}");
    }
}

#[test]
fn torques_are_those_of_rnea() {
    all_torques::<1>();
    all_torques::<2>();
    all_torques::<3>();
    all_torques::<6>();
    all_torques::<12>();
}

/// M of today's core.
fn inertia<const N: usize>(q: &[f64; N]) -> [[f64; N]; N] {
    let model = &Rods::<N>::MODEL;
    let m = crba(model, &state::JointTrig::new(model, q), &RIGID_BODY);
    std::array::from_fn(|i| std::array::from_fn(|j| m.get(i, j)))
}

fn all_inertias<const N: usize>() {
    let methods: [(&str, Inertia<N>); 3] = [("1", method_1), ("2", method_2), ("3", method_3)];
    let chain = Chain::default();
    for seed in 0..STATES {
        let state = random::<N>(seed);
        let oracle = inertia::<N>(&state.q);
        let ours = State::new(&state.q, &state.qd, &state.qdd);
        for (name, method) in methods {
            let h = method(&chain, &ours);
            let error = error(h.as_flattened(), oracle.as_flattened());
            assert!(error <= BOUND, "method {name}, n = {N}: {error:e}");
        }
    }
}

#[test]
fn inertia_matrices_are_those_of_crba() {
    all_inertias::<1>();
    all_inertias::<2>();
    all_inertias::<3>();
    all_inertias::<6>();
    all_inertias::<12>();
}

/// The largest number of steps that a state needs.
fn conjugate_gradients<const N: usize>() -> usize {
    let chain = Chain::default();
    let mut most = 0;
    for seed in 0..STATES {
        let state = random::<N>(seed);
        let ours = State::new(&state.q, &state.qd, &state.qdd);
        let h = inertia::<N>(&state.q);
        let product = |x: &[f64; N]| -> [f64; N] {
            std::array::from_fn(|i| std::iter::zip(&h[i], x).map(|(h, x)| h * x).sum())
        };
        let tau = product(&state.qdd);
        let (qdd, steps) = solve(&chain, &ours, &tau, (20 * N, 1e-13));
        assert!(error(&product(&qdd), &tau) <= BOUND, "n = {N}: {steps} steps");
        most = most.max(steps);
    }
    most
}

#[test]
fn conjugate_gradients_give_the_accelerations() {
    let steps =
        [conjugate_gradients::<2>(), conjugate_gradients::<6>(), conjugate_gradients::<12>()];
    // Without rounding errors as many as there are joints would suffice; docs/history.md names
    // these.
    assert_eq!(steps, [2, 8, 19]);
}

#[test]
fn a_wrong_ancestor_is_refused() {
    let without_coriolis: Torques<6> = |chain, state| {
        let still = State { qd: [0.0; 6], ..*state };
        luh_walker_paul::torques(chain, &still)
    };
    assert!(torque_error(without_coriolis) > 1e-3);
    let heavier: Torques<6> = |chain, state| {
        let mut chain = *chain;
        chain.links[5].mass *= 1.0 + 1e-10;
        luh_walker_paul::torques(&chain, state)
    };
    assert!(torque_error(heavier) > BOUND);
}
