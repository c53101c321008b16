//! Claims about an SO-101 that learns its parameters and weighs its load, in f32 as in firmware.
//! `TABLES_WRITE=1` writes what the firmware knows.

use simulation_tests::learning::arm::{BRISTLES, SMOOTH};
use simulation_tests::learning::parameters::Known;
use simulation_tests::learning::run::{LOAD, Outcome, run};
use simulation_tests::learning::select::{FILE, known, selected, source, truth};

/// The required error of the torques.
const ERROR: f32 = 0.05;
/// The errors of a load: of its mass, as a share, and of its centre, m.
const LOAD_ERRORS: [f32; 2] = [0.02, 5e-3];

/// The outcomes of an arm with either kind of friction.
fn both(known: &Known) -> [(&'static str, Outcome); 2] {
    let smooth = run(known, SMOOTH, |_, _, _| ()).expect("a run");
    let sticking = run(known, BRISTLES, |_, _, _| ()).expect("a run");
    [("Coulomb", smooth), ("LuGre", sticking)]
}

/// The errors of a load as in [`LOAD_ERRORS`].
fn of_load(outcome: &Outcome) -> [f32; 2] {
    let [mass, off] = outcome.load;
    [(mass / LOAD.mass - 1.0).abs(), off]
}

#[test]
fn the_firmware_file_is_that_of_the_selection() {
    let fresh = source();
    if std::env::var_os("TABLES_WRITE").is_some() {
        std::fs::write(FILE, &fresh).expect("written");
    }
    let written = std::fs::read_to_string(FILE).expect("a file");
    assert!(written == fresh, "{FILE}: TABLES_WRITE=1 writes it");
}

// 24 parameters start 30 % off and are learned in half a minute.
#[test]
fn learned_parameters_give_torques_within_5_percent() {
    for seed in 1..4 {
        for (friction, outcome) in both(&known(seed)) {
            let [[before, _], [after, worst]] = outcome.errors;
            println!("{seed} {friction}: {outcome:?}");
            assert!(before > 0.2 && after < ERROR && worst < 0.1, "{outcome:?}");
            // The part of the gears' friction that the learned model lacks counts as load.
            let [mass, centre] = of_load(&outcome);
            assert!(mass < 0.35 && centre < 0.04, "{outcome:?}");
        }
    }
}

// The mass is within 2 % and the centre of mass within 5 mm.
#[test]
fn an_exact_model_finds_the_load() {
    for (friction, outcome) in both(&selected(truth())) {
        let [mass, centre] = of_load(&outcome);
        println!("{friction}: {mass} {centre}");
        assert!(
            mass < LOAD_ERRORS[0] && centre < LOAD_ERRORS[1],
            "{outcome:?}"
        );
    }
}
