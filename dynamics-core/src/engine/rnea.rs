//! Inverse dynamics by one recursion over the bodies: the outward pass on entering a joint, the
//! inward pass on returning from its children, so that intermediate values stay in registers.

use super::acceleration_field::{AccelerationField, Inertia, Wrench, along_z};
use super::call::Call;
use super::compile::{
    BodyPlacement, Compiled, CompiledJoint, JointPair, are_whole, has_subtree_functions, last,
    load, loads, place,
};
use super::displacement::Displacement;
use super::folding::Folded;
use super::folding::{Mat3, Sym3, Vec3};
use super::joint_rates::{JointRates, SeveralRates, Twist};
use super::only_if;
use super::reaction::Reactions;
use crate::effects::{
    BodyState, Declared, Effect, RegroupedInertia, call_hook, hook, load_friction,
};
use crate::model::JointCoordinate;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::State;

/// The data that all bodies share.
pub(crate) struct Task<'a, R: Real, T, E, Seen, const B: usize, const Q: usize, const V: usize> {
    pub(super) call: Call<'a, R, T, E, B, Q, V>,
    /// The positions of the call, loaded again in the inward pass where registers are short.
    pub(super) back: &'a [JointCoordinate<R>; Q],
    pub(super) state: &'a State<R, Q, V>,
    pub(super) tau: &'a mut [R; V],
    /// The wrenches that are kept.
    pub(super) seen: Seen,
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The recursion of inverse dynamics; `back` are the positions as the inward pass loads them.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn torques(self, back: &[JointCoordinate<R>; Q], state: &State<R, Q, V>) -> [R; V] {
        // A constant: behind a loop that clears the torques the compiler would reverse the order of
        // the sines and spill more of them.
        let mut tau = const { [R::ZERO; V] };
        self.write_torques(back, state, &mut tau);
        tau
    }

    /// The torques of [`Self::torques`], written into `tau`, which holds zeros.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn write_torques(
        self,
        back: &[JointCoordinate<R>; Q],
        state: &State<R, Q, V>,
        tau: &mut [R; V],
    ) {
        let base = self.base();
        let mut task = Task { call: self, back, state, tau, seen: () };
        for_each_joint!(
            J,
            const { CompiledJoint::<T, J>::IS_ON_BASE && !has_subtree_functions::<T>(E::WRENCH) },
            visit = Task::visit::<J> as fn(&mut _, &_) -> _,
            {
                visit(&mut task, &base);
            }
        );
        for_each_joint!(
            J,
            const { CompiledJoint::<T, J>::IS_ON_BASE && has_subtree_functions::<T>(E::WRENCH) },
            visit = Task::root_subtree::<J> as fn(&mut _),
            {
                visit(&mut task);
            }
        );
    }
}

