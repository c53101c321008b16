//! Base parameters of calibrated inertias, at run time: what [`super::compile`] does to those of
//! the description.
//!
//! The geometry is the description's. Khalil & Dombre, *Modeling, Identification and Control of
//! Robots* (2002), chapter 9.

use core::marker::PhantomData;

use super::Engine;
use super::compile::{Compiled, CompiledRobot, JointMotion};
use crate::effects::{BaseParameters, Effect, RegroupedInertia, body_inertia};
use crate::model::{
    BASE, Calibrated, JointKind, LinkView, ModelError, Problem, Robot, RobotModel, model,
};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{SpatialInertia, Xform};
use crate::state::{all_finite, entry};

impl<T, K> Engine<T, K> {
    /// The base parameters of a calibrated robot with the payloads of `effects`, for the scenes of
    /// the engine.
    ///
    /// A payload that is part of the set costs nothing in the tick; in the scene it costs what
    /// `docs/costs.md` says. A whole set is computed at once, outside the tick.
    ///
    /// ```
    /// use dynamics_core::effects::{Payload, RIGID_BODY};
    /// use dynamics_core::model::{BodyInertia, Calibrated, Robot};
    /// use dynamics_core::{Engine, robots::Ur5e, state::State};
    /// type OnWrist = Payload<f64, { Ur5e::MODEL.body("wrist_3") }>;
    /// let tool = OnWrist::try_new(BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.1], inertia: [0.01; 6] }, 1.0)?;
    /// let with_tool = Engine::<Ur5e>::base_parameters(&Calibrated::nominal(), &tool)?;
    ///
    /// let state = State { q: [0.3; 6], qd: [0.5; 6], qdd: [1.0; 6] };
    /// let (a, b) = (
    ///     Engine::<Ur5e>::rnea(&state, &(RIGID_BODY, &with_tool)),
    ///     Engine::<Ur5e>::rnea(&state, &(RIGID_BODY, tool)),
    /// );
    /// assert!((0..6).all(|i| (a[i] - b[i]).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Cost
    /// Some 200 flops for each body; not for the tick.
    ///
    /// # Errors
    /// [`ModelError`] names the first body whose placement is not that of the description
    /// ([`Problem::Placement`]), or a moving body whose base parameters are not finite
    /// ([`Problem::NotFinite`]). Whether inertias are physical is checked by
    /// [`Calibrated::set_inertia`] and [`Calibrated::check`].
    ///
    /// # Source
    /// Khalil & Dombre (2002), chapter 9.
    #[inline(never)]
    pub fn base_parameters<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        robot: &Calibrated<T, R, B, Q, V>,
        effects: &E,
    ) -> Result<BaseParameters<T, R, B, Q, V>, ModelError>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        let mut joints = joints_of(robot, effects)?;
        let sizes = sizes::<R, T, E, B, Q, V>(robot, effects);
        let length = R::from_f64(CompiledRobot::<T, B, Q, V>::LENGTH);
        let mut set =
            BaseParameters { joints: [RegroupedInertia::default(); V], robot: PhantomData };
        for (body, size) in set.joints.iter_mut().zip(sizes) {
            body.size = size;
        }
        for (i, by) in CompiledRobot::<T, B, Q, V>::JOINTS.iter().enumerate().rev() {
            let Some(&JointBodies { x, inertia, parent }) = joints.get(i) else {
                continue;
            };
            if by.first != i {
                continue; // the first coordinate moves the body
            }
            let (mut kept, passed) = split(inertia.parameters(), by.motion, length);
            if let Some(parent) = joints.get_mut(parent) {
                parent.inertia += passed.at_parent(&x);
            }
            kept.size = entry(&sizes, i);
            let single = [kept.mass, kept.second_zz];
            let numbers = [&single[..], &kept.moment, &kept.second, &kept.size];
            if !numbers.into_iter().all(all_finite) {
                let mut links = robot.links();
                let moved = links.find(|link| link.coordinates().any(|k| k == i));
                return Err(moved.map_or(
                    ModelError { body: T::MODEL.name, problem: Problem::NotFinite },
                    |link| error(&link, Problem::NotFinite),
                ));
            }
            if let Some(body) = set.joints.get_mut(i + by.count - 1) {
                *body = kept;
            }
        }
        Ok(set)
    }
}

