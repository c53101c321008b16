//! Prints the library's robots as JSON for `host-tests/oracle/record.py`.

use dynamics_core::model::Robot;
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use host_tests::export::robot;

fn main() -> serde_json::Result<()> {
    let robots = [
        robot(&Ur5e::MODEL),
        robot(&Panda::MODEL),
        robot(&Iiwa14::MODEL),
        robot(&A1::MODEL),
    ];
    println!("{}", serde_json::to_string(&robots)?);
    Ok(())
}
