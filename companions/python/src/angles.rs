//! Angles beyond the range in which the library computes sines: whole turns are subtracted before
//! the call, in f64, and where turns matter the angle is refused.

use dynamics_core::model::JointKind;
use pyo3::prelude::*;
use robot_dynamics_kernels::Scalar;
use robot_dynamics_kernels::spec::Spec;

use crate::error::Exception;

/// A position coordinate whose derivative is a velocity coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Position {
    /// Its column in q, or in y of linkages.
    pub column: usize,
    /// The velocity coordinate that belongs to it.
    pub coordinate: usize,
    /// The kind of its joint.
    pub kind: JointKind,
    /// Whether it is an angle.
    pub angle: bool,
}

/// The use that a function makes of positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// Only sines and cosines of angles matter to it.
    Sines,
    /// It returns them, or what depends on them.
    Numbers,
    /// It takes the difference of two positions.
    Difference,
    /// It brings them to within half a turn.
    Normalise,
    /// It adds a step to them.
    Integrate,
    /// They are the steps themselves.
    Step,
}

/// The positions in an argument, and their use.
#[derive(Clone, Copy)]
pub struct Positions<'a> {
    /// The use that is made of them.
    pub by: Use,
    /// The coordinates, by their places.
    pub at: &'a [Position],
}

/// The treatment of an angle beyond the range.
enum Beyond {
    /// The angle may stay as it is.
    Stays,
    /// The angle loses whole turns.
    Turns,
    /// It is refused, for this reason.
    Refused(&'static str),
}

impl Positions<'_> {
    fn beyond(&self, position: &Position, effects: &[Spec]) -> Beyond {
        let at = position.coordinate;
        let turns_matter = || {
            let effect = effects.iter().find(|effect| match effect {
                Spec::Spring { stiffness, .. } => stiffness.get(at).is_none_or(|x| *x != 0.0),
                Spec::Cogging { per_turn, .. } => per_turn.get(at).is_none_or(|x| *x != 0.0),
                Spec::EndStops { .. } => true,
                _ => false,
            });
            match (effect, position.kind) {
                (Some(Spec::Spring { .. }), _) => Some("Spring depends on whole turns"),
                (Some(Spec::Cogging { .. }), _) => Some("Cogging depends on whole turns"),
                (Some(_), _) => Some("EndStops depend on whole turns"),
                (None, JointKind::Helical) => Some("its turns are a way"),
                (None, _) => None,
            }
        };
        match (self.by, position.kind) {
            (Use::Sines, _) => turns_matter().map_or(Beyond::Turns, Beyond::Refused),
            (Use::Numbers, _) => Beyond::Refused("the result depends on whole turns"),
            (Use::Difference, JointKind::Continuous | JointKind::Planar) => Beyond::Turns,
            (Use::Normalise, JointKind::Continuous) => Beyond::Turns,
            (Use::Difference | Use::Normalise, _) => Beyond::Stays,
            (Use::Integrate, JointKind::Planar) => {
                Beyond::Refused("the result depends on whole turns")
            }
            (Use::Integrate, _) => Beyond::Stays,
            (Use::Step, _) => Beyond::Refused("a step is no more"),
        }
    }

    /// The rows of an argument with all angles in the range, if that changes one; `joint_of` names
    /// the joint of a velocity coordinate.
    pub fn in_range<'r, R: Scalar>(
        &self,
        py: Python<'_>,
        joint_of: impl Fn(usize) -> &'r str,
        (data, width): (&[R], usize),
        effects: &[Spec],
    ) -> PyResult<Option<Vec<R>>> {
        let cogs = effects.iter().any(|effect| matches!(effect, Spec::Cogging { .. }));
        // Almost always none is large, which one pass over all numbers finds.
        let least = R::from_f64(R::MOST_ANGLE);
        let fits = |part: &[R]| part.iter().fold(true, |all, x| all & (x.abs() <= least));
        if !cogs && data.chunks(1024).all(fits) {
            return Ok(None);
        }
        let mut changed: Option<Vec<R>> = None;
        for position in self.at {
            let column = || data.iter().skip(position.column).step_by(width).enumerate();
            let refused = |row: usize, angle: R, reason: String| {
                let (joint, angle) = (joint_of(position.coordinate), angle.to_f64());
                let text = format!(
                    "joint `{joint}` is at {angle} rad, and sines are computed to {} rad: {reason} (state {row})",
                    R::MOST_ANGLE
                );
                let error = Exception::new(py, "AngleError", text).with("joint", joint);
                let error = error.with("coordinate", position.coordinate);
                let error = error.with("angle", angle).with("limit", R::MOST_ANGLE);
                Err(error.with("state", row).build())
            };
            for effect in effects {
                let Spec::Cogging { per_turn, .. } = effect else {
                    continue;
                };
                let n = per_turn.get(position.coordinate).copied().unwrap_or(0.0);
                let fits = |x: R| (n * x.to_f64()).abs() <= R::MOST_ANGLE || !x.is_finite();
                if let Some((row, &x)) = column().find(|&(_, &x)| !fits(x)) {
                    return refused(row, x, format!("Cogging takes sines of {n} times the angle"));
                }
            }
            if !position.angle {
                continue;
            }
            let outside = |x: R| x.to_f64().abs() > R::MOST_ANGLE && x.is_finite();
            let Some((first, &angle)) = column().find(|&(_, &x)| outside(x)) else {
                continue;
            };
            match self.beyond(position, effects) {
                Beyond::Stays => {}
                Beyond::Refused(reason) => return refused(first, angle, reason.to_owned()),
                Beyond::Turns => {
                    let all = changed.get_or_insert_with(|| data.to_vec());
                    let own = all.iter_mut().skip(position.column).step_by(width);
                    for x in own.skip(first).filter(|x| outside(**x)) {
                        *x = R::from_f64(within_half_a_turn(x.to_f64()));
                    }
                }
            }
        }
        Ok(changed)
    }
}

/// The same angle within ±π. The sines of the standard library are right for numbers of any size.
fn within_half_a_turn(angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    sin.atan2(cos)
}

/// The places of the positions of a robot's joints, of kinds; and the velocities that
/// are rates of attitudes.
pub fn of_joints(kinds: impl Iterator<Item = JointKind>) -> (Vec<Position>, Vec<Position>) {
    let (mut positions, mut rates, mut first) = (Vec::new(), Vec::new(), [0, 0]);
    for kind in kinds {
        let [q, v] = first;
        let (nq, nv) = kind.coordinates();
        first = [q + nq, v + nv];
        let of = |k, column, angle| Position { column, coordinate: v + k, kind, angle };
        let (angles, turning) = match kind {
            JointKind::Prismatic | JointKind::Fixed => (0, 0),
            JointKind::Spherical | JointKind::Free => (0, 3),
            JointKind::Universal => (2, 0),
            JointKind::Planar => (1, 1),
            _ => (1, 0),
        };
        if nq == nv {
            positions.extend((0..nq).map(|k| of(k, q + k, k < angles)));
        }
        rates.extend((0..turning).map(|k| of(k, v + k, true)));
    }
    (positions, rates)
}
