//! Mobility Λ⁻¹ of a body, the inverse of its operational-space inertia, in O(n).
//!
//! Chang & Khatib, "Operational space dynamics: efficient algorithms for modeling and control of
//! branching mechanisms" (2000); Lilly & Orin, "Efficient O(N) recursive computation of the
//! operational space inertia matrix" (1993). Articulated-body inertias are computed inward, as in
//! the ABA; then Λ⁻¹ outward, from the base, where it is zero, to the body. A joint of axis s
//! transmits the part P of its parent's acceleration and adds its own:
//!
//! ```text
//! U = Iᴬ s      D = sᵀ U      P = 1 − s D⁻¹ Uᵀ
//! Λ_i⁻¹ = P_i ⁱX_λ(i) Λ_λ(i)⁻¹ ⁱX_λ(i)ᵀ P_iᵀ + s_i D_i⁻¹ s_iᵀ
//! ```

use core::borrow::Borrow;

use core::ops::Mul;

use crate::algorithms::NotPositiveDefinite;
use crate::algorithms::articulated_pass::{ArticulatedPass, JointFactor, eliminate};
use crate::algorithms::kinematics::frame::{Frame, Pose};
use crate::effects::Effect;
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::MotionSubspace;
use crate::spatial::symmetric::{Symmetric, turned_back};
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Configuration, entry};

/// Λ⁻¹: the acceleration of a body per force on it, with all joints free to move.
///
/// The blocks of a symmetric map from F⁶ to M⁶; `mobility * force` is a motion; a motion is not
/// accepted as a force:
///
/// ```compile_fail,E0308
/// use dynamics_core::{Core, algorithms::frame, robots::Ur5e, spatial::Motion};
/// let mobility = Core::<Ur5e>::osim_inverse(&[0.1_f32; 6], 5, frame::LocalWorldAligned, &()).unwrap();
/// let _ = mobility * Motion::<f32>::ZERO;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OsimInverse<R: Real> {
    /// Angular acceleration of a couple, 1/(kg·m²).
    ang: Symmetric<R>,
    /// Angular acceleration of a force, and transposed linear acceleration of a couple, 1/(kg·m).
    coupling: R::Mat3,
    /// Linear acceleration of a force, 1/kg.
    lin: Symmetric<R>,
}

/// Λ⁻¹ f: the acceleration by a force, rad/s² and m/s². 66 flops.
impl<R: Real> Mul<Force<R>> for OsimInverse<R> {
    type Output = Motion<R>;
    #[cfg_attr(optimised, inline(always))]
    fn mul(self, f: Force<R>) -> Motion<R> {
        Motion::new(
            self.ang.times(f.ang) + self.coupling * f.lin,
            self.coupling.transpose_mul(f.ang) + self.lin.times(f.lin),
        )
    }
}

impl<R: Real> OsimInverse<R> {
    /// The mobility of a body that cannot move.
    pub(crate) const ZERO: Self =
        Self { ang: Symmetric::ZERO, coupling: R::Mat3::ZERO, lin: Symmetric::ZERO };

