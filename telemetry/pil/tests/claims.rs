//! The comparison passes for the right robot and fails for a wrong one, with the firmware's controller in this process.

use telemetry::pil::Measured;
use telemetry_pil::comparison::{Comparison, DIFFERENCE, RMS};
use telemetry_pil::machine::{Local, Machine};
use telemetry_pil::motion::Motion;
use telemetry_pil::plant::{Inside, Outside, Robot};

const TICKS: u32 = 3000;

fn motion(robot: &mut impl Robot) -> Motion {
    let mut machine = Local::new().expect("a trajectory within its limits");
    Motion::of(&mut machine, robot, TICKS).expect("a run")
}

fn comparison(friction: f64) -> Comparison {
    Comparison::of(
        &motion(&mut Outside::new(friction)),
        &motion(&mut Inside::new()),
    )
}

// The bounds are not slack.
#[test]
fn an_f64_robot_moves_like_the_one_inside() {
    let comparison = comparison(1.0);
    let (difference, rms) = comparison.largest();
    assert!(comparison.check().is_ok(), "{difference} {rms}");
    assert!(
        DIFFERENCE < 10.0 * difference && RMS < 10.0 * rms,
        "{difference} {rms}"
    );
}

#[test]
fn a_robot_with_other_friction_fails() {
    for friction in [0.97, 1.03] {
        let comparison = comparison(friction);
        let error = comparison.check().expect_err("other friction").to_string();
        assert!(error.contains("over 3000 ticks"), "{error}");
    }
}

#[test]
fn a_request_that_comes_twice_is_controlled_once() {
    let run = |twice: bool| {
        let mut machine = Local::new().expect("a trajectory within its limits");
        let mut robot = Inside::new();
        let mut last = None;
        for number in 0..50 {
            let answers = robot.answers().into_iter().collect();
            let measured = Measured { number, answers };
            if twice && number > 0 {
                machine.tick(&measured).expect("a reply");
            }
            let reply = machine.tick(&measured).expect("a reply");
            let duties = reply.duties.clone().into_array().expect("six joints");
            assert!(robot.advance(&telemetry_pil::plant::torques(&duties)));
            last = Some(reply);
        }
        last
    };
    assert_eq!(run(true), run(false));
}

#[test]
fn what_is_not_a_number_fails() {
    let still = Motion {
        references: vec![[0.0; 6]; 3],
        estimates: vec![[0.0; 6]; 3],
    };
    let mut broken = still.clone();
    broken.estimates[1][4] = f32::NAN;
    assert!(Comparison::of(&still, &still).check().is_ok());
    assert!(Comparison::of(&broken, &still).check().is_err());
    assert!(Comparison::of(&Motion::default(), &still).check().is_err());
}
