//! Derivatives of inverse and forward dynamics and of effects: against dual numbers, and products
//! against the matrices, on trees with joints of every kind.

use crate::common::*;
use dynamics_core::Core;
use dynamics_core::algorithms::{
    aba, forward_dynamics_derivatives, rnea, rnea_along, rnea_derivatives, rnea_transposed, solve,
};
use dynamics_core::effects::{
    Armature, AsymmetricCoulomb, Cogging, ConstantTorque, Coriolis, Coulomb, Effect, EndStops,
    Frozen, GravityVector, Inertia, JointState, MovingBase, Payload, RIGID_BODY, Spring, Stribeck,
    TorqueDerivatives, Viscous, Width,
};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use glam::DVec3;
use host_tests::dual::{Dual, gradient, seeded, vector};
use host_tests::measured::largest;
use host_tests::random::recorded_trees;
use host_tests::recordings::{TreeDerivatives, read};

type Matrix = [[f64; V]; V];

/// All that has derivatives: gravity aslant, a payload, a base that moves, armatures, friction and springs.
fn scene<R: Real>() -> impl Effect<R, B, V> + Copy {
    let of = R::from_f64;
    let load = Payload::<R, { B - 1 }>::from_inertia(BodyInertia {
        mass: of(1.5),
        com: [0.1, -0.2, 0.05].map(of),
        inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015].map(of),
    });
    let motion = |ang: [f64; 3], lin: [f64; 3]| -> Motion<R> {
        Motion::new(vector::<R>(DVec3::from(ang)), vector::<R>(DVec3::from(lin)))
    };
    let ship = MovingBase {
        velocity: motion([0.3, -0.5, 0.7], [0.1, 0.2, -0.3]),
        acceleration: motion([-1.0, 2.0, 0.5], [0.4, 1.0, -2.0]),
    };

    let springs = Spring { stiffness: [of(7.0); V], rest: [of(0.2); V] };
    let tilted = GravityVector(vector::<R>(DVec3::new(2.0, -3.0, -9.0)));
    let rigid = (Inertia, Coriolis, tilted);
    (rigid, Armature([of(0.3); V]), load, ship, Viscous([of(0.7); V]), springs)
}

fn unit(k: usize) -> [f64; V] {
    core::array::from_fn(|j| f64::from(u8::from(j == k)))
}

fn column(rows: &Matrix, k: usize) -> [f64; V] {
    core::array::from_fn(|i| rows[i][k])
}

/// The largest error of an entry relative to the matrix's largest entry.
fn relative<R: Real, const V: usize>(got: &[[R; V]; V], want: &[[f64; V]; V]) -> f64 {
    let mut worst = Worst::default();
    got.iter().zip(want).for_each(|(got, want)| worst.see(got.map(R::to_f64), *want));
    worst.error / worst.full_scale
}

fn speak<const N: usize>(names: [&str; N], scalar: &str, errors: [f64; N]) {
    let mut verdict = Verdict::default();
    for (name, error) in names.iter().zip(errors) {
        verdict.see("mixed tree", name, scalar, &Worst { error, full_scale: 1.0 });
    }
    verdict.speak();
}

/// A state in another scalar.
fn cast<R: Real, S: Real>(state: &State<R, Q, V>) -> State<S, Q, V> {
    let of = |x: R| S::from_f64(x.to_f64());
    State { q: state.q.map(of), qd: state.qd.map(of), qdd: state.qdd.map(of) }
}

/// The largest relative errors of ∂τ/∂q and ∂τ/∂q̇ of any of a hundred trees.
fn of_trees<R: Real>() -> [f64; 2] {
    let mut worst = [0.0; 2];
    for (tree, state) in trees(false) {
        let state = cast::<f64, R>(&state);
        let by = rnea_derivatives(&R::cast(&tree), &state, &scene::<R>());
        let dual = Dual::cast(&tree);
        let want = gradient(&tree, &cast(&state), |state| rnea(&dual, state, &scene::<Dual>()));
        let errors = [relative(&by.dq, &want[0]), relative(&by.dqd, &want[1])];
        worst = core::array::from_fn(|i| largest([worst[i], errors[i]]));
    }
    worst
}

#[test]
fn the_derivatives_of_inverse_dynamics_are_those_of_dual_numbers() {
    let names = ["∂ID/∂q by dual numbers", "∂ID/∂qd by dual numbers"];
    speak(names, "f64", of_trees::<f64>());
    speak(names, "f32", of_trees::<f32>());
}

