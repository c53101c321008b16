//! Prints the digests of 100 arms under injected faults, as the firmware's bin `fault_runs` does.

use fixtures::faults::{Setup, one};

fn main() {
    for seed in 0..100 {
        match one(seed, Setup::SOUND, |_| ()) {
            (name, Ok(outcome)) => {
                println!("run {seed} {name} {} faults {:016x}", outcome.injected, outcome.digest.0)
            }
            (name, Err(why)) => println!("run {seed} {name} {why}"),
        }
    }
}
