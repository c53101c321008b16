//! Inverse dynamics by one recursion over the bodies: the outward pass on entering a joint, the
//! inward pass on returning from its children, so that intermediate values stay in registers.

use super::acceleration_field::{AccelerationField, Inertia, Wrench, along_z};
use super::base::base;
use super::compile::{BodyPlacement, Compiled, CompiledJoint, JointPair, last, load, loads, place};
use super::displacement::Displacement;
use super::folding::Folded;
use super::folding::{Mat3, Sym3, Vec3};
use super::joint_rates::{JointRates, SeveralRates, Twist};
use super::only_if;
use super::rotors::{borne, coupling, felt};
use super::subtree::{has_subtree_functions, root_subtree, visit_child};
use crate::effects::{
    BodyState, Declared, Effect, JointState, RegroupedInertia, call_hook, hook, load_friction,
};
use crate::model::JointCoordinate;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::{JointTrig, State};

/// The data that all bodies share.
pub(crate) struct Task<'a, R: Real, E, const Q: usize, const V: usize> {
    pub(crate) turns: &'a [JointCoordinate<R>; Q],
    /// The same, loaded again in the inward pass where registers are short.
    pub(crate) back: &'a [JointCoordinate<R>; Q],
    pub(crate) state: &'a State<R, Q, V>,
    pub(crate) effects: &'a E,
    pub(crate) tau: &'a mut [R; V],
}

/// The recursion of inverse dynamics; `back` is `trig` as the inward pass loads it.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn torques<R, C, E, const B: usize, const Q: usize, const V: usize>(
    trig: &JointTrig<R, Q>,
    back: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
) -> [R; V]
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    // A constant: behind a loop that clears the torques the compiler would reverse the order of the
    // sines and spill more of them.
    let mut tau = const { [R::ZERO; V] };
    write_torques::<R, C, E, B, Q, V>(trig, back, state, effects, &mut tau);
    tau
}

/// The torques of [`torques`], written into `tau`, which holds zeros.
#[cfg_attr(optimised, inline(always))]
pub(super) fn write_torques<R, C, E, const B: usize, const Q: usize, const V: usize>(
    trig: &JointTrig<R, Q>,
    back: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    tau: &mut [R; V],
) where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let base = base::<R, E, B, V>(effects, C::LENGTH);
    let mut task = Task {
        turns: &trig.coordinates,
        back: &back.coordinates,
        state,
        effects,
        tau,
    };
    for_each_joint!(J, {
        if const { CompiledJoint::<C, J>::IS_ON_BASE && !has_subtree_functions::<C>(E::WRENCH) }
            && let Some(visit) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE && !has_subtree_functions::<C>(E::WRENCH),
                    visit::<R, C, E, B, Q, V, J> as Visit<R, E, Q, V>,
                )
            }
        {
            visit(&mut task, &base);
        }
        if const { CompiledJoint::<C, J>::IS_ON_BASE && has_subtree_functions::<C>(E::WRENCH) }
            && let Some(visit) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE && has_subtree_functions::<C>(E::WRENCH),
                    root_subtree::<R, C, E, B, Q, V, J> as fn(&mut Task<'_, R, E, Q, V>),
                )
            }
        {
            visit(&mut task);
        }
    });
}

