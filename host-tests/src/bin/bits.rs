//! Prints the digests of the dynamics' results, as the firmware's bin `bits` does.

use firmware_demo::bits::digests;

fn main() {
    digests(|robot, quantity, digest| println!("bits {robot} {quantity} {:016x}", digest.0));
}
