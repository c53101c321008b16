//! The cost of dynamics of machines with kinematic loops, by general constraints.
#![no_std]
#![no_main]

#[path = "costs/closed.rs"]
mod closed;
mod costs;

use core::marker::PhantomData;

use costs::row::Row;
use costs::{STATES, done};
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};
use dynamics_core::loops::{
    LoopRobot, LoopTorque, Stabilisation, forward_dynamics, inverse_dynamics,
};
use dynamics_core::model::Static;
use dynamics_core::state::State;
use firmware_demo::robots::Delta;
use firmware_demo::robots::planar_loops::{FiveBar, FourBar};

type Scene = (Gravity, Inertia, Coriolis);

/// The measurements of a robot.
struct Of<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(PhantomData<T>);

impl<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
> Of<T, B, Q, V, L, C, A>
where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    /// The torques of the motors, or none.
    #[inline(never)]
    fn inverse(state: &State<f32, Q, V>, scene: &Scene) -> Option<[f32; A]> {
        let found = inverse_dynamics(&Static::<T>::NEW, &T::LOOPS, state, scene);
        found.ok().map(|LoopTorque { tau, .. }| tau)
    }

    /// The accelerations of all joints, or none.
    #[inline(never)]
    fn forward(state: &State<f32, Q, V>, scene: &Scene) -> Option<[f32; V]> {
        let by = Stabilisation::for_step(1e-3);
        let found = forward_dynamics(&Static::<T>::NEW, &T::LOOPS, state, &[0.1; A], by, scene);
        found.ok().map(|motion| motion.qdd)
    }

    /// Both directions, on states that are closed and have a result.
    fn rows(states: &[State<f32, Q, V>]) {
        let of = |algorithm| Row {
            robot: T::MODEL.name,
            algorithm,
            form: "core",
            inputs: "full",
            trig: true,
            joints: V,
        };
        let scene = &RIGID_BODY;
        let run = Self::inverse;
        for state in states {
            defmt::assert!(run(state, scene).is_some());
        }
        of("inverse_loops").measure(run as *const () as usize, states, |state| run(state, scene));
        let run = Self::forward;
        for state in states {
            defmt::assert!(run(state, scene).is_some());
        }
        of("forward_loops").measure(run as *const () as usize, states, |state| run(state, scene));
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    Of::<FourBar, 3, 3, 3, 1, 5, 1>::rows(&closed::four_bar::<STATES>());
    Of::<FiveBar, 4, 4, 4, 1, 5, 2>::rows(&closed::five_bar::<STATES>());
    Of::<Delta, 10, 22, 21, 6, 18, 3>::rows(&closed::delta::<STATES>());
    done()
}