#[test]
fn the_derivatives_of_forward_dynamics_are_those_of_dual_numbers() {
    let mut worst = [0.0; 3];
    for (tree, state) in trees(false) {
        let (dual, scene_there) = (Dual::cast(&tree), scene::<Dual>());
        let tau = rnea(&tree, &state, &scene());
        let by =
            forward_dynamics_derivatives(&tree, &state, &tau, &scene()).expect("M is positive");
        let at = |state: &State<Dual, Q, V>, tau: [Dual; V]| {
            aba(&dual, state, &tau, &scene_there).expect("M is positive")
        };
        let want = gradient(&tree, &state, |state| at(state, tau.map(Dual::from_f64)));
        let rows: Matrix = core::array::from_fn(|k| solve(&tree, &by.factors, &unit(k)));
        let by_tau: Matrix =
            core::array::from_fn(|k| at(&cast(&state), seeded(&tau, k)).map(|entry| entry.slope));
        let errors =
            [relative(&by.dq, &want[0]), relative(&by.dqd, &want[1]), relative(&rows, &by_tau)];
        worst = core::array::from_fn(|i| largest([worst[i], errors[i]]));
    }
    let names = ["∂FD/∂q by dual", "∂FD/∂qd by dual", "∂FD/∂tau by dual"];
    speak(names.map(|name| format!("{name} numbers")).each_ref().map(|name| &**name), "f64", worst);
}

#[test]
fn the_derivatives_of_random_trees_are_pinocchios() {
    let recorded: Vec<TreeDerivatives> = read("trees");
    assert_eq!(recorded.len(), 20);
    let mut worst = [0.0; 2];
    for ((tree, state), TreeDerivatives { q, by }) in recorded_trees().zip(&recorded) {
        assert_eq!(state.q[..], q[..], "the trees have changed: record them again");
        let got = rnea_derivatives(&tree, &state, &RIGID_BODY);
        for ((worst, got), by) in worst.iter_mut().zip([got.dq, got.dqd]).zip(by) {
            let want = by.as_chunks().0.try_into().expect("rows of the tree's coordinates");
            *worst = largest([*worst, relative(&got, want)]);
        }
    }
    speak(["∂ID/∂q by Pinocchio", "∂ID/∂qd by Pinocchio"], "f64", worst);
}

/// The largest error of an effect's derivatives by `slopes`, relative to the largest one.
fn error<E, D>(
    (effect, dual): (E, D),
    slopes: fn(&E, usize, JointState<f64>, &mut TorqueDerivatives<f64>),
) -> f64
where
    E: Effect<f64, 1, 1>,
    D: Effect<Dual, 1, 1>,
{
    assert!(E::DIFFERENTIABLE);
    let (mut rng, mut worst) = (Rng::new(77), Worst { full_scale: f64::EPSILON, error: 0.0 });
    for k in 0..2000 {
        let (q, qd) = (rng.within(1.5), rng.within(if k % 2 == 0 { 0.1 } else { 3.0 }));
        let mut by = TorqueDerivatives::default();
        slopes(&effect, 0, JointState::new(q, qd), &mut by);
        let want = [0, 1].map(|seed| {
            let ([q, qd], mut tau) = (seeded(&[q, qd], seed), Dual::default());
            dual.torque(0, JointState::new(q, qd), &mut tau);
            tau.slope
        });
        worst.see([by.dq, by.dqd], want);
    }
    worst.error / worst.full_scale
}

/// An effect in f64 and in dual numbers.
macro_rules! both {
    (|$of:ident, $width:ident| $effect:expr) => {{
        let double = {
            let ($of, $width) = (|x: f64| x, Width::<f64>::new);
            $effect
        };
        let ($of, $width) = (Dual::from_f64, |x: f64| Width::new(Dual::from_f64(x)));
        (double, $effect)
    }};
}

