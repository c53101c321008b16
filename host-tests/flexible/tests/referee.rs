//! Links that bend against a referee that has no modal integrals: forces on the beams' points in 50 digits, and finite
//! elements of 40 to a link (`host-tests/oracle/beam.py`).

use std::fmt::Write;

use dynamics_core::effects::{Elasticity, RIGID_BODY};
use dynamics_core::flexible::{
    Beam, FlexibleLink, ModalFeedforward, Modes, Shape, crba, modal_dynamics, rnea,
};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
use dynamics_core::state::State;
use flexible_tests::{LOWER, PLANAR, Planar, SPATIAL, Spatial, UPPER, recording::*};

/// The largest difference over the largest number.
fn error<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> f64 {
    let (worst, scale) = pairs.fold((0.0, 0.0), |(worst, scale), (a, b)| {
        (f64::max(worst, (a - b).abs()), f64::max(scale, b.abs()))
    });
    worst / scale
}

fn dynamics<const M: usize>(name: &str, model: &ArmModel<f64, 2>, modes: &Modes<f64, M>) {
    let recorded = &recording().dynamics[name];
    let array = |row: &Vec<f64>| <[f64; 2]>::try_from(&row[..]).expect("two joints");
    let many = |row: &Vec<f64>| <[f64; M]>::try_from(&row[..]).expect("the robot's modes");
    let (mut tau, mut of_modes) = (Vec::new(), Vec::new());
    for k in 0..recorded.q.len() {
        let state = State {
            q: array(&recorded.q[k]),
            qd: array(&recorded.qd[k]),
            qdd: array(&recorded.qdd[k]),
        };
        let bent = State {
            q: many(&recorded.eta[k]),
            qd: many(&recorded.etad[k]),
            qdd: many(&recorded.etadd[k]),
        };
        let found = rnea(model, modes, &state, &bent, &RIGID_BODY);
        tau.extend(found.joints);
        of_modes.extend(found.modes);
        let energy =
            crba(model, modes, &state.q, &bent.q, &RIGID_BODY).kinetic_energy(&state.qd, &bent.qd);
        assert!(
            (energy / recorded.kinetic[k] - 1.0).abs() < 1e-12,
            "{name} {k}: {energy}"
        );
    }
    let joints = error(tau.iter().zip(recorded.tau.iter().flatten()));
    let modal = error(of_modes.iter().zip(recorded.modal.iter().flatten()));
    println!("{name}: joints {joints:.1e}, modes {modal:.1e} of full scale");
    assert!(
        joints < 1e-13 && modal < 1e-13,
        "{name}: {joints:.1e} {modal:.1e}"
    );
    // A difference of a part in 10⁹ is found.
    let first = &mut tau[0];
    *first += 1e-9
        * recorded
            .tau
            .iter()
            .flatten()
            .fold(0.0, |a, b| f64::max(a, b.abs()));
    assert!(error(tau.iter().zip(recorded.tau.iter().flatten())) > 5e-10);
}

#[test]
fn inverse_dynamics_is_that_of_the_beams_points() {
    dynamics("planar", &Planar::MODEL, &PLANAR);
    dynamics("spatial", &Spatial::MODEL, &SPATIAL);
}

