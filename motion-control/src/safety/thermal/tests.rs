//! Random loads against a motor in K, W and J/K, forecasts, restarts, the gate and its refusals.

use super::*;
use crate::motion::{MotionController, PreviousTick};
use crate::tests::Random;
use crate::tests::{controlled, refused, safety_limits};
use core::ops::Range;
use dynamics_core::state::State;

const AMBIENT: f64 = 25.0;

/// A motor as circuits have it: resistances in K/W, capacities in J/K, watts at τ_c and a hot
/// winding, and copper's coefficient of resistance, which is zero for windings that lose as much
/// when they are cold.
struct Motor {
    resistance: [f64; 2],
    capacity: [f64; 2],
    continuous: f64,
    watts: f64,
    hottest: f64,
    copper: f64,
    kelvin: [f64; 2],
}

impl Motor {
    fn rates(&self, [winding, housing]: [f64; 2], torque: f64) -> [f64; 2] {
        let losses = 1.0 + self.copper * (winding - self.hottest);
        let heat = self.watts * losses * (torque / self.continuous).powi(2);
        let inner = (winding - housing) / self.resistance[0];
        // I²t alone has no second resistance, and a housing that does not warm.
        let outer = (housing - AMBIENT) / self.resistance[1].max(f64::MIN_POSITIVE);
        [(heat - inner) / self.capacity[0], (inner - outer) / self.capacity[1]]
    }

