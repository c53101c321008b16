//! Prints the library's robots as JSON for `host-tests/oracle/record.py`.

use dynamics_core::model::Robot;
use dynamics_core::robots::{
    A1, A1Free, G1, G1Free, Gen3, Iiwa14, OpenArm, Panda, Puma560, So101, Ur5e, XArm7, Yam, Z1,
};
use host_tests::export::robot;
use host_tests::trees::{TreeA, TreeB};

fn main() -> serde_json::Result<()> {
    let robots = [
        robot(&Ur5e::MODEL),
        robot(&Panda::MODEL),
        robot(&Iiwa14::MODEL),
        robot(&A1::MODEL),
        robot(&A1Free::MODEL),
        robot(&G1::MODEL),
        robot(&G1Free::MODEL),
        robot(&Gen3::MODEL),
        robot(&XArm7::MODEL),
        robot(&Puma560::MODEL),
        robot(&OpenArm::MODEL),
        robot(&Yam::MODEL),
        robot(&Z1::MODEL),
        robot(&So101::MODEL),
        robot(&TreeA::MODEL),
        robot(&TreeB::MODEL),
    ];
    println!("{}", serde_json::to_string(&robots)?);
    Ok(())
}
