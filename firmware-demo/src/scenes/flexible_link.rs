//! Scene `flexible_link`: a light arm whose links bend, under feed-forward with their modes and
//! under one that takes them for rigid. It swings to a pose through a shaper that leaves no
//! vibration, and back without.

use dynamics_core::effects::{Armature, Coriolis, Effect, Elasticity, Gravity, Inertia, Viscous};
use dynamics_core::flexible::{Bending, ModalFeedforward, Modes};
use dynamics_core::model::{Calibrated, Static};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use motion_control::reference::{Shaped, TrajectoryError};

use crate::plant::BendingPlant;
use crate::robots::TwoLink;
use crate::robots::two_link::{MODES_2, MODES_2_SOFT};
use crate::scene::{Noise, PlantModel, Run, Scene, TICK, speeds};
use crate::trajectories::swing_and_back::{Move, SwingAndBack, rest_to_rest, shaper};
use joint_drivers::Law;

pub type Effects = (Gravity, Inertia, Coriolis, Elasticity, Viscous<f32, 2>, Armature<f32, 2>);

/// Gears and motors of this size, assumed.
pub const EFFECTS: Effects =
    (Gravity::EARTH, Inertia, Coriolis, Elasticity, Viscous([1.0, 0.2]), Armature([0.2, 0.04]));

/// The start and end of the arm, rad: q₀ > 0 is below the horizontal.
pub const START: [f32; 2] = [0.3, 0.9];
/// The ends of its swing.
pub const END: [f32; 2] = [-0.6, 0.6];
/// Ticks of a swing.
pub const SWING: u32 = 400;
/// Ticks of the pauses, some four periods of the slow vibration.
pub const PAUSE: u32 = 600;

/// A swing from one of the poses to the other.
///
/// # Errors
/// A motion beyond the joints' limits.
pub fn swing(from: [f32; 2], to: [f32; 2]) -> Result<Move, TrajectoryError> {
    rest_to_rest(from, to, SWING, &speeds(&BendingArm::LIMITS, [100.0; 2]))
}

#[derive(Clone, Copy, Debug)]
pub struct BendingArm;

impl Scene<2, 2, 2, 2> for BendingArm {
    type Robot = TwoLink;
    type Effects = Effects;
    type Reference = SwingAndBack;
    /// The modes under the reference, before the tick.
    type Environment = State<f32, 4, 4>;
    type Plant = BendingPlant<TwoLink, Effects, 2, 4>;

    const NAME: &'static str = "flexible_link";
    const BOUND: f32 = 2e-3;
    const EFFECTS: Effects = EFFECTS;
    const CONSTANT_EFFECTS: bool = true;
    const GAIN_POSE: [f32; 2] = START;
    const GAIN_POSE_NAME: &'static str = "start";
    const BASELINES: &'static [Run<Self, 2, 2, 2, 2>] = &[
        Run::of::<RigidLinks>(PlantModel::Exact, "rigid-links"),
        Run::of::<RigidLinks>(PlantModel::Mismatched, "rigid-links"),
    ];

    fn reference() -> Result<SwingAndBack, TrajectoryError> {
        let (reference, back) = (swing(START, END)?, swing(END, START)?);
        // The modes have a frequency: they are checked while compiling.
        let shaper = shaper(&Static::<TwoLink>::NEW, &MODES_2, END).unwrap_or_default();
        Ok(SwingAndBack::new(Shaped { reference, shaper }, back, PAUSE))
    }

    fn environment(reference: &SwingAndBack, ticks: f32) -> State<f32, 4, 4> {
        reference.modes_before(
            ticks as u32,
            || at_rest(START),
            |modes, state| {
                let moved = Bending::<Engine<TwoLink>>::tick(modes, state, &EFFECTS, TICK);
                // The numbers of the reference are finite.
                let _ = moved;
            },
        )
    }

    fn inverse<E: Effect<f32, 2, 2>>(
        reference: &State<f32, 2, 2>,
        bent: &State<f32, 4, 4>,
        effects: &E,
    ) -> [f32; 2] {
        let mut modes = ModalFeedforward { bent: *bent };
        let tau = Bending::<Engine<TwoLink>>::tick(&mut modes, reference, effects, TICK);
        tau.unwrap_or([0.0; 2])
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        let (mut robot, mut effects) = (Calibrated::nominal(), EFFECTS);
        let modes: &Modes<f32, 4> = if let Some(noise) = noise {
            noise.masses(&mut robot);
            noise.friction(&mut effects.4.0);
            &MODES_2_SOFT
        } else {
            &MODES_2
        };
        BendingPlant::new(robot, *modes, effects, START)
    }
}

/// The modes at rest at a pose.
fn at_rest(q: [f32; 2]) -> State<f32, 4, 4> {
    let rest = ModalFeedforward::at_rest(&Static::<TwoLink>::NEW, &MODES_2, &q, &EFFECTS);
    rest.map_or(State::at([0.0; 4]), |rest| rest.bent)
}

/// Feed-forward that takes the links for rigid.
#[derive(Clone, Copy, Debug)]
pub struct RigidLinks;

impl Law<2, State<f32, 4, 4>> for RigidLinks {
    fn feedforward(reference: &State<f32, 2, 2>, _: &State<f32, 4, 4>) -> [f32; 2] {
        Core::<TwoLink>::rnea(reference, &EFFECTS)
    }
}
