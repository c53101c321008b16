//! Axes that coincide, and axes that are parallel.

use super::masses::refusals;
use super::measure::{ErrorBounds, against_oracle, by_joints};
use super::setup::list::arm;
use super::setup::{turning, widened};
use dynamics_core::algorithms::{aba, cholesky, crba, ltdl, rnea};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::hard::{GRAVITY, N, scene};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;
use host_tests::random::{random_numbers, within};
use proptest::test_runner::TestRng;

const ORACLE: &str = "computation in 50 digits from the same f32 bits (oracle/hard.py)";

pub const CASES: &[Case] = &[
    Case {
        number: 20,
        name: "coincident axes, no link between",
        parameters: "UR5e, wrist 2 massless and wrist 3 on its axis, four states; 1000 chains of \
            four links, one massless between two joints on one axis of any direction",
        source: "a roll joint after a continuous joint, a dummy link between them",
        oracle: ORACLE,
        reason: "RNEA has no inverse. A pivot of at most 32 times the rounding error of M's \
            diagonal entry, or eight times that of the largest inertia that its joint could move, \
            is a rounding error of zero, whatever the robot's size",
        run: coincident,
    },
    Case {
        number: 21,
        name: "parallel axes",
        parameters: "six rods of 1 kg and 1 m on parallel axes in a vertical plane, four states",
        source: "planar arms use every spatial inertia in one plane only",
        oracle: "50 digits, and the planar closed form in absolute angles, in f64",
        reason: "κ ε = 2·10⁻⁴ in f32 for accelerations; torques are rounded as in any other arm",
        run: planar,
    },
];

/// A chain of four whose joints 1 and 2 lie on one axis, with nothing on the first of them.
fn twofold(rng: &mut TestRng) -> ArmModel<f64, 4> {
    let (axis, place): ([f64; 3], [f64; 3]) = (within(rng, 1.0), within(rng, 0.5));
    let [along] = within(rng, 1.0);
    let body = |parent, axis| {
        Body::new("link", parent, Joint::revolute(axis))
            .mass(1.5)
            .com(place)
            .inertia([0.1, 0.01, 0.02, 0.1, 0.0, 0.15])
    };
    Model::new(
        "twofold",
        [
            body(BASE, [0.3, 0.4, 1.0]),
            Body::new("nothing", 0, Joint::revolute(axis)).xyz(place).rpy(place),
            body(1, axis).xyz(axis.map(|a: f64| a * along)),
            body(2, [0.1, 1.0, 0.2]).xyz(place).rpy(place),
        ],
    )
}

/// The number of algorithms among LᵀDL, Cholesky's method and ABA that do not name joint 1.
fn unnamed<R: Real>(arm: &ArmModel<R, 4>, q: &[R; 4], counts: &mut [u32; 3]) {
    let arm = &turning(arm);
    let m = crba(arm, q, &RIGID_BODY);
    let by_bodies = aba(arm, &State::at(*q), &[R::ONE; 4], &RIGID_BODY).err();
    let named = [ltdl(arm, &m).err(), cholesky(arm, &m).err(), by_bodies];
    for (count, error) in counts.iter_mut().zip(named) {
        *count += u32::from(error.is_none_or(|error| error.joint != 1));
    }
}

