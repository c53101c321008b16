//! Links that bend against a referee that has no modal integrals: forces on the beams' points in 50
//! digits, and finite elements of 40 to a link (`host-tests/oracle/beam.py`).

use std::fmt::Write;

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::flexible::{Beam, Bending, BendingRobot, ModeProblem, Shape};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use flexible_tests::recording::{Static, recording};
use flexible_tests::referee::{error, forced, inverse, kinetic, sag, vibration};
use flexible_tests::{LOWER, Planar, Spatial, UPPER};

fn dynamics<T: BendingRobot<2, 2, 2, M>, const M: usize>(name: &str) {
    let recorded = &recording().dynamics[name];
    let energies = kinetic::<f64, M>(recorded, &T::MODEL, &T::MODES);
    for (k, (energy, recorded)) in energies.iter().zip(&recorded.kinetic).enumerate() {
        assert!((energy / recorded - 1.0).abs() < 1e-12, "{name} {k}: {energy}");
    }
    let by_core = |q: &State<f64, 2, 2>, eta: &_| Bending::<Core<T>>::rnea(q, eta, &RIGID_BODY);
    compared(name, inverse(recorded, by_core));
    let folded = |q: &State<f64, 2, 2>, eta: &_| Bending::<Engine<T>>::rnea(q, eta, &RIGID_BODY);
    compared(name, inverse(recorded, folded));
}

fn compared(name: &str, [mut tau, of_modes]: [Vec<f64>; 2]) {
    let recorded = &recording().dynamics[name];
    let joints = error(tau.iter().zip(recorded.tau.iter().flatten()));
    let modal = error(of_modes.iter().zip(recorded.modal.iter().flatten()));
    println!("{name}: joints {joints:.1e}, modes {modal:.1e} of full scale");
    assert!(joints < 1e-13 && modal < 1e-13, "{name}: {joints:.1e} {modal:.1e}");
    // A difference of a part in 10⁹ is found.
    let first = &mut tau[0];
    *first += 1e-9 * recorded.tau.iter().flatten().fold(0.0, |a, b| f64::max(a, b.abs()));
    assert!(error(tau.iter().zip(recorded.tau.iter().flatten())) > 5e-10);
}

#[test]
fn inverse_dynamics_is_that_of_the_beams_points() {
    dynamics::<Planar, 4>("planar");
    dynamics::<Spatial, 6>("spatial");
}

fn beams() -> [(&'static str, Beam); 4] {
    [
        ("upper", UPPER),
        ("fore", LOWER),
        ("plain", Beam::new(1.0, 1.0).bending([1.0, 1.0])),
        ("heavy", Beam::new(1.0, 1.0).bending([1.0, 1.0]).tip(10.0, 0.0)),
    ]
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
        let link = beam.link(0, &[1, 2, 3, 4].map(Shape::Twist)).expect("a rod");
        for k in 0..4 {
            let [omega, mass] = vibration(&link, k);
            worst = f64::max(worst, (omega / of.omega[k] - 1.0).abs());
            worst = f64::max(worst, (mass / of.modal_mass[k] - 1.0).abs());
        }
    }
    println!("frequencies, modal masses and slopes: {worst:.1e}");
    assert!(worst < 1e-10, "{worst:.1e}");
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
            assert!(m < 2 || rest < all[m - 2][1], "{name}, {m} modes: {rest:.1e}");
        }
        page.push('\n');
        assert!(all[0][1] < 3e-3 && all[5][1] < 1e-6, "{name}");
    }
    println!("{page}");
}

/// The guide states the sag by one mode and by two: a body at the end makes a beam's shape that of
/// its first mode.
#[test]
fn a_bare_beam_needs_more_modes_for_its_sag() {
    let (length, density, stiffness, body) = (0.5_f64, 0.8, 4.0, 0.3);
    let bare = Beam::new(length, density).bending([stiffness; 2]);
    for (beam, body, of_one, of_two) in [
        (bare.tip(body, 0.0), body, 1.2e-3..1.9e-3, 5e-5..7e-5),
        (bare, 0.0, 1.2e-2..1.4e-2, 8.6e-4..9.6e-4),
    ] {
        // ρ L⁴ / 8 and m L³ / 3, times g / EI.
        let load = density * length.powi(4) / 8.0 + body * length.powi(3) / 3.0;
        let closed = -load * 9.81 / stiffness;
        let whole = Static {
            x_deflection_slope: vec![[length, closed, 0.0]; 4],
            tip_of_modes: vec![closed; 2],
        };
        let [one, two] = [sag::<1>(&beam, &whole)[1], sag::<2>(&beam, &whole)[1]];
        println!("sag by one mode {one:.2e}, by two {two:.2e}");
        assert!(of_one.contains(&one) && of_two.contains(&two), "{one:.2e}, {two:.2e}");
    }
}

#[test]
fn a_beam_of_infinite_stiffness_has_no_modes() {
    let rigid = UPPER.bending([f64::INFINITY; 2]);
    let endless = Beam::new(f64::INFINITY, 0.8).bending([4.0; 2]);
    // Finite properties of which the modes' stiffness is not.
    let overflowing = Beam::new(1e-3, 0.8).bending([1e308; 2]);
    for beam in [rigid, endless, overflowing] {
        assert_eq!(beam.link(0, &[Shape::BendZ(1)]), Err(ModeProblem::NotFinite), "{beam:?}");
    }
    let twisted = UPPER.sections([1e-5; 2]).torsion(f64::INFINITY);
    assert_eq!(twisted.link(0, &[Shape::Twist(1)]), Err(ModeProblem::NotFinite));
}

// With the same modes they differ by less than 10⁻¹⁰.
#[test]
fn forced_motion_converges_to_finite_elements_with_more_modes() {
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
        assert!(tip < 1e-10 && torque < 1e-10, "{m}: {tip:.1e} {torque:.1e}");
        truncation.push(whole);
    }
    assert!(truncation.windows(2).all(|pair| pair[1] < pair[0]), "{truncation:?}");
}
