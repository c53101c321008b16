//! Claims about the scene `so101_learn`, in f32 as in the firmware. `TABLES_WRITE=1` writes what the firmware knows.

use lab_target::learning::tag_k::TagK;
use trial_tests::learning::{ERROR, LOAD_ERRORS, both, of_load};
use trial_tests::select::{FILE, known, selected, source, truth};

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

#[test]
fn tag_k_solves_exact_rows_and_skips_empty_ones() {
    let truth: [f32; 10] = core::array::from_fn(|i| 0.1 * i as f32 - 0.3);
    let mut found = TagK::default();
    for tick in 0..2000_u32 {
        let entry = |row: usize, k: usize| {
            let rate = (1.0 + 0.31 * row as f32) * (0.7 + 0.13 * k as f32);
            if row == 4 {
                0.0
            } else {
                (rate * tick as f32).sin()
            }
        };
        let rows: [[f32; 10]; 6] = core::array::from_fn(|i| core::array::from_fn(|k| entry(i, k)));
        let torque = |row: &[f32; 10]| row.iter().zip(&truth).map(|(y, x)| y * x).sum();
        let mut torques: [f32; 6] = rows.each_ref().map(torque);
        torques[4] = 100.0;
        found.update(&rows, &torques);
    }
    for (found, truth) in found.estimate().iter().zip(truth) {
        assert!((found - truth).abs() < 1e-4, "{found} {truth}");
    }
}
