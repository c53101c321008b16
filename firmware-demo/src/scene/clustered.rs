//! The common parts of scenes of robots with kinematic loops. Their motors are N of the tree's
//! coordinates.

use core::marker::PhantomData;

use dynamics_core::clusters::{ClusterError, Clustered, ClusteredRobot, MotorTorques};
use dynamics_core::effects::Effect;
use dynamics_core::model::Calibrated;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use motion_control::reference::Reference;

use super::{Noise, Scene};
use crate::plant::ClusterPlant;

/// The motors' motion of a reference of y, for a controller whose encoders are at the motors.
///
/// It is NaN where the loops do not close: see [`inverse`].
#[derive(Debug)]
pub struct MotorReference<T, C, const B: usize, const V: usize> {
    pub y: C,
    robot: PhantomData<fn() -> T>,
}

impl<T, C, const B: usize, const V: usize> MotorReference<T, C, B, V> {
    /// The motors' motion of this reference of y.
    pub const fn new(y: C) -> Self {
        Self { y, robot: PhantomData }
    }
}

impl<T, C, const B: usize, const V: usize, const N: usize> Reference<f32, N>
    for MotorReference<T, C, B, V>
where
    T: ClusteredRobot<B, V, V, N, N>,
    C: Reference<f32, N>,
{
    #[inline(always)]
    fn at(&self, tick: u32) -> State<f32, N, N> {
        let motors = Clustered::<Engine<T>>::motors(&self.y.at(tick));
        motors.unwrap_or_else(|_| State::at([f32::NAN; N]))
    }

    fn ticks(&self) -> u32 {
        self.y.ticks()
    }
}

/// The motors' torques at y, ẏ, ÿ; zero where the loops do not close.
///
/// A [`MotorReference`] of the same y is then NaN, and so is the feedback's torque: the supervisor
/// stops the robot with [`Fault::Torque`](motion_control::limits::Fault::Torque), which the
/// telemetry shows. The status of motors near a dead point is not read: the references of the
/// scenes have none.
#[inline(always)]
pub fn inverse<T, E, const B: usize, const V: usize, const N: usize>(
    y: &State<f32, N, N>,
    effects: &E,
) -> [f32; N]
where
    T: ClusteredRobot<B, V, V, N, N>,
    E: Effect<f32, B, V>,
{
    match Clustered::<Engine<T>>::rnea_of_motors(y, effects) {
        Ok(MotorTorques { tau, .. }) => tau,
        Err(_) => [0.0; N],
    }
}

/// A robot at rest at y: that of the scene, or, with noise, one of other masses, of which `disturb`
/// changes the effects.
pub fn plant<S, const B: usize, const V: usize, const N: usize>(
    y: [f32; N],
    noise: Option<&mut Noise>,
    disturb: fn(&mut S::Effects, &mut Noise),
) -> ClusterPlant<S::Robot, S::Effects, B, V, N>
where
    S: Scene<B, V, V, N>,
    S::Robot: ClusteredRobot<B, V, V, N, N>,
{
    let mut effects = S::EFFECTS;
    let mut robot = Calibrated::nominal();
    if let Some(noise) = noise {
        noise.masses(&mut robot);
        disturb(&mut effects, noise);
    }
    ClusterPlant::new(robot, effects, y)
}

/// The inertia at each motor at y while the other motors do not move, kg·m²: the diagonal of G_a⁻ᵀ
/// Gᵀ M G G_a⁻¹.
///
/// # Errors
/// [`ClusterError`] names the cluster that does not close at y.
pub fn inertia<S, const B: usize, const V: usize, const N: usize>(
    y: [f32; N],
) -> Result<[f32; N], ClusterError>
where
    S: Scene<B, V, V, N>,
    S::Robot: ClusteredRobot<B, V, V, N, N>,
{
    let motion = Clustered::<Core<S::Robot>>::motion(&State::at(y))?;
    let m = motion.inertia(&Core::<S::Robot>::crba(motion.configuration(), &S::EFFECTS));
    // G_a⁻ᵀ of the columns, and then of the rows.
    let mut half = [[0.0; N]; N];
    for (k, column) in half.iter_mut().enumerate() {
        *column = motion.to_motors(&core::array::from_fn(|i| m.get(i, k)))?.tau;
    }
    let mut diagonal = [0.0; N];
    for (j, entry) in diagonal.iter_mut().enumerate() {
        let row = core::array::from_fn(|k| half[k][j]);
        *entry = motion.to_motors(&row)?.tau[j];
    }
    Ok(diagonal)
}
