//! Prints the spanning trees of robots with clusters as JSON for `host-tests/oracle/clusters.py`.

use dynamics_core::model::Robot;
use firmware_demo::robots::{AnkleLeg, FourBarLeg, StewartPlatform};
use host_tests::export::robot;
use loop_tests::clusters::{DeltaRobot, FiveBarLeg, Geared, Wrist};

fn main() -> serde_json::Result<()> {
    let robots = [
        robot(&FourBarLeg::MODEL),
        robot(&FiveBarLeg::MODEL),
        robot(&AnkleLeg::MODEL),
        robot(&DeltaRobot::MODEL),
        robot(&StewartPlatform::MODEL),
        robot(&Wrist::MODEL),
        robot(&Geared::MODEL),
    ];
    println!("{}", serde_json::to_string(&robots)?);
    Ok(())
}
