//! Paths, inertias and limits of all sizes, in f32.

use super::*;
use crate::tests::motion_limits;
use dynamics_core::state::all_finite;

/// Numbers in [−1, 1), by xorshift.
struct Random(u32);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (f64::from(self.0) / f64::from(u32::MAX) * 2.0 - 1.0) as f32
    }

    /// A number of any size between 10^−e and 10^e.
    fn size(&mut self, e: f32) -> f32 {
        10.0_f32.powf(e * self.next())
    }
}

// The torques hold at the points of the grid.
#[test]
fn random_motions_are_finite_and_within_the_torques() {
    let mut random = Random(0x1234_5678);
    let (mut timed_paths, mut excess, mut refusals) = (0, 0.0_f32, 0);
    for _ in 0..2000 {
        let (scale, omega) = (random.size(2.0), [2.0, 3.0].map(|w| w * random.next()));
        let path = Curve(|s: f32| {
            let trig = omega.map(|w| (w * s).sin_cos());
            [
                trig.map(|(sin, _)| scale * sin),
                core::array::from_fn(|j| scale * omega[j] * trig[j].1),
                core::array::from_fn(|j| -scale * omega[j] * omega[j] * trig[j].0),
            ]
        });
        let (m, g) = (random.size(2.0), random.size(2.0));
        let off = 0.95 * random.next();
        let id = |state: &State<f32, 2, 2>| {
            let ([x, y], [v, w]) = (state.qdd, state.qd);
            let weight = 0.95 * g * state.q[1].sin();
            [m * (x + off * y) + m * v * w, m * (off * x + y) - m * v * v + weight]
        };
        let has = f32::from(u8::from(random.next() > 0.0));
        let viscous = has * 0.1 * random.size(1.0);
        let limits = PathLimits {
            torque: [g * random.size(0.4), g],
            motion: [motion_limits(random.size(2.0), random.size(3.0)); 2],
            friction: [friction(0.1 * g, viscous, 0.0); 2],
        };
        let motion = match TimedPath::<_, _, 33>::new(&path, 1e-3, &limits, id) {
            Ok(motion) => motion,
            Err(error) => {
                let expected = matches!(error, TimedPathError::Torque { .. });
                assert!(expected, "{error}");
                refusals += 1;
                continue;
            }
        };
        timed_paths += 1;
        for k in (0..=motion.ticks()).step_by(1 + motion.ticks() as usize / 50) {
            let State { q, qd, qdd } = motion.at(k);
            assert!(all_finite(&q) && all_finite(&qd) && all_finite(&qdd), "{k}");
        }
        for k in 0..32 {
            let (from, to) = (motion.square_rate(k), motion.square_rate(k + 1));
            let u = (to - from) / (2.0 * (motion.grid_point(k + 1) - motion.grid_point(k)));
            for (at, x) in [(k, from), (k + 1, to)] {
                let point = path.point(motion.grid_point(at));
                let (slope, curvature) = (point.slope, point.curvature);
                let state = State {
                    q: point.q,
                    qd: slope.map(|slope| slope * x.sqrt()),
                    qdd: core::array::from_fn(|j| slope[j] * u + curvature[j] * x),
                };
                for (j, (tau, limit)) in id(&state).iter().zip(limits.torque).enumerate() {
                    let friction = limits.friction[j];
                    let moves = f32::from(u8::from(slope[j] != 0.0));
                    let sign = moves * slope[j].signum();
                    let moving = tau + sign * friction.coulomb + friction.viscous * state.qd[j];
                    excess = excess.max(tau.abs() / limit - 1.0).max(moving.abs() / limit - 1.0);
                }
            }
        }
    }
    std::println!("{timed_paths} {refusals} {excess:e}");
    assert!(timed_paths > 1000 && refusals > 50, "{refusals}");
    assert!(excess < 2e-5, "{excess:e}");
}
