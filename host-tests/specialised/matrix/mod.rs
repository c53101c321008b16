//! M, its factors and what solves with them: against Pinocchio, and against each other on trees
//! that mix every kind of joint.

mod recorded;
mod singular;
mod trees;

use std::cell::Cell;

use dynamics_core::MassMatrix;
use dynamics_core::algorithms::{
    Prescribed, aba, cholesky, crba, crba_jacobian, forward_dynamics, hybrid_dynamics, inverse,
    ltdl, rnea, solve, spatial_operator_inverse, spatial_operator_ltdl,
};
use dynamics_core::effects::{
    Armature, Coriolis, Effect, Gravity, Inertia, RIGID_BODY, Viscous, hook,
};
use dynamics_core::model::{JointKind, Model};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use fixtures::hard::OnLast;
use host_tests::tolerances;
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

use trees::*;

/// The largest errors of one scalar, each relative to its full scale.
#[derive(Default)]
struct Worst {
    /// Errors of algorithms that do not solve with M, by quantity.
    plain: Vec<(&'static str, f64)>,
    /// Errors of those that do: the largest used share of their bound, and κ there.
    solved: Vec<(&'static str, f64, f64)>,
}

/// max |got − want| / max |want|, over all entries.
fn relative<R: Real>(got: &[R], want: &[R]) -> f64 {
    let scale = want.iter().fold(0.0, |s, x| f64::max(s, x.to_f64().abs()));
    let error = got.iter().zip(want).fold(0.0, |e, (g, w)| {
        let d = (g.to_f64() - w.to_f64()).abs();
        assert!(d.is_finite());
        f64::max(e, d)
    });
    if scale == 0.0 { error } else { error / scale }
}

impl Worst {
    fn plain<R: Real>(&mut self, what: &'static str, got: &[R], want: &[R]) {
        let error = relative(got, want);
        match self.plain.iter_mut().find(|(known, _)| *known == what) {
            Some((_, worst)) => *worst = worst.max(error),
            None => self.plain.push((what, error)),
        }
    }

    /// Within max(1e-11, 10 κ 2⁻⁵²), in f32 with its own rounding.
    fn solved<R: Real>(&mut self, what: &'static str, kappa: f64, got: &[R], want: &[R]) {
        let epsilon = R::EPSILON.to_f64();
        let floor = if epsilon < 1e-10 { 1e-11 } else { 1e-5 };
        let used = relative(got, want) / f64::max(floor, 10.0 * kappa * epsilon);
        assert!(used <= 1.0, "{what}: {used:.2} of the bound, κ = {kappa:.1e}");
        match self.solved.iter_mut().find(|(known, ..)| *known == what) {
            Some(worst) if worst.1 >= used => {}
            Some(worst) => *worst = (what, used, kappa),
            None => self.solved.push((what, used, kappa)),
        }
    }

    fn report<R: Real>(&self) -> Vec<String> {
        let scalar = std::any::type_name::<R>();
        for (what, used, kappa) in &self.solved {
            println!("{scalar} {what}: {used:.4} of the bound where κ = {kappa:.1e}");
        }
        (self.plain.iter())
            .filter_map(|(what, error)| tolerances::check("mixed", what, scalar, *error).err())
            .collect()
    }
}

fn entries<R: Real, const V: usize>(m: &MassMatrix<R, V>) -> Vec<R> {
    (0..V).flat_map(|i| *m.row(i).expect("a row")).collect()
}

/// A body's velocity as an effect receives it.
struct Witness<R: Real> {
    body: usize,
    observed: Cell<Motion<R>>,
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Witness<R> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> =
        hook::Wrench::of_velocity(|witness, body, at, _| {
            if body == witness.body {
                witness.observed.set(at.velocity);
            }
        });
}

/// M: its columns are differences of inverse dynamics, exactly symmetric, exactly zero between
/// branches; and the modified method's Jacobian.
fn matrix<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    state: &State<R, Q, V>,
    body: usize,
    worst: &mut Worst,
) {
    let scene = (
        Armature(core::array::from_fn(|i| R::from_f64(0.01 * i as f64))),
        OnLast::new(R::from_f64(0.7), [R::from_f64(0.1); 3], [R::ZERO; 6]),
        Inertia,
    );
    let m = crba(model, &state.q, &scene);
    let at_rest = State::at(state.q);
    let (mut columns, none) = (Vec::new(), rnea(model, &at_rest, &scene));
    for i in 0..V {
        let mut state = at_rest;
        state.qdd[i] = R::ONE;
        let column = rnea(model, &state, &scene);
        columns.extend(column.iter().zip(none).map(|(&a, b)| a - b));
    }
    worst.plain("columns of M", &entries(&m), &columns);
    for i in 0..V {
        for j in 0..i {
            assert_eq!(m.get(i, j), m.get(j, i));
            let mut above = i;
            while above != j && above < V {
                above = model.lambda[above];
            }
            assert!(above == j || m.get(i, j) == R::ZERO, "{i} and {j} do not meet");
        }
    }
    let (modified, jacobian) = crba_jacobian(model, &state.q, body, &scene);
    worst.plain("modified method", &entries(&modified), &entries(&m));
    let mut velocity = Motion::ZERO;
    for (column, &qd) in jacobian.iter().zip(&state.qd) {
        velocity += *column * qd;
    }
    let observed = Cell::new(Motion::ZERO);
    let witness = (Witness { body, observed },);
    let _ = rnea(model, state, &witness);
    let numbers = |m: Motion<R>| [m.ang.array(), m.lin.array()].concat();
    let want = numbers(witness.0.observed.get());
    worst.plain("Jacobian", &numbers(velocity), &want);
}

/// Solutions with M: all algorithms give the same.
fn solutions<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    state: &State<R, Q, V>,
    worst: &mut Worst,
) {
    let m = crba(model, &state.q, &RIGID_BODY);
    let kappa = condition(&m);
    let (x, tau) = (state.qdd, m.mul_vec(&state.qdd));
    let factors = ltdl(model, &m).expect("M is positive definite");
    worst.solved("solve", kappa, &solve(model, &factors, &tau), &x);
    let root = cholesky(model, &m).expect("M is positive definite");
    worst.solved("root of M", kappa, &root.solve(model, &tau), &x);
    let of_bodies =
        spatial_operator_ltdl(model, &state.q, &RIGID_BODY).expect("M is positive definite");
    worst.solved("operators", kappa, &solve(model, &of_bodies, &tau), &x);
    worst.solved("D", kappa, of_bodies.d_inv(), factors.d_inv());
    let l = |f: &dynamics_core::Ltdl<R, V>| -> Vec<R> {
        (0..V * V).map(|k| f.get(k / V, k % V)).collect()
    };
    worst.solved("L", kappa, &l(&of_bodies), &l(&factors));
    let m_inv = inverse(model, &factors);
    let one: Vec<R> = (0..V).flat_map(|i| m.mul_vec(m_inv.row(i).expect("a row"))).collect();
    let identity: Vec<R> =
        (0..V * V).map(|k| R::from_f64(f64::from(u8::from(k / V == k % V)))).collect();
    worst.solved("M times its inverse", kappa, &one, &identity);
    let of_bodies =
        spatial_operator_inverse(model, &state.q, &RIGID_BODY).expect("M is positive definite");
    worst.solved("inverse by operators", kappa, &entries(&of_bodies), &entries(&m_inv));
}

