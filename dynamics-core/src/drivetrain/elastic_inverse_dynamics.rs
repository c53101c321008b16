//! Inverse dynamics with compliant joints: the motors' torques for a trajectory of the links with
//! four derivatives.
//!
//! De Luca & Lucibello, "A general algorithm for dynamic feedback linearization of robots with
//! elastic joints" (1998); Buondonno & De Luca, "A recursive Newton-Euler algorithm for robots with
//! elastic joints" (2015). The derivatives τ̇ and τ̈ are computed by components in link
//! coordinates, with W_j = S q⁽ʲ⁺¹⁾, the rule of Leibniz and
//!
//! ```text
//! d/dt (X m) = X ṁ − W₀ × X m      d/dt (Xᵀ f) = Xᵀ (ḟ + W₀ ×* f)
//! ```

use core::fmt;

use heapless::Vec;

use super::ElasticJoints;
use crate::algorithms::inward;
use crate::effects::{
    Declared, Effect, add_joint_torque_rates, base_motion, body_inertia, joint_state,
    no_load_friction,
};
use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::{JointTrig, State, entry};

/// The reference of the links: positions with four derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticReference<R, const Q: usize, const V: usize> {
    /// q, q̇ and q̈.
    pub state: State<R, Q, V>,
    /// The third derivative, rad/s³ or m/s³.
    pub jerk: [R; V],
    /// The fourth derivative, rad/s⁴ or m/s⁴.
    pub snap: [R; V],
}

/// The command to the drives of elastic joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticCommand<R, const V: usize> {
    /// Torque τ_m of each motor, N·m or N.
    pub torque: [R; V],
    /// Angle θ of each motor, reflected to the joint, rad or m.
    pub position: [R; V],
    /// Its rate θ̇, rad/s or m/s.
    pub velocity: [R; V],
}

/// The error for a joint of several degrees of freedom: no transmission is defined for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct MultiDofJoint {
    /// The body on that joint.
    pub body: usize,
}

impl fmt::Display for MultiDofJoint {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "the joint of body {} has several degrees of freedom: no transmission of it is known",
            self.body
        )
    }
}

impl core::error::Error for MultiDofJoint {}

/// Torques τ_m, angles θ and rates θ̇ of the motors for a motion of the links.
///
/// ```text
/// τ = ID(q, q̇, q̈)      θ = q + τ / k      τ_m = J θ̈ + b θ̇ + τ
/// ```
///
/// Effects act on the links. The torques of joint effects are differentiated with derivatives that
/// are assumed constant: this is exact for springs and viscous friction, and for Coulomb friction
/// at speeds above its width. Effects that exert wrenches on bodies or move the base have no known
/// derivatives and do not compile. Cost: some 1000 flops per joint, O(B).
///
/// ```
/// use dynamics_core::effects::RIGID_BODY;
/// use dynamics_core::drivetrain::{ElasticReference, ElasticJoints, elastic_inverse_dynamics};
/// use dynamics_core::{algorithms::rnea, model::Robot, robots::Ur5e, state::State};
/// let joints = ElasticJoints { stiffness: [1e4_f64; 6], rotor: [1.0; 6], friction: [0.0; 6] };
/// let rest = ElasticReference { state: State::at([0.3; 6]), jerk: [0.0; 6], snap: [0.0; 6] };
/// let command = elastic_inverse_dynamics(&Ur5e::MODEL, &joints, &rest, &RIGID_BODY)?;
/// let weight = rnea(&Ur5e::MODEL, &rest.state, &RIGID_BODY);
/// assert!((command.torque[1] - weight[1]).abs() < 1e-12);
/// assert!((command.position[1] - 0.3 - weight[1] / 1e4).abs() < 1e-15); // the spring is wound up
/// # Ok::<(), dynamics_core::drivetrain::MultiDofJoint>(())
/// ```
///
/// ```compile_fail,E0080
/// use dynamics_core::effects::{BodyWrench, RIGID_BODY};
/// use dynamics_core::drivetrain::{ElasticReference, ElasticJoints, elastic_inverse_dynamics};
/// use dynamics_core::{model::Robot, robots::Ur5e, spatial::Force, state::State};
/// let joints = ElasticJoints { stiffness: [1e4_f64; 6], rotor: [1.0; 6], friction: [0.0; 6] };
/// let rest = ElasticReference { state: State::at([0.3; 6]), jerk: [0.0; 6], snap: [0.0; 6] };
/// let pushed = (RIGID_BODY, BodyWrench { body: 5, wrench: Force::<f64>::ZERO });
/// let _ = elastic_inverse_dynamics(&Ur5e::MODEL, &joints, &rest, &pushed);
/// // error: inverse dynamics of compliant joints allows no wrenches on bodies, moving base or `GyroscopicRotors`
/// ```
///
/// # Errors
/// [`MultiDofJoint`] names a body on a joint of several degrees of freedom.
pub fn elastic_inverse_dynamics<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    joints: &ElasticJoints<R, V>,
    reference: &ElasticReference<R, Q, V>,
    effects: &E,
) -> Result<ElasticCommand<R, V>, MultiDofJoint>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    for (body, link) in robot.links().enumerate() {
        if link.coordinates().len() > 1 {
            return Err(MultiDofJoint { body });
        }
    }
    Ok(command(robot, joints, reference, effects))
}

