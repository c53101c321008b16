//! What an effect that wraps another passes on as it is.

/// All of an `impl Effect` but `ACCELERATIONS`, `torque` and `inertia`, which a wrapper is there to change,
/// and `derivatives` and `advance`, which belong to the effects themselves: `$inner` is the field that holds them.
macro_rules! passed_on {
    ($inner:tt) => {
        const FIELD: bool = E::FIELD;
        const FIELD_AXES: [bool; 3] = E::FIELD_AXES;
        const VELOCITY_PRODUCTS: bool = E::VELOCITY_PRODUCTS;
        const WRENCH: bool = E::WRENCH;
        const BODY_VELOCITY: bool = E::BODY_VELOCITY;
        const BODY_POSE: bool = E::BODY_POSE;
        const BASE_MOTION: bool = E::BASE_MOTION;
        const GRAVITIES: usize = E::GRAVITIES;
        const PAYLOAD: [bool; B] = E::PAYLOAD;
        const GYROSCOPIC_ROTORS: bool = E::GYROSCOPIC_ROTORS;

        #[inline(always)]
        fn payload(&self, body: usize, inertia: &mut SpatialInertia<R>) {
            self.$inner.payload(body, inertia);
        }

        #[inline(always)]
        fn field(&self, g: &mut R::Vec3) {
            self.$inner.field(g);
        }

        #[inline(always)]
        fn base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
            self.$inner.base(velocity, acceleration);
        }

        #[inline(always)]
        fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
            self.$inner.wrench(body, at, fx);
        }

        #[inline(always)]
        fn spin(&self, joint: usize, coupling: &mut R) {
            self.$inner.spin(joint, coupling);
        }
    };
}

pub(super) use passed_on;