fn beams() -> [(&'static str, Beam); 4] {
    [
        ("upper", UPPER),
        ("fore", LOWER),
        ("plain", Beam::new(1.0, 1.0).bending([1.0, 1.0])),
        (
            "heavy",
            Beam::new(1.0, 1.0).bending([1.0, 1.0]).tip(10.0, 0.0),
        ),
    ]
}

/// ω and modal mass of mode k.
fn vibration(link: &FlexibleLink, k: usize) -> [f64; 2] {
    let [[xx, _, _], [_, yy, _], [_, _, zz]] = link.products[k][k];
    let mass = xx + yy + zz;
    [(link.stiffness[k][k] / mass).sqrt(), mass]
}

#[test]
fn frequencies_and_slopes_of_beams_are_those_of_finite_elements() {
    let recorded = &recording().frequencies;
    let mut worst = 0.0;
    for (name, beam) in beams() {
        let of = &recorded.bending[name];
        let shapes = [1, 2, 3, 4].map(Shape::BendZ);
        let link = beam.link(0, &shapes).expect("a beam");
        for k in 0..4 {
            let [omega, mass] = vibration(&link, k);
            let ratios = [
                omega / of.omega[k],
                mass / of.modal_mass[k],
                -link.modes[k].turn[1] / of.tip_slope[k],
            ];
            for ratio in ratios {
                worst = f64::max(worst, (ratio - 1.0).abs());
            }
        }
    }
    for (name, beam) in beams().into_iter().take(2) {
        let of = &recorded.torsion[name];
        let link = beam
            .link(0, &[1, 2, 3, 4].map(Shape::Twist))
            .expect("a rod");
        for k in 0..4 {
            let [omega, mass] = vibration(&link, k);
            worst = f64::max(worst, (omega / of.omega[k] - 1.0).abs());
            worst = f64::max(worst, (mass / of.modal_mass[k] - 1.0).abs());
        }
    }
    println!("frequencies, modal masses and slopes: {worst:.1e}");
    assert!(worst < 1e-10, "{worst:.1e}");
}

/// A link on one joint about y.
struct One(ArmModel<f64, 1>);

impl One {
    fn new(beam: &Beam) -> Self {
        Self(ArmModel::new(
            "one",
            [Body::new("link", BASE, Joint::revolute([0.0, 1.0, 0.0]))
                .mass(beam.mass())
                .com(beam.com())
                .inertia(beam.inertia())],
        ))
    }

    fn modes<const M: usize>(&self, beam: &Beam) -> Modes<f64, M> {
        let shapes: [Shape; M] = core::array::from_fn(|k| Shape::BendZ(k + 1));
        let link = beam.link(0, &shapes).expect("a beam");
        Modes::try_new(&self.0, &[link]).expect("modes of a beam")
    }
}

/// The tip's deflection at rest, and the relative difference from the whole beam's.
fn sag<const M: usize>(beam: &Beam, recorded: &Static) -> [f64; 2] {
    let one = One::new(beam);
    let modes = one.modes::<M>(beam);
    let rest = ModalFeedforward::at_rest(&one.0, &modes, &[0.0], &(RIGID_BODY, Elasticity));
    let tip: f64 = rest.expect("stiffness").bent.q.iter().sum();
    let whole = recorded.x_deflection_slope[3][1];
    [
        tip / recorded.tip_of_modes[M - 1] - 1.0,
        (tip / whole - 1.0).abs(),
    ]
}

#[test]
fn static_sag_converges_to_the_beams_as_modes_are_added() {
    let mut page = String::new();
    for (name, beam) in beams().into_iter().take(2) {
        let recorded = &recording().r#static[name];
        let all = [
            sag::<1>(&beam, recorded),
            sag::<2>(&beam, recorded),
            sag::<3>(&beam, recorded),
            sag::<4>(&beam, recorded),
            sag::<5>(&beam, recorded),
            sag::<6>(&beam, recorded),
        ];
        let _ = write!(page, "{name}: static tip by 1 to 6 modes:");
        for (m, [same, rest]) in all.into_iter().enumerate() {
            let _ = write!(page, " {rest:.1e}");
            assert!(same.abs() < 1e-10, "{name}, {m} modes: {same:.1e}");
            assert!(
                m < 2 || rest < all[m - 2][1],
                "{name}, {m} modes: {rest:.1e}"
            );
        }
        page.push('\n');
        assert!(all[0][1] < 0.03 && all[5][1] < 1e-5, "{name}");
    }
    println!("{page}");
}

/// Tip and torque at the recorded times, of M modes.
fn forced<const M: usize>(beam: &Beam, recorded: &Forced) -> Vec<[f64; 2]> {
    let (one, scene) = (One::new(beam), (RIGID_BODY, Elasticity));
    let modes = one.modes::<M>(beam);
    let at = |t: f64| {
        let (u, d) = ((t / recorded.duration).min(1.0), recorded.duration);
        let [q, qd, qdd] = [
            u.powi(3) * (10.0 + u * (-15.0 + 6.0 * u)),
            30.0 * (u * (1.0 - u)).powi(2) / d,
            60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (d * d),
        ]
        .map(|x| [recorded.angle * x]);
        State { q, qd, qdd }
    };
    let accelerate = |t: f64, bent: &State<f64, M, M>| {
        modal_dynamics(&one.0, &modes, &at(t), bent, &scene).expect("positive definite")
    };
    let rest = ModalFeedforward::at_rest(&one.0, &modes, &[0.0], &scene);
    let (mut bent, mut t) = (rest.expect("stiffness").bent, 0.0);
    let mut rows = Vec::new();
    for &until in &recorded.t {
        // Runge-Kutta 4, 1000 steps a period of the highest mode.
        let omega = vibration(&beam.link(0, &[Shape::BendZ(M)]).expect("a beam"), 0)[0];
        let steps = ((until - t) * omega * 160.0).ceil().max(1.0);
        let h = (until - t) / steps;
        for _ in 0..steps as usize {
            bent = runge_kutta(&bent, t, h, &accelerate);
            t += h;
        }
        t = until;
        bent.qdd = accelerate(t, &bent);
        let tau = rnea(&one.0, &modes, &at(t), &bent, &scene).joints[0];
        rows.push([bent.q.iter().sum(), tau]);
    }
    rows
}

fn runge_kutta<const M: usize>(
    x: &State<f64, M, M>,
    t: f64,
    h: f64,
    accelerate: impl Fn(f64, &State<f64, M, M>) -> [f64; M],
) -> State<f64, M, M> {
    let ahead = |rate: &[f64; M], acceleration: &[f64; M], h: f64| State {
        q: core::array::from_fn(|k| x.q[k] + h * rate[k]),
        qd: core::array::from_fn(|k| x.qd[k] + h * acceleration[k]),
        qdd: [0.0; M],
    };
    let a1 = accelerate(t, x);
    let x2 = ahead(&x.qd, &a1, 0.5 * h);
    let a2 = accelerate(t + 0.5 * h, &x2);
    let x3 = ahead(&x2.qd, &a2, 0.5 * h);
    let a3 = accelerate(t + 0.5 * h, &x3);
    let x4 = ahead(&x3.qd, &a3, h);
    let a4 = accelerate(t + h, &x4);
    let mean = |k: usize, [a, b, c, d]: [&[f64; M]; 4]| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0;
    State {
        q: core::array::from_fn(|k| x.q[k] + h * mean(k, [&x.qd, &x2.qd, &x3.qd, &x4.qd])),
        qd: core::array::from_fn(|k| x.qd[k] + h * mean(k, [&a1, &a2, &a3, &a4])),
        qdd: [0.0; M],
    }
}

#[test]
fn forced_motion_is_that_of_finite_elements_as_far_as_the_modes_allow() {
    let recorded = &recording().forced;
    let mut truncation = Vec::new();
    let runs = [
        forced::<1>(&UPPER, recorded),
        forced::<2>(&UPPER, recorded),
        forced::<3>(&UPPER, recorded),
    ];
    for (m, rows) in runs.iter().enumerate() {
        let [tips, torques] = [0, 1].map(|k| rows.iter().map(|row| row[k]).collect::<Vec<_>>());
        let tip = error(tips.iter().zip(&recorded.tip_of_modes[m]));
        let torque = error(torques.iter().zip(&recorded.torque_of_modes[m]));
        let whole = error(tips.iter().zip(&recorded.tip));
        println!(
            "{} modes: tip {tip:.1e}, torque {torque:.1e}; of the whole beam {whole:.1e}",
            m + 1
        );
        assert!(tip < 1e-9 && torque < 1e-9, "{m}: {tip:.1e} {torque:.1e}");
        truncation.push(whole);
    }
    assert!(
        truncation.windows(2).all(|pair| pair[1] < pair[0]),
        "{truncation:?}"
    );
}
