//! Links in motion: stiff ones, energy, and a mode that is faster than the step.

use dynamics_core::algorithms;
use dynamics_core::effects::{Coriolis, Effect, Elasticity, Inertia, RIGID_BODY};
use dynamics_core::flexible::{ModalFeedforward, Modes, Shape, crba, forward_dynamics, rnea, step};
use dynamics_core::model::ArmModel;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::hard::Row;

use super::{Scalar, number, one, two};
use crate::{LOWER, UPPER};

pub(super) fn rigid_limit() -> Vec<Row> {
    fn worst<R: Scalar>(stiffer: f64) -> f64 {
        let ei = |ei: f64| [ei * stiffer; 2];
        let beams = [UPPER.bending(ei(4.0)), LOWER.bending(ei(1.0))];
        let (robot, modes) = two::<R, 2, 4>(&beams);
        let scene = (RIGID_BODY, Elasticity);
        let at = |t: f64| {
            let u = (t / 0.5).min(1.0);
            let q = u.powi(4) * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u)));
            let qd = 140.0 * (u * (1.0 - u)).powi(3) / 0.5;
            let qdd = 420.0 * (u * (1.0 - u)).powi(2) * (1.0 - 2.0 * u) / 0.25;
            let both = |x: f64| [number(x), number(-0.5 * x)];
            State::<R, 2, 2> { q: both(q), qd: both(qd), qdd: both(qdd) }
        };
        let rest = ModalFeedforward::at_rest(&robot, &modes, &at(0.0).q, &scene);
        let mut feedforward = rest.expect("stiffness");
        let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
        for tick in 0..600 {
            let reference = at(f64::from(tick) * 1e-3);
            let rigid = algorithms::rnea(&robot, &reference, &RIGID_BODY);
            let tau = feedforward.tick(&robot, &modes, &reference, &scene, number(1e-3));
            for (a, b) in tau.expect("finite").iter().zip(rigid) {
                worst = worst.max((a.to_f64() - b.to_f64()).abs());
                scale = scale.max(b.to_f64().abs());
            }
        }
        worst / scale
    }
    fn run<R: Scalar>(rows: &mut Vec<Row>, bounds: [f64; 2]) {
        for (stiffer, bound) in [(1e4, bounds[0]), (1e8, bounds[1])] {
            let quantity = format!("torques, EI × {stiffer:.0e}");
            rows.push(Row::measured(quantity, R::NAME, worst::<R>(stiffer), bound));
        }
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, [1e-3, 5e-7]);
    run::<f64>(&mut rows, [1e-3, 1e-7]);
    rows
}

pub(super) fn energy() -> Vec<Row> {
    energy_for(60)
}

/// The energy of the bending arm for this many seconds, with the bounds in proportion to them.
pub fn energy_for(seconds: u32) -> Vec<Row> {
    fn run<R: Scalar>(seconds: u32, rows: &mut Vec<Row>, bound: f64) {
        let (robot, modes) = two::<R, 1, 2>(&[UPPER, LOWER]);
        let scene = (Inertia, Coriolis, Elasticity);
        let both = |x: f64, y: f64| [number::<R>(x), number(y)];
        let mut joints = State { qd: both(1.0, -2.0), ..State::at(both(0.2, 0.8)) };
        let mut bent = State { qd: both(0.3, -0.2), ..State::at(both(0.01, -0.01)) };
        let whole = |joints: &State<R, 2, 2>, bent: &State<R, 2, 2>| {
            let m = crba(&robot, &modes, &joints.q, &bent.q, &scene);
            let elastic =
                rnea(&robot, &modes, &State::at(joints.q), &State::at(bent.q), &Elasticity);
            let work =
                elastic.modes.iter().zip(&bent.q).map(|(f, q)| 0.5 * f.to_f64() * q.to_f64());
            m.kinetic_energy(&joints.qd, &bent.qd).to_f64() + work.sum::<f64>()
        };
        let start = whole(&joints, &bent);
        let mut worst = 0.0_f64;
        for step in 0..seconds * 5_000 {
            runge_kutta(&robot, &modes, &mut joints, &mut bent, &scene, number(2e-4));
            if step % 1000 == 0 {
                worst = worst.max((whole(&joints, &bent) / start - 1.0).abs());
            }
        }
        rows.push(Row::measured("energy, of that at the start", R::NAME, worst, bound));
    }
    let mut rows = Vec::new();
    let minutes = f64::from(seconds) / 60.0;
    run::<f32>(seconds, &mut rows, 1e-3 * minutes);
    run::<f64>(seconds, &mut rows, 1e-6 * minutes);
    rows
}

