use super::*;
use crate::motion::{CurrentTick, MotionControllerConfig};
use crate::tests::{controlled, motion_limits, safety_limits};

mod joints;

const TICK: f64 = 1e-3;
const INERTIA: f64 = 2.0;
const CONFIG: MotionControllerConfig<f64, 1> = controlled(
    safety_limits([40.0], [10.0], [3.0], [-1.0], [1.0]),
    TICK,
    [2, 100, 50],
    [250.0, 25.0, 0.1],
);
const SLOW: BackOffConfig<f64> = BackOffConfig { limits: motion_limits(0.5, 2.0), margin: 0.05 };

type Controller = MotionController<f64, 1, CurrentTick>;

/// The law of a joint under this gravity.
fn law(gravity: f64) -> impl Fn(&State<f64, 1, 1>, &Estimate<f64, 1>) -> [f64; 1] {
    move |r, e| {
        let gap = [r.q[0] - e.q[0], r.qd[0] - e.qd[0]];
        [INERTIA * r.qdd[0] - gravity + 1250.0 * gap[0] + 100.0 * gap[1]]
    }
}

/// A joint on its brake beyond its bound, where it has been measured.
struct Bench {
    controller: Controller,
    q: f64,
    qd: f64,
    gravity: f64,
    command: Command<f64, 1>,
}

impl Bench {
    fn new(q: f64, gravity: f64) -> Self {
        let mut controller = Controller::new(CONFIG).on_brake();
        let rest = State::at([0.0]);
        let command = controller.tick(Ok(&[q]), &rest, |_, _| [0.0]);
        let outside = ResetError::OutOfBounds { joint: 0 };
        assert_eq!(controller.reset(&rest), Err(outside));
        Self { controller, q, qd: 0.0, gravity, command }
    }

    fn step(&mut self) {
        if self.command.brake {
            self.qd = 0.0;
            return;
        }
        self.qd += TICK * (self.command.torque[0] + self.gravity) / INERTIA;
        self.q += TICK * self.qd;
    }

    fn back_off(&mut self, back_off: &mut BackOff<f64, 1>, push: f64) {
        let law = law(self.gravity - push);
        self.command = back_off.tick(&mut self.controller, Ok(&[self.q]), law);
        self.step();
    }
}

// This holds at either bound and under gravity of either sign.
#[test]
fn a_joint_beyond_a_bound_backs_off_under_gravity() {
    for side in [1.0, -1.0] {
        for gravity in [-8.0, 0.0, 8.0] {
            let start = side * 1.2;
            let mut bench = Bench::new(start, gravity);
            let mut back_off = BackOff::start(&mut bench.controller, &SLOW).expect("measured");
            let (mut ticks, mut fastest) = (0, 0.0_f64);
            while !back_off.is_done() {
                bench.back_off(&mut back_off, 0.0);
                assert!(side * bench.q <= 1.2 + 1e-4, "{} {gravity}", bench.q);
                assert_eq!(bench.command.status.fault, None);
                fastest = fastest.max(bench.qd.abs());
                ticks += 1;
                assert!(ticks < 2000, "{} {gravity}", bench.q);
            }
            assert!(fastest < 0.6, "{fastest} {gravity}");
            assert!((side * bench.q - 0.95).abs() < 0.06, "{}", bench.q);
            // Held there; from there on as any stopped arm.
            let rest = State::at([0.0]);
            for _ in 0..500 {
                let measured = Ok(&[bench.q]);
                bench.command = bench.controller.tick(measured, &rest, law(gravity));
                bench.step();
                assert_eq!(bench.command.status.mode, Mode::Hold);
                assert!(bench.q.abs() <= 1.0);
            }
        }
    }
}

#[test]
fn no_law_drives_a_joint_further_out() {
    let mut bench = Bench::new(1.2, 0.0);
    let mut back_off = BackOff::start(&mut bench.controller, &SLOW).expect("measured");
    for _ in 0..1000 {
        bench.back_off(&mut back_off, 500.0);
        // Rounding of the estimated speed is all that is left of 40 N·m.
        assert!(bench.q <= 1.2 + 1e-9, "{}", bench.q);
        assert!(bench.command.torque[0] <= 1e-6);
    }
}

#[test]
fn a_joint_pushed_outwards_stops_in_its_tick() {
    let mut bench = Bench::new(1.2, 0.0);
    let mut back_off = BackOff::start(&mut bench.controller, &SLOW).expect("measured");
    (0..400).for_each(|_| bench.back_off(&mut back_off, 0.0));
    assert!(bench.q < 1.15, "{}", bench.q);
    // Nearer than where it began, and further than where it was.
    bench.q += 0.02;
    bench.back_off(&mut back_off, 0.0);
    let command = bench.command;
    let fault = Some(Fault::Position { joint: 0 });
    assert_eq!(command.status.fault, fault);
    assert_eq!((command.torque, command.brake), ([0.0], true));
}

#[test]
fn the_configured_bounds_hold_outside_of_its_ticks() {
    let mut bench = Bench::new(1.2, 0.0);
    let mut back_off = BackOff::start(&mut bench.controller, &SLOW).expect("measured");
    (0..10).for_each(|_| bench.back_off(&mut back_off, 0.0));
    let rest = State::at([0.0]);
    let command = bench.controller.tick(Ok(&[bench.q]), &rest, law(0.0));
    assert_eq!(command.status.fault, Some(Fault::Position { joint: 0 }));
}

#[test]
fn by_hand_an_arm_comes_back_as_well() {
    let mut bench = Bench::new(1.2, 0.0);
    let rest = State::at([0.9]);
    while bench.q > 0.95 {
        bench.q -= 1e-3;
        let command = bench.controller.tick(Ok(&[bench.q]), &rest, |_, _| [9.0]);
        assert_eq!((command.torque, command.brake), ([0.0], true));
    }
    assert_eq!(bench.controller.reset(&rest), Ok(()));
}

#[test]
fn back_off_needs_a_measurement_and_a_stop() {
    let mut controller = Controller::new(CONFIG);
    for reason in [ResetError::NotStopped, ResetError::NoMeasurement] {
        let refused = BackOff::start(&mut controller, &SLOW).err();
        assert_eq!(refused, Some(ApproachError::Reset(reason)));
        controller = controller.on_brake();
    }
}
