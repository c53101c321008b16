//! Singular configurations of the motors: a status, and torques that are finite, bounded and
//! continuous.

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{
    Drive, LoopRobot, LoopTorque, Loops, Moving, SINGULAR, assemble, inverse_dynamics,
};
use dynamics_core::model::{Robot, RobotModel, Static};
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};
use host_tests::measured::within;
use loop_tests::distance::{distance, inverse, squares};
use loop_tests::machines::{Delta, FOUR_BAR, FiveBar, FourBar, Machine, Parallelogram, Stewart};
use loop_tests::states::closed_states;
use nalgebra::DVector;

/// A machine that a parameter leads through a singular configuration of its motors, at zero.
struct Sweep<const Q: usize, const L: usize, const C: usize, const A: usize> {
    loops: Loops<L, C, A>,
    /// The closed configuration of a parameter.
    at: fn(f64) -> [f64; Q],
    /// The largest parameter.
    reach: f64,
}

const RATE: f64 = 1.0;
const ACCELERATION: f64 = 2.0;

impl<const Q: usize, const L: usize, const C: usize, const A: usize> Sweep<Q, L, C, A> {
    /// ς: the distance from the singular configuration, as the documentation of `damped_below` has
    /// it.
    fn distance<T, const B: usize, const V: usize>(&self, off: f64) -> f64
    where
        T: LoopRobot<B, Q, V, L, C, A>,
    {
        distance::<T, B, Q, V, L, C, A>(&self.loops, &(self.at)(off))
    }

    fn torque<R: Real, T, const B: usize, const V: usize>(
        &self,
        loops: &Loops<L, C, A>,
        (off, moving): (f64, f64),
    ) -> LoopTorque<R, Q, V, C, A>
    where
        T: LoopRobot<B, Q, V, L, C, A>,
        Static<T>: RobotModel<R, B, Q, V>,
    {
        let state = State {
            q: (self.at)(off).map(R::from_f64),
            qd: [R::from_f64(moving * RATE); V],
            qdd: [R::from_f64(moving * ACCELERATION); V],
        };
        let found = inverse_dynamics(&Static::<T>::NEW, loops, &state, &RIGID_BODY);
        found.unwrap_or_else(|error| panic!("{off:e}: {error}"))
    }