/// The state x + h ẋ of rates and accelerations at another.
fn ahead<R: Real, const N: usize>(
    x: &State<R, N, N>,
    rates: &State<R, N, N>,
    h: R,
) -> State<R, N, N> {
    State {
        q: core::array::from_fn(|k| x.q[k] + h * rates.qd[k]),
        qd: core::array::from_fn(|k| x.qd[k] + h * rates.qdd[k]),
        qdd: [R::ZERO; N],
    }
}

fn runge_kutta<R: Real, E: Effect<R, 2, 2>, const M: usize>(
    robot: &ArmModel<R, 2>,
    modes: &Modes<R, M>,
    joints: &mut State<R, 2, 2>,
    bent: &mut State<R, M, M>,
    scene: &E,
    h: R,
) {
    let slopes = |joints: &mut State<R, 2, 2>, bent: &mut State<R, M, M>| {
        let found = forward_dynamics(robot, modes, &*joints, bent, &[R::ZERO; 2], scene);
        let found = found.expect("positive definite");
        (joints.qdd, bent.qdd) = (found.joints, found.modes);
    };
    let half = h * number(0.5);
    slopes(joints, bent);
    let (mut j2, mut b2) = (ahead(joints, joints, half), ahead(bent, bent, half));
    slopes(&mut j2, &mut b2);
    let (mut j3, mut b3) = (ahead(joints, &j2, half), ahead(bent, &b2, half));
    slopes(&mut j3, &mut b3);
    let (mut j4, mut b4) = (ahead(joints, &j3, h), ahead(bent, &b3, h));
    slopes(&mut j4, &mut b4);
    *joints = mean([joints, &j2, &j3, &j4], h);
    *bent = mean([bent, &b2, &b3, &b4], h);
}

fn mean<R: Real, const N: usize>(x: [&State<R, N, N>; 4], h: R) -> State<R, N, N> {
    let sixth = h * number(1.0 / 6.0);
    let of = |a: [R; 4]| (a[0] + (a[1] + a[2]) * number(2.0) + a[3]) * sixth;
    State {
        q: core::array::from_fn(|k| x[0].q[k] + of(x.map(|x| x.qd[k]))),
        qd: core::array::from_fn(|k| x[0].qd[k] + of(x.map(|x| x.qdd[k]))),
        qdd: [R::ZERO; N],
    }
}

pub(super) fn fast_mode() -> Vec<Row> {
    fn run<R: Scalar>(rows: &mut Vec<Row>, bound: f64) {
        let soft = UPPER.link(0, &[Shape::BendZ(1)]).expect("a beam");
        let omega2 = soft.stiffness[0][0] / soft.products[0][0][2][2];
        let stiffer = (core::f64::consts::TAU * 1e4).powi(2) / omega2;
        let beam = UPPER.bending([4.0 * stiffer; 2]);
        let (robot, modes) = one::<R, 1>(&beam);
        let scene = (Inertia, Coriolis, Elasticity);
        let (mut joint, mut bent) = (State::at([R::ZERO]), State::at([R::ZERO]));
        let inertia = {
            let [_, _, _, yy, _, _] = beam.inertia();
            yy + beam.mass() * beam.com()[0].powi(2)
        };
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for n in 1..=1000 {
            step(&robot, &modes, &mut joint, &mut bent, &[R::ONE], &scene, number(1e-3))
                .expect("stable");
            let t = f64::from(n) * 1e-3;
            let turned = 0.5 * t * t / inertia;
            worst = worst.max((joint.q[0].to_f64() - turned).abs() / (0.5 / inertia));
            largest = largest.max(bent.q[0].to_f64().abs());
        }
        rows.push(Row::measured("angle, of the last", R::NAME, worst, bound));
        // Twice the static deflection under the tip's acceleration, and what rotation adds.
        rows.push(Row::claim("deflection below 10 µm", R::NAME, largest < 1e-5));
        let (mut joint, mut bent) = (State::at([R::ZERO]), State::at([R::ZERO]));
        for _ in 0..20 {
            let Ok(found) = forward_dynamics(&robot, &modes, &joint, &bent, &[R::ONE], &scene)
            else {
                break;
            };
            let h = number::<R>(1e-3);
            joint.qd[0] += h * found.joints[0];
            joint.q[0] += h * joint.qd[0];
            bent.qd[0] += h * found.modes[0];
            bent.q[0] += h * bent.qd[0];
        }
        let blown = bent.q[0].to_f64().abs();
        rows.push(Row::naive("an explicit step: deflection, m, after 20", R::NAME, blown, 1.0));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, 1e-6);
    run::<f64>(&mut rows, 5e-9);
    rows
}
