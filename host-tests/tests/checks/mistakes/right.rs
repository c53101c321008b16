//! Effects that may occur twice in a scene, and a scene with a tool as a constant in both scalars.

use dynamics_core::effects::*;
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

const WRIST: usize = Ur5e::MODEL.body("wrist_3");
type Scene<R> = ((Gravity, Inertia, Coriolis), Viscous<R, 6>, Coulomb<R, 6>, Payload<R, WRIST>);
pub const SINGLE: Scene<f32> = Engine::<Ur5e>::scene_f32((
    RIGID_BODY,
    Viscous([0.5; 6]),
    Coulomb { torque: [1.0; 6], width: Width::f32(0.02) },
    Payload::f32(BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.1], inertia: [0.0; 6] }),
));
pub const DOUBLE: Scene<f64> = Engine::<Ur5e>::scene_f64((
    RIGID_BODY,
    Viscous([0.5; 6]),
    Coulomb { torque: [1.0; 6], width: Width::f64(0.02) },
    Payload::f64(BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.1], inertia: [0.0; 6] }),
));

/// An effect of one's own, whose only hook is its inertia.
#[derive(Clone, Copy)]
pub struct Flywheel;
impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Flywheel {
    fn torque(&self, _: usize, _: JointState<R>, _: &mut R) {}
    fn inertia(&self, _: usize) -> Option<R> {
        Some(R::ONE)
    }
}

const SPRING: Spring<f64, 6> = Spring { stiffness: [1.0; 6], rest: [0.0; 6] };
const PUSH: BodyWrench<f64> = BodyWrench { body: 1, wrench: Force::ZERO };
const WIND: WorldWrench<f64> = WorldWrench { body: 2, wrench: Force::ZERO };
const STOPS: EndStops<f64, 6> = EndStops {
    lower: [-1.0; 6], upper: [1.0; 6], stiffness: 1.0, damping: 1.0, damping_depth: Width::f64(1e-3),
};
const SLOTS: Cogging<f64, 1, 6> = Cogging { per_turn: [1.0; 6], cos: [[0.0]; 6], sin: [[0.0]; 6] };
const ONE_WAY: AsymmetricCoulomb<f64, 6> = AsymmetricCoulomb { forward: [1.0; 6], backward: [1.0; 6], width: Width::f64(0.02) };

pub fn twice(at: &State<f64, 6, 6>, tool: Payload<f64, 5>, cup: Payload<f64, 5>, hose: Payload<f64, 3>) {
    let springs = (SPRING, SPRING, STOPS, STOPS, SLOTS, SLOTS);
    let forces = (PUSH, PUSH, WIND, WIND, tool, cup, hose, Flywheel, Flywheel);
    let _ = Core::<Ur5e>::rnea(at, &(DOUBLE, ONE_WAY, springs, forces));
}
