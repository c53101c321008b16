//! Prints the digests of the dynamics' results, as the firmware's bin `bits` does.

use fixtures::{hard, recorded};

fn main() {
    recorded::digests(|robot, quantity, digest| {
        println!("bits {robot} {quantity} {:016x}", digest.0)
    });
    hard::digests(|case, name, digest| println!("bits hard {case} {name} {:016x}", digest.0));
}
