//! Claims about the scene `so101_learn`, in f32 as in the firmware. `TABLES_WRITE=1` writes what the firmware knows.

use trial_tests::learning::{ERROR, LOAD_ERRORS, both, of_load};
use trial_tests::select::{FILE, known, selected, source, truth};

#[test]
fn the_firmware_knows_what_the_selection_gives() {
    let fresh = source();
    if std::env::var_os("TABLES_WRITE").is_some() {
        std::fs::write(FILE, &fresh).expect("written");
    }
    let written = std::fs::read_to_string(FILE).expect("a file");
    assert!(written == fresh, "{FILE}: TABLES_WRITE=1 writes it");
}

#[test]
fn in_half_a_minute_24_parameters_that_are_30_percent_off_give_torques_within_5_percent() {
    for seed in 1..4 {
        for (friction, outcome) in both(&known(seed)) {
            let [[before, _], [after, worst]] = outcome.errors;
            println!("{seed} {friction}: {outcome:?}");
            assert!(before > 0.2 && after < ERROR && worst < 0.1, "{outcome:?}");
            // What the learned model lacks of the gears' friction counts as load.
            let [mass, centre] = of_load(&outcome);
            assert!(mass < 0.35 && centre < 0.04, "{outcome:?}");
        }
    }
}

#[test]
fn a_load_is_found_within_2_percent_and_5_mm_by_an_exact_model() {
    for (friction, outcome) in both(&selected(truth())) {
        let [mass, centre] = of_load(&outcome);
        println!("{friction}: {mass} {centre}");
        assert!(
            mass < LOAD_ERRORS[0] && centre < LOAD_ERRORS[1],
            "{outcome:?}"
        );
    }
}