/// The number of a body's joint, its first coordinate, or [`BASE`] of a body that is fixed to its
/// parent.
fn joint_of<R: Real>(link: &LinkView<'_, R>) -> usize {
    link.coordinates().next().unwrap_or(BASE)
}

/// A joint's frame, and the inertia of the bodies that move with it as one.
#[derive(Clone, Copy)]
struct JointBodies<R: Real> {
    /// From the frame of the parent joint.
    x: Xform<R>,
    inertia: CompositeInertia<R>,
    /// The parent joint, or [`BASE`].
    parent: usize,
}

/// The joints with what they carry, before regrouping.
fn joints_of<R: Real, T, E, const B: usize, const Q: usize, const V: usize>(
    robot: &Calibrated<T, R, B, Q, V>,
    effects: &E,
) -> Result<[JointBodies<R>; V], ModelError>
where
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let nothing = CompositeInertia::from(SpatialInertia::ZERO);
    let at_base = Xform::IDENTITY;
    let mut joints = [JointBodies { x: at_base, inertia: nothing, parent: BASE }; V];
    // The joint that each body moves with, and its frame relative to that joint's.
    let mut places = [(BASE, at_base); B];
    let described = &model::<R, T, B, Q, V>().links;
    for ((i, link), described) in robot.links().enumerate().zip(described) {
        if link.placement != described.placement {
            return Err(error(&link, Problem::Placement));
        }
        let (parent, frame) = places.get(link.parent).copied().unwrap_or((BASE, at_base));
        let mut place = (parent, link.placement * frame);
        if link.kind() != JointKind::Fixed {
            place = attach(&mut joints, &link, place);
        }
        if let Some(joint) = joints.get_mut(place.0) {
            let own = CompositeInertia::from(body_inertia(effects, i, &link));
            joint.inertia += own.at_parent(&place.1);
        }
        if let Some(known) = places.get_mut(i) {
            *known = place;
        }
    }
    Ok(joints)
}

/// Writes the coordinates that move a body, whose frame is `place`; returns the one that carries
/// it, and its frame there.
fn attach<R: Real>(
    joints: &mut [JointBodies<R>],
    link: &LinkView<'_, R>,
    (parent, frame): (usize, Xform<R>),
) -> (usize, Xform<R>) {
    use JointKind::*;
    let (i, o, l) = (joint_of(link), R::ZERO, R::ONE);
    let [x, y, z] = [[l, o, o], [o, l, o], [o, o, l]].map(|[x, y, z]| R::Vec3::new(x, y, z));
    match link.kind() {
        Planar | Spherical | Free => {
            if let Some(joint) = joints.get_mut(i) {
                (joint.x, joint.parent) = (frame, parent);
            }
            (i, Xform::IDENTITY)
        }
        Universal => {
            // The first rotation is about x.
            let turned = R::Mat3::from_cols(y, z, x);
            let rot = turned.transpose() * frame.rot;
            let back = along_axis(joints, i, parent, Xform { rot, ..frame });
            let rot = turned * back.rot;
            let place = along_axis(joints, i + 1, i, Xform { rot, ..back });
            (i + 1, place)
        }
        Cylindrical => {
            let place = along_axis(joints, i, parent, frame);
            (i + 1, along_axis(joints, i + 1, i, place))
        }
        Revolute | Continuous | Prismatic | Helical | Fixed => {
            (i, along_axis(joints, i, parent, frame))
        }
    }
}