/// The same of a robot all of whose joints have one degree of freedom.
pub(super) fn command<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    joints: &ElasticJoints<R, V>,
    reference: &ElasticReference<R, Q, V>,
    effects: &E,
) -> ElasticCommand<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let rates = torque_rates(robot, reference, effects);
    let mut command = ElasticCommand::ZERO;
    for link in robot.links() {
        for i in link.coordinates() {
            let q = link.position(&reference.state.q, i);
            command.set(i, joints, q, reference, rates.map(|tau| entry(&tau, i)));
        }
    }
    command
}

impl<R: Real, const V: usize> ElasticCommand<R, V> {
    pub(super) const ZERO: Self =
        Self { torque: [R::ZERO; V], position: [R::ZERO; V], velocity: [R::ZERO; V] };

    /// The motor of joint i at q, whose spring transmits τ with these derivatives: θ = q + τ/k, τ_m
    /// = J θ̈ + b θ̇ + τ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<const Q: usize>(
        &mut self,
        i: usize,
        joints: &ElasticJoints<R, V>,
        q: R,
        reference: &ElasticReference<R, Q, V>,
        [tau, rate, accel]: [R; 3],
    ) {
        let State { qd, qdd, .. } = &reference.state;
        let k_inv = R::ONE / entry(&joints.stiffness, i);
        let velocity = entry(qd, i) + rate * k_inv;
        let inertial = entry(&joints.rotor, i) * (entry(qdd, i) + accel * k_inv);
        let torque = inertial + entry(&joints.friction, i) * velocity + tau;
        let values = [torque, q + tau * k_inv, velocity];
        let places = [&mut self.torque, &mut self.position, &mut self.velocity];
        for (place, value) in places.into_iter().zip(values) {
            if let Some(place) = place.get_mut(i) {
                *place = value;
            }
        }
    }
}

/// Velocity of a body and its derivatives by components; the first is its spatial acceleration.
type MotionDerivatives<R> = [Motion<R>; 4];

/// The results of the outward pass for the inward one: f, ḟ, f̈ and W₀, W₁.
struct Link<'a, R: Real> {
    link: LinkView<'a, R>,
    x: Xform<R>,
    w: [Motion<R>; 4],
    f: [Force<R>; 3],
}

/// A scene whose torques have derivatives.
pub(super) const fn scene_taken<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    no_load_friction::<R, E, B, V>();
    assert!(
        E::ACCELERATIONS && E::VELOCITY_PRODUCTS,
        "inverse dynamics of compliant joints needs `Inertia` and `Coriolis` in the scene"
    );
    assert!(
        !(E::WRENCH | E::BASE_MOTION | E::GYROSCOPIC_ROTORS),
        "inverse dynamics of compliant joints allows no wrenches on bodies, moving base or \
         `GyroscopicRotors`"
    );
}