    /// Λ⁻¹ of a task: along directions of the body that are given as forces. 77 M² flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn along<const M: usize>(&self, directions: &[Force<R>; M]) -> [[R; M]; M] {
        directions.map(|f| {
            let a = *self * f;
            directions.map(|direction| a.dot(direction))
        })
    }

    /// Λ⁻¹ + w s sᵀ. 63 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn plus_square(&self, s: Motion<R>, w: R) -> Self {
        let scaled = s * w;
        Self {
            ang: self.ang.minus_outer(-scaled.ang, s.ang),
            coupling: self.coupling + outer::<R>(scaled.ang, s.lin),
            lin: self.lin.minus_outer(-scaled.lin, s.lin),
        }
    }

    /// X Λ⁻¹ Xᵀ: the same in another frame. 300 flops.
    #[cfg_attr(optimised, inline(always))]
    fn at(&self, x: &Xform<R>) -> Self {
        // [Σ H; Hᵀ M] at the new origin: H + Σ r×, and M − r× (H + Σ r×) + Hᵀ r×, whose upper
        // triangle is used.
        let (et, r) = (x.rot.transpose(), x.pos);
        let turned = self.ang.columns().map(|column| r.cross(column));
        let [x, y, z] = turned;
        let coupling = self.coupling - R::Mat3::from_cols(x, y, z).transpose();
        let old = self.coupling.cols().map(|column| r.cross(column).array());
        let new = coupling.cols().map(|column| r.cross(column).array());
        let moved = |i: usize, j: usize| new[j][i] + old[i][j];
        let lin = Symmetric {
            xx: self.lin.xx - moved(0, 0),
            xy: self.lin.xy - moved(0, 1),
            xz: self.lin.xz - moved(0, 2),
            yy: self.lin.yy - moved(1, 1),
            yz: self.lin.yz - moved(1, 2),
            zz: self.lin.zz - moved(2, 2),
        };
        Self {
            ang: self.ang.turned_back(&et),
            coupling: turned_back::<R>(&coupling, &et),
            lin: lin.turned_back(&et),
        }
    }

    /// P Λ⁻¹ Pᵀ + s D⁻¹ sᵀ.
    ///
    /// For a rotation about z or a translation along it, P differs from 1 in one row, p = e_z − U
    /// D⁻¹: the row and column of z become Λ⁻¹ p, and their common entry pᵀ Λ⁻¹ p + D⁻¹.
    /// Cancellation thus occurs in p, before the multiplication by entries that may be much larger
    /// than the others. 80 flops.
    #[cfg_attr(optimised, inline(always))]
    fn across(&self, s: &MotionSubspace<R>, joint: &JointFactor<R>) -> Self {
        let k = joint.u_a * joint.d_inv;
        let mut next = *self;
        match s {
            MotionSubspace::RevoluteZ => {
                let [x, y, _] = k.ang.array();
                let p = Force::new(R::Vec3::new(-x, -y, joint.armature_share), -k.lin);
                let w = *self * p;
                let [xz, yz, _] = w.ang.array();
                (next.ang.xz, next.ang.yz, next.ang.zz) = (xz, yz, w.dot(p) + joint.d_inv);
                next.coupling = with_row_z::<R>(&self.coupling, w.lin);
            }
            MotionSubspace::PrismaticZ => {
                let [x, y, _] = k.lin.array();
                let p = Force::new(-k.ang, R::Vec3::new(-x, -y, joint.armature_share));
                let w = *self * p;
                let [xz, yz, _] = w.lin.array();
                (next.lin.xz, next.lin.yz, next.lin.zz) = (xz, yz, w.dot(p) + joint.d_inv);
                let [x, y, _] = self.coupling.cols();
                next.coupling = R::Mat3::from_cols(x, y, w.ang);
            }
            MotionSubspace::Unit(k) => next = self.across_any(Motion::unit(*k), joint),
            MotionSubspace::General(s) => next = self.across_any(*s, joint),
        }
        next
    }

    /// The same along any axis, multiplied out: with w = Λ⁻¹ U that is Λ⁻¹ + s bᵀ + b sᵀ where
    /// b = s (1 + U·w D⁻¹) D⁻¹/2 − w D⁻¹. 200 flops.
    #[cfg_attr(optimised, inline(always))]
    fn across_any(&self, s: Motion<R>, joint: &JointFactor<R>) -> Self {
        let (u, d_inv) = (joint.u_a, joint.d_inv);
        let w = *self * u;
        let own = (R::ONE + w.dot(u) * d_inv) * d_inv * R::from_f64(0.5);
        let b = s * own - w * d_inv;
        let coupling = outer::<R>(s.ang, b.lin) + outer::<R>(b.ang, s.lin);
        Self {
            ang: self.ang.minus_outer(-s.ang, b.ang).minus_outer(-b.ang, s.ang),
            coupling: self.coupling + coupling,
            lin: self.lin.minus_outer(-s.lin, b.lin).minus_outer(-b.lin, s.lin),
        }
    }
}

