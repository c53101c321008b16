//! Claims about the energy of push and dither for any motion, and about their time and direction.

use super::*;
use crate::tests::refused;

mod energy;

const COUNT: f64 = 0.38e-3; // rad
const CONFIG: BreakawayConfig<f64, 1> = BreakawayConfig {
    tick: 2e-3,
    resolution: COUNT,
    late: true,
    stiction: [2.4],
    push: 0.6,
    dither: 0.7,
    window: 20,
    push_ticks: 100,
    dither_ticks: 6,
    energy: [0.4],
    friction: [0.45],
    share: 0.75,
    speed: [1.5],
};
const PUSH: f64 = 0.6 * 2.4;
const DITHER: f64 = 0.7 * 2.4;

fn law(config: BreakawayConfig<f64, 1>) -> Breakaway<f64, 1> {
    Breakaway::try_new(config).expect("a good one")
}

/// A law without dither of a joint that stands at zero.
fn standing(dither: f64) -> Breakaway<f64, 1> {
    let mut law = law(BreakawayConfig { dither, ..CONFIG });
    for _ in 0..=CONFIG.window {
        assert_eq!(law.torque(&[0.0]), [0.0]);
    }
    law
}

/// The torques of a joint that moves by so many counts in each tick, from a place in counts.
fn torques(law: &mut Breakaway<f64, 1>, from: f64, each: f64, ticks: u32) -> Vec<f64> {
    (1..=ticks).map(|k| law.torque(&[COUNT * (from + each * f64::from(k))])[0]).collect()
}

#[test]
fn a_push_helps_in_the_direction_of_a_motion_out_of_a_standstill_and_fades() {
    for side in [1.0, -1.0] {
        let mut law = standing(0.0);
        let pushes = torques(&mut law, 0.0, 1.001 * side, 40);
        assert!(pushes[..3].iter().all(|push| *push == 0.0), "{pushes:?}");
        assert_eq!(pushes[3], side * PUSH);
        assert!(pushes[3..16].windows(2).all(|p| side * p[1] < side * p[0] || p[1] == 0.0));
        assert!(side * pushes[9] > 0.4 * PUSH && pushes[15..].iter().all(|push| *push == 0.0));
        // No other one before it has stood again.
        assert!(torques(&mut law, 40.0 * side, -side, 40).iter().all(|push| *push == 0.0));
        for _ in 0..=CONFIG.window {
            assert_eq!(law.torque(&[0.0]), [0.0]);
        }
        assert_eq!(torques(&mut law, 0.0, 1.001 * side, 4)[3], side * PUSH);
    }
}

#[test]
fn a_push_ends_with_its_time_and_with_a_motion_back() {
    let mut held = standing(0.0);
    torques(&mut held, 0.0, 4.001, 1);
    let pushes = torques(&mut held, 4.001, 0.0, 120);
    for (k, push) in pushes.iter().enumerate() {
        let left = 1.0 - (k + 1) as f64 / 100.0;
        assert!((push - PUSH * left.max(0.0)).abs() < 1e-12, "{k}: {push}");
    }
    let mut back = standing(0.0);
    torques(&mut back, 0.0, 4.001, 1);
    let pushes = torques(&mut back, 4.001, -1.001, 8);
    assert!(pushes[2] > 0.9 * PUSH && pushes[3..].iter().all(|push| *push == 0.0), "{pushes:?}");
}

#[test]
fn a_joint_that_is_held_still_or_creeps_is_not_pushed() {
    let mut law = standing(0.0);
    // Noise of a count to both sides; and a way of four counts in more than two windows.
    let noise = (0..10_000).map(|k| COUNT * [0.0, 1.0, -1.0, 1.0, 0.0][k % 5]);
    for q in noise {
        assert_eq!(law.torque(&[q]), [0.0]);
    }
    assert!(torques(&mut law, 0.0, 0.09, 10_000).iter().all(|push| *push == 0.0));
}

