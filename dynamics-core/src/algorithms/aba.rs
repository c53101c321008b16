//! Forward dynamics: the articulated-body algorithm in link coordinates.
//!
//! Featherstone, RBDA (2008), table 7.1; Featherstone & Orin (2000), section 3.2:
//!
//! ```text
//! c_i  = S̊_i q̇_i + v_i × S_i q̇_i
//! Iᴬ_i = I_i + Σ_{λ(j)=i} ʲX_iᵀ Iᵃ_j ʲX_i    pᴬ_i = v_i ×* I_i v_i − fˣ_i + Σ_{λ(j)=i} ʲX_iᵀ pᵃ_j
//! U_i  = Iᴬ_i S_i      D_i = S_iᵀ U_i        u_i  = τ_i − S_iᵀ pᴬ_i
//! Iᵃ_i = Iᴬ_i − U_i D_i⁻¹ U_iᵀ               pᵃ_i = pᴬ_i + Iᵃ_i c_i + U_i D_i⁻¹ u_i
//! a′_i = ⁱX_λ(i) a_λ(i) + c_i
//! q̈_i  = D_i⁻¹ (u_i − U_iᵀ a′_i)             a_i  = a′_i + S_i q̈_i
//! ```
//!
//! A joint of several degrees of freedom is eliminated a coordinate at a time, which is the same as
//! by its block D. Nothing is eliminated where [`hybrid_dynamics`](super::hybrid_dynamics()) prescribes a
//! coordinate's motion, RBDA section 9.2.

use heapless::Vec;

use super::pivot_check::{Magnitude, PivotCheck};
use super::rnea::external_force;
use super::rotors::with_rotor;
use super::tree_pass::{inward, per_body};
use super::{JointResult, NotPositiveDefinite, Prescribed};
use crate::effects::{
    Declared, Effect, add_inertia, base_motion, body_inertia, gyroscopic, joint_state,
    joint_torque, load_friction, rotor_force, transmitted,
};
use crate::model::{JointKind, LinkView, RobotModel};
use crate::scalar::{Matrix, Real};
use crate::spatial::inertia::ArticulatedInertia;
use crate::spatial::{Force, Motion, MotionSubspace, Xform};
use crate::state::{JointTrig, State, entry};

/// The data of a body that the outward passes and the inward pass share.
struct Body<R: Real> {
    x: Xform<R>,
    c: Motion<R>,
    ia: ArticulatedInertia<R>,
    magnitude: Magnitude<R>,
    pa: Force<R>,
}

/// The results of the inward pass for a coordinate: U, 1/D and u; where the motion is prescribed
/// only U and, as u, sᵀ pᴬ.
#[derive(Clone, Copy)]
pub(crate) struct JointFactor<R: Real> {
    pub(crate) u_a: Force<R>,
    pub(crate) d_inv: R,
    pub(crate) u: R,
}

/// q̈ and τ by the three passes of table 7.1; each coordinate's torque or its acceleration is
/// `given`.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn aba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    given: impl Fn(usize) -> Prescribed<R>,
) -> Result<JointResult<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let mut passes =
        Passes { robot, trig, state, effects, given, bodies: Vec::new(), factors: Vec::new() };
    passes.outward_velocities();
    passes.inward_inertias()?;
    Ok(passes.outward_accelerations())
}

/// The arguments of a call, and what each pass leaves for the next one.
struct Passes<'a, R: Real, D, E, G, const B: usize, const Q: usize, const V: usize> {
    robot: &'a D,
    trig: &'a JointTrig<R, Q>,
    state: &'a State<R, Q, V>,
    effects: &'a E,
    given: G,
    bodies: Vec<Body<R>, B>,
    factors: Vec<JointFactor<R>, V>,
}

