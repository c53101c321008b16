//! The inertia of joints and modes: the composite-rigid-body algorithm with modes.
//!
//! The composite body on the end of a link is rigid, as everywhere in the algorithm: a mode's
//! column is the force of its unit acceleration on its own link and on that body, projected on
//! every coordinate between it and the base.

use core::borrow::Borrow;
use core::ops::Range;

use heapless::Vec;

use super::Modes;
use super::deformation::{End, axial, deform};
use crate::algorithms::{MassMatrix, inward};
use crate::effects::{Effect, add_inertia, body_inertia, no_gyroscopic_rotors};
use crate::model::{LinkView, RobotModel};
use crate::scalar::{Real, Vector};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{Force, MotionSubspace, SpatialInertia, Xform};
use crate::state::{Configuration, entry};

/// The inertia of V joints and M modes, in blocks: [joints, couplingᵀ; coupling, modes], kg, kg·m
/// or kg·m².
///
/// Positive definite where the links' data are: see [`Modes`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlexibleInertia<R, const V: usize, const M: usize> {
    /// M(q, η) between joints.
    pub joints: MassMatrix<R, V>,
    /// Between a mode, by rows, and a joint.
    pub coupling: [[R; V]; M],
    /// Between modes.
    pub modes: MassMatrix<R, M>,
}

/// A coordinate of a robot with modes.
#[derive(Clone, Copy)]
enum Coordinate {
    Joint(usize),
    Mode(usize),
}

use Coordinate::{Joint, Mode};

impl<R: Real, const V: usize, const M: usize> FlexibleInertia<R, V, M> {
    fn set(&mut self, a: Coordinate, b: Coordinate, value: R) {
        match (a, b) {
            (Joint(i), Joint(j)) => self.joints.set(i, j, value),
            (Mode(k), Mode(l)) => self.modes.set(k, l, value),
            (Joint(i), Mode(k)) | (Mode(k), Joint(i)) => {
                if let Some(entry) = self.coupling.get_mut(k).and_then(|row| row.get_mut(i)) {
                    *entry = value;
                }
            }
        }
    }

    /// The kinetic energy at these rates, J: ½ ẋᵀ M ẋ.
    pub fn kinetic_energy(&self, qd: &[R; V], etad: &[R; M]) -> R {
        let of = |a: &[R], b: &[R]| {
            let products = a.iter().zip(b).map(|(&a, &b)| a * b);
            products.fold(R::ZERO, |sum, product| sum + product)
        };
        let coupling = self.coupling.map(|row| of(&row, qd));
        let joints = of(&self.joints.mul_vec(qd), qd);
        let modes = of(&self.modes.mul_vec(etad), etad);
        (joints + modes) * R::from_f64(0.5) + of(&coupling, etad)
    }
}

/// The inertia M(q, η) of joints and modes.
///
/// # Shape
/// Blocks of V × V, M × V and M × M.
///
/// # Cost
/// The cost of [`crba`](crate::algorithms::crba()) of as many joints as there are joints and modes.
///
/// # Source
/// Walker & Orin (1982), method 3; Book (1984) for the modes.
///
/// # Example
/// See the example of [`forward_dynamics`](super::forward_dynamics()).
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn crba<R: Real, D, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
    robot: &D,
    modes: &Modes<R, M>,
    q: &impl Configuration<R, Q>,
    eta: &[R; M],
    effects: &E,
) -> FlexibleInertia<R, V, M>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    sweep::<R, D, E, B, Q, V, M, true>(robot, modes, q, eta, effects)
}

/// The inertia of the modes alone: the block that the motion of modes along a given one of the
/// joints needs.
#[cfg_attr(optimised, inline(always))]
pub(super) fn modal_inertia<
    R: Real,
    D,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
>(
    robot: &D,
    modes: &Modes<R, M>,
    q: &impl Configuration<R, Q>,
    eta: &[R; M],
    effects: &E,
) -> [[R; M]; M]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let m = sweep::<R, D, E, B, Q, V, M, false>(robot, modes, q, eta, effects);
    m.modes.rows
}

/// The two passes; without `JOINTS` those blocks stay zero that joints have.
#[cfg_attr(optimised, inline(always))]
fn sweep<
    R: Real,
    D,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
    const JOINTS: bool,