    /// A tick by two steps of Runge and Kutta's fourth-order method.
    fn tick(&mut self, torque: f64, tick: f64) {
        for _ in 0..2 {
            let h = 0.5 * tick;
            let x = self.kelvin;
            let at = |k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
            let a = self.rates(x, torque);
            let b = self.rates(at(a, 0.5 * h), torque);
            let c = self.rates(at(b, 0.5 * h), torque);
            let d = self.rates(at(c, h), torque);
            self.kelvin =
                core::array::from_fn(|i| x[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
        }
    }
}

/// Joints of random motors, and their data sheets.
fn arm<R: Real, const V: usize>(random: &mut Random) -> ([Motor; V], ThermalConfig<R, V>) {
    let tick = random.log(1e-3, 1e-2);
    let mut config = motors([1.0; V]);
    config.tick = R::from_f64(tick);
    let arm = core::array::from_fn(|i| {
        let (rho, continuous) = (random.within(0.1, 1.1).min(1.0), random.log(0.05, 50.0));
        let (ratio, hottest) = (random.within(1.0, 5.0), random.within(80.0, 155.0));
        let block = tick * ticks::<f64, V>();
        // From the shortest times that are accepted.
        let shortest = (9.2 * ratio * ratio * rho).max(8.1) * block;
        let winding = shortest * random.log(1.0, 10.0);
        let housing = (winding * random.log(1.0, 100.0)).max(8.1 * block * (1.0 - rho) / rho);
        let watts = random.log(1.0, 100.0);
        let total = (hottest - AMBIENT) / watts;
        let resistance = [rho * total, (1.0 - rho) * total];
        let of = R::from_f64;
        (config.continuous[i], config.peak[i]) = (of(continuous), of(ratio * continuous));
        (config.winding_time[i], config.housing_time[i]) = (of(winding), of(housing));
        (config.share[i], config.hottest[i]) = (of(rho), of(hottest));
        let copper = if random.next() < 0.5 { 0.0 } else { 0.0028 };
        let capacity = [winding / resistance[0], housing / resistance[1]];
        let kelvin = [AMBIENT; 2];
        Motor { resistance, capacity, continuous, watts, hottest, copper, kelvin }
    });
    (arm, config)
}

fn motors<R: Real, const V: usize>(continuous: [f64; V]) -> ThermalConfig<R, V> {
    let all = |x: f64| [R::from_f64(x); V];
    ThermalConfig {
        tick: R::from_f64(1e-3),
        continuous: continuous.map(R::from_f64),
        peak: continuous.map(|x| R::from_f64(3.0 * x)),
        winding_time: all(12.0),
        housing_time: all(600.0),
        share: all(0.4),
        hottest: all(125.0),
        ambient: R::from_f64(AMBIENT),
    }
}

fn limits<R: Real, const V: usize>(torque: f64) -> SafetyLimits<R, V> {
    let all = |x: f64| [R::from_f64(x); V];
    safety_limits(all(torque), all(torque), all(9.0), all(-3.0), all(3.0))
}

/// What a law wants: a torque for some ticks, of any size up to twice the peak, or a push of one
/// direction and the other in turn.
fn wanted(random: &mut Random, kind: u32, tick: u32, held: &mut f64) -> f64 {
    if tick.is_multiple_of(1 + 97 * (kind % 4)) {
        *held = random.within(-2.0, 2.0);
    }
    match kind {
        0 => 2.0,
        1 if tick.is_multiple_of(48) => 2.0,
        1 => -0.1,
        _ => *held,
    }
}

/// The greatest rise of each of 5 windings of `arms`, which are seeds, as shares of what they may
/// have, with torques that the model limits or that are limited to the peak alone.
fn hottest<R: Real>(arms: Range<u64>, limited: bool) -> Vec<f64> {
    let mut hottest = Vec::new();
    for seed in arms {
        let mut random = Random(seed);
        let (mut arm, config) = arm::<R, 5>(&mut random);
        let limits = limits::<R, 5>(1e4);
        let mut thermal = ThermalLimit::try_new(config, &limits).expect("motors");
        // From temperatures which another load has left.
        let share = arm.each_ref().map(|_| random.next());
        let rho = config.share.map(R::to_f64);
        let state = ThermalState {
            winding: share.map(R::from_f64),
            housing: core::array::from_fn(|i| R::from_f64(share[i] * (1.0 - rho[i]))),
        };
        thermal = thermal.resumed(&state, R::ZERO);
        for (i, motor) in arm.iter_mut().enumerate() {
            let span = motor.hottest - AMBIENT;
            let saved = [state.winding[i], state.housing[i]];
            motor.kelvin = saved.map(|x| AMBIENT + span * x.to_f64());
        }
        let (mut rises, mut held) = ([0.0_f64; 5], [0.0; 5]);
        for tick in 0..2000 {
            let torque = core::array::from_fn(|i| {
                let kind = (seed as u32 + i as u32) % 6;
                let peak = config.peak[i];
                let most = if limited { thermal.torque()[i] } else { peak };
                let wanted = R::from_f64(wanted(&mut random, kind, tick, &mut held[i])) * peak;
                wanted.clamped(-most, most)
            });
            thermal.update(&torque);
            for ((motor, torque), rise) in arm.iter_mut().zip(torque).zip(&mut rises) {
                motor.tick(torque.to_f64(), config.tick.to_f64());
                *rise = rise.max((motor.kelvin[0] - AMBIENT) / (motor.hottest - AMBIENT));
            }
        }
        hottest.extend(rises);
    }
    hottest
}

#[test]
fn no_winding_of_ten_thousand_random_loads_is_hotter_than_its_limit() {
    for rises in [hottest::<f32>(0..1000, true), hottest::<f64>(1000..2000, true)] {
        let most = rises.iter().fold(0.0_f64, |most, &rise| most.max(rise));
        assert!(most <= 1.0, "{most}");
        // Not by giving away the motor.
        let near = rises.iter().filter(|&&rise| rise > 0.9).count();
        assert!(most > 0.995 && near > 1500, "{most}, {near} of {}", rises.len());
    }
    let free = hottest::<f64>(0..20, false);
    assert!(free.iter().filter(|&&rise| rise > 1.0).count() > 50, "the loads are too light");
}

#[test]
fn a_torque_that_may_last_is_the_continuous_one() {
    let limits = limits(1e4);
    let mut thermal = ThermalLimit::<f32, 1>::try_new(motors([2.0]), &limits).expect("motors");
    assert!((1.985..2.0).contains(&thermal.torque()[0]));
    thermal = thermal.resumed(&ThermalState { winding: [0.0], housing: [0.0] }, 0.0);
    let mut last = thermal.torque()[0];
    // Cold, at all that is allowed for two hours, and off for one.
    for tick in 0..10_800_000 {
        thermal.update(&[if tick < 7_200_000 { last } else { 0.0 }]);
        last = thermal.torque()[0];
        if tick == 7_199_999 {
            assert!((1.98..2.0).contains(&last), "{last}");
        }
    }
    assert_eq!((last, thermal.status()), (6.0, ThermalStatus::Cool));
}

/// In no tick does a limit change by more than the slowest rate of a gate that is accepted.
#[test]
fn no_limit_of_many_motors_steps() {
    let (mut random, mut most) = (Random(5), 0.0_f64);
    for load in 0..400 {
        let (_, config) = arm::<f64, 1>(&mut random);
        let [peak] = config.peak;
        let (ratio, block) = (peak / config.continuous[0], config.tick * ticks::<f64, 1>());
        let slowest = 8.0 * peak * config.share[0] * ratio * ratio * block / config.winding_time[0];
        let with =
            |rate| ThermalLimit::try_new(config, &SafetyLimits { rate: [rate], ..limits(1e4) });
        assert!(with(0.999 * slowest).is_err());
        let cold = ThermalState { winding: [0.0], housing: [0.0] };
        let mut thermal = with(1.001 * slowest).expect("motors").resumed(&cold, 0.0);
        let mut held = 0.0;
        for tick in 0..4000 {
            let [limit] = *thermal.torque();
            let torque = wanted(&mut random, load % 6, tick, &mut held) * peak;
            // Half of the drives say for half of the time that their windings are too hot.
            if load % 4 < 2 && tick % 1024 < 512 {
                thermal.measured(0, config.hottest[0] + 20.0);
            }
            thermal.update(&[torque.clamped(-limit, limit)]);
            most = most.max((thermal.torque()[0] - limit).abs() / slowest);
        }
    }
    assert!((0.5..=1.0).contains(&most), "{most}");
}

#[test]
fn forecasts_are_what_the_limit_does() {
    let mut random = Random(9);
    let mut finite = 0;
    for _ in 0..300 {
        let (_, config) = arm::<f64, 1>(&mut random);
        let thermal = ThermalLimit::try_new(config, &limits(1e4)).expect("motors");
        let winding = [random.next()];
        let housing = [random.next() * (1.0 - config.share[0])];
        let mut thermal = thermal.resumed(&ThermalState { winding, housing }, 0.0);
        // The first block, which is shorter.
        (0..33).for_each(|_| thermal.update(&[0.0]));
        let torque = random.within(0.3, 1.02) * config.peak[0];
        let seconds = thermal.holds_for(0, torque);
        let mut held = 0;
        while thermal.torque()[0] >= torque && held < 300_000 {
            thermal.update(&[torque]);
            held += 1;
        }
        // A block ends in the first of its ticks; the housing may be thought hotter.
        let held = f64::from(held) * config.tick;
        let block = ticks::<f64, 1>() * config.tick;
        finite += i32::from(seconds.is_finite() && seconds > 0.0);
        assert!(seconds.min(300_000.0 * config.tick) <= held + 1e-9 + block, "{seconds} {held}");
        let heavy = (torque > config.continuous[0]) & (held < 299_999.0 * config.tick);
        assert!(!heavy | (held <= seconds + block + 1e-9), "{seconds} {held}");
    }
    assert!(finite > 100, "{finite}");
    let thermal = ThermalLimit::<f32, 1>::try_new(motors([2.0]), &limits(1e4)).expect("motors");
    assert_eq!([f32::NAN, f32::INFINITY].map(|torque| thermal.holds_for(0, torque)), [0.0; 2]);
    assert_eq!(thermal.holds_for(1, 0.1), 0.0);
}

/// The temperatures of three motors after some ticks at their limits or without torque, by steps of
/// 1/1000 of a tick.
#[test]
fn the_first_block_is_not_colder_than_the_equations() {
    let mut config = motors([2.0, 2.0, 2.0]);
    (config.tick, config.share) = (3.8e-3, [0.15; 3]);
    (config.winding_time, config.housing_time) = ([1.5; 3], [20.0; 3]);
    let (winding, housing) = ([0.78, 1.0, 0.3], [0.1, 0.0, 0.25]);
    for share in [0.0, 0.7, 1.0] {
        let thermal = ThermalLimit::<f64, 3>::try_new(config, &limits(1e4)).expect("motors");
        let mut thermal = thermal.resumed(&ThermalState { winding, housing }, 0.0);
        let (mut w, mut c) = (winding, housing);
        for tick in 0..100 {
            let torque = thermal.torque().map(|most| share * most);
            thermal.update(&torque);
            let h = config.tick * 1e-3;
            for (j, tau) in torque.iter().enumerate() {
                for _ in 0..1000 {
                    let (heat, rho) = (0.15 * (tau / config.continuous[j]).powi(2), 0.15);
                    let rates = [heat - (w[j] - c[j]), (1.0 - rho) / rho * (w[j] - c[j]) - c[j]];
                    (w[j], c[j]) = (w[j] + h * rates[0] / 1.5, c[j] + h * rates[1] / 20.0);
                }
            }
            let state = thermal.state();
            for j in 0..3 {
                assert!(state.winding[j] >= w[j] - 1e-6, "{share} {tick} {j} {state:?} {w:?}");
                assert!(thermal.joints[j].winding.sum <= 1.0, "{share} {tick} {j}");
            }
        }
    }
}

#[test]
fn temperatures_outlast_a_restart_and_follow_a_hotter_drive() {
    let new = || ThermalLimit::<f32, 2>::try_new(motors([2.0, 1.0]), &limits(1e4)).expect("motors");
    let warm = ThermalState { winding: [0.7, 0.2], housing: [0.3, 0.1] };
    let near = |[a, b]: [f32; 2], [c, d]: [f32; 2]| (a - c).abs().max((b - d).abs()) < 1e-2;
    assert_eq!(new().resumed(&warm, 0.0).state(), warm);
    // 100 s by blocks, and by a forecast.
    let mut ticked = new().resumed(&warm, 0.0);
    (0..100_000).for_each(|_| ticked.update(&[0.0; 2]));
    let (ticked, resumed) = (ticked.state(), new().resumed(&warm, 100.0).state());
    assert!(near(ticked.winding, resumed.winding) && near(ticked.housing, resumed.housing));
    // What a memory cannot have kept is the worst case, and so is a time that is none.
    let worst = new().state();
    for bad in [f32::NAN, -0.1, 1e9] {
        let bad = ThermalState { winding: [bad; 2], housing: [bad; 2] };
        assert_eq!(new().resumed(&bad, f32::NAN).state(), worst);
    }
    // The sensor of joint 1 says 140 °C, of 125 that its winding may have.
    let mut hot = new().resumed(&warm, 0.0);
    assert_eq!(hot.status(), ThermalStatus::Cool);
    let (mut states, mut last) = (vec![hot.status()], hot.torque()[1]);
    for tick in 0..60_000 {
        hot.measured(1, if tick < 9 { f32::NAN } else { 140.0 });
        hot.update(&[0.0; 2]);
        assert!((last - hot.torque()[1]).abs() < 0.04 * 3.0, "a step");
        last = hot.torque()[1];
        // Once in a block: the decay of a whole block is taken at its end.
        if tick % 32 == 31 && states.last() != Some(&hot.status()) {
            states.push(hot.status());
        }
    }
    let joint = 1;
    let through =
        [ThermalStatus::Cool, ThermalStatus::Limited { joint }, ThermalStatus::Hot { joint }];
    assert_eq!((&states[..], last), (&through[..], 0.0));
    assert!((hot.celsius(1) - 140.0).abs() < 0.2);
    // A torque that is none is not forgotten, nor does it last.
    hot.update(&[f32::NAN; 2]);
    assert!(hot.state().winding[1].is_finite());
    (0..32).for_each(|_| hot.update(&[0.0; 2]));
    assert!(hot.state().winding[0] > 0.2 && hot.torque()[0].is_finite());
}

#[test]
fn the_gate_has_the_limits_and_the_numbers_of_a_motor_are_checked() {
    let gate = limits::<f64, 1>(8.0);
    let thermal = ThermalLimit::try_new(motors([2.0]), &gate).expect("motors");
    let config = controlled(gate, 1e-3, [2, 3, 10], [250.0, 25.0, 0.1]);
    let mut controller = MotionController::<f64, 1, PreviousTick>::try_new(config).expect("limits");
    controller.limit_torques(&thermal);
    let command = controller.tick(Ok(&[0.0]), &State::at([0.0]), |_, _| [5.0]);
    assert_eq!((command.torque, command.status.limited), (*thermal.torque(), true));
    // The least limit holds, in whatever order the limits are given, in any tick of a block.
    let mut thermal = thermal;
    for tick in 0..100 {
        let weak = limits(if tick % 7 < 3 { 1.0 } else { 8.0 });
        let mut controller =
            MotionController::<f64, 1, PreviousTick>::try_new(config).expect("limits");
        if tick % 2 == 0 {
            controller.limit_torques(&thermal);
        }
        assert_eq!(controller.set_limits(&weak, 1.0), Ok(true));
        if tick % 2 == 1 {
            controller.limit_torques(&thermal);
        }
        let command = controller.tick(Ok(&[0.0]), &State::at([0.0]), |_, _| [5.0]);
        assert_eq!(command.torque, [weak.torque[0].min(thermal.torque()[0])], "{tick}");
        thermal.update(&command.torque);
    }

    let refused = |change: fn(&mut ThermalConfig<f64, 1>)| {
        let mut config = motors([2.0]);
        change(&mut config);
        refused(ThermalLimit::try_new(config, &limits(8.0)))
    };
    use ConfigParameter::Tick;
    let joint = 0;
    let (motor, torque) =
        (ConfigParameter::ThermalMotor { joint }, ConfigParameter::ThermalTorque { joint });
    assert_eq!(refused(|_| ()), None);
    assert_eq!(refused(|config| config.tick = f64::NAN), Some(Tick));
    assert_eq!(refused(|config| config.continuous = [0.0]), Some(torque));
    assert_eq!(refused(|config| config.peak = [1.9]), Some(torque));
    assert_eq!(refused(|config| config.peak = [8.1]), Some(torque));
    assert_eq!(refused(|config| config.share = [0.0]), Some(motor));
    assert_eq!(refused(|config| config.share = [f64::NAN]), Some(motor));
    assert_eq!(refused(|config| config.winding_time = [0.06]), Some(motor));
    assert_eq!(refused(|config| config.housing_time = [f64::INFINITY]), Some(motor));
    assert_eq!(refused(|config| config.hottest = [25.0]), Some(motor));
    let slow = SafetyLimits { rate: [1e-3], ..limits(8.0) };
    assert_eq!(super::tests::refused(ThermalLimit::try_new(motors([2.0]), &slow)), Some(torque));
}
