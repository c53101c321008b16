//! Evaluates the hooks of effects for the textbook algorithms, in the frames in which hooks are
//! defined.

use super::{
    BodyState, Declared, Effect, JointState, Scene, TorqueDerivatives, call_hook, field_axes, hook,
    loads, only_load,
};
use crate::model::LinkView;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::{State, entry};

/// The field g, in base coordinates.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn field<R: Real, E, const B: usize, const V: usize>(effects: &E) -> R::Vec3
where
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::MEANING };
    let [x, y, z] = const { field_axes::<R, E, B, V>() };
    if !(x | y | z) {
        return R::Vec3::ZERO;
    }
    let mut g = R::Vec3::ZERO;
    call_hook!(E::GRAVITY_FIELD.add, effects, &mut g);
    let g = g.array();
    let only_if = |declared, g| if declared { g } else { R::ZERO };
    R::Vec3::new(only_if(x, g[0]), only_if(y, g[1]), only_if(z, g[2]))
}

/// v₀ and a₀ of the base, a₀ less the field g: gravity is an acceleration of the base. RBDA (5.20).
#[cfg_attr(optimised, inline(always))]
pub(crate) fn base_motion<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
) -> (Motion<R>, Motion<R>)
where
    E: Effect<R, B, V>,
{
    let g = field(effects);
    if !E::BASE_MOTION {
        return (Motion::ZERO, Motion::new(R::Vec3::ZERO, -g));
    }
    let (v, mut a) = base_given(effects);
    a.lin -= g;
    (v, a)
}

/// v₀ and a₀ of the base.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn base_given<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
) -> (Motion<R>, Motion<R>)
where
    E: Effect<R, B, V>,
{
    let (mut v, mut a) = (Motion::ZERO, Motion::ZERO);
    if E::BASE_MOTION {
        call_hook!(E::BASE.add, effects, &mut v, &mut a);
    }
    (v, a)
}

/// The mass that the effects add to body `i`, kg.
#[doc(hidden)]
pub fn payload_mass<R: Real, E, const B: usize, const V: usize>(effects: &E, i: usize) -> R
where
    E: Effect<R, B, V>,
{
    let mut load = SpatialInertia::ZERO;
    if const { &E::PAYLOAD }.get(i) == Some(&true) {
        call_hook!(E::ADDED_INERTIA.add, effects, i, &mut load);
    }
    load.mass
}

/// The inertia of body `i` with the contributions of the effects, in its aligned frame.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn body_inertia<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    i: usize,
    link: &LinkView<'_, R>,
) -> SpatialInertia<R>
where
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    let (none, single) = const { (loads::<R, E, B, V>() == 0, loads::<R, E, B, V>() == 1) };
    // The number of a single load is a constant, with which the hook's own comparison is folded.
    let body = if single { const { only_load::<R, E, B, V>() } } else { i };
    if none || body != i || !(single || is_loaded::<R, E, B, V>(i)) {
        return link.inertia;
    }
    let mut load = SpatialInertia::ZERO;
    call_hook!(E::ADDED_INERTIA.add, effects, body, &mut load);
    link.inertia
        + SpatialInertia {
            mass: load.mass,
            first_moment: link.to_joint_frame * load.first_moment,
            rotational: link.to_joint_frame * load.rotational * link.to_joint_frame.transpose(),
        }
}

/// Whether body `i` carries a payload.
#[cfg_attr(optimised, inline(always))]
fn is_loaded<R: Real, E, const B: usize, const V: usize>(i: usize) -> bool
where
    E: Effect<R, B, V>,
{
    const { &E::PAYLOAD }.get(i) == Some(&true)
}

