//! Prints the machines as JSON for `host-tests/oracle/loops.py`.

use loop_tests::export::machine;
use loop_tests::machines::{Delta, FiveBar, FourBar, Stewart};

fn main() -> serde_json::Result<()> {
    let machines = [
        machine::<FourBar, 3, 3, 3, 1, 5, 1>(),
        machine::<FiveBar, 4, 4, 4, 1, 5, 2>(),
        machine::<Delta, 10, 22, 21, 6, 18, 3>(),
        machine::<Stewart, 13, 25, 24, 6, 18, 6>(),
    ];
    println!("{}", serde_json::to_string(&machines)?);
    Ok(())
}
