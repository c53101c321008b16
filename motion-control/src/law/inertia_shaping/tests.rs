//! Claims about one joint against the closed forms, and about numbers that are not finite.

use super::*;
use crate::estimate::{MomentumObserver, ObserverConfig};
use crate::tests::refused;

const H: f64 = 1e-4;
const INERTIA: f64 = 1.5;

fn shaping(k: f64, damping: f64, torque: f64) -> InertiaShaping<f64, 1> {
    InertiaShaping::try_new(InertiaShapingConfig {
        amplification: k,
        dead_band: [0.0],
        damping: [damping],
        torque: [torque],
    })
    .expect("a good one")
}

/// A joint with its observer and its law.
struct Joint {
    law: InertiaShaping<f64, 1>,
    observer: MomentumObserver<f64, 1>,
    q: f64,
    qd: f64,
}

impl Joint {
    fn new(law: InertiaShaping<f64, 1>, bandwidth: f64) -> Self {
        let config = ObserverConfig { bandwidth, tick: H };
        Self {
            law,
            observer: MomentumObserver::try_new(config).expect("a good one"),
            q: 0.0,
            qd: 0.0,
        }
    }

    fn tick(&mut self, external: f64) {
        let p = [INERTIA * self.qd];
        self.observer.update(&p, &[0.0]).expect("finite");
        let tau = self.law.torque(self.observer.external_torque(), &[self.qd]);
        self.observer.drive(&tau);
        self.qd += H * (tau[0] + external) / INERTIA;
        self.q += H * self.qd;
    }

    /// |τ_ext / q̇| at a frequency.
    fn impedance(&mut self, omega: f64) -> f64 {
        let period = core::f64::consts::TAU / omega;
        let ticks = (20.0 * period / H).round() as u32;
        let settle = (10.0 * period / H).round() as u32;
        let [mut sine, mut cosine] = [0.0; 2];
        for tick in 0..ticks {
            let (s, c) = (omega * H * f64::from(tick)).sin_cos();
            self.tick(s);
            if tick >= settle {
                sine += self.qd * s;
                cosine += self.qd * c;
            }
        }
        let half = 0.5 * f64::from(ticks - settle);
        half / sine.hypot(cosine)
    }
}

/// Share of ω M, of the closed form.
fn share(k: f64, x: f64) -> f64 {
    ((1.0 + x * k * k) * (1.0 + x) / (1.0 + x * (1.0 + k).powi(2))).sqrt()
}

#[test]
fn a_passive_joint_has_the_impedance_of_the_closed_form() {
    for (k, bandwidth, omega) in
        [(1.0, 20.0, 28.3), (1.0, 20.0, 6.0), (3.0, 10.0, 20.0), (0.5, 30.0, 15.0)]
    {
        let law = shaping(k, k * bandwidth * INERTIA, 1e9);
        let found = Joint::new(law, bandwidth).impedance(omega) / (omega * INERTIA);
        let expected = share(k, (bandwidth / omega).powi(2));
        let off = found / expected - 1.0;
        assert!(off.abs() < 5e-3, "{k} {bandwidth} {omega}: {off}");
    }
}

#[test]
fn a_passive_joint_is_at_most_13_percent_lighter() {
    let ks = (1..400).map(|i| 0.02 * f64::from(i));
    let all = ks.flat_map(|k| (1..400).map(move |i| share(k, 0.02 * f64::from(i))));
    let least = all.fold(f64::INFINITY, f64::min);
    assert!((least - 0.75_f64.sqrt()).abs() < 1e-3, "{least}");
    assert!((share(1.0, 0.5) - 0.75_f64.sqrt()).abs() < 1e-12);
}

/// The growth of the greatest speed of a joint that hangs on a spring, over two seconds.
fn growth(damping: f64) -> f64 {
    let (k, bandwidth) = (2.0, 30.0);
    let mut joint = Joint::new(shaping(k, damping * k * bandwidth * INERTIA, 1e9), bandwidth);
    joint.qd = 0.1;
    let mut fastest = |ticks: u32| {
        (0..ticks).fold(0.0_f64, |most, _| {
            joint.tick(-2000.0 * joint.q);
            most.max(joint.qd.abs())
        })
    };
    let first = fastest(5000);
    fastest(10_000);
    fastest(5000) / first
}

// A joint without damping oscillates.
#[test]
fn only_a_passive_joint_rests_on_a_spring() {
    let [passive, undamped] = [growth(1.0), growth(0.0)];
    assert!(passive < 1e-3 && undamped > 10.0, "{passive} {undamped}");
}

// Every torque is finite.
#[test]
fn the_dead_band_is_not_amplified_and_torques_limited() {
    let mut law = shaping(2.0, 0.0, 10.0);
    law.config.dead_band = [3.0];
    for [r, tau] in [[2.9, 0.0], [-2.9, 0.0], [4.0, 2.0], [-4.0, -2.0], [1e3, 10.0]] {
        assert_eq!(law.torque(&[r], &[0.0]), [tau]);
    }
    let bad = [f64::NAN, f64::INFINITY, -f64::INFINITY, f64::MAX, -f64::MAX];
    let damped = shaping(2.0, 1.0, 10.0);
    for r in bad {
        for qd in bad {
            assert!(damped.torque(&[r], &[qd])[0].abs() <= 10.0, "{r} {qd}");
        }
    }
}

#[test]
fn the_passive_damping_covers_coupled_joints() {
    use dynamics_core::algorithms::crba;
    use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e};
    let m = crba(&Ur5e::MODEL, &[0.3, -1.0, 1.2, 0.1, 0.5, 0.0], &RIGID_BODY);
    let d = InertiaShaping::passive_damping(1.5, 20.0, &m);
    for (i, d) in d.into_iter().enumerate() {
        let others: f64 = (0..6).filter(|j| *j != i).map(|j| m.get(i, j).abs()).sum();
        let left = d - 30.0 * m.get(i, i);
        assert!((left - 30.0 * others).abs() < 1e-9 * d, "joint {i}");
    }
}

#[test]
fn numbers_that_are_negative_or_not_finite_are_refused() {
    let good = InertiaShapingConfig {
        amplification: 1.0,
        dead_band: [1.0],
        damping: [1.0],
        torque: [1.0],
    };
    type Change = fn(&mut InertiaShapingConfig<f64, 1>, f64);
    let changes: [(Change, _); 4] = [
        (|c, x| c.amplification = x, ConfigParameter::Amplification),
        (|c, x| c.dead_band = [x], ConfigParameter::ShapedJoint),
        (|c, x| c.damping = [x], ConfigParameter::ShapedJoint),
        (|c, x| c.torque = [x], ConfigParameter::ShapedJoint),
    ];
    for (change, parameter) in changes {
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let mut config = good;
            change(&mut config, bad);
            assert_eq!(refused(config.check()), Some(parameter));
            assert!(InertiaShaping::try_new(config).is_err());
        }
    }
    assert_eq!(good.check(), Ok(()));
}
