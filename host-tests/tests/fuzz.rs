//! The fuzz targets on a fixed stream of bytes: the bounded run of the package `host-tests/fuzz`.
//! The package `simulation-tests`, which is optimised, has more of them.

use crate::common::few_or_many;
use host_tests::fuzz::{BYTES_PER_FRAME, can_frames, controller, description, dynamics, frames};
use host_tests::random::random_numbers;
use proptest::prelude::RngExt;

fn run(target: fn(&[u8]), inputs: usize) {
    let rng = &mut random_numbers();
    for _ in 0..inputs {
        let length = rng.random_range(0..512);
        let bytes: Vec<u8> = (0..length).map(|_| rng.random()).collect();
        target(&bytes);
    }
}

#[test]
fn no_description_breaks_what_is_accepted() {
    run(description, few_or_many(4_000, 20_000));
}

#[test]
fn no_state_breaks_the_dynamics() {
    run(dynamics, few_or_many(2_000, 10_000));
}

#[test]
fn no_inputs_drive_the_controller_beyond_its_limits() {
    run(controller, few_or_many(40, 300));
}

#[test]
fn no_frame_is_mistaken_for_another() {
    run(frames, 2_000);
}

#[test]
fn no_frame_of_a_drive_says_or_does_what_it_should_not() {
    let rng = &mut random_numbers();
    // Many are 10⁷ replies and as many commands.
    let mut bytes = vec![0; 1_000 * BYTES_PER_FRAME];
    for _ in 0..few_or_many(100, 10_000) {
        rng.fill(&mut bytes[..]);
        can_frames(&bytes);
    }
}
