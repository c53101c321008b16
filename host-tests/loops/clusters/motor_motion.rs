//! Motors at actuated rows, and forward dynamics of a robot with inertias of its own.

use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::{Armature, RIGID_BODY, Viscous};
use dynamics_core::model::Calibrated;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine, algorithms};
use firmware_demo::robots::AnkleLeg;
use loop_tests::clusters::{DeltaRobot, ankle_states, apart, delta_states, hold, largest};

/// The errors that the tests of a robot measure.
#[derive(Debug, Default)]
struct Errors {
    power: f64,
    rates: f64,
    accelerations: f64,
    calibrated: f64,
}

/// A state `h` seconds later, at constant acceleration.
fn after<const Y: usize>(y: &State<f64, Y, Y>, h: f64) -> State<f64, Y, Y> {
    let at = |k: usize| y.q[k] + h * (y.qd[k] + 0.5 * h * y.qdd[k]);
    State {
        q: core::array::from_fn(at),
        qd: core::array::from_fn(|k| y.qd[k] + h * y.qdd[k]),
        qdd: y.qdd,
    }
}

fn errors<T, const N: usize, const Y: usize>(states: &[State<f64, Y, Y>]) -> Errors
where
    T: ClusteredRobot<N, N, N, Y, Y>,
{
    let scene = (RIGID_BODY, Viscous([0.3; N]), Armature([0.02; N]));
    let mut heavy = Calibrated::<T, f64, N, N, N>::nominal();
    for (i, inertia) in heavy.inertias().enumerate() {
        let factor = 1.0 + 0.1 * i as f64;
        inertia.mass *= factor;
        inertia.first_moment *= factor;
        inertia.rotational *= factor;
    }
    let mut worst = Errors::default();
    for y in states {
        let motors = Clustered::<Core<T>>::motors(y).expect("it closes");
        let at_y = Clustered::<Core<T>>::rnea(y, &scene).expect("it closes");
        let work = |tau: &[f64; Y], qd: &[f64; Y]| -> f64 {
            tau.iter().zip(qd).map(|(tau, qd)| tau * qd).sum()
        };
        let size: f64 = at_y.iter().zip(&y.qd).map(|(tau, qd)| (tau * qd).abs()).sum();
        for at_motors in [
            Clustered::<Core<T>>::rnea_of_motors(y, &scene),
            Clustered::<Engine<T>>::rnea_of_motors(y, &scene),
        ] {
            let at_motors = at_motors.expect("it closes");
            assert_eq!(at_motors.singular, None);
            let lost = work(&at_motors.tau, &motors.qd) - work(&at_y, &y.qd);
            worst.power = worst.power.max(lost.abs() / size);
        }

        let h = 1e-5;
        let [before, later] =
            [-h, h].map(|h| Clustered::<Core<T>>::motors(&after(y, h)).expect("it closes"));
        let slope = |a: &[f64; Y], b: &[f64; Y]| -> [f64; Y] {
            core::array::from_fn(|k| (b[k] - a[k]) / (2.0 * h))
        };
        let rates = apart(&slope(&before.q, &later.q), &motors.qd) / largest(&motors.qd);
        let accelerations =
            apart(&slope(&before.qd, &later.qd), &motors.qdd) / largest(&motors.qdd);
        worst.rates = worst.rates.max(rates);
        worst.accelerations = worst.accelerations.max(accelerations);

        let motion = Clustered::<Core<T>>::motion(y).expect("it closes");
        let tau = motion.torque(&algorithms::rnea(&heavy, motion.state(), &scene));
        let ydd = motion.aba(&heavy, &tau, &scene).expect("it moves inertia");
        worst.calibrated = worst.calibrated.max(apart(&ydd, &y.qdd) / 10.0);
        // The change of masses is large enough to count.
        let light = Clustered::<Core<T>>::aba(y, &tau, &scene).expect("it moves inertia");
        assert!(apart(&light, &y.qdd) > 1e-3, "{light:?}");
    }
    println!("{}: {worst:?}", T::MODEL.name);
    worst
}

#[test]
fn motor_power_and_rates_are_those_of_the_coordinates() {
    let all =
        [errors::<AnkleLeg, 9, 3>(&ankle_states()), errors::<DeltaRobot, 12, 3>(&delta_states())];
    let worst = |of: fn(&Errors) -> f64| all.iter().map(of).fold(0.0, f64::max);
    hold("power of motors", worst(|e| e.power), 1e-14);
    hold("motors' rates", worst(|e| e.rates), 5e-9);
    hold("motors' accelerations", worst(|e| e.accelerations), 3e-8);
    hold("FD of a calibrated robot", worst(|e| e.calibrated), 1e-14);
}
