//! Laws that hold for every machine in every state.

use dynamics_core::algorithms::{kinetic_energy, poses, potential_energy, rnea};
use dynamics_core::effects::{BodyWrench, RIGID_BODY};
use dynamics_core::loops::{LoopTorque, Stabilisation, forward_dynamics, inverse_dynamics};
use dynamics_core::model::{RobotModel, Static};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::state::manifold::integrate;
use host_tests::measured::largest;
use host_tests::tolerances;
use loop_tests::machines::{Delta, FiveBar, FourBar, Machine, Parallelogram, Stewart};
use loop_tests::states::closed_states;
use loop_tests::wrenches::wrenches;

const STATES: usize = 200;

/// A test of each machine `T`.
macro_rules! law {
    ($(#[$words:meta])* fn $name:ident() $law:block) => {
        $(#[$words])*
        #[test]
        fn $name() {
            fn law<
                T,
                const B: usize,
                const Q: usize,
                const V: usize,
                const L: usize,
                const C: usize,
                const A: usize,
            >()
            where
                T: Machine<B, Q, V, L, C, A>,
                Static<T>: RobotModel<f32, B, Q, V> + RobotModel<f64, B, Q, V>,
            $law
            law::<FourBar, 3, 3, 3, 1, 5, 1>();
            law::<Parallelogram, 3, 3, 3, 1, 5, 1>();
            law::<FiveBar, 4, 4, 4, 1, 5, 2>();
            law::<Delta, 10, 22, 21, 6, 18, 3>();
            law::<Stewart, 13, 25, 24, 6, 18, 6>();
        }
    };
}

/// A measured error and full scale, collected over states.
#[derive(Default)]
struct Errors {
    differences: Vec<f64>,
    sizes: Vec<f64>,
}

impl Errors {
    fn compare(&mut self, got: impl IntoIterator<Item = f64>, want: impl IntoIterator<Item = f64>) {
        for (got, want) in got.into_iter().zip(want) {
            self.differences.push((got - want).abs());
            self.sizes.push(want.abs());
        }
    }

    #[track_caller]
    fn check(self, robot: &str, quantity: &str, scalar: &str) {
        let error = largest(self.differences) / largest(self.sizes);
        tolerances::check(robot, quantity, scalar, error).unwrap_or_else(|e| panic!("{e}"));
    }
}

fn driven<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    state: &State<f64, Q, V>,
) -> LoopTorque<f64, Q, V, C, A>
where
    T: Machine<B, Q, V, L, C, A>,
{
    inverse_dynamics(&Static::<T>::NEW, &T::LOOPS, state, &RIGID_BODY).expect("a torque")
}

law! {
    fn forward_dynamics_with_loops_inverts_inverse_dynamics() {
        let mut accelerations = Errors::default();
        for state in closed_states::<T, B, Q, V, L, C, A>(STATES) {
            let id = driven::<T, B, Q, V, L, C, A>(&state);
            let none = Stabilisation::NONE;
            let robot = Static::<T>::NEW;
            let fd = forward_dynamics(&robot, &T::LOOPS, &id.state, &id.tau, none, &RIGID_BODY);
            accelerations.compare(fd.expect("accelerations").qdd, id.state.qdd);
        }
        accelerations.check(T::MODEL.name, "forward of inverse dynamics", "f64");
    }
}

law! {
    /// The joints of the loops supply none.
    fn the_motors_alone_supply_the_change_of_energy() {
        let (robot, h) = (Static::<T>::NEW, 1e-4);
        let energy = |state: &State<f64, Q, V>| {
            kinetic_energy(&robot, state, &RIGID_BODY)
                + potential_energy(&robot, &state.q, &RIGID_BODY)
        };
        let mut power = Errors::default();
        for state in closed_states::<T, B, Q, V, L, C, A>(STATES) {
            let LoopTorque { tau, state, .. } = driven::<T, B, Q, V, L, C, A>(&state);
            let after = |h: f64| {
                let step = std::array::from_fn(|i| h * state.qd[i] + 0.5 * h * h * state.qdd[i]);
                energy(&State {
                    q: integrate(&robot, &state.q, &step),
                    qd: std::array::from_fn(|i| state.qd[i] + h * state.qdd[i]),
                    qdd: [0.0; V],
                })
            };
            let motors = T::LOOPS.actuated().iter().zip(tau).map(|(&i, tau)| state.qd[i] * tau);
            power.compare([motors.sum()], [(after(h) - after(-h)) / (2.0 * h)]);
        }
        power.check(T::MODEL.name, "power of the motors", "f64");
    }
}

law! {
    fn cut_bodies_are_in_equilibrium_under_the_loop_forces() {
        let robot = Static::<T>::NEW;
        let mut torques = Errors::default();
        for state in closed_states::<T, B, Q, V, L, C, A>(STATES) {
            let id = driven::<T, B, Q, V, L, C, A>(&state);
            let none = Stabilisation::NONE;
            let fd = forward_dynamics(&robot, &T::LOOPS, &id.state, &id.tau, none, &RIGID_BODY)
                .expect("accelerations");
            for lambda in [fd.lambda, id.lambda] {
                let poses = poses(&robot, &id.state.q);
                let mut tree = rnea(&robot, &id.state, &RIGID_BODY);
                for (i, joint) in T::LOOPS.joints().iter().enumerate() {
                    let force = fd.constraints.force(&T::LOOPS, i, &lambda);
                    for (body, wrench) in wrenches(joint, force, &poses) {
                        let of_wrench = rnea(&robot, &id.state, &BodyWrench { body, wrench });
                        for (tree, tau) in tree.iter_mut().zip(of_wrench) {
                            *tree += tau;
                        }
                    }
                }
                let mut motors = [0.0; V];
                for (&i, tau) in T::LOOPS.actuated().iter().zip(id.tau) {
                    motors[i] = tau;
                }
                torques.compare(tree, motors);
            }
        }
        torques.check(T::MODEL.name, "balance of the cut bodies", "f64");
    }
}

law! {
    fn single_precision_stays_within_its_bounds() {
        let (mut torques, mut accelerations) = (Errors::default(), Errors::default());
        for state in closed_states::<T, B, Q, V, L, C, A>(STATES) {
            let state = driven::<T, B, Q, V, L, C, A>(&state).state;
            let single = State {
                q: state.q.map(|x| x as f32),
                qd: state.qd.map(|x| x as f32),
                qdd: state.qdd.map(|x| x as f32),
            };
            let double = State {
                q: single.q.map(f64::from),
                qd: single.qd.map(f64::from),
                qdd: single.qdd.map(f64::from),
            };
            let robot = Static::<T>::NEW;
            let want = driven::<T, B, Q, V, L, C, A>(&double);
            let got = inverse_dynamics(&robot, &T::LOOPS, &single, &RIGID_BODY).expect("a torque");
            torques.compare(got.tau.map(f64::from), want.tau);

            let tau: [f32; A] = want.tau.map(|x| x as f32);
            let (none_32, none) = (Stabilisation::NONE, Stabilisation::NONE);
            let got = forward_dynamics(&robot, &T::LOOPS, &single, &tau, none_32, &RIGID_BODY);
            let tau = tau.map(Real::to_f64);
            let want = forward_dynamics(&robot, &T::LOOPS, &double, &tau, none, &RIGID_BODY);
            let (got, want) = (got.expect("accelerations"), want.expect("accelerations"));
            assert_eq!(got.rows, want.rows, "f32 finds another rank");
            accelerations.compare(got.qdd.map(f64::from), want.qdd);
        }
        torques.check(T::MODEL.name, "inverse dynamics with loops", "f32");
        accelerations.check(T::MODEL.name, "forward dynamics with loops", "f32");
    }
}