#[test]
fn the_derivatives_of_effects_are_those_of_dual_numbers() {
    let lopsided = both!(|of, width| AsymmetricCoulomb {
        forward: [of(0.5)],
        backward: [of(4.0)],
        width: width(0.05),
    });
    let fading = both!(|of, width| Stribeck {
        excess: [of(2.0)],
        stribeck_speed: width(0.08),
        width: width(0.02),
    });
    let stops = both!(|of, width| EndStops {
        lower: [of(-0.8)],
        upper: [of(0.9)],
        stiffness: of(100.0),
        damping: of(20.0),
        damping_depth: width(0.3),
    });
    let slots = both!(|of, _width| Cogging {
        per_turn: [of(7.0)],
        cos: [[of(0.3), of(-0.1)]],
        sin: [[of(0.2), of(0.4)]],
    });
    let slopes = [
        error(both!(|of, _width| Viscous([of(0.7)])), Effect::<f64, 1, 1>::slopes),
        error(
            both!(|of, width| Coulomb { torque: [of(4.0)], width: width(0.05) }),
            Effect::<f64, 1, 1>::slopes,
        ),
        error(lopsided, Effect::<f64, 1, 1>::slopes),
        error(fading, Effect::<f64, 1, 1>::slopes),
        error(
            both!(|of, _width| Spring { stiffness: [of(9.0)], rest: [of(0.3)] }),
            Effect::<f64, 1, 1>::slopes,
        ),
        error(stops, Effect::<f64, 1, 1>::slopes),
        error(slots, Effect::<f64, 1, 1>::slopes),
        error(both!(|of, _width| ConstantTorque([of(3.0)])), Effect::<f64, 1, 1>::slopes),
        error(both!(|of, _width| Armature([of(0.2)])), Effect::<f64, 1, 1>::slopes),
    ];
    assert!(slopes.iter().all(|&error| error < 1e-14), "{slopes:?}");

    // Wrong ones are seen: a factor, what an implicit step leaves out, and all of it.
    let wrong = [
        error((Viscous([0.7]), Viscous([Dual::from_f64(0.701)])), Effect::<f64, 1, 1>::slopes),
        error(lopsided, Effect::<f64, 1, 1>::derivatives),
        error(fading, Effect::<f64, 1, 1>::derivatives),
        error(stops, Effect::<f64, 1, 1>::derivatives),
        error(slots, Effect::<f64, 1, 1>::derivatives),
        error((Frozen(slots.0), slots.1), Effect::<f64, 1, 1>::slopes),
    ];
    assert!(wrong.iter().all(|&error| error > 1e-4), "{wrong:?}");
}

#[test]
fn what_is_frozen_acts_and_has_no_derivative() {
    let (tree, state) = trees(false).next().expect("a tree");
    let slots = Cogging { per_turn: [7.0; V], cos: [[0.3]; V], sin: [[0.2]; V] };
    let without = scene::<f64>();
    let (free, frozen) = ((without, slots), (without, Frozen(slots)));
    assert_eq!(rnea(&tree, &state, &frozen), rnea(&tree, &state, &free));
    assert_ne!(rnea(&tree, &state, &frozen), rnea(&tree, &state, &without));
    let by = rnea_derivatives(&tree, &state, &frozen);
    assert_eq!(by, rnea_derivatives(&tree, &state, &without));
    assert_ne!(by, rnea_derivatives(&tree, &state, &free));
}

/// The errors of ∂ID x and xᵀ ∂ID of any of a hundred trees.
fn products<R: Real>() -> [Worst; 2] {
    let mut worst = <[Worst; 2]>::default();
    let (scene, mut rng) = (scene::<f64>(), Rng::new(31));
    for (tree, state) in trees(false) {
        let by = rnea_derivatives(&tree, &state, &scene);
        let [x, y] = [rng.vector::<V>(3.0), rng.vector::<V>(3.0)];
        let row = |a: &[f64; V], b: &[f64; V]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let want = core::array::from_fn::<_, V, _>(|i| row(&by.dq[i], &x) + row(&by.dqd[i], &y));
        let (tree, state, [to, by_rate]) = (R::cast(&tree), cast(&state), [x, y].map(reals));
        let along = rnea_along(&tree, &state, &to, &by_rate, &self::scene::<R>());
        worst[0].see(along.map(R::to_f64), want);
        let transposed = rnea_transposed(&tree, &state, &to, &self::scene::<R>());
        for (got, rows) in transposed.into_iter().zip([by.dq, by.dqd]) {
            let want = core::array::from_fn(|k| row(&column(&rows, k), &x));
            worst[1].see::<V>(got.map(R::to_f64), want);
        }
    }
    worst
}

fn reals<R: Real>(x: [f64; V]) -> [R; V] {
    x.map(R::from_f64)
}

#[test]
fn products_with_the_derivatives_are_those_of_the_matrices() {
    let errors = |worst: Worst| worst.error / worst.full_scale;
    speak(["∂ID x", "xᵀ ∂ID"], "f64", products::<f64>().map(errors));
    speak(["∂ID x", "xᵀ ∂ID"], "f32", products::<f32>().map(errors));
    let (state, x) = (State { qd: [1.0; 6], ..State::at([0.3; 6]) }, [0.1; 6]);
    let along = rnea_along(&Ur5e::MODEL, &state, &x, &x, &RIGID_BODY);
    assert_eq!(Core::<Ur5e>::rnea_along(&state, &x, &x, &RIGID_BODY), along);
    let transposed = rnea_transposed(&Ur5e::MODEL, &state, &x, &RIGID_BODY);
    assert_eq!(Core::<Ur5e>::rnea_transposed(&state, &x, &RIGID_BODY), transposed);
}