    /// Checks the sweep, where the status may be off by a part `slack` of the threshold; returns
    /// the step at the end of the damping relative to the torque, the largest torque over its
    /// bound, and the largest error beyond the damping.
    fn check<R: Real, T, const B: usize, const V: usize>(&self, slack: f64) -> [f64; 3]
    where
        T: LoopRobot<B, Q, V, L, C, A>,
        Static<T>: RobotModel<R, B, Q, V> + RobotModel<f64, B, Q, V>,
    {
        let robot = Static::<T>::NEW;
        let torque = |loops, at| self.torque::<R, T, B, V>(loops, at);
        let (mut fullest, mut undamped, mut outside) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut counts = [0; 2];
        for k in (-80_i32..=80).step_by(2) {
            let off = f64::from(k.signum()) * self.reach * (f64::from(80 - k.abs()) * -0.25).exp();
            for moving in [0.0, 1.0] {
                let found = torque(&self.loops, (off, moving));
                let numbers = found.state.qd.iter().chain(&found.state.qdd);
                assert!(all_finite(&found.tau) && all_finite(&found.lambda));
                assert!(numbers.copied().all(Real::is_finite), "{off:e}");

                // The status is there below the threshold, and nowhere else.
                let distance = self.distance::<T, B, V>(off) / SINGULAR;
                let damped = matches!(found.drive, Drive::Singular { .. });
                assert!(damped == (distance < 1.0) || (distance - 1.0).abs() < slack, "{off:e}");
                counts[usize::from(damped)] += 1;

                // The bound of `damped_below`, by the tree's torques.
                let tree = rnea(&robot, &found.state, &RIGID_BODY).map(Real::to_f64);
                let bound = |tree: &[f64; V]| self.bound(tree);
                let size = norm(&found.tau.map(Real::to_f64));
                fullest = fullest.max(size / bound(&tree));
                if moving == 0.0 {
                    // Without damping: it exceeds the bound near the singular configuration, and is
                    // the same beyond.
                    let exact = self.undamped::<T, B, V>(off, &tree);
                    if off != 0.0 {
                        undamped = undamped.max(norm(&exact) / bound(&tree));
                    }
                    if !damped {
                        let size = norm(&exact);
                        let error = exact.iter().zip(&found.tau);
                        let error = error.map(|(a, b)| (a - b.to_f64()).abs() / size);
                        outside = outside.max(error.fold(0.0, f64::max));
                    }
                }
            }
        }
        assert!(counts[0] > 10 && counts[1] > 10, "{counts:?}");
        println!("{}: {fullest:.3} of the bound, {undamped:.1} without damping", T::MODEL.name);
        assert!(fullest < 1.0 && undamped > 1.0);

        // The two sides of the end of the damping.
        let damped = |off| {
            let found = torque(&self.loops, (off, 1.0));
            (matches!(found.drive, Drive::Singular { .. }), found.tau)
        };
        let (mut inside, mut beyond) = (0.0, self.reach);
        while beyond - inside > beyond * f64::from(f32::EPSILON) * 4.0 {
            let middle = 0.5 * (inside + beyond);
            if damped(middle).0 { inside = middle } else { beyond = middle }
        }
        let ((_, a), (_, b)) = (damped(inside), damped(beyond));
        let size = norm(&b.map(Real::to_f64));
        let apart = a.iter().zip(&b).map(|(&a, &b)| (a - b).to_f64().abs() / size);
        [apart.fold(0.0, f64::max), fullest, outside]
    }

    /// τ_m − K_aᵀ K_p⁺ᵀ τ_p by K_p⁺ = (K_pᵀ K_p)⁻¹ K_pᵀ.
    fn undamped<T, const B: usize, const V: usize>(&self, off: f64, tree: &[f64; V]) -> [f64; A]
    where
        T: LoopRobot<B, Q, V, L, C, A>,
    {
        let q = (self.at)(off);
        let (passive, product) = squares::<T, B, Q, V, L, C, A>(&self.loops, &q);
        let passive_torques = DVector::from_fn(passive.len(), |i, _| tree[passive[i]]);
        let weights = inverse(&passive, &product) * passive_torques;
        self.loops.actuated().map(|joint| {
            let of_passive = passive.iter().zip(weights.iter());
            tree[joint] - of_passive.map(|(&i, w)| w * product(i, joint)).sum::<f64>()
        })
    }