impl<R: Real, D, E, G, const B: usize, const Q: usize, const V: usize>
    Passes<'_, R, D, E, G, B, Q, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
    G: Fn(usize) -> Prescribed<R>,
{
    /// Pass 1: vᵢ, cᵢ = v × S q̇ + S̊ q̇, and, of each body alone, Iᴬ = I and pᴬ = v ×* I v − fˣ.
    #[cfg_attr(optimised, inline(always))]
    fn outward_velocities(&mut self) {
        let (turns, qd, effects) = (&self.trig.coordinates, &self.state.qd, self.effects);
        let mut v = per_body(self.robot, base_motion(effects).0);
        let mut poses = per_body(self.robot, Xform::IDENTITY);
        for (i, link) in self.robot.links().enumerate() {
            let x = link.xform(turns);
            let v_i = link.plus_motion(x * v.parent(&link), turns, qd);
            let inertia = body_inertia(effects, i, &link);
            let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
            if E::VELOCITY_PRODUCTS {
                c = link.plus_velocity_product(Motion::ZERO, turns, qd, v_i);
                pa = inertia.bias_force(v_i);
            }
            if E::WRENCH {
                pa -= external_force(effects, i, &link, &x, &mut poses, v_i);
            }
            if E::GYROSCOPIC_ROTORS
                && E::VELOCITY_PRODUCTS
                && let Some(parent) = self.bodies.get_mut(link.parent)
            {
                let couple = gyroscopic(effects, &link, v_i.ang, entry(qd, link.idx_v()), R::ZERO);
                parent.pa.ang += x.rot.transpose_mul(couple);
            }
            v.push(v_i);
            let (ia, magnitude) = (inertia.into(), Magnitude::from(&inertia));
            let _ = self.bodies.push(Body { x, c, ia, magnitude, pa });
        }
    }

    /// Pass 2: Iᴬ and pᴬ of every articulated body, and U, D and u of every coordinate, from the
    /// last one to the first.
    #[cfg_attr(optimised, inline(always))]
    fn inward_inertias(&mut self) -> Result<(), NotPositiveDefinite> {
        let (turns, state, effects) = (&self.trig.coordinates, self.state, self.effects);
        let mut pass = inward(&mut self.bodies);
        while let Some((body, inner)) = pass.next() {
            let Some(link) = self.robot.link(inner.len()) else {
                break;
            };
            let (mut ia, mut pa, mut pivots) = (body.ia, body.pa, PivotCheck::of(body.magnitude));
            // Iᵃ of a joint that turns freely, whose zeros about z are exact: their rounding errors
            // would be those of all that a small body carries.
            let mut free = None;
            for (k, joint) in link.coordinates().enumerate().rev() {
                let s = link.subspace(turns, k);
                let mut u_a = ia.along(&s);
                let (d_inv, u) = match (self.given)(joint) {
                    Prescribed::Torque(tau) => {
                        let mut d = s.dot(u_a);
                        add_inertia(effects, joint, &mut d);
                        pivots.check(&link, k, turns, u_a, d)?;
                        let at = joint_state(&link, state, joint);
                        let tau = transmitted(effects, joint, at, tau);
                        let u = tau - joint_torque(effects, &link, state, joint) - s.dot(pa);
                        let d_inv = R::ONE / d;
                        let revolute = matches!(s, MotionSubspace::RevoluteZ);
                        u_a = with_rotor(effects, &link, u_a);
                        if revolute && effects.inertia(joint).is_none() {
                            free = Some(ia.free_about_z(u_a, d_inv));
                        } else {
                            ia = ia.minus_outer(u_a, d_inv);
                        }
                        pa += u_a * (u * d_inv);
                        (d_inv, u)
                    }
                    Prescribed::Acceleration(qdd) => {
                        let load = s.dot(pa);
                        u_a = with_rotor(effects, &link, u_a);
                        pa += u_a * qdd;
                        (R::ZERO, load)
                    }
                };
                let _ = self.factors.push(JointFactor { u_a, d_inv, u });
            }
            if let Some(parent) = inner.get_mut(link.parent) {
                let (ia_c, ia) = match free {
                    Some(ia) => (ia.times_across(body.c), ia.at_parent(&body.x)),
                    None => (ia.times(body.c), ia.at_parent(&body.x)),
                };
                pa += ia_c;
                parent.ia += ia;
                parent.magnitude += body.magnitude.at_parent(body.x.pos);
                parent.pa += body.x.transpose_mul(pa);
            }
        }
        Ok(())
    }

    /// Pass 3: q̈ᵢ = D⁻¹ (u − Uᵀ a′) with a′ = X a_λ + c, and aᵢ = a′ + S q̈.
    #[cfg_attr(optimised, inline(always))]
    fn outward_accelerations(&mut self) -> JointResult<R, V> {
        let mut joints = JointResult::ZERO;
        let mut a = per_body(self.robot, base_motion(self.effects).1);
        for (body, link) in self.bodies.iter().zip(self.robot.links()) {
            let a_parent = body.x * a.parent(&link) + body.c;
            let free = D::KINDS.has(JointKind::Free) && self.is_free(&link);
            let mut a_i = if free { Motion::ZERO } else { a_parent };
            for (k, joint) in link.coordinates().enumerate() {
                let Some(JointFactor { u_a, d_inv, u }) = self.factors.pop() else {
                    break;
                };
                let s = link.subspace(&self.trig.coordinates, k);
                let (tau, qdd) = match (self.given)(joint) {
                    Prescribed::Torque(tau) => (tau, (u - a_i.dot(u_a)) * d_inv),
                    Prescribed::Acceleration(qdd) => {
                        let load = a_i.dot(u_a) + s.dot(u_a) * qdd + u;
                        (self.prescribed_torque(&link, s, joint, load, qdd), qdd)
                    }
                };
                a_i = s.add_scaled_to(a_i, qdd);
                joints.set(joint, tau, qdd);
            }
            if free {
                joints.set_relative(&link, a_i, a_parent);
            }
            a.push(a_i);
        }
        joints
    }

    /// The torque of a coordinate with a prescribed motion, from the load Uᵀ a′ + sᵀ U q̈ + sᵀ pᴬ of
    /// the articulated body. RBDA, section 9.2.
    #[cfg_attr(optimised, inline(always))]
    fn prescribed_torque(
        &self,
        link: &LinkView<'_, R>,
        s: MotionSubspace<R>,
        joint: usize,
        load: R,
        qdd: R,
    ) -> R {
        let (mut tau, mut armature) = (load, R::ZERO);
        if E::GYROSCOPIC_ROTORS {
            tau -= s.dot(rotor_force(self.effects, link)) * qdd;
        }
        add_inertia(self.effects, joint, &mut armature);
        tau += armature * qdd + joint_torque(self.effects, link, self.state, joint);
        load_friction(self.effects, joint, joint_state(link, self.state, joint), &mut tau);
        tau
    }

    /// Whether a body is decoupled from its parent: no constraint, no prescribed motion, no inertia
    /// at the joint.
    ///
    /// The body's acceleration is then independent of the parent's; without it free fall is exact.
    #[cfg_attr(optimised, inline(always))]
    fn is_free(&self, link: &LinkView<'_, R>) -> bool {
        matches!(link.kind(), JointKind::Free)
            && link.coordinates().all(|joint| {
                let mut inertia = R::ZERO;
                add_inertia(self.effects, joint, &mut inertia);
                matches!((self.given)(joint), Prescribed::Torque(_)) & (inertia == R::ZERO)
            })
    }
}