>(
    robot: &D,
    modes: &Modes<R, M>,
    q: &impl Configuration<R, Q>,
    eta: &[R; M],
    effects: &E,
) -> FlexibleInertia<R, V, M>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    no_gyroscopic_rotors::<R, E, B, V>();
    let trig = q.trig_of(robot);
    let turns = &trig.borrow().coordinates;
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    let mut swings = [R::Vec3::ZERO; M];
    for i in 0..B {
        let Some(link) = robot.link(i) else {
            break;
        };
        let (mut x, range) = (link.xform(turns), modes.of_body(i));
        if let Some((parent, end)) = bodies.get(link.parent).and_then(|p| Some((p, p.end?))) {
            x = end.xform(&x, modes.rest(&parent.range));
        }
        let mut own = body_inertia(effects, i, &link);
        for k in range.clone() {
            if let (Some(mode), Some(swing)) = (modes.each.get(k), swings.get_mut(k)) {
                let moments = modes.moments(k, &range, eta);
                deform::<R>(&mut own, mode, moments, entry(eta, k));
                *swing = axial::<R>(&moments);
            }
        }
        let end = (!range.is_empty()).then(|| {
            let [bend] = modes.at_end(&range, [eta]);
            End::of(bend, modes.rest(&range))
        });
        let _ = bodies.push(Body {
            link,
            x,
            own: own.into(),
            on_end: SpatialInertia::ZERO.into(),
            range,
            end,
        });
    }

    let mut m = FlexibleInertia {
        joints: MassMatrix::ZERO,
        coupling: [[R::ZERO; V]; M],
        modes: MassMatrix::ZERO,
    };
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        let mut composite = body.own;
        if let Some(end) = &body.end {
            for k in body.range.clone() {
                let Some(mode) = modes.each.get(k) else {
                    break;
                };
                let column = end.velocity([mode.shift, mode.half_turn]);
                let on_end = body.on_end.along(&MotionSubspace::General(column));
                let load = end.load(on_end);
                for l in body.range.start..=k {
                    m.modes.set(k, l, modes.inertia(k, l) + modes.work(l, load));
                }
                let swing = swings.get(k).copied().unwrap_or(R::Vec3::ZERO);
                let f = Force::new(swing, mode.momentum) + on_end;
                let of = Mode(k);
                climb::<R, V, M, JOINTS>(modes, turns, body, inner, of, f, &mut m);
            }
        }
        composite += body.on_end;
        if let Some(parent) = inner.get_mut(body.link.parent) {
            parent.on_end += composite.at_parent(&body.x);
        }
        if !JOINTS {
            continue;
        }
        let Some(link) = robot.link(inner.len()) else {
            break;
        };
        for (k, joint) in link.coordinates().enumerate() {
            let f = composite.along(&link.subspace(turns, k));
            let of = Joint(joint);
            climb::<R, V, M, JOINTS>(modes, turns, body, inner, of, f, &mut m);
            if let Some(diagonal) = m.joints.diagonal_mut(joint) {
                add_inertia(effects, joint, diagonal);
            }
        }
    }
    m
}

/// The results of the outward pass for the inward one.
struct Body<'a, R: Real> {
    link: LinkView<'a, R>,
    x: Xform<R>,
    own: CompositeInertia<R>,
    on_end: CompositeInertia<R>,
    range: Range<usize>,
    end: Option<End<R>>,
}

type Turns<R> = [crate::model::JointCoordinate<R>];

impl<R: Real> Body<'_, R> {
    /// Sets the entries between a coordinate and the joint of this body, on which its force is f.
    fn project<const V: usize, const M: usize>(
        &self,
        turns: &Turns<R>,
        of: Coordinate,
        f: Force<R>,
        m: &mut FlexibleInertia<R, V, M>,
    ) {
        for (l, joint) in self.link.coordinates().enumerate() {
            m.set(of, Joint(joint), self.link.subspace(turns, l).dot(f));
        }
    }
}

/// Sets the entries between a coordinate of `body`, on which its force is f, and the joints and
/// modes from that body to the base.
fn climb<R: Real, const V: usize, const M: usize, const JOINTS: bool>(
    modes: &Modes<R, M>,
    turns: &Turns<R>,
    body: &Body<'_, R>,
    inner: &[Body<'_, R>],
    of: Coordinate,
    mut f: Force<R>,
    m: &mut FlexibleInertia<R, V, M>,
) {
    let mut child = body;
    if JOINTS {
        body.project(turns, of, f, m);
    }
    while let Some(parent) = inner.get(child.link.parent) {
        f = child.x.transpose_mul(f);
        if let Some(end) = &parent.end {
            let load = end.load(f);
            for k in parent.range.clone() {
                m.set(of, Mode(k), modes.work(k, load));
            }
        }
        if JOINTS {
            parent.project(turns, of, f, m);
        }
        child = parent;
    }
}
