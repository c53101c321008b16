//! Motors at dead points: a status, and torques that are finite, bounded and continuous.

use dynamics_core::Core;
use dynamics_core::clusters::{
    Branch, Clustered, ClusteredRobot, DEAD_POINT, Driven, FiveBar, FourBar, MotorTorques,
};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use firmware_demo::robots::StewartPlatform;
use loop_tests::clusters::hold;
use nalgebra::{SMatrix, SVector};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn bar(name: &'static str, parent: usize, x: f64) -> Body {
    Body::new(name, parent, Joint::revolute(Z)).xyz([x, 0.0, 0.0]).mass(1.0)
}

/// A four-bar with the motor at its rocker.
struct Rocked;

impl Robot<3, 3, 3> for Rocked {
    const MODEL: ArmModel<f64, 3> = {
        let coupler = bar("coupler", 0, 0.2);
        Model::new("rocked", [bar("crank", BASE, 0.0), coupler, bar("rocker", BASE, 0.6)])
    };
}

impl ClusteredRobot<3, 3, 3, 1, 1> for Rocked {
    type Clusters = (Driven<FourBar, 3, 1>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("rocked", FourBar::new(0.6, 0.2, 0.5, 0.4, Branch::Positive)).actuated([2]),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
}

/// A five-bar with both motors at one crank: one turns it, the other its coupler.
struct Coupled;

impl Robot<4, 4, 4> for Coupled {
    const MODEL: ArmModel<f64, 4> = {
        let [left, right] = [bar("left", BASE, 0.0), bar("right", BASE, 0.1)];
        Model::new("coupled", [left, bar("left_rod", 0, 0.12), right, bar("right_rod", 2, 0.11)])
    };
}

impl ClusteredRobot<4, 4, 4, 2, 2> for Coupled {
    type Clusters = (Driven<FiveBar, 4, 2>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("coupled", FiveBar::new(0.1, [0.12, 0.2], [0.11, 0.21], Branch::Positive))
            .actuated([0, 1])
            .damped_below([0.02, 0.05]),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2, 3]];
}

/// A robot that a parameter leads through a dead point.
struct Sweep<const Y: usize> {
    at: fn(f64) -> [f64; Y],
    /// Beyond the dead point on either side of it.
    range: [f64; 2],
    tau: [f64; Y],
    /// The rates of `damped_below`.
    rates: [f64; Y],
}

struct Found {
    /// The step of the torque where the damping ends, relative to the torque.
    step: f64,
    /// The largest torque over the bound.
    largest: f64,
    undamped: f64,
    /// The error of the torque beyond the damping.
    error: f64,
}

impl<const Y: usize> Sweep<Y> {
    fn torques<R: Real, T, const V: usize>(
        &self,
        parameter: f64,
    ) -> (MotorTorques<R, Y>, [f64; Y], f64)
    where
        T: ClusteredRobot<V, V, V, Y, Y>,
    {
        let y = State::at((self.at)(parameter).map(R::from_f64));
        let motion = Clustered::<Core<T>>::motion(&y).expect("it closes");
        let found = motion.to_motors(&self.tau.map(R::from_f64)).expect("finite");
        // G_aᵀ by its columns, the torques at y of unit torques, in f64 of the same coordinates.
        let y = State::at(y.q.map(Real::to_f64));
        let motion = Clustered::<Core<T>>::motion(&y).expect("it closes");
        let columns: Vec<[f64; Y]> = (0..Y)
            .map(|k| motion.from_motors(&core::array::from_fn(|i| f64::from(u8::from(i == k)))))
            .collect();
        let scaled = SMatrix::<f64, Y, Y>::from_fn(|i, k| columns[k][i] / self.rates[i]);
        let inverse = scaled.try_inverse().unwrap_or(SMatrix::repeat(f64::INFINITY));
        let exact = inverse * SVector::from_fn(|i, _| self.tau[i] / self.rates[i]);
        (found, exact.into(), inverse.norm().recip())
    }