/// A function that visits a joint.
pub(crate) type Visit<R, E, const Q: usize, const V: usize> =
    fn(&mut Task<'_, R, E, Q, V>, &AccelerationField<R>) -> Wrench<R>;

/// Visits joint I and its descendants; returns the wrench that they need from the parent, in its
/// frame.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn visit<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    parent: &AccelerationField<R>,
) -> Wrench<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let (at, mut field) = across::<R, C, E, B, Q, V, I>(task, parent);
    if E::BODY_POSE {
        field.pose = parent.pose.transformed_by::<C, I>(&at);
    }
    let body = inertia::<R, C, E, B, Q, V, I>(task.effects, E::BASE_MOTION);
    let mut total = field.wrench(&body);
    if const { is_round::<R, C, E, B, V, I>() } {
        let second = &CompiledJoint::<C, I>::JOINT.second;
        total.n.0[2] = field.alpha.0[2] * Folded::constant(second.x_axis.x + second.y_axis.y);
    }
    if E::WRENCH {
        total = environment::<R, C, E, B, Q, V, I>(task.effects, &field, total);
    }

    for_each_joint!(J, {
        if JointPair::<C, I, J>::IS_CHILD
            && let Some(visit) = const {
                only_if(
                    JointPair::<C, I, J>::IS_CHILD,
                    visit_child::<R, C, E, B, Q, V, I, J> as Visit<R, E, Q, V>,
                )
            }
        {
            let child = visit(task, &field);
            total = Wrench {
                f: total.f + child.f,
                n: total.n + child.n,
            };
        }
    });

    if CompiledJoint::<C, I>::COUNT == 1 {
        let felt = felt::<R, C, E, B, V, I>(task.effects, total, parent.alpha);
        drive::<R, C, E, B, Q, V, I>(task, &felt);
        let couple = spin::<R, C, E, B, Q, V, I>(task, &field);
        total = borne::<R, E, B, V>(task.effects, total, couple);
    } else if let Some(drive) = const {
        only_if(
            CompiledJoint::<C, I>::COUNT > 1,
            drive_several::<R, C, E, B, Q, V, I> as fn(&mut Task<'_, R, E, Q, V>, &Wrench<R>),
        )
    } {
        drive(task, &total);
    }

    if const { is_round::<R, C, E, B, V, I>() } {
        return total.turned_to_parent::<C, I>(&at);
    }
    let turn = if C::LOADS_SINES_AGAIN {
        task.back[CompiledJoint::<C, I>::Q]
    } else {
        at.turn
    };
    total.to_parent::<C, I>(&at.with_turn(turn))
}

/// The displacement of joint I, and the field of the body behind it from that of the parent.
#[cfg_attr(optimised, inline(always))]
fn across<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &Task<'_, R, E, Q, V>,
    parent: &AccelerationField<R>,
) -> (Displacement<R>, AccelerationField<R>)
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let joint = CompiledJoint::<C, I>::JOINT;
    let (qd, qdd) = (&task.state.qd, &task.state.qdd);
    if CompiledJoint::<C, I>::COUNT > 1 {
        let rates = SeveralRates {
            velocity: Twist::of::<C, V, I>(qd, E::BODY_VELOCITY),
            products: Twist::of::<C, V, I>(qd, E::VELOCITY_PRODUCTS),
            accel: Twist::of::<C, V, I>(qdd, E::ACCELERATIONS),
        };
        let at = Displacement::of::<C, Q, I>(task.turns);
        return (at, parent.across_several::<C, I>(&at, &rates));
    }
    // Rates are loaded before sines and cosines, and q̈ first: less is spilled.
    let (qdd, qd) = (qdd[I], qd[I]);
    let unit = if joint.prismatic {
        Folded::constant(C::LENGTH_INV)
    } else {
        Folded::constant(1.0)
    };
    let rates = JointRates {
        velocity: Folded::runtime_if(E::BODY_VELOCITY, qd) * unit,
        omega_products: Folded::runtime_if(E::VELOCITY_PRODUCTS, qd) * unit,
        accel: Folded::runtime_if(E::ACCELERATIONS, qdd) * unit,
    };
    let at = Displacement::of::<C, Q, I>(task.turns);
    if const { is_round::<R, C, E, B, V, I>() } {
        // No turn changes what this body does to the others.
        return (at, parent.across_revolute::<false>(joint, at.turn, rates));
    }
    (at, parent.across::<C, I>(&at, rates))
}

/// Whether nothing in the scene feels how far the last body behind joint I has turned.
const fn is_round<R: Real, C: Compiled, E, const B: usize, const V: usize, const I: usize>() -> bool
where
    E: Effect<R, B, V>,
{
    CompiledJoint::<C, I>::IS_ROUND
        && !(E::WRENCH || E::GYROSCOPIC_ROTORS)
        && E::BASE_PARAMETERS == 0
        && loads::<C>(I, &E::PAYLOAD) == 0
}