    /// |τ_m| + √(2 L) / ε |τ_p|
    fn bound<const V: usize>(&self, tree: &[f64; V]) -> f64 {
        let actuated = self.loops.actuated();
        let part = |motors: bool| -> Vec<f64> {
            let tau = tree.iter().enumerate();
            tau.filter(|(i, _)| actuated.contains(i) == motors).map(|(_, tau)| *tau).collect()
        };
        norm(&part(true)) + (2.0 * L as f64).sqrt() / SINGULAR * norm(&part(false))
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A flat parallelogram with a motor at its crank, whose joints are off by up to a milliradian, as
/// encoders are: where crank, coupler and rocker are exactly in line, the torque has a limit.
const FLAT: Sweep<3, 1, 5, 1> = Sweep {
    loops: Parallelogram::LOOPS,
    at: |off| {
        // At zero the crank's end is on the rocker's line, but not the crank.
        let [crank, coupler, rocker] = [off - 2e-3 / 3.0, 1e-3, off + 1e-3];
        [-crank, crank - coupler, -rocker]
    },
    reach: 0.5,
};

/// A four-bar linkage with the motor at its rocker: crank and coupler in line are a dead point.
const DEAD: Sweep<3, 1, 5, 1> = Sweep {
    loops: Loops::new(&FourBar::MODEL, *FourBar::LOOPS.joints(), [2]),
    at: |off| {
        let [a, b, c, d] = FOUR_BAR;
        let reach = a + b;
        let crank = ((reach * reach + d * d - c * c) / (2.0 * reach * d)).acos();
        let rocker = (reach * crank.sin()).atan2(reach * crank.cos() - d);
        let guess = [-crank + off, 0.0, -rocker];
        let robot = Static::<FourBar>::NEW;
        let closed = assemble(&robot, &FourBar::LOOPS, &guess, Moving::Passive);
        closed.expect("it closes").q
    },
    reach: 0.4,
};

/// The Stewart platform, turned by 90° (Fichter, 1986), and further by the parameter.
const FICHTER: Sweep<25, 6, 18, 6> = Sweep {
    loops: Stewart::LOOPS,
    at: |off| {
        const PLATFORM: Loops<6, 18, 6> =
            Loops::new(&Stewart::MODEL, *Stewart::LOOPS.joints(), [0, 1, 2, 3, 4, 5]);
        let (robot, mut q) = (Static::<Stewart>::NEW, Stewart::HOME);
        for yaw in [0.4, 0.8, 1.2, core::f64::consts::FRAC_PI_2 + off] {
            (q[2], q[3]) = (0.5 * yaw).sin_cos();
            q = assemble(&robot, &PLATFORM, &q, Moving::Passive).expect("it closes").q;
        }
        q
    },
    reach: 0.5,
};

#[test]
fn torques_across_a_singular_configuration_are_named_bounded_and_continuous() {
    let double = [
        FLAT.check::<f64, Parallelogram, 3, 3>(1e-9),
        DEAD.check::<f64, FourBar, 3, 3>(1e-9),
        FICHTER.check::<f64, Stewart, 13, 24>(1e-9),
    ];
    let single = [
        FLAT.check::<f32, Parallelogram, 3, 3>(0.01),
        DEAD.check::<f32, FourBar, 3, 3>(0.01),
        FICHTER.check::<f32, Stewart, 13, 24>(0.01),
    ];
    let worst = |of: &[[f64; 3]; 3], k: usize| of.iter().map(|found| found[k]).fold(0.0, f64::max);
    within("step at the end of the damping, f64", worst(&double, 0), 5e-6);
    within("step at the end of the damping, f32", worst(&single, 0), 5e-3);
    within("torque over its bound", worst(&double, 1), 0.2);
    within("torque over its bound, f32", worst(&single, 1), 0.2);
    within("torque beyond the damping, f64", worst(&double, 2), 1e-11);
    within("torque beyond the damping, f32", worst(&single, 2), 2e-5);
}

/// The distance of the machines in their usual range, of which the damping takes nothing.
#[test]
fn machines_are_far_from_the_threshold_where_they_work() {
    fn least<
        T,
        const B: usize,
        const Q: usize,
        const V: usize,
        const L: usize,
        const C: usize,
        const A: usize,
    >() -> f64
    where
        T: Machine<B, Q, V, L, C, A>,
    {
        let states = closed_states::<T, B, Q, V, L, C, A>(200);
        let distances = states.iter().map(|s| distance::<T, B, Q, V, L, C, A>(&T::LOOPS, &s.q));
        distances.fold(1.0, f64::min)
    }
    let found = [
        least::<FourBar, 3, 3, 3, 1, 5, 1>(),
        least::<Parallelogram, 3, 3, 3, 1, 5, 1>(),
        least::<FiveBar, 4, 4, 4, 1, 5, 2>(),
        least::<Delta, 10, 22, 21, 6, 18, 3>(),
        least::<Stewart, 13, 25, 24, 6, 18, 6>(),
    ];
    println!("{found:.4?}");
    assert!(found.iter().all(|distance| *distance > 2.0 * SINGULAR), "{found:?}");
}