impl<R, T, E, Seen, const B: usize, const Q: usize, const V: usize> Task<'_, R, T, E, Seen, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
    Seen: Reactions<R, T>,
{
    /// Visits joint I and its descendants; returns the wrench that they need from the parent, in
    /// its frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn visit<const I: usize>(&mut self, parent: &AccelerationField<R>) -> Wrench<R> {
        let (at, mut field) = self.across::<I>(parent);
        if E::BODY_POSE {
            field.pose = parent.pose.transformed_by(&at);
        }
        let body = self.call.inertia::<I>(E::BASE_MOTION);
        let mut total = field.wrench(&body);
        if const { Self::is_round::<I>() } {
            let second = &CompiledJoint::<T, I>::JOINT.second;
            total.n.0[2] = field.alpha.0[2] * Folded::constant(second.x_axis.x + second.y_axis.y);
        }
        if E::WRENCH {
            total = self.call.environment::<I>(&field, total);
        }

        let mut carried = Seen::NOTHING;
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_CHILD,
            visit = Self::visit_child::<I, J> as fn(&mut _, &_) -> Wrench<R>,
            {
                let child = visit(self, &field);
                total = Wrench { f: total.f + child.f, n: total.n + child.n };
                if Seen::KEEPS {
                    Seen::add::<J>(&mut carried, &child);
                }
            }
        );
        if Seen::KEEPS {
            let turn = if const { Self::is_round::<I>() } { Some(at.turn) } else { None };
            self.seen.keep::<E, I, B, Q, V>(self.call, &field, &total, &carried, turn);
        }

        if CompiledJoint::<T, I>::COUNT == 1 {
            let felt = self.call.felt::<I>(total, parent.alpha);
            self.drive::<I>(&felt);
            let couple = self.spin::<I>(&field);
            total = self.call.borne(total, couple);
        } else if let Some(drive) = const {
            only_if(CompiledJoint::<T, I>::COUNT > 1, Self::drive_several::<I> as fn(&mut _, &_))
        } {
            drive(self, &total);
        }

        if const { Self::is_round::<I>() } {
            return total.turned_to_parent(&at);
        }
        let turn = if T::LOADS_SINES_AGAIN { self.back[CompiledJoint::<T, I>::Q] } else { at.turn };
        total.to_parent(&at.with_turn(turn))
    }

    /// The displacement of joint I, and the field of the body behind it from that of the parent.
    #[cfg_attr(optimised, inline(always))]
    fn across<const I: usize>(
        &self,
        parent: &AccelerationField<R>,
    ) -> (Displacement<R, T, I>, AccelerationField<R>) {
        let joint = CompiledJoint::<T, I>::JOINT;
        let (qd, qdd) = (&self.state.qd, &self.state.qdd);
        if CompiledJoint::<T, I>::COUNT > 1 {
            let rates = SeveralRates {
                velocity: Twist::of::<T, V, I>(qd, E::BODY_VELOCITY),
                products: Twist::of::<T, V, I>(qd, E::VELOCITY_PRODUCTS),
                accel: Twist::of::<T, V, I>(qdd, E::ACCELERATIONS),
            };
            let at = self.call.displacement::<I>();
            let field = parent.across_several(&at, &rates);
            return (at, field);
        }
        // Rates are loaded before sines and cosines, and q̈ first: less is spilled.
        let (qdd, qd) = (qdd[I], qd[I]);
        let unit =
            if joint.prismatic { Folded::constant(T::LENGTH_INV) } else { Folded::constant(1.0) };
        let rates = JointRates {
            velocity: Folded::runtime_if(E::BODY_VELOCITY, qd) * unit,
            omega_products: Folded::runtime_if(E::VELOCITY_PRODUCTS, qd) * unit,
            accel: Folded::runtime_if(E::ACCELERATIONS, qdd) * unit,
        };
        let at = self.call.displacement::<I>();
        if const { Self::is_round::<I>() } {
            // No turn changes what this body does to the others.
            let field = parent.across_revolute::<false>(joint, at.turn, rates);
            return (at, field);
        }
        let field = parent.across(&at, rates);
        (at, field)
    }

    /// Whether nothing in the scene feels how far the last body behind joint I has turned.
    const fn is_round<const I: usize>() -> bool {
        CompiledJoint::<T, I>::IS_ROUND
            && !(E::WRENCH || E::GYROSCOPIC_ROTORS)
            && E::BASE_PARAMETERS == 0
            && loads::<T>(I, &E::PAYLOAD) == 0
            && are_whole::<T>(Seen::BODIES, I)
    }

    /// ρ I (q̈ z + q̇ ω × z): the couple that the parent exerts on the rotor of joint I.
    #[cfg_attr(optimised, inline(always))]
    fn spin<const I: usize>(&self, field: &AccelerationField<R>) -> Vec3<R> {
        let coupling = self.call.coupling::<I>();
        let qd = Folded::runtime_if(E::VELOCITY_PRODUCTS, self.state.qd[I]);
        let qdd = Folded::runtime_if(E::ACCELERATIONS, self.state.qdd[I]);
        along_z(coupling * qdd) + field.omega_products.cross(along_z(coupling * qd))
    }

    /// The torque of the motor of coordinate I, which carries `total`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn drive<const I: usize>(&mut self, total: &Wrench<R>) {
        let at = self.call.joint_state::<I>(self.state);
        let length_inv = Folded::constant(T::LENGTH_INV);
        let mut tau = total.along(CompiledJoint::<T, I>::JOINT, length_inv).get();
        self.call.effects.torque(I, at, &mut tau);
        if let Some(inertia) = self.call.effects.inertia(I) {
            tau += inertia * self.state.qdd[I];
        }
        load_friction(self.call.effects, I, at, &mut tau);
        self.tau[I] = tau;
    }

    /// The same of all coordinates of a joint.
    #[cfg_attr(optimised, inline(always))]
    fn drive_several<const I: usize>(&mut self, total: &Wrench<R>) {
        for_each_joint!(
            K,
            JointPair::<T, I, K>::IS_COORDINATE,
            drive = Self::drive::<K> as fn(&mut _, &_),
            {
                drive(self, total);
            }
        );
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The inertia of the body behind joint I, with its payloads; all of Σ if the base moves.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn inertia<const I: usize>(self, base_moves: bool) -> Inertia<R> {
        let body = self.own_inertia::<I>(base_moves);
        self.with_payloads::<I>(body)
    }

    /// The same in M, and the inertia that only the rotation of its own joint feels.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn matrix_inertia<const I: usize>(self) -> (Inertia<R>, Folded<R>) {
        // Those of M are known at compile time only.
        let (body, spin) = if const { E::BASE_PARAMETERS > 0 } {
            let body = self.own_inertia::<I>(false);
            (body, Folded::ZERO)
        } else {
            let joint = CompiledJoint::<T, I>::BODY;
            (Inertia::in_matrix(joint), Folded::constant(joint.spin))
        };
        (self.with_payloads::<I>(body), spin)
    }

    #[cfg_attr(optimised, inline(always))]
    fn with_payloads<const I: usize>(self, body: Inertia<R>) -> Inertia<R> {
        match const {
            only_if(loads::<T>(last::<T>(I), &E::PAYLOAD) > 0, Self::loaded::<I> as fn(_, _) -> _)
        } {
            Some(loaded) => loaded(self, body),
            None => body,
        }
    }

    /// The same without payloads: the description's, or that of the loaded base parameters.
    #[cfg_attr(optimised, inline(always))]
    fn own_inertia<const I: usize>(self, base_moves: bool) -> Inertia<R> {
        let joint = CompiledJoint::<T, I>::BODY;
        if const { E::BASE_PARAMETERS > 0 } {
            let mut body = RegroupedInertia::default();
            call_hook!(E::REGROUPED.load, self.effects, CompiledJoint::<T, I>::LAST, &mut body);
            Inertia::loaded(&body, CompiledJoint::<T, I>::FIRST, base_moves)
        } else if base_moves {
            Inertia::second_moment_only(joint)
        } else {
            Inertia::of(joint)
        }
    }

    /// Adds the payloads of the bodies on joint I, which are given in those bodies' own frames, to
    /// its inertia.
    #[cfg_attr(optimised, inline(always))]
    fn loaded<const I: usize>(self, mut body: Inertia<R>) -> Inertia<R> {
        const {
            assert!(
                loads::<T>(last::<T>(I), &E::PAYLOAD) <= 32,
                "the engine takes up to 32 bodies with payloads on one joint; use `Core`"
            )
        };
        for_each_joint!(K, {
            if const { K < loads::<T>(last::<T>(I), &E::PAYLOAD) } {
                let of = const { load::<T>(last::<T>(I), K, &E::PAYLOAD) };
                let place = const {
                    let of = load::<T>(last::<T>(I), K, &E::PAYLOAD);
                    &place::<T>(of)
                };
                body = self.with_load(of, place, body);
            }
        });
        body
    }

    /// Adds the payload of one body, at `place`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn with_load(
        self,
        of: usize,
        place: &'static BodyPlacement,
        body: Inertia<R>,
    ) -> Inertia<R> {
        let (rot, d) = (Mat3::constant(&place.rot), Vec3::constant(place.pos));
        let length = Folded::constant(T::LENGTH);
        let mut load = SpatialInertia::ZERO;
        call_hook!(E::ADDED_INERTIA.add, self.effects, of, &mut load);
        let mass = Folded::runtime(load.mass) * length * length;
        let h = rot.mul(Vec3::runtime(load.first_moment)).scale(length);
        // Σ = ½ tr(Ī) 1 − Ī, turned and moved to the joint's frame.
        let [x, y, z] = load.rotational.cols();
        let trace = x.array()[0] + y.array()[1] + z.array()[2];
        let half = Folded::runtime(trace * R::from_f64(0.5));
        let zero = Folded::ZERO;
        let sigma = Mat3([
            rot.mul(Vec3([half, zero, zero]) - Vec3::runtime(x)),
            rot.mul(Vec3([zero, half, zero]) - Vec3::runtime(y)),
            rot.mul(Vec3([zero, zero, half]) - Vec3::runtime(z)),
        ]);
        let moved = h + d.scale(mass);
        let [dx, dy, dz] = d.0;
        let [hx, hy, hz] = h.0;
        let [tx, ty, tz] = rot.rows();
        let second = Mat3([
            sigma.mul(tx) + moved.scale(dx) + d.scale(hx),
            sigma.mul(ty) + moved.scale(dy) + d.scale(hy),
            sigma.mul(tz) + moved.scale(dz) + d.scale(hz),
        ]);
        Inertia {
            mass: body.mass + mass,
            moment: body.moment + moved,
            second: body.second + Sym3::of(&second),
        }
    }

    /// Subtracts the wrenches fˣ of the bodies on joint I.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn environment<const I: usize>(
        self,
        field: &AccelerationField<R>,
        mut total: Wrench<R>,
    ) -> Wrench<R> {
        // Evaluated in scenes without wrenches, too, where their number does not matter.
        const {
            assert!(
                !E::WRENCH || CompiledJoint::<T, I>::BODIES <= 32,
                "the engine takes wrenches on up to 32 bodies that move with one joint; use `Core`"
            )
        };
        // Body by body: in a loop their places would be no constants, and nothing would fold.
        for_each_joint!(K, {
            if JointPair::<T, I, K>::HAS_BODY {
                let (body, place) = JointPair::<T, I, K>::BODY;
                let fx = self.exerted(*body, place, field);
                total = Wrench { f: total.f - fx.f, n: total.n - fx.n };
            }
        });
        total
    }

    /// The wrench fˣ of one body, which the effects give in its own frame, in that of its joint.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn exerted(
        self,
        body: usize,
        place: &'static BodyPlacement,
        field: &AccelerationField<R>,
    ) -> Wrench<R> {
        let length = Folded::constant(T::LENGTH);
        let (rot, pos) = (Mat3::constant(&place.rot), Vec3::constant(place.pos));
        let mut at = BodyState { pose: Xform::IDENTITY, velocity: Motion::ZERO, base: None };
        if E::BASE_MOTION && E::BODY_VELOCITY {
            let (mut base, mut acceleration) = (Motion::ZERO, Motion::ZERO);
            call_hook!(E::BASE.add, self.effects, &mut base, &mut acceleration);
            at.base = Some(base);
        }
        if E::BODY_VELOCITY {
            let v = field.v + field.omega.cross(pos);
            at.velocity = Motion::new(
                rot.transpose_mul(field.omega).get(),
                rot.transpose_mul(v).scale(length).get(),
            );
        }
        if E::BODY_POSE {
            at.pose = field.pose.of(place, length);
        }
        let mut fx = Force::ZERO;
        hook::add_wrench(self.effects, body, &at, &mut fx);
        let f = rot.mul(Vec3::runtime(fx.lin)).scale(length);
        let n = rot.mul(Vec3::runtime(fx.ang)) + pos.cross(f);
        Wrench { f, n }
    }
}
