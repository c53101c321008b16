//! The motion that is chosen.

use dynamics_core::state::State;
use identification::{FourierMotion, Search};
use motion_control::reference::Reference;
use nalgebra::DMatrix;

use crate::generated::Ur5eExcitation;
use crate::setup::*;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/generated/ur5e_excitation.rs");

fn search(search: Search) -> (FourierMotion<6>, f64) {
    let found = search.run(&*ARM, |_| true, |_| ()).expect("a motion");
    (found.motion, found.condition)
}

/// The condition numbers of random motions that use the limits fully, in order.
fn random() -> Vec<f64> {
    let one = |seed| search(Search { starts: 1, fresh: 1, steps: 0, seed, ..SEARCH }).1;
    let mut all: Vec<f64> = (0..100).map(one).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// `EXCITATION_WRITE=1` writes the file of the firmware.
#[test]
#[cfg_attr(debug_assertions, ignore = "a search takes long")]
fn the_search_is_repeatable_and_as_good_as_recorded() {
    let brief = Search { starts: 1, steps: 30, ..SEARCH };
    assert_eq!(search(brief), search(brief));
    let (motion, condition) = search(SEARCH);
    if std::env::var_os("EXCITATION_WRITE").is_some() {
        std::fs::write(FILE, source(&motion)).expect("written");
    }
    let kept = ARM.condition(&states(&CHOSEN, SEARCH.samples as u32));
    assert!(condition < 1.3 * kept, "{condition} {kept}");
}

fn source(motion: &FourierMotion<6>) -> String {
    motion.rust_source("Ur5eExcitation", TICK, PERIODS as u32)
}

// It is better conditioned, and a pick and place does not show all parameters.
#[test]
fn the_chosen_motion_beats_100_random_ones() {
    let chosen = ARM.condition(&states(&CHOSEN, 500));
    let work = ARM.condition(&pick_and_place());
    let random = random();
    let [best, median, worst] = [random[0], random[50], random[99]];
    println!("chosen {chosen}; best {best}, median {median} and worst {worst} of random ones");
    // A joint rests: the number is one of rounding.
    assert!(work > 1e6, "{work}");
    assert!(chosen < 0.8 * best && best < 0.5 * median && worst > 2.0 * median);
}

#[test]
fn the_condition_number_is_that_of_the_singular_values() {
    let states = states(&CHOSEN, 60);
    let mut rows = DMatrix::zeros(6 * 60, ARM.len());
    for (k, state) in states.iter().enumerate() {
        for (j, row) in ARM.rows(state).iter().enumerate() {
            for (i, y) in row.iter().enumerate() {
                rows[(6 * k + j, i)] = y / RATED[j];
            }
        }
    }
    // Without the scale of the columns another number, of which each factor is between the least
    // and the greatest scale.
    let values = rows.singular_values();
    let unscaled = values.max() / values.min();
    for (i, unit) in ARM.scales().iter().enumerate() {
        rows.column_mut(i).scale_mut(1.0 / unit);
    }
    let values = rows.singular_values();
    let expected = values.max() / values.min();
    let found = ARM.condition(&states);
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    assert!(unscaled > 5.0 * found, "{unscaled}");
}

#[test]
fn each_joint_reaches_a_limit_and_exceeds_none() {
    let at_start = CHOSEN.at(0.0);
    let rates = at_start.qd.into_iter().chain(at_start.qdd);
    assert!(rates.fold(0.0, |most, rate| rate.abs().max(most)) < 1e-5);
    let mut shares = [0.0_f64; 6];
    for state in states(&CHOSEN, 20_000) {
        for (j, most) in shares.iter_mut().enumerate() {
            let middle = 0.5 * (LIMITS.lower[j] + LIMITS.upper[j]);
            let half = 0.5 * (LIMITS.upper[j] - LIMITS.lower[j]);
            let share = [
                (state.q[j] - middle).abs() / half,
                state.qd[j].abs() / LIMITS.velocity[j],
                state.qdd[j].abs() / LIMITS.acceleration[j],
            ];
            *most = share.into_iter().fold(*most, f64::max);
        }
    }
    assert!(shares.iter().all(|share| (0.98..1.0001).contains(share)), "{shares:?}");
}

// Its reference in f32 follows the motion.
#[test]
fn the_firmware_file_agrees_with_the_motion() {
    let file = std::fs::read_to_string(FILE).expect("the file");
    assert_eq!(file, source(&CHOSEN));
    let host = CHOSEN.reference(TICK, PERIODS as u32);
    let end = Reference::<f64, 6>::ticks(&host);
    assert_eq!(Ur5eExcitation.ticks(), end);
    let mut most = 0.0_f64;
    for tick in (0..=end + 10).step_by(7) {
        let expected: State<f64, 6, 6> = host.at(tick);
        let found = Ur5eExcitation.at(tick);
        let pairs = [(expected.q, found.q), (expected.qd, found.qd), (expected.qdd, found.qdd)];
        for (expected, found) in pairs {
            let off = expected.iter().zip(found).map(|(x, y)| (x - f64::from(y)).abs());
            most = off.fold(most, f64::max);
        }
    }
    assert!((1e-7..2e-5).contains(&most), "{most}");
    assert_eq!(Ur5eExcitation.at(end).qd, [0.0; 6]);
}

// If none is clear there is no motion.
#[test]
fn the_search_keeps_to_clear_configurations() {
    let brief = Search { starts: 1, fresh: 60, steps: 30, ..SEARCH };
    let clear = |q: &[f64; 6]| q[0] < 1.6;
    let found = brief.run(&*ARM, clear, |_| ()).expect("a motion");
    assert!(states(&found.motion, SEARCH.samples as u32).iter().all(|state| clear(&state.q)));
    assert!(brief.run(&*ARM, |_| false, |_| ()).is_none());
}