    /// Checks the sweep; the status may be off by a part `slack` of the threshold.
    fn check<R: Real, T, const V: usize>(&self, slack: f64) -> Found
    where
        T: ClusteredRobot<V, V, V, Y, Y>,
    {
        let rates = self.tau.iter().zip(self.rates);
        let bound = norm(&rates.map(|(tau, rate)| tau / rate).collect::<Vec<_>>());
        let mut all = Found { step: 0.0, largest: 0.0, undamped: 0.0, error: 0.0 };
        let (mut counts, [low, high]) = ([0; 2], self.range);
        let at = |k: i32| low + (high - low) * f64::from(k) / 20_000.0;
        let mut borders = Vec::new();
        let mut before = None;
        for k in 0..=20_000 {
            let (found, exact, distance) = self.torques::<R, T, V>(at(k));
            let tau = found.tau.map(Real::to_f64);
            assert!(tau.iter().all(|tau| tau.is_finite()));
            let damped = found.singular.is_some();
            assert!(damped == (distance < 1.0) || (distance - 1.0).abs() < slack, "{distance}");
            counts[usize::from(damped)] += 1;
            all.largest = all.largest.max(norm(&tau) / bound);
            if distance > 0.0 {
                all.undamped = all.undamped.max(norm(&exact) / bound);
            }
            if !damped {
                let errors = tau.iter().zip(&exact).map(|(a, b)| (a - b).abs() / norm(&exact));
                all.error = all.error.max(errors.fold(0.0, f64::max));
            }
            if before.is_some_and(|before| before != damped) {
                borders.push([at(k - 1), at(k)]);
            }
            before = Some(damped);
        }
        assert!(counts[0] > 10 && counts[1] > 10 && borders.len() >= 2, "{counts:?} {borders:?}");
        for [mut one, mut other] in borders {
            let get = |x| {
                let (found, ..) = self.torques::<R, T, V>(x);
                (found.singular.is_some(), found.tau.map(Real::to_f64))
            };
            let first = get(one).0;
            while (other - one).abs() > f64::from(f32::EPSILON) {
                let middle = 0.5 * (one + other);
                if get(middle).0 == first { one = middle } else { other = middle }
            }
            let ((_, a), (_, b)) = (get(one), get(other));
            let size = norm(&b);
            let apart = a.iter().zip(&b).map(|(a, b)| (a - b).abs() / size);
            all.step = all.step.max(apart.fold(0.0, f64::max));
        }
        all
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

const DEAD: Sweep<1> = Sweep { at: |y| [y], range: [0.2, 1.4], tau: [3.0], rates: [DEAD_POINT] };

const COUPLED: Sweep<2> =
    Sweep { at: |y| [2.0, y], range: [-3.0, 3.0], tau: [3.0, -2.0], rates: [0.02, 0.05] };

/// The platform beside its centre, turned about the vertical.
const FICHTER: Sweep<6> = Sweep {
    at: |yaw| [0.03, -0.05, 0.8, yaw, 0.0, 0.0],
    range: [1.2, 1.9],
    tau: [10.0, -20.0, 100.0, 3.0, -2.0, 1.0],
    rates: [DEAD_POINT; 6],
};

fn checked<R: Real>([steps, errors]: [f64; 2], slack: f64, scalar: &str) {
    let all = [
        DEAD.check::<R, Rocked, 3>(slack),
        COUPLED.check::<R, Coupled, 4>(slack),
        FICHTER.check::<R, StewartPlatform, 24>(slack),
    ];
    for found in &all {
        assert!(found.largest < 1.0 && found.undamped > 1.0);
    }
    let most = |of: fn(&Found) -> f64| all.iter().map(of).fold(0.0, f64::max);
    hold(&format!("step where the damping ends, {scalar}"), most(|found| found.step), steps);
    hold(&format!("torque beyond the damping, {scalar}"), most(|found| found.error), errors);
}

// They are continuous, and the dead point is named.
#[test]
fn motor_torques_across_a_dead_point_are_bounded() {
    checked::<f64>([5e-5, 1e-14], 1e-9, "f64");
    checked::<f32>([5e-4, 5e-5], 0.01, "f32");
}
