use core::f32::consts::{PI, TAU};

use super::*;
use crate::tests::{controlled, full_command, motion_limits, safety_limits, stop};
use crate::{estimate::*, law::*, limits::*, motion::*, reference::*, safety::*};
use dynamics_core::state::manifold::nearest_turn;

mod detectors;
mod far;
mod reactions;

const TICK: f32 = 1e-3;
/// The first joint is a circle, the second one slides.
const WHEEL: u128 = Circles::NONE.with(0).bits();
const INERTIA: f32 = 2.0;
const LIMITS: [MotionLimits<f32>; 2] = [motion_limits(1.0, 4.0); 2];

type Controller = MotionController<f32, 2, OnCircles<WHEEL, CurrentTick>>;

fn config(lower: f32, upper: f32) -> MotionControllerConfig<f32, 2> {
    controlled(
        safety_limits([40.0; 2], [10.0; 2], [3.0; 2], [lower, -7.0], [upper, 7.0]),
        TICK,
        [2, 100, 200],
        [250.0, 25.0, 0.1],
    )
}

const FREE: [f32; 2] = [f32::NEG_INFINITY, f32::INFINITY];

/// A motion of the first joint from rest to rest.
fn line(from: [f32; 2], way: f32, ticks: u32) -> Trajectory<f32, 2, 2> {
    let points = [stop(from, 0), stop([from[0] + way, from[1]], ticks)];
    Trajectory::new(&points, TICK, &LIMITS).expect("within the limits")
}

/// Two joints without gravity, of which the first is measured within a turn; the true first angle
/// counts turns.
struct Bench {
    controller: Controller,
    q: [f64; 2],
    qd: [f64; 2],
    command: Command<f32, 2>,
}

impl Bench {
    fn new(controller: Controller, q: [f64; 2]) -> Self {
        let command = full_command([0.0; 2], true);
        let qd = [0.0; 2];
        Self { controller, q, qd, command }
    }

    /// One without bounds, at rest at the start of its motion.
    fn at(start: [f32; 2]) -> Self {
        let controller = Controller::try_new(config(FREE[0], FREE[1])).expect("a circle");
        Self::new(controller, start.map(f64::from))
    }

    /// Goes from the brake to a place, and how far the first joint went.
    fn approach(&mut self, [lower, upper]: [f32; 2], goal: [f32; 2]) -> f64 {
        let motion = State::at(goal);
        let bounds = config(lower, upper).supervisor.limits;
        let path = self.controller.approach(&motion, &LIMITS, &bounds);
        let (path, begin) = (path.expect("a way"), self.q[0]);
        self.controller.reset(&path).expect("near");
        let mut steps = ReferenceStep::new([2e-3; 2]).on_circles::<WHEEL>();
        for _ in 0..path.ticks() + 500 {
            self.follow(&path);
            assert_eq!(steps.check(self.controller.reference()), Ok(()));
            assert!((lower..upper).contains(&(self.q[0] as f32)));
        }
        assert!((self.q[1] as f32 - goal[1]).abs() < 2e-3);
        self.q[0] - begin
    }

    /// A tick without a fault.
    fn follow(&mut self, motion: &impl Reference<f32, 2>) {
        self.tick(motion);
        assert_eq!(self.command.status.fault, None, "{:?}", self.q);
    }

    fn measured(&self) -> [f32; 2] {
        [nearest_turn(self.q[0], 0.0) as f32, self.q[1] as f32]
    }

    fn law(reference: &State<f32, 2, 2>, estimate: &Estimate<f32, 2>) -> [f32; 2] {
        let gains = Gains::from_inertia(&[INERTIA; 2], 25.0, 1.0);
        let feedback = feedback(&gains, reference, estimate);
        core::array::from_fn(|joint| INERTIA * reference.qdd[joint] + feedback[joint])
    }

    fn tick(&mut self, motion: &impl Reference<f32, 2>) {
        self.command = self.controller.tick(Ok(&self.measured()), motion, Self::law);
        self.advance();
    }

    fn advance(&mut self) {
        for joint in 0..2 {
            self.qd[joint] += f64::from(TICK * self.command.torque[joint] / INERTIA);
            self.qd[joint] *= f64::from(!self.command.brake);
            self.q[joint] += f64::from(TICK) * self.qd[joint];
        }
    }
}

/// A bench on its brake, measured once.
fn on_brake([lower, upper]: [f32; 2], q: [f64; 2]) -> Bench {
    let controller = Controller::try_new(config(lower, upper)).expect("a circle");
    let mut bench = Bench::new(controller.on_brake(), q);
    let measured = bench.measured();
    bench.tick(&State::at(measured));
    bench
}

#[test]
fn a_reset_at_the_same_place_on_another_turn_starts() {
    for (stands, begins) in
        [(-3.10, 3.18), (6.282, 0.01), (0.0, 25.13), (3.1, -3.1831855), (-25.13, 12.57)]
    {
        let mut bench = on_brake(FREE, [stands, 0.0]);
        let motion = line([begins, 0.0], 0.2, 1000);
        assert_eq!(bench.controller.reset(&motion), Ok(()), "{stands} {begins}");
        for _ in 0..1500 {
            bench.follow(&motion);
            assert!(bench.command.torque[0].abs() < 10.0);
        }
        let travel = bench.q[0] - stands;
        let near = (0.17..0.23).contains(&travel);
        assert!(near, "{stands} {begins}: {travel}");
    }
}