fn coincident() -> Vec<Row> {
    let setup = arm(20, "coincident axes");
    let truth = setup.truth();
    let answers = setup.answers(&truth);
    let single = answers.iter().map(|(a, _)| Ok(a.rnea));
    let double = answers.iter().map(|(_, a)| Ok(a.rnea));
    let single = by_joints(single, &truth.states, |t| Some(&t.rnea));
    let double = by_joints(double, &truth.states, |t| Some(&t.rnea));
    let mut rows = vec![
        Row::measured("RNEA", "f32", single, 4e-7),
        Row::measured("RNEA", "f64", double, 1e-15),
    ];
    let quantities = ["CRBA + LᵀDL", "ABA", "OSIM⁻¹ by bodies", "OSIM⁻¹ by J M⁻¹ Jᵀ"];
    for (k, quantity) in quantities.into_iter().enumerate() {
        let single = answers.iter().all(|(a, _)| refusals(a)[k].is_some());
        let double = answers.iter().all(|(_, a)| refusals(a)[k].is_some());
        let quantity = format!("{quantity}: not positive definite");
        rows.push(Row::claim(&quantity, "f32", single));
        rows.push(Row::claim(&quantity, "f64", double));
    }
    let (mut single, mut double, mut rng) = ([0; 3], [0; 3], random_numbers());
    for _ in 0..1000 {
        let arm = twofold(&mut rng);
        let q: [f64; 4] = within(&mut rng, 3.0);
        unnamed(&arm, &q, &mut double);
        unnamed(&arm.to_f32(), &q.map(|x| x as f32), &mut single);
    }
    let names = ["LᵀDL", "Cholesky's method", "ABA"];
    for ((name, single), double) in names.into_iter().zip(single).zip(double) {
        let text = format!("{name}: singular M not named, of 1000 any way round");
        rows.push(Row::stated(&text, "f32", f64::from(single), 0.0));
        rows.push(Row::stated(&text, "f64", f64::from(double), 0.0));
    }
    rows
}

/// Torques of rods of 1 kg and 1 m about axes along y, φ downwards, in absolute angles: the
/// outermost first moment is m/2, and every rod carries those beyond it at its end.
fn closed_form(state: &State<f64, N, N>, about_centre: f64) -> [f64; N] {
    let sums = |row: [f64; N]| {
        let mut sum = 0.0;
        row.map(|x| {
            sum += x;
            sum
        })
    };
    let (angle, rate, accel) = (sums(state.q), sums(state.qd), sums(state.qdd));
    let beyond = |i: usize| (N - 1 - i) as f64;
    let moment = |i: usize| beyond(i) + 0.5;
    let mut tau = [0.0; N];
    for i in 0..N {
        // The rod hangs down by sin φ: gravity turns it on.
        tau[i] = -moment(i) * GRAVITY * angle[i].cos();
        for j in 0..N {
            let shared = match i == j {
                true => beyond(i) + 0.25 + about_centre,
                false => moment(i.max(j)),
            };
            let (s, c) = (angle[i] - angle[j]).sin_cos();
            tau[i] += shared * (c * accel[j] + s * rate[j] * rate[j]);
        }
    }
    for i in (0..N - 1).rev() {
        tau[i] += tau[i + 1];
    }
    tau
}

fn planar() -> Vec<Row> {
    let setup = arm(21, "parallel axes");
    let mut rows = against_oracle(&setup, &PARALLEL);
    // 1/3 and 1/12 as f32 rounds them, about the rod's end and about its centre.
    let about_centre = setup.double.links[0].inertia.rotational.z_axis.z - 0.25;
    let (single, double) = (scene(&setup.extras), scene(&setup.extras));
    let (mut f32s, mut f64s, mut full) = (0.0, 0.0, 0.0_f64);
    for state in &setup.states {
        let wide = widened(state);
        let truth = closed_form(&wide, about_centre);
        let (a, b) = (
            rnea(&turning(&setup.single), state, &single),
            rnea(&turning(&setup.double), &wide, &double),
        );
        for i in 0..N {
            full = full.max(truth[i].abs());
            f32s = larger(f32s, (f64::from(a[i]) - truth[i]).abs());
            f64s = larger(f64s, (b[i] - truth[i]).abs());
        }
    }
    let name = "RNEA against the planar closed form";
    rows.push(Row::measured(name, "f32", f32s / full, CLOSED[0]));
    rows.push(Row::measured(name, "f64", f64s / full, CLOSED[1]));
    rows
}

const CLOSED: [f64; 2] = [1.5e-7, 5e-16];

const PARALLEL: ErrorBounds = ErrorBounds {
    single: [5e-7, 6e-5, 1.5e-5, 6e-6, 2e-6],
    double: [6e-16, 8e-14, 3e-14, 4e-15, 4e-15],
};
