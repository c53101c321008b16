//! Reactions of an arm near the seam.

use super::*;
use crate::tests::{Motion, motion_limits};

const SLOW: MotionLimits<f32> = motion_limits(0.5, 2.0);
const BACK: BackOffConfig<f32> = BackOffConfig { limits: SLOW, margin: 0.05 };

impl Bench {
    fn back_off(&mut self, back: &mut BackOff<f32, 2>) {
        let measured = self.measured();
        self.command = back.tick(&mut self.controller, Ok(&measured), Self::law);
        assert_eq!(self.command.status.fault, None, "{:?}", self.q);
        self.advance();
    }
}

#[test]
fn a_joint_beyond_its_arc_goes_back_to_the_nearest_end() {
    // The arc lies over the seam, or opposite to it.
    for (ends, q, goal) in [
        ([2.5, 3.8], 3.9, 3.75),
        ([2.5, 3.8], -2.3, 3.75),
        ([2.5, 3.8], 2.3, 2.55),
        ([-3.0, 3.0], 3.1, 2.95),
        ([-3.0, 3.0], 3.2, -2.95),
        ([-3.0, 3.0], 3.141_52, 2.95),
        ([-3.0, 3.0], -3.141_52, -2.95),
    ] {
        let mut bench = on_brake(ends, [q, 0.0]);
        let mut back = BackOff::start(&mut bench.controller, &BACK).expect("a way");
        for _ in 0..4000 {
            if back.is_done() {
                break;
            }
            bench.back_off(&mut back);
        }
        assert!(back.is_done());
        let off = nearest_turn(bench.q[0] as f32, goal) - goal;
        assert!(off.abs() < 2e-3, "{ends:?} {q}: {}", bench.q[0]);
        assert!((bench.q[0] - q).abs() < 0.4);
    }
}

#[test]
fn a_circle_stands_on_the_seam_while_another_joint_backs_off() {
    let mut bench = on_brake(FREE, [f64::from(PI), 7.2]);
    let mut back = BackOff::start(&mut bench.controller, &BACK).expect("a way");
    let mut tick = 0;
    while !back.is_done() {
        tick += 1;
        assert!(tick < 5000);
        // Noise to both sides of the seam.
        bench.q[0] = f64::from(PI) + [1e-4, -1e-4][tick % 2];
        bench.qd[0] = 0.0;
        bench.back_off(&mut back);
        assert!(bench.command.torque[0].abs() < 2.0);
    }
    assert!((bench.q[1] - 6.95).abs() < 5e-3);
}

#[test]
fn a_retraction_leads_back_over_the_seam() {
    for way in [0.5_f32, -0.5] {
        let start = [PI - 0.4 * way, 0.0];
        let (motion, mut bench) = (line(start, way, 1500), Bench::at(start));
        let (distance, limits) = (0.2, SLOW);
        let config = ContactReactionConfig {
            response: ContactResponse::Retract { distance, limits },
            release_ticks: 50,
        };
        let mut reaction = ContactReaction::<f32, 2>::try_new(config).expect("positive");
        let mut before = bench.q[0];
        for tick in 0..4000 {
            let measured = bench.measured();
            let observed = bench.controller.observe(Ok(&measured));
            let contact = (tick == 900).then_some(DetectedContact { joint: 0, torque: -3.0 });
            let tick = reaction.reference(observed, Ok(contact), &motion);
            let tau = Bench::law(tick.reference(), tick.estimate());
            bench.command = tick.command(&tau);
            bench.advance();
            assert!((bench.q[0] - before).abs() < 2e-3);
            before = bench.q[0];
        }
        assert_eq!(reaction.phase(), ContactPhase::Held);
        let back = f64::from(motion.at(900).q[0]) - bench.q[0];
        let share = back / f64::from(0.2 * way.signum());
        assert!((0.8..1.2).contains(&share), "{way}: {back}");
    }
}

#[test]
fn hand_guiding_pulls_and_pushes_the_short_way() {
    let spring = LimitedSpring { stiffness: [100.0_f32], damping: [0.0], torque: [50.0] };
    let config = |lower, upper| HandGuidingConfig {
        error: 0.1,
        share: 0.8,
        rest_speed: [0.01],
        compensation: [2.0],
        damping: [0.0],
        brake: SpeedBrake { speed: [1.0], damping: [0.0], torque: [0.0] },
        lower: [lower],
        upper: [upper],
        wall: spring,
        lock: spring,
    };
    let at = |q: f32| Estimate { q: [q], qd: [0.0] };
    let new = |lower, upper| {
        let law = HandGuiding::<f32, 1>::try_new(config(lower, upper)).expect("walls");
        law.on_circles::<1>()
    };
    let mut guiding = new(FREE[0], FREE[1]).expect("no walls");
    guiding.lock(&[true], &[3.13]).expect("finite");
    let pull = guiding.torque(&at(-3.13), &[0.0], &[0.0])[0];
    assert!((pull + 100.0 * (TAU - 6.26)).abs() < 1e-2, "{pull}");
    // A range over the seam: −2.6 lies in it, −2.4 and 2.4 beyond its ends.
    let guiding = new(2.5, 3.8).expect("an arc");
    let push = |q| guiding.torque(&at(q), &[0.0], &[0.0])[0];
    assert_eq!(push(-2.6), 0.0);
    assert!((push(-2.4) + 100.0 * (TAU - 2.4 - 3.8)).abs() < 1e-2);
    assert!((push(2.4) - 10.0).abs() < 1e-2);
    assert!(new(-4.0, 4.0).is_err());
}

#[test]
fn a_taught_path_goes_the_way_of_the_hand() {
    fn teach<const C: u128>() -> (f32, usize) {
        let taught = TaughtPath::<f32, 2, 16>::try_new([0.1; 2]).expect("spacings");
        let mut taught = taught.on_circles::<C>();
        for step in 0..=50 {
            let q = nearest_turn(3.0 + 0.01 * step as f32, 0.0);
            taught.record(&[q, 0.0]);
        }
        taught.end(&[3.5 - TAU, 0.0]);
        let ends = [taught.points()[0], *taught.points().last().expect("some")];
        (ends[1][0] - ends[0][0], taught.points().len())
    }
    let (way, count) = teach::<WHEEL>();
    assert!((way - 0.5).abs() < 1e-5 && count <= 7, "{way} {count}");
    assert!(teach::<0>().0 < -5.0);
}

#[test]
fn a_shaped_reference_that_leaps_by_a_turn_does_not() {
    // Through π, within a turn.
    let within = |tick| State::at([nearest_turn(3.0 + 1e-3 * tick as f32, 0.0)]);
    let sway = Vibration { link: "boom", mode: 0, omega: 50.0, damping_ratio: 0.0 };
    let shaper = Shaper::<f32, 3>::zv(&[sway], TICK).expect("a vibration");
    let shaped = Shaped { reference: Motion(within), shaper: shaper.on_circles::<1>() };
    for tick in 100..400 {
        let q = shaped.at(tick).q[0];
        let step = nearest_turn(shaped.at(tick + 1).q[0], q) - q;
        assert!((step - 1e-3).abs() < 1e-5, "{tick}: {step}");
    }
}
