//! A joint that is guided, held, moved along one motion and then along another one.

use super::*;
use crate::tests::{motion_limits, stop};

const INERTIA: f64 = 2.0;
const FRICTION: f64 = 1.5;
const BANDWIDTH: f64 = 250.0;
const WAY: [MotionLimits<f64>; 1] = [motion_limits(1.0, 4.0)];
const LIMITS: SafetyLimits<f64, 1> = safety_limits([60.0], [60.0], [3.0], [-2.0], [2.0]);
type Controller = MotionController<f64, 1, CurrentTick>;

fn gravity(q: f64) -> f64 {
    5.0 * q.cos()
}

fn friction(qd: f64) -> f64 {
    FRICTION * (qd / 0.02).clamp(-1.0, 1.0)
}

fn guided(limits: SafetyLimits<f64, 1>) -> HandGuidingConfig<f64, 1> {
    HandGuidingConfig::from_limits(limits, &[INERTIA], BANDWIDTH).expect("good limits")
}

/// A joint with its loop.
struct Bench {
    controller: Controller,
    guiding: HandGuiding<f64, 1>,
    hand_over: HandOver<f64, 1>,
    q: f64,
    qd: f64,
    /// The torque of the last tick, and the greatest change of it from tick to tick.
    torque: f64,
    step: f64,
}

impl Bench {
    fn new(ticks: u32) -> Self {
        Self {
            controller: Controller::new(controlled(
                LIMITS,
                TICK,
                [RIDE, 200, 300],
                [BANDWIDTH, 25.0, 0.1],
            )),
            guiding: HandGuiding::try_new(guided(LIMITS)).expect("a good one"),
            hand_over: HandOver::try_new(ticks).expect("ticks"),
            q: 0.2,
            qd: 0.0,
            torque: gravity(0.2),
            step: 0.0,
        }
    }

    fn advance(&mut self, command: Command<f64, 1>, hand: f64) {
        assert!(!command.status.limited);
        let [torque] = command.torque;
        self.step = self.step.max((torque - self.torque).abs());
        self.torque = torque;
        let rest = torque + hand - gravity(self.q) - friction(self.qd);
        self.qd += TICK * rest / INERTIA;
        self.q += TICK * self.qd;
    }

    /// A tick in which a hand pushes.
    fn guide(&mut self, hand: f64) -> Option<Fault> {
        let Self { guiding, hand_over, q, .. } = self;
        let command = self.controller.tick(Ok(&[*q]), &State::at([*q]), |_, estimate| {
            let (at, qd) = (estimate.q[0], estimate.qd[0]);
            let [guide] = guiding.torque(estimate, &[friction(qd)], &[0.0]);
            hand_over.torque(&[gravity(at) + guide])
        });
        self.advance(command, hand);
        command.status.fault
    }

    /// A tick of a motion, or of a hold.
    fn follow<T: Reference<f64, 1>>(&mut self, motion: &T) {
        let gains = Gains::from_inertia(&[INERTIA], 25.0, 1.0);
        let (hand_over, q) = (&mut self.hand_over, self.q);
        let command = self.controller.tick(Ok(&[q]), motion, |reference, estimate| {
            let State { q, qd, qdd } = *reference;
            let [back] = feedback(&gains, reference, estimate);
            hand_over.torque(&[INERTIA * qdd[0] + gravity(q[0]) + friction(qd[0]) + back])
        });
        self.advance(command, 0.0);
    }

    /// Holds the joint, and then leads it along a motion from where it is.
    fn lead(&mut self, motion: &Trajectory<f64, 1, 2>) {
        let hold = State::at([self.q]);
        self.controller.stop_by(Fault::External, StopCategory::ControlledHold);
        self.hand_over.begin();
        let mut ticks = 0;
        let path = loop {
            self.follow(&hold);
            ticks += 1;
            assert!(ticks < 1000);
            let at_rest = self.qd.abs() < 1e-3;
            if let (true, Ok(path)) = (at_rest, self.controller.approach(motion, &WAY, &LIMITS)) {
                break path;
            }
        };
        assert!((path.first_point()[0] - self.q).abs() < 1e-3);
        self.controller.reset(&path).expect("it stands");
        self.hand_over.begin();
        for _ in 0..path.ticks() + 300 {
            self.follow(&path);
            assert_eq!(self.controller.mode(), Mode::Full);
        }
        let end = motion.at(motion.ticks()).q[0];
        assert!((self.q - end).abs() < 1e-2, "{} {end}", self.q);
    }
}

/// The greatest change of the torque in a tick of the whole sequence.
fn greatest_step(ticks: u32) -> f64 {
    let mut bench = Bench::new(ticks);
    let motion = |from, to| Trajectory::new(&[stop([from], 0), stop([to], 800)], TICK, &WAY);
    for k in 0..1000 {
        bench.guide((0.02 * f64::from(k)).min(4.0));
    }
    assert!(bench.q > 0.4 && bench.qd > 0.1, "{} {}", bench.q, bench.qd);
    bench.lead(&motion(0.6, 0.9).expect("within the limits"));
    bench.lead(&motion(0.4, 0.1).expect("within the limits"));
    bench.hand_over.begin();
    bench.guide(0.0);
    for _ in 0..500 {
        bench.guide(0.0);
    }
    assert!((bench.q - 0.1).abs() < 0.02);
    bench.step
}

#[test]
fn guiding_holding_and_two_motions_follow_each_other_without_a_step_of_the_torque() {
    let [with, without] = [50, 1].map(greatest_step);
    println!("steps of {with} and {without} N·m");
    assert!(with < 3.0 && without > 30.0, "{with} {without} N·m");
}

/// A hand pushes a joint to its speed, and then both the supervisor and the guiding have a fifth of
/// the speed and less range. The greatest change of the torque in a tick, the speed after 0.6 s in
/// which the hand pushes on with half of its force, the way to the new end of travel, and the fault.
fn slowed(ticks: u32, guiding: bool) -> ([f64; 3], Option<Fault>) {
    let mut bench = Bench::new(ticks);
    (bench.q, bench.torque) = (-1.8, gravity(-1.8));
    for _ in 0..800 {
        bench.guide(8.0);
    }
    assert!(bench.qd > 1.5, "{}", bench.qd);
    bench.step = 0.0;
    let slow = SafetyLimits { upper: [bench.q + 0.5], ..LIMITS }.with_speed_share(0.2);
    let mut pushed = 0.0;
    let fault = (0..3000).find_map(|k| {
        bench.controller.set_limits(&slow, 5.0).expect("good ones");
        if guiding && bench.guiding.set_config(guided(slow)) == Ok(true) {
            bench.hand_over.begin();
        }
        pushed = if k < 600 { bench.qd } else { pushed };
        bench.guide(if k < 600 { 4.0 } else { 0.0 })
    });
    ([bench.step, pushed, slow.upper[0] - bench.q], fault)
}

#[test]
fn limits_that_fall_while_a_hand_pushes_reach_the_guiding_without_a_step() {
    let ([with, speed, left], fault) = slowed(50, true);
    let ([without, ..], _) = slowed(1, true);
    println!("steps of {with} and {without} N·m, {speed} rad/s, {left} rad");
    assert_eq!(fault, None);
    assert!(with < 0.5 && without > 7.0, "{with} {without} N·m");
    // At the new wall.
    assert!(speed < 0.6 && (left - 0.05).abs() < 1e-3, "{speed} rad/s {left} rad");
    assert_eq!(slowed(50, false).1, Some(Fault::Speed { joint: 0 }));
}