#[test]
fn a_dither_has_no_mean_and_ends_with_half_of_the_energy() {
    let mut law = law(CONFIG);
    let torques = torques(&mut law, 0.0, 0.0, 4000);
    let begin = torques.iter().position(|tau| *tau != 0.0).expect("it begins");
    assert_eq!(begin, CONFIG.window as usize);
    let half = [1.0, 3.0, 5.0].map(|x: f64| x / 3.0 * (1.0 - x / 12.0));
    let wave = [half[0], half[1], half[2], half[2], half[1], half[0]];
    for (k, tau) in torques[begin..begin + 600].iter().enumerate() {
        let sign = [1.0, -1.0][k / 6 % 2];
        let off = tau - sign * DITHER * wave[k % 6];
        assert!(off.abs() < 1e-12, "{k}: {off}");
    }
    let silent = torques.iter().rposition(|tau| tau.abs() > 0.1).expect("it ends");
    let seconds = CONFIG.tick * silent as f64;
    // Each change of the sign costs a count times its torque.
    let changes = 0.2 / (2.0 * wave[2] * DITHER * COUNT);
    assert!((0.95..1.1).contains(&(seconds / (changes * 6.0 * CONFIG.tick))), "{seconds} s");
    let mean = torques.iter().sum::<f64>() / torques.len() as f64;
    assert!(mean.abs() < 0.005 * DITHER, "{mean}");
    assert!((0.19..0.21).contains(&law.energy()[0]));
    // The push has the rest.
    assert!(self::torques(&mut law, 0.0, 1.001, 8).contains(&PUSH));
}

#[test]
fn numbers_that_are_not_finite_give_no_torque_and_keep_the_energy() {
    let bad = [f64::NAN, f64::INFINITY, -f64::INFINITY, f64::MAX, -f64::MAX, 1e3];
    for bad in bad {
        for late in [false, true] {
            let mut law = law(BreakawayConfig { late, ..CONFIG });
            for tick in 0..2000 {
                let lost = tick % 50 > 40;
                let [tau] = law.torque(&[if lost { bad } else { 0.0 }]);
                assert!(tau.is_finite() && !(lost && tick % 50 < 43 && tau != 0.0), "{bad}: {tau}");
                let [energy] = law.energy();
                assert!((0.0..=0.4).contains(&energy), "{bad}: {energy} J");
            }
            // It is pushed again once it stands.
            for _ in 0..=CONFIG.window {
                let _ = law.torque(&[0.0]);
            }
            let pushes = torques(&mut law, 0.0, 1.001, 8);
            assert!(pushes.iter().any(|push| *push > 0.5 * PUSH), "{bad}");
        }
    }
}

#[test]
fn an_angle_goes_the_short_way_over_the_seam() {
    use core::f64::consts::PI;
    let mut law = law(BreakawayConfig { dither: 0.0, ..CONFIG });
    for _ in 0..=CONFIG.window {
        let _ = law.torque(&[PI - COUNT]);
    }
    let pushes = [0.0, 1.001, 2.002, 3.003].map(|k| law.torque(&[COUNT * k - PI + 1e-9])[0]);
    assert_eq!(pushes[3], PUSH);
}

#[test]
fn every_number_of_a_configuration_is_checked() {
    use ConfigParameter::*;
    type Change = fn(&mut BreakawayConfig<f64, 1>, f64);
    let changes: [(Change, _); 9] = [
        (|c, x| c.tick = x, Tick),
        (|c, x| c.resolution = x, Resolution),
        (|c, x| c.push = x, BreakawayShare),
        (|c, x| c.dither = x, BreakawayShare),
        (|c, x| c.share = x, BreakawayShare),
        (|c, x| c.stiction = [x], Stiction),
        (|c, x| c.energy = [x], Stiction),
        (|c, x| c.friction = [x], Stiction),
        (|c, x| c.speed = [x], Stiction),
    ];
    let refuse = |change: &dyn Fn(&mut BreakawayConfig<f64, 1>), parameter| {
        let mut config = CONFIG;
        change(&mut config);
        assert_eq!(refused(Breakaway::try_new(config)), Some(parameter));
    };
    for (change, parameter) in changes {
        for bad in [-0.1, f64::NAN, f64::INFINITY] {
            refuse(&|c| change(c, bad), parameter);
        }
    }
    refuse(&|c| c.tick = 0.0, Tick);
    refuse(&|c| c.resolution = 0.0, Resolution);
    refuse(&|c| c.push = 1.0, BreakawayShare);
    refuse(&|c| c.window = 0, BreakawayTicks);
    refuse(&|c| c.push_ticks = 0, BreakawayTicks);
    refuse(&|c| c.dither_ticks = 0, BreakawayTicks);
    assert_eq!(BreakawayConfig { share: 1.0, ..CONFIG }.check(), Ok(()));
}