/// Forward and hybrid dynamics take back what inverse dynamics gives, under friction, rotors and
/// load.
fn dynamics<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    state: &State<R, Q, V>,
    rng: &mut TestRng,
    worst: &mut Worst,
) {
    let scene = (
        Gravity::EARTH,
        Inertia,
        Coriolis,
        Viscous([R::from_f64(0.5); V]),
        Armature([R::from_f64(0.02); V]),
        OnLast::new(R::from_f64(0.7), [R::from_f64(0.1); 3], [R::ZERO; 6]),
    );
    let kappa = condition(&crba(model, &state.q, &scene));
    let tau = rnea(model, state, &scene);
    let by_bodies = aba(model, state, &tau, &scene).expect("M is positive definite");
    worst.solved("aba", kappa, &by_bodies, &state.qdd);
    let by_matrix = forward_dynamics(model, state, &tau, &scene).expect("M is positive definite");
    worst.solved("forward", kappa, &by_matrix, &state.qdd);

    let all = tau.map(Prescribed::Torque);
    let response = hybrid_dynamics(model, state, &all, &scene).expect("M is positive definite");
    assert_eq!((response.qdd, response.tau), (by_bodies, tau));
    let all = state.qdd.map(Prescribed::Acceleration);
    let response = hybrid_dynamics(model, state, &all, &scene).expect("nothing is solved for");
    assert_eq!(response.qdd, state.qdd);
    worst.plain("hybrid as inverse", &response.tau, &tau);
    let some = core::array::from_fn(|i| {
        if rng.random_range(0..2) == 0 {
            Prescribed::Torque(tau[i])
        } else {
            Prescribed::Acceleration(state.qdd[i])
        }
    });
    let response = hybrid_dynamics(model, state, &some, &scene).expect("M is positive definite");
    worst.solved("hybrid", kappa, &response.qdd, &state.qdd);
    worst.plain("torques of hybrid", &response.tau, &tau);
}

fn laws<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    state: &State<f64, Q, V>,
    rng: &mut TestRng,
    worst: &mut Worst,
) {
    let state = cast::<R, Q, V>(state);
    matrix(model, &state, rng.random_range(0..B), worst);
    solutions(model, &state, worst);
    dynamics(model, &state, rng, worst);
}

/// All laws on `count` trees, in both scalars.
fn hold<const B: usize, const Q: usize, const V: usize>(
    count: usize,
    worst: &mut [Worst; 2],
    make: impl Fn(&mut TestRng) -> Model<f64, B, Q, V>,
) {
    let rng = &mut random_numbers();
    for _ in 0..count {
        let model = make(rng);
        let state = state_of(&model, rng);
        laws::<f64, B, Q, V>(&model, &state, rng, &mut worst[0]);
        laws::<f32, B, Q, V>(&model.to_f32(), &state, rng, &mut worst[1]);
    }
}

#[test]
fn all_mass_matrix_algorithms_agree_on_every_joint() {
    use JointKind::*;
    let run = || {
        let mut worst = <[Worst; 2]>::default();
        for kind in [Revolute, Continuous, Prismatic, Helical] {
            hold::<1, 1, 1>(20, &mut worst, |rng| tree(rng, [kind]));
        }
        hold::<1, 7, 6>(20, &mut worst, |rng| tree(rng, [Free]));
        hold::<1, 0, 0>(1, &mut worst, |rng| tree(rng, [Fixed]));
        hold::<5, 5, 5>(50, &mut worst, mixed);
        hold::<10, 22, 20>(100, &mut worst, mixed);
        #[cfg(feature = "full")]
        hold::<64, 136, 124>(2, &mut worst, mixed);
        let complaints = [worst[0].report::<f64>(), worst[1].report::<f32>()].concat();
        assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    };
    // Matrices of 124 × 124 by value, in unoptimised frames.
    let thread = std::thread::Builder::new().stack_size(256 << 20).spawn(run);
    thread.expect("a thread").join().expect("the laws hold");
}
