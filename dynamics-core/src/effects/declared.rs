//! The declarations of an effect's hooks, from these.

use super::{BodyState, BodyVelocity, Declared, Effect, JointState, LoadFactors, RegroupedInertia};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, SpatialInertia};

impl<R: Real, E, const B: usize, const V: usize> Declared<R, B, V> for E
where
    E: Effect<R, B, V>,
{
    const FIELD: bool = E::GRAVITY_FIELD.add.is_some();
    const FIELD_AXES: [bool; 3] = E::GRAVITY_FIELD.axes;
    const GRAVITIES: usize = E::GRAVITY_FIELD.gravities;
    const WRENCH: bool = E::EXTERNAL_WRENCH.is_some();
    const BODY_VELOCITY: bool = E::EXTERNAL_WRENCH.reads_velocity;
    const BODY_POSE: bool = E::EXTERNAL_WRENCH.reads_pose;
    const BASE_MOTION: bool = E::BASE.add.is_some();
    const PAYLOAD: [bool; B] = E::ADDED_INERTIA.bodies;
    const PAYLOAD_ON_NO_BODY: Option<usize> = E::ADDED_INERTIA.no_body;
    const GYROSCOPIC_ROTORS: bool = E::ROTOR.add.is_some();
    const LOAD_DEPENDENT: bool = E::LOAD_FRICTION.factors.is_some();
    const BASE_PARAMETERS: usize = E::REGROUPED.sets;
    const BASE_PARAMETERS_OF: &'static str = E::REGROUPED.robot;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn field(&self, g: &mut R::Vec3) {
        if let Some(add) = const { E::GRAVITY_FIELD.add } {
            add(self, g);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
        if let Some(add) = const { E::BASE.add } {
            add(self, velocity, acceleration);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
        if let Some(add) = const { E::EXTERNAL_WRENCH.constant } {
            add(self, body, fx);
        }
        if let Some(add) = const { E::EXTERNAL_WRENCH.of_pose } {
            add(self, body, &at.pose, fx);
        }
        if let Some(add) = const { E::EXTERNAL_WRENCH.of_velocity } {
            let &BodyState { velocity, base, .. } = at;
            add(self, body, &BodyVelocity { velocity, base }, fx);
        }
        if let Some(add) = const { E::EXTERNAL_WRENCH.of_state } {
            add(self, body, at, fx);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn payload(&self, body: usize, inertia: &mut SpatialInertia<R>) {
        if let Some(add) = const { E::ADDED_INERTIA.add } {
            add(self, body, inertia);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rotor_coupling(&self, joint: usize, coupling: &mut R) {
        if let Some(add) = const { E::ROTOR.add } {
            add(self, joint, coupling);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load_factors(&self, joint: usize, at: JointState<R>, factors: &mut LoadFactors<R>) {
        if let Some(add) = const { E::LOAD_FRICTION.factors } {
            add(self, joint, at, factors);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load_slopes(&self, joint: usize, at: JointState<R>, slopes: &mut LoadFactors<R>) {
        if let Some(add) = const { E::LOAD_FRICTION.slopes } {
            add(self, joint, at, slopes);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn regrouped(&self, joint: usize, body: &mut RegroupedInertia<R>) {
        if let Some(load) = const { E::REGROUPED.load } {
            load(self, joint, body);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_inertia(&self, joint: usize, diagonal: &mut R) {
        if let Some(inertia) = self.inertia(joint) {
            *diagonal += inertia;
        }
    }
}