/// ρ I (q̈ z + q̇ ω × z): the couple that the parent exerts on the rotor of joint I.
#[cfg_attr(optimised, inline(always))]
fn spin<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &Task<'_, R, E, Q, V>,
    field: &AccelerationField<R>,
) -> Vec3<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let coupling = coupling::<R, C, E, B, V, I>(task.effects);
    let qd = Folded::runtime_if(E::VELOCITY_PRODUCTS, task.state.qd[I]);
    let qdd = Folded::runtime_if(E::ACCELERATIONS, task.state.qdd[I]);
    along_z(coupling * qdd) + field.omega_products.cross(along_z(coupling * qd))
}

/// The torque of the motor of coordinate I, which carries `total`.
#[cfg_attr(optimised, inline(always))]
pub(super) fn drive<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    total: &Wrench<R>,
) where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let at = joint_state::<R, C, Q, V, I>(task.state);
    let length_inv = Folded::constant(C::LENGTH_INV);
    let mut tau = total.along(CompiledJoint::<C, I>::JOINT, length_inv).get();
    task.effects.torque(I, at, &mut tau);
    if let Some(inertia) = task.effects.inertia(I) {
        tau += inertia * task.state.qdd[I];
    }
    load_friction(task.effects, I, at, &mut tau);
    task.tau[I] = tau;
}

/// The same of all coordinates of a joint.
#[cfg_attr(optimised, inline(always))]
fn drive_several<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    total: &Wrench<R>,
) where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    for_each_joint!(K, {
        if JointPair::<C, I, K>::IS_COORDINATE
            && let Some(drive) = const {
                only_if(
                    JointPair::<C, I, K>::IS_COORDINATE,
                    drive::<R, C, E, B, Q, V, K> as fn(&mut Task<'_, R, E, Q, V>, &Wrench<R>),
                )
            }
        {
            drive(task, total);
        }
    });
}

/// What effects at coordinate I read.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn joint_state<R: Real, C: Compiled, const Q: usize, const V: usize, const I: usize>(
    state: &State<R, Q, V>,
) -> JointState<R> {
    let q = match CompiledJoint::<C, I>::POSITION {
        Some(position) => state.q[position],
        None => R::ZERO,
    };
    JointState::new(q, state.qd[I])
}

/// The inertia of the body behind joint I, with its payloads; all of Σ if the base moves.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn inertia<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    effects: &E,
    base_moves: bool,
) -> Inertia<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let body = own_inertia::<R, C, E, B, Q, V, I>(effects, base_moves);
    with_payloads::<R, C, E, B, Q, V, I>(effects, body)
}

/// The same in M, and the inertia that only the rotation of its own joint feels.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn matrix_inertia<
    R,
    C,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const I: usize,
>(
    effects: &E,
) -> (Inertia<R>, Folded<R>)
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    // Those of M are known at compile time only.
    let (body, spin) = if const { E::BASE_PARAMETERS > 0 } {
        let body = own_inertia::<R, C, E, B, Q, V, I>(effects, false);
        (body, Folded::ZERO)
    } else {
        let joint = CompiledJoint::<C, I>::BODY;
        (Inertia::in_matrix(joint), Folded::constant(joint.spin))
    };
    (with_payloads::<R, C, E, B, Q, V, I>(effects, body), spin)
}

#[cfg_attr(optimised, inline(always))]
fn with_payloads<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    effects: &E,
    body: Inertia<R>,
) -> Inertia<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    match const {
        only_if(
            loads::<C>(last::<C>(I), &E::PAYLOAD) > 0,
            loaded::<R, C, E, B, Q, V, I> as fn(&E, Inertia<R>) -> Inertia<R>,
        )
    } {
        Some(loaded) => loaded(effects, body),
        None => body,
    }
}