/// τ, τ̇ and τ̈ of the springs.
fn torque_rates<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    reference: &ElasticReference<R, Q, V>,
    effects: &E,
) -> [[R; V]; 3]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { scene_taken::<R, E, B, V>() };
    let (state, turns) = (&reference.state, JointTrig::new(robot, &reference.state.q).coordinates);
    let rates = [&state.qd, &state.qdd, &reference.jerk, &reference.snap];
    // A base that accelerates by −g for ever is gravity.
    let (v_0, a_0) = base_motion(effects);
    let base = [v_0, a_0, Motion::ZERO, Motion::ZERO];
    let mut all: Vec<MotionDerivatives<R>, B> = Vec::new();
    let mut links: Vec<Link<'_, R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let (x, w) = (link.xform(&turns), rates.map(|rate| link.motion(&turns, rate)));
        let carried = transformed(&x, &w, all.get(link.parent).unwrap_or(&base));
        let v = [0, 1, 2, 3].map(|n| carried[n] + w[n]);
        let f = forces(&body_inertia(effects, i, &link), &v);
        let _ = all.push(v);
        let _ = links.push(Link { link, x, w, f });
    }

    let mut tau = [[R::ZERO; V]; 3];
    let mut pass = inward(&mut links);
    while let Some((link, inner)) = pass.next() {
        for (tau, f) in tau.iter_mut().zip(link.f) {
            link.link.project(&turns, f, tau);
        }
        for k in link.link.coordinates() {
            let (at, mut added) = (joint_state(&link.link, state, k), [R::ZERO; 3]);
            let [_, onwards @ ..] = rates.map(|rates| entry(rates, k));
            add_joint_torque_rates(effects, k, at, onwards, &mut added);
            for (tau, added) in tau.iter_mut().zip(added) {
                if let Some(tau) = tau.get_mut(k) {
                    *tau += added;
                }
            }
        }
        if let Some(parent) = inner.get_mut(link.link.parent) {
            for (sum, f) in parent.f.iter_mut().zip(force_at_parent(link)) {
                *sum += f;
            }
        }
    }
    tau
}

/// X m and its derivatives, from those of m in the parent's coordinates.
///
/// The n-th derivative y_k,n of X m⁽ᵏ⁾ is
///
/// ```text
/// y_{k,n} = y_{k+1,n−1} − Σ_{j=0..n−1} binom(n−1, j) W_j × y_{k,n−1−j}
/// ```
fn transformed<R: Real>(
    x: &Xform<R>,
    w: &[Motion<R>; 4],
    m: &MotionDerivatives<R>,
) -> MotionDerivatives<R> {
    let [w0, w1, w2, _] = *w;
    let two = R::from_f64(2.0);
    let [a0, b0, c0, d0] = m.map(|m| *x * m);
    let [a1, b1, c1] = [b0 - w0.cross(a0), c0 - w0.cross(b0), d0 - w0.cross(c0)];
    let [a2, b2] = [b1 - w0.cross(a1) - w1.cross(a0), c1 - w0.cross(b1) - w1.cross(b0)];
    let a3 = b2 - w0.cross(a2) - w1.cross(a1) * two - w2.cross(a0);
    [a0, a1, a2, a3]
}

/// f = I a + v ×* I v with its first two derivatives.
fn forces<R: Real>(inertia: &SpatialInertia<R>, v: &MotionDerivatives<R>) -> [Force<R>; 3] {
    let [v0, v1, v2, _] = *v;
    let [p0, p1, p2, p3] = v.map(|v| *inertia * v);
    let twice = v1.cross_force(p1) * R::from_f64(2.0);
    [
        p1 + v0.cross_force(p0),
        p2 + v1.cross_force(p0) + v0.cross_force(p1),
        p3 + v2.cross_force(p0) + twice + v0.cross_force(p2),
    ]
}

/// Xᵀ f with its first two derivatives.
fn force_at_parent<R: Real>(link: &Link<'_, R>) -> [Force<R>; 3] {
    let ([w0, w1, ..], [f0, f1, f2]) = (link.w, link.f);
    let once = f1 + w0.cross_force(f0);
    let twice = f2 + w1.cross_force(f0) + w0.cross_force(f1 + once);
    [f0, once, twice].map(|f| link.x.transpose_mul(f))
}
