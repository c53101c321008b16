//! Tuples of effects: constants are joined, hooks run in the order of the tuple.

use super::{BodyState, Effect, JointState, TorqueDerivatives};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, SpatialInertia};

/// Which bodies any of the effects loads.
const fn joined<const B: usize, const N: usize>(effects: &[[bool; B]; N]) -> [bool; B] {
    let (mut any, mut i) = ([false; B], 0);
    while i < N * B {
        any[i % B] |= effects[i / B][i % B];
        i += 1;
    }
    any
}

macro_rules! tuple {
    ($($name:ident $at:tt),*) => {
        impl<R: Real, const B: usize, const V: usize, $($name: Effect<R, B, V>),*> Effect<R, B, V>
            for ($($name,)*)
        {
            const FIELD: bool = false $(| $name::FIELD)*;
            const FIELD_AXES: [bool; 3] = [
                false $(| $name::FIELD_AXES[0])*,
                false $(| $name::FIELD_AXES[1])*,
                false $(| $name::FIELD_AXES[2])*,
            ];
            const ACCELERATIONS: bool = false $(| $name::ACCELERATIONS)*;
            const VELOCITY_PRODUCTS: bool = false $(| $name::VELOCITY_PRODUCTS)*;
            const WRENCH: bool = false $(| $name::WRENCH)*;
            const BODY_VELOCITY: bool = false $(| $name::BODY_VELOCITY)*;
            const BODY_POSE: bool = false $(| $name::BODY_POSE)*;
            const BASE_MOTION: bool = false $(| $name::BASE_MOTION)*;
            const GRAVITIES: usize = 0 $(+ $name::GRAVITIES)*;
            const PAYLOAD: [bool; B] = joined(&[$($name::PAYLOAD),*]);
            const GYROSCOPIC_ROTORS: bool = false $(| $name::GYROSCOPIC_ROTORS)*;

            #[inline(always)]
            fn payload(&self, body: usize, inertia: &mut SpatialInertia<R>) {
                let _ = (body, &inertia);
                $(self.$at.payload(body, inertia);)*
            }

            #[inline(always)]
            fn field(&self, g: &mut R::Vec3) {
                let _ = &g;
                $(self.$at.field(g);)*
            }
            #[inline(always)]
            fn base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
                let _ = (&velocity, &acceleration);
                $(self.$at.base(velocity, acceleration);)*
            }
            #[inline(always)]
            fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
                let _ = (body, at, &fx);
                $(self.$at.wrench(body, at, fx);)*
            }
            #[inline(always)]
            fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
                let _ = (joint, at, &tau);
                $(self.$at.torque(joint, at, tau);)*
            }
            #[inline(always)]
            fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
                let _ = (joint, at, &derivatives);
                $(self.$at.derivatives(joint, at, derivatives);)*
            }
            #[inline(always)]
            fn advance(&mut self, joint: usize, at: JointState<R>, h: R) {
                let _ = (joint, at, h);
                $(self.$at.advance(joint, at, h);)*
            }
            #[inline(always)]
            fn inertia(&self, joint: usize, diagonal: &mut R) {
                let _ = (joint, &diagonal);
                $(self.$at.inertia(joint, diagonal);)*
            }
            #[inline(always)]
            fn spin(&self, joint: usize, coupling: &mut R) {
                let _ = (joint, &coupling);
                $(self.$at.spin(joint, coupling);)*
            }
        }
    };
}

tuple!();
tuple!(E0 0);
tuple!(E0 0, E1 1);
tuple!(E0 0, E1 1, E2 2);
tuple!(E0 0, E1 1, E2 2, E3 3);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8, E9 9);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8, E9 9, E10 10);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8, E9 9, E10 10, E11 11);