#[test]
fn an_approach_goes_over_the_seam_unless_its_range_does_not() {
    // From 2.5 rad over π to 3.8 rad, and from −2.5 rad through zero.
    let [over, through] = [[2.5, 3.8], [-2.5, 2.5]];
    for (range, stands, begins, way) in [
        (FREE, 3.0, -3.0, 0.2832),
        (FREE, -3.0, 3.0, -0.2832),
        (FREE, 2.0, -2.0, 2.2832),
        (FREE, 0.0, 25.13, -0.0027),
        (FREE, 1.0, 1.0 - 5.0 * TAU, 0.0),
        (over, 3.7, 2.6 - TAU, -1.1),
        (through, 2.4, -2.4, -4.8),
    ] {
        let mut bench = on_brake(range, [stands, 0.5]);
        let travel = bench.approach(range, [begins, 0.4]);
        assert!((travel - way).abs() < 2e-3, "{stands} {begins}: {travel}");
        let near = range != FREE || bench.controller.estimate().q[0].abs() < PI + 0.01;
        assert!(near, "{stands} {begins}");
    }
    for outside in [2.45, 3.85, 0.5, -2.4] {
        let mut bench = on_brake(over, [outside, 0.0]);
        let error = ResetError::OutOfBounds { joint: 0 };
        assert_eq!(bench.controller.reset(&State::at([3.0, 0.0])), Err(error));
    }
}

#[test]
fn a_trajectory_crosses_the_seam_without_a_leap() {
    for way in [2.0_f32, -2.0, 13.0] {
        let start = [PI - 0.5, 0.0];
        let ticks = (way.abs() * 2000.0) as u32;
        let motion = line(start, way, ticks);
        let mut bench = Bench::at(start);
        for tick in 0..ticks + 200 {
            bench.follow(&motion);
            let is = bench.controller.estimate();
            let wanted = bench.controller.reference();
            assert!((wanted.q[0] - is.q[0]).abs() < 0.01, "{tick}");
            assert!((wanted.qd[0] - is.qd[0]).abs() < 0.05, "{tick}");
        }
        assert!((bench.q[0] - f64::from(start[0] + way)).abs() < 1e-3);
    }
}

#[test]
fn a_slide_is_never_moved_by_a_turn() {
    let mut bench = on_brake(FREE, [0.0, 6.5]);
    let far = ResetError::TooFar { joint: 1 };
    let motion = State::at([0.0, 6.5 - TAU]);
    assert_eq!(bench.controller.reset(&motion), Err(far));
    let bounds = config(FREE[0], FREE[1]).supervisor.limits;
    let path = bench.controller.approach(&motion, &LIMITS, &bounds);
    assert_eq!(path.expect("a way").first_point()[1], 6.5);
}

#[test]
fn a_lost_measurement_at_the_seam_is_ridden_through() {
    let start = [PI - 0.1, 0.0];
    let motion = line(start, 0.4, 1000);
    for lost in [1, 2, 50] {
        let mut bench = Bench::at(start);
        let mut left = lost;
        for _ in 0..2000 {
            let near = bench.q[0] > f64::from(PI) - 2e-3;
            if near && left > 0 {
                left -= 1;
                let fault = Err(Fault::Encoder { joint: 0 });
                bench.command = bench.controller.tick(fault, &motion, Bench::law);
                bench.advance();
            } else {
                bench.tick(&motion);
            }
            assert_ne!(bench.command.status.mode, Mode::Stopped, "{lost}");
        }
        assert_eq!(left, 0);
        assert!((bench.q[0] - f64::from(start[0] + 0.4)).abs() < 2e-3);
    }
}

#[test]
fn a_missed_tick_at_the_seam_leads_on() {
    let start = [PI - 0.02, 0.0];
    let motion = line(start, 0.2, 1000);
    let mut bench = Bench::at(start);
    for tick in 0..1500 {
        if tick % 20 == 10 {
            bench.advance();
            bench.controller.missed(1, &motion);
        }
        bench.follow(&motion);
        let off = bench.controller.reference().q[0] - bench.controller.estimate().q[0];
        assert!(off.abs() < 0.02);
    }
    assert!((bench.q[0] - f64::from(start[0] + 0.2)).abs() < 2e-3);
}

#[test]
fn a_range_that_counts_turns_is_refused_for_a_circle() {
    for [lower, upper] in [[-7.0, 7.0], [-1.0, f32::INFINITY], [-9e3, 9e3]] {
        let counts = |error| matches!(error, SafetyLimitsError::CountsTurns { joint: 0, .. });
        let refused = Controller::try_new(config(lower, upper)).unwrap_err();
        assert!(matches!(refused, ConfigError::Limits(error) if counts(error)));
        let mut unchecked = Controller::new(config(lower, upper));
        let command = unchecked.tick(Ok(&[0.0; 2]), &State::at([0.0; 2]), |_, _| [1.0; 2]);
        assert_eq!(command.status.fault, Some(Fault::Limits { joint: 0 }));
        // The same range of a line has nothing against it.
        assert!(MotionController::<f32, 2>::try_new(config(lower, upper)).is_ok());
    }
    assert!(Controller::try_new(config(-PI, PI)).is_ok());
}

#[test]
fn numbers_that_are_no_angles_are_rejected_as_before() {
    for wrong in [f32::NAN, f32::INFINITY, 1e30, -2e4] {
        let (mut bench, rest) = (on_brake(FREE, [0.5, 0.0]), State::at([0.5, 0.0]));
        bench.controller.reset(&rest).expect("near");
        bench.tick(&rest);
        let before = *bench.controller.estimate();
        let measured = Ok(&[wrong, 0.0]);
        let command = bench.controller.tick(measured, &rest, Bench::law);
        assert!(command.status.fault.is_some(), "{wrong}");
        assert!((bench.controller.estimate().q[0] - before.q[0]).abs() < 1e-3);
    }
}
