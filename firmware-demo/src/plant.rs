//! Simulated robots on the wires: forward dynamics under the scene's effects at a finer step than
//! the tick, outside the measured regions.

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::Effect;
use dynamics_core::model::{Calibrated, Robot};
use dynamics_core::sim::{linearly_implicit, momentum_preserving};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;

use crate::sim_io::Wires;

mod bending;
mod clustered;
mod flexible;
mod servos;

pub use bending::BendingPlant;
pub use clustered::ClusterPlant;
pub use flexible::FlexiblePlant;
pub use servos::ServoPlant;

/// A simulated robot of which N joints are driven and have encoders; `X` is the state of its
/// environment.
pub trait Simulated<X, const N: usize> {
    /// Why a step has no result: its forward dynamics have none.
    type Error;

    /// The positions that the encoders measure, rad or m.
    fn encoder_positions(&self) -> [f32; N];

    /// The true positions of the driven joints, rad or m; an encoder may sit on the other side of a
    /// spring.
    fn actual(&self) -> [f32; N] {
        self.encoder_positions()
    }

    /// One step of `h` seconds under the drives' torques, N·m or N.
    ///
    /// # Errors
    /// As forward dynamics.
    fn step(&mut self, torque: &[f32; N], environment: &X, h: f32) -> Result<(), Self::Error>;
}

/// A simulated robot and its drives, on wires.
#[derive(Debug)]
pub struct Rig<P, const N: usize> {
    pub plant: P,
    full_scale: [f32; N],
}

impl<P, const N: usize> Rig<P, N> {
    /// A robot whose drives deliver `full_scale` at full duty and whose positions the encoders
    /// measure.
    pub fn new<X>(plant: P, full_scale: [f32; N], wires: &Wires<N>) -> Self
    where
        P: Simulated<X, N>,
    {
        wires.publish(&plant.encoder_positions());
        Self { plant, full_scale }
    }

    /// Moves on by `steps` steps of `h` seconds under the duties of now, and shows the encoders
    /// where the robot is; `environment` gives the environment at a step.
    ///
    /// # Errors
    /// As forward dynamics.
    pub fn advance<X>(
        &mut self,
        wires: &Wires<N>,
        steps: u32,
        h: f32,
        environment: impl Fn(u32) -> X,
    ) -> Result<(), P::Error>
    where
        P: Simulated<X, N>,
    {
        let mut tau = wires.duties();
        for (tau, full) in tau.iter_mut().zip(self.full_scale) {
            *tau *= full;
        }
        for step in 0..steps {
            self.plant.step(&tau, &environment(step), h)?;
        }
        wires.publish(&self.plant.encoder_positions());
        Ok(())
    }
}

/// A robot of rigid bodies; its last joints are the driven ones.
#[derive(Debug)]
pub struct Plant<T, E, X, const B: usize, const Q: usize, const V: usize> {
    robot: Calibrated<T, f32, B, Q, V>,
    effects: E,
    /// Applies the environment to the effects.
    apply: fn(&mut E, &X),
    /// Position, velocity and acceleration, beyond what the encoders measure.
    pub state: State<f32, Q, V>,
}

impl<T, E, X, const B: usize, const Q: usize, const V: usize> Plant<T, E, X, B, Q, V>
where
    T: Robot<B, Q, V>,
    E: Effect<f32, B, V>,
{
    /// A robot at rest at q.
    pub fn new(
        robot: Calibrated<T, f32, B, Q, V>,
        effects: E,
        q: [f32; Q],
        apply: fn(&mut E, &X),
    ) -> Self {
        Self { robot, effects, apply, state: State::at(q) }
    }
}

impl<T, E, X, const B: usize, const Q: usize, const V: usize, const N: usize> Simulated<X, N>
    for Plant<T, E, X, B, Q, V>
where
    T: Robot<B, Q, V>,
    E: Effect<f32, B, V>,
{
    type Error = NotPositiveDefinite;

    fn encoder_positions(&self) -> [f32; N] {
        last(&self.state.q)
    }

    fn step(
        &mut self,
        torque: &[f32; N],
        environment: &X,
        h: f32,
    ) -> Result<(), NotPositiveDefinite> {
        (self.apply)(&mut self.effects, environment);
        let tau = padded(torque);
        linearly_implicit(&self.robot, &mut self.state, &tau, &mut self.effects, h)
    }
}

/// A robot whose first body floats free and on which nothing acts from outside: started at rest, it
/// keeps a momentum of zero.
#[derive(Debug)]
pub struct Floating<T, E, X, const B: usize, const Q: usize, const V: usize>(
    pub Plant<T, E, X, B, Q, V>,
);

impl<T, E, X, const B: usize, const Q: usize, const V: usize, const N: usize> Simulated<X, N>
    for Floating<T, E, X, B, Q, V>
where
    T: Robot<B, Q, V>,
    E: Effect<f32, B, V>,
{
    type Error = NotPositiveDefinite;

    fn encoder_positions(&self) -> [f32; N] {
        last(&self.0.state.q)
    }

    fn step(
        &mut self,
        torque: &[f32; N],
        environment: &X,
        h: f32,
    ) -> Result<(), NotPositiveDefinite> {
        let plant = &mut self.0;
        (plant.apply)(&mut plant.effects, environment);
        let (tau, rest) = (padded(torque), Force::ZERO);
        momentum_preserving(&plant.robot, &mut plant.state, &tau, &mut plant.effects, rest, h)
    }
}

/// The torques of all coordinates from those of the driven joints.
fn padded<const N: usize, const V: usize>(torque: &[f32; N]) -> [f32; V] {
    let mut tau = [0.0; V];
    for (tau, &torque) in tau.iter_mut().rev().zip(torque.iter().rev()) {
        *tau = torque;
    }
    tau
}

/// The last N of some values: those of the driven joints.
pub fn last<T: Copy + Default, const N: usize>(values: &[T]) -> [T; N] {
    let mut last = [T::default(); N];
    for (to, &from) in last.iter_mut().rev().zip(values.iter().rev()) {
        *to = from;
    }
    last
}