/// Moves the frame of joint `i` along its axis z to where the offset from the parent is
/// perpendicular to it; returns the way back.
fn along_axis<R: Real>(
    joints: &mut [JointBodies<R>],
    i: usize,
    parent: usize,
    Xform { rot, pos }: Xform<R>,
) -> Xform<R> {
    let axis = rot.transpose_mul(R::Vec3::new(R::ZERO, R::ZERO, R::ONE));
    let along = axis.dot(pos);
    if let Some(joint) = joints.get_mut(i) {
        joint.x = Xform { rot, pos: pos - axis * along };
        joint.parent = parent;
    }
    Xform { pos: R::Vec3::new(R::ZERO, R::ZERO, along), ..Xform::IDENTITY }
}

/// The inertia that regrouping leaves to a body behind a joint, in units of length, and the inertia
/// that its parent receives.
fn split<R: Real>(
    [mass, hx, hy, hz, xx, xy, yy, xz, yz, zz]: [R; 10],
    motion: JointMotion,
    length: R,
) -> (RegroupedInertia<R>, CompositeInertia<R>) {
    use JointMotion::*;
    let (zero, half) = (R::ZERO, R::from_f64(0.5));
    // Σ = ½ tr(Ī) 1 − Ī, of which Σ_zz goes to the parent as a thin rod.
    let trace = half * (xx + yy + zz);
    let mut kept = RegroupedInertia {
        mass: mass * length * length,
        moment: [hx, hy, hz].map(|h| h * length),
        second: [trace - xx, -xy, -xz, trace - yy, -yz],
        second_zz: trace - zz,
        ..RegroupedInertia::default()
    };
    let mut passed = [zero; 10];
    match motion {
        Slide => {
            (kept.second, kept.second_zz) = ([zero; 5], zero);
            passed = [zero, zero, zero, zero, xx, xy, yy, xz, yz, zz];
        }
        Turn | Screw | Planar => {
            let rod = trace - zz;
            kept.second_zz = zero;
            (passed[4], passed[6]) = (rod, rod);
        }
        Spherical | Free | Still => {}
    }
    if matches!(motion, Turn | Spherical) {
        (kept.mass, passed[0]) = (zero, mass);
    }
    if matches!(motion, Turn) {
        (kept.moment[2], passed[3]) = (zero, hz);
    }
    (kept, SpatialInertia::from_parameters(passed).into())
}

/// Mass, largest first and largest second moment of each joint and its descendants: see
/// [`super::pivot_noise`].
fn sizes<R: Real, T, E, const B: usize, const Q: usize, const V: usize>(
    robot: &Calibrated<T, R, B, Q, V>,
    effects: &E,
) -> [[R; 3]; V]
where
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let length = |v: R::Vec3| {
        let [x, y, z] = v.array();
        x.abs() + y.abs() + z.abs()
    };
    let (mut bodies, mut joints) = ([[R::ZERO; 3]; B], [[R::ZERO; 3]; V]);
    for (i, link) in robot.links().enumerate().rev() {
        let own = body_inertia(effects, i, &link);
        let [_, _, _, _, xx, _, yy, _, _, zz] = own.parameters();
        let [mut mass, mut moment, mut second] = entry(&bodies, i);
        mass += own.mass;
        moment += length(own.first_moment);
        second += R::from_f64(0.5) * (xx + yy + zz);
        for k in link.coordinates() {
            if let Some(joint) = joints.get_mut(k) {
                *joint = [mass, moment, second];
            }
        }
        if let Some(parent) = bodies.get_mut(link.parent) {
            let r = length(link.placement.pos);
            let moved = moment + r * mass;
            parent[0] += mass;
            parent[1] += moved;
            parent[2] += second + r * (moment + moved);
        }
    }
    joints
}

fn error<R: Real>(link: &LinkView<'_, R>, problem: Problem) -> ModelError {
    ModelError { body: link.name, problem }
}