/// A matrix with another last row.
#[cfg_attr(optimised, inline(always))]
fn with_row_z<R: Real>(m: &R::Mat3, row: R::Vec3) -> R::Mat3 {
    let ([x, y, z], [p, q, r]) = (m.cols().map(Vector::array), row.array());
    R::Mat3::from_cols(
        R::Vec3::new(x[0], x[1], p),
        R::Vec3::new(y[0], y[1], q),
        R::Vec3::new(z[0], z[1], r),
    )
}

/// The inverse operational-space inertia Λ⁻¹ = J M⁻¹ Jᵀ of `body` in a [`Frame`], without J or M.
///
/// Inertias of joints and a payload of the scene are included.
///
/// ```text
/// Λ⁻¹ = J M⁻¹ Jᵀ
/// ```
///
/// # Shape
/// 6 × 6; zero for a body that the robot does not have.
///
/// # Cost
/// O(B): some 390 flops for each revolute joint, and 390 more for one between body and base.
///
/// # Source
/// Chang & Khatib (2000); Lilly & Orin (1993).
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::{frame, osim_inverse}, effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// use dynamics_core::spatial::Force;
/// use glam::DVec3;
/// let q = [0.0, -1.2, 1.5, 0.3, 0.0, 0.0];
/// let push = Force::new(DVec3::ZERO, DVec3::X * 10.0);
/// let a = osim_inverse(&Ur5e::MODEL, &q, 5, frame::LocalWorldAligned, &RIGID_BODY)? * push;
/// assert!(a.lin.x > 0.0);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names a coordinate that moves no inertia, or whose inertia is NaN, as
/// [`aba`](crate::algorithms::aba()) does.
#[doc(alias = "end effector")]
#[doc(alias = "mobility")]
#[doc(alias = "OSIM")]
#[cfg_attr(optimised, inline(always))]
pub fn osim_inverse<R: Real, D, E, F: Frame, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    body: usize,
    frame: F,
    effects: &E,
) -> Result<OsimInverse<R>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    let turns = &trig.coordinates;
    let ArticulatedPass { x, factors } = eliminate(robot, turns, effects)?;
    let carries: [bool; B] = path(robot, body);
    let (mut pose, mut mobility) = (Pose::IDENTITY, OsimInverse::ZERO);
    let bodies = robot.links().zip(&x).zip(carries);
    for ((link, x), _) in bodies.filter(|(_, carries)| *carries) {
        pose = pose.transformed_by(x);
        mobility = mobility.at(x);
        for (k, coordinate) in link.coordinates().enumerate() {
            let factor = entry(&factors, coordinate);
            mobility = mobility.across(&link.subspace(turns, k), &factor);
        }
    }
    let Some(link) = robot.link(body) else {
        return Ok(OsimInverse::ZERO);
    };
    let own = Xform { rot: link.to_joint_frame.transpose(), pos: R::Vec3::ZERO };
    let expressed = frame.transform(&pose.in_link_frame(&link.to_joint_frame));
    Ok(mobility.at(&(expressed * own)))
}

/// The ancestors of `body`, itself included.
#[cfg_attr(optimised, inline(always))]
fn path<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    body: usize,
) -> [bool; B]
where
    D: RobotModel<R, B, Q, V>,
{
    let (mut carries, mut reached) = ([false; B], body);
    for _ in 0..B {
        if let (Some(link), Some(carries)) = (robot.link(reached), carries.get_mut(reached)) {
            *carries = true;
            reached = link.parent;
        }
    }
    carries
}

/// a bᵀ
#[cfg_attr(optimised, inline(always))]
fn outer<R: Real>(a: R::Vec3, b: R::Vec3) -> R::Mat3 {
    let [x, y, z] = b.array();
    R::Mat3::from_cols(a * x, a * y, a * z)
}