/// fˣ on body `i`, in its aligned frame; `pose` and `v` are that frame's.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn body_wrench<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    i: usize,
    link: &LinkView<'_, R>,
    pose: &Xform<R>,
    v: Motion<R>,
) -> Force<R>
where
    E: Effect<R, B, V>,
{
    let (frame, mut fx) = (&link.to_joint_frame, Force::ZERO);
    let mut at = BodyState { pose: Xform::IDENTITY, velocity: Motion::ZERO, base: None };
    if E::BASE_MOTION && E::BODY_VELOCITY {
        at.base = Some(base_given(effects).0);
    }
    if E::BODY_POSE {
        at.pose = Xform { rot: frame.transpose() * pose.rot, pos: pose.pos };
    }
    if E::BODY_VELOCITY {
        at.velocity = Motion::new(frame.transpose_mul(v.ang), frame.transpose_mul(v.lin));
    }
    hook::add_wrench(effects, i, &at, &mut fx);
    Force::new(*frame * fx.ang, *frame * fx.lin)
}

/// The state that joint hooks read of velocity coordinate k.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn joint_state<R: Real, const Q: usize, const V: usize>(
    link: &LinkView<'_, R>,
    state: &State<R, Q, V>,
    k: usize,
) -> JointState<R> {
    JointState { q: link.position(&state.q, k), qd: entry(&state.qd, k) }
}

/// Adds to the torques of one joint's coordinates those of the effects, inertia times q̈ included.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn joint_torques<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    state: &State<R, Q, V>,
    tau: &mut [R; V],
) where
    E: Effect<R, B, V>,
{
    for k in link.coordinates() {
        if let Some(tau) = tau.get_mut(k) {
            effects.torque(k, joint_state(link, state, k), tau);
            if let Some(inertia) = effects.inertia(k) {
                *tau += inertia * entry(&state.qdd, k);
            }
        }
    }
}

/// The torque of the effects at one joint's coordinate at q̈ = 0.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn joint_torque<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    state: &State<R, Q, V>,
    joint: usize,
) -> R
where
    E: Effect<R, B, V>,
{
    let mut loss = R::ZERO;
    effects.torque(joint, joint_state(link, state, joint), &mut loss);
    loss
}

/// Adds the torque of the effects at one joint's coordinate, and its first two derivatives, along a
/// course with these derivatives of q from the second to the fourth. ∂τ/∂q and ∂τ/∂q̇ are taken as
/// constant.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn add_joint_torque_rates<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    joint: usize,
    at: JointState<R>,
    [qdd, jerk, snap]: [R; 3],
    [tau, rate, accel]: &mut [R; 3],
) where
    E: Effect<R, B, V>,
{
    let mut by = TorqueDerivatives::default();
    effects.torque(joint, at, tau);
    effects.derivatives(joint, at, &mut by);
    *rate += by.dq * at.qd + by.dqd * qdd;
    *accel += by.dq * qdd + by.dqd * jerk;
    if let Some(inertia) = effects.inertia(joint) {
        *tau += inertia * qdd;
        *rate += inertia * jerk;
        *accel += inertia * snap;
    }
}

/// Adds what stands at `joint` to an entry of M's diagonal.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn add_inertia<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    joint: usize,
    diagonal: &mut R,
) where
    E: Effect<R, B, V>,
{
    if let Some(inertia) = effects.inertia(joint) {
        *diagonal += inertia;
    }
}

/// ρ I z of the rotor that spins about the axis of this joint's only coordinate.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rotor_force<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
) -> Force<R>
where
    E: Effect<R, B, V>,
{
    let (mut coupling, coordinates) = (R::ZERO, link.coordinates());
    if coordinates.len() == 1 {
        call_hook!(E::ROTOR.add, effects, coordinates.start, &mut coupling);
    }
    Force::new(R::Vec3::new(R::ZERO, R::ZERO, coupling), R::Vec3::ZERO)
}

/// ρ I (q̈ z + q̇ ω × z): the couple that the parent link exerts on such a rotor, in the body's
/// aligned frame.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn gyroscopic<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    omega: R::Vec3,
    rate: R,
    accel: R,
) -> R::Vec3
where
    E: Effect<R, B, V>,
{
    let axis = rotor_force(effects, link).ang;
    axis * accel + omega.cross(axis) * rate
}