/// The same without payloads: the description's, or that of the loaded base parameters.
#[cfg_attr(optimised, inline(always))]
fn own_inertia<R: Real, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    effects: &E,
    base_moves: bool,
) -> Inertia<R>
where
    C: Compiled,
    E: Effect<R, B, V>,
{
    let joint = CompiledJoint::<C, I>::BODY;
    if const { E::BASE_PARAMETERS > 0 } {
        let mut body = RegroupedInertia::default();
        call_hook!(
            E::REGROUPED.load,
            effects,
            CompiledJoint::<C, I>::LAST,
            &mut body
        );
        Inertia::loaded(&body, CompiledJoint::<C, I>::FIRST, base_moves)
    } else if base_moves {
        Inertia::second_moment_only(joint)
    } else {
        Inertia::of(joint)
    }
}

/// Adds the payloads of the bodies on joint I, which are given in those bodies' own frames, to its
/// inertia.
#[cfg_attr(optimised, inline(always))]
fn loaded<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    effects: &E,
    mut body: Inertia<R>,
) -> Inertia<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    const {
        assert!(
            loads::<C>(last::<C>(I), &E::PAYLOAD) <= 32,
            "the engine takes up to 32 bodies with payloads on one joint; use `Core`"
        )
    };
    for_each_joint!(K, {
        if const { K < loads::<C>(last::<C>(I), &E::PAYLOAD) } {
            let of = const { load::<C>(last::<C>(I), K, &E::PAYLOAD) };
            let place = const {
                let of = load::<C>(last::<C>(I), K, &E::PAYLOAD);
                &place::<C>(of)
            };
            let length = C::LENGTH;
            body = with_load(effects, of, place, length, body);
        }
    });
    body
}

/// Adds the payload of one body, at `place`.
#[cfg_attr(optimised, inline(always))]
fn with_load<R, E, const B: usize, const V: usize>(
    effects: &E,
    of: usize,
    place: &'static BodyPlacement,
    length: f64,
    body: Inertia<R>,
) -> Inertia<R>
where
    R: Real,
    E: Effect<R, B, V>,
{
    let (rot, d) = (Mat3::constant(&place.rot), Vec3::constant(place.pos));
    let length = Folded::constant(length);
    let mut load = SpatialInertia::ZERO;
    call_hook!(E::ADDED_INERTIA.add, effects, of, &mut load);
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
pub(crate) fn environment<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    effects: &E,
    field: &AccelerationField<R>,
    mut total: Wrench<R>,
) -> Wrench<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    // Evaluated in scenes without wrenches, too, where their number does not matter.
    const {
        assert!(
            !E::WRENCH || CompiledJoint::<C, I>::BODIES <= 32,
            "the engine takes wrenches on up to 32 bodies that move with one joint; use `Core`"
        )
    };
    // Body by body: in a loop their places would be no constants, and nothing would fold.
    for_each_joint!(K, {
        if JointPair::<C, I, K>::HAS_BODY {
            let (body, place) = JointPair::<C, I, K>::BODY;
            let length = C::LENGTH;
            let fx = exerted(effects, *body, place, length, field);
            total = Wrench {
                f: total.f - fx.f,
                n: total.n - fx.n,
            };
        }
    });
    total
}

/// The wrench fˣ of one body, which the effects give in its own frame, in that of its joint.
#[cfg_attr(optimised, inline(always))]
fn exerted<R, E, const B: usize, const V: usize>(
    effects: &E,
    body: usize,
    place: &'static BodyPlacement,
    length: f64,
    field: &AccelerationField<R>,
) -> Wrench<R>
where
    R: Real,
    E: Effect<R, B, V>,
{
    let length = Folded::constant(length);
    let (rot, pos) = (Mat3::constant(&place.rot), Vec3::constant(place.pos));
    let mut at = BodyState {
        pose: Xform::IDENTITY,
        velocity: Motion::ZERO,
        base: None,
    };
    if E::BASE_MOTION && E::BODY_VELOCITY {
        let (mut base, mut acceleration) = (Motion::ZERO, Motion::ZERO);
        call_hook!(E::BASE.add, effects, &mut base, &mut acceleration);
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
    hook::add_wrench(effects, body, &at, &mut fx);
    let f = rot.mul(Vec3::runtime(fx.lin)).scale(length);
    let n = rot.mul(Vec3::runtime(fx.ang)) + pos.cross(f);
    Wrench { f, n }
}
