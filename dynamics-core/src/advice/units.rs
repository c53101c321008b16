//! Units of a description: masses against the reach, radii of gyration, limits of most joints.
//!
//! The thresholds lie between what the robots of the library and of docs/robots.md have and what the same robots have in
//! another unit; the figures are beside each.

use super::{Advice, AdvisedJoint};
use crate::model::{BASE, JointKind, Link, Model, moments_excess};
use crate::scalar::{Matrix, Real, Vector};
use core::f64::consts::PI;

/// Mass over the cube of the reach, kg/m³. Robots have 3 to 132, in grams therefore 3,000 or more.
const DENSE: f64 = 2000.0;
/// The same of lengths in mm: at most 132 · 10⁻⁹, in grams 1.3 · 10⁻⁴.
const THIN: f64 = 1e-2;
/// A reach, m. Robots have 0.16 to 1.8; no crane's is thinner than [`THIN`].
const FAR: f64 = 20.0;
/// m over the cube of the radius of gyration of a solid sphere of steel, 9 · 7,850 kg/m³: compact weights have less, though
/// their mass over the cube of the reach may be large.
const SOLID: f64 = 9.0 * 7850.0;
/// Radius of gyration over reach. Robots have a median of 0.03 to 0.74, in kg·mm² 28 or more.
const GYRATION: f64 = 10.0;
/// Position, rad: four turns. Robots have up to 1.6 turns; a median of 56° to 360° makes 9 turns or more.
const TURNS: f64 = 8.0 * PI;
/// Speed, rad/s: 573 turns a minute. Robots have a median of up to 32; in degrees/s a slow one has 70.
const SPEED: f64 = 60.0;
/// The share of a body's largest moment of inertia beyond which m d² would be of note.
const SHARE: f64 = 0.5;

/// The units that look wrong.
pub(super) fn of<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> [Option<Advice>; 6] {
    let size = Size::of(model);
    let millimetres = size.reach > FAR && size.density(1.0) < THIN;
    let (robot, mass, reach) = (model.name, size.mass, size.reach);
    let grams = if millimetres {
        // Inertias may be in either unit: the density of the whole decides.
        size.density(1e-3) > DENSE
    } else {
        size.density(1.0) > DENSE && size.solid > 0.5 * size.mass
    };
    [
        grams.then_some(Advice::MassesInGrams { robot, mass, reach }),
        millimetres.then_some(Advice::LengthsInMillimetres { robot, mass, reach }),
        if millimetres {
            None
        } else {
            gyration(model, reach)
        },
        about_joints(model),
        positions_in_degrees(rotations(model).map(|(joint, link)| {
            let ends = [link.limits.lower, link.limits.upper];
            (joint, ends.map(R::to_f64))
        })),
        speeds_in_degrees(
            rotations(model).map(|(joint, link)| (joint, link.limits.velocity.to_f64())),
        ),
    ]
}

/// Whether a limit is one, and not a number that stands for none: infinite, zero, or a power of ten.
pub(super) fn is_stated(limit: f64) -> bool {
    let mut power = 100.0;
    while power < limit.abs() && power < 1e30 {
        power *= 10.0;
    }
    // The rounding of an f32.
    let is_power = (limit.abs() - power).abs() <= 1e-6 * power;
    limit.is_finite() && limit != 0.0 && !is_power
}

/// Mass and reach of what the joints move.
struct Size {
    mass: f64,
    reach: f64,
    /// The mass of bodies that are denser than a solid sphere of steel.
    solid: f64,
}

impl Size {
    fn of<R: Real, const B: usize, const Q: usize, const V: usize>(
        model: &Model<R, B, Q, V>,
    ) -> Self {
        let mut size = Self {
            mass: 0.0,
            reach: 0.0,
            solid: 0.0,
        };
        let (mut distance, mut moves) = ([0.0; B], [false; B]);
        for (i, link) in model.links.iter().enumerate() {
            let mut from_first = 0.0;
            let mut moved = link.joint.kind != JointKind::Fixed;
            if link.parent != BASE {
                let before = distance.get(link.parent).copied().unwrap_or_default();
                from_first = before + length::<R>(link.placement.pos);
                moved |= moves.get(link.parent).copied().unwrap_or_default();
            }
            if let (Some(d), Some(m)) = (distance.get_mut(i), moves.get_mut(i)) {
                (*d, *m) = (from_first, moved);
            }
            let body = Massive::of(link);
            if !moved {
                continue;
            }
            size.mass += body.mass;
            size.reach = size.reach.max(from_first + body.com);
            let k = body.gyration;
            if body.mass > SOLID * k * k * k {
                size.solid += body.mass;
            }
        }
        size
    }

    /// Mass over the cube of the reach, where that is in this unit, m.
    fn density(&self, unit: f64) -> f64 {
        let reach = self.reach * unit;
        if reach > 0.0 {
            self.mass / (reach * reach * reach)
        } else {
            // One body about its centre: nothing to compare with.
            1.0
        }
    }
}

/// A body's mass, the distance of its centre of mass, and its radius of gyration about that.
struct Massive {
    mass: f64,
    com: f64,
    gyration: f64,
}

impl Massive {
    fn of<R: Real>(link: &Link<R>) -> Self {
        let mass = link.inertia.mass.to_f64();
        if mass <= 0.0 {
            return Self {
                mass: 0.0,
                com: 0.0,
                gyration: 0.0,
            };
        }
        let com = length::<R>(link.inertia.first_moment) / mass;
        let [[x, ..], [_, y, _], [.., z]] = moments(link);
        let squared = 0.5 * (x + y + z) / mass - com * com;
        Self {
            mass,
            com,
            gyration: if squared > 0.0 {
                Real::sqrt(squared)
            } else {
                0.0
            },
        }
    }
}

fn moments<R: Real>(link: &Link<R>) -> [[f64; 3]; 3] {
    link.inertia
        .rotational
        .cols()
        .map(|column| column.array().map(R::to_f64))
}

fn length<R: Real>(v: R::Vec3) -> f64 {
    let [x, y, z] = v.array().map(R::to_f64);
    let squared = x * x + y * y + z * z;
    if squared > 0.0 {
        Real::sqrt(squared)
    } else {
        0.0
    }
}

/// The largest radius of gyration, if most are beyond all reach.
fn gyration<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    reach: f64,
) -> Option<Advice> {
    let (mut beyond, mut bodies, mut largest, mut body) = (0, 0, 0.0, "");
    for link in &model.links {
        let k = Massive::of(link).gyration;
        if k > 0.0 {
            bodies += 1;
            beyond += usize::from(k > GYRATION * reach);
            if k > largest {
                (largest, body) = (k, link.name);
            }
        }
    }
    (reach > 0.0 && 2 * beyond > bodies).then_some(Advice::InertiasInMillimetres {
        body,
        gyration: largest,
        reach,
    })
}

/// A body whose inertia is mostly the distance of its centre, if those of all such bodies could be about their joints.
fn about_joints<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> Option<Advice> {
    let (mut bodies, mut far, mut most, mut found) = (0, 0, 0.0, None);
    for link in &model.links {
        let size = Massive::of(link);
        if size.mass == 0.0 || size.com == 0.0 || size.gyration == 0.0 {
            continue;
        }
        bodies += 1;
        let mut about_com = moments(link);
        let com = link
            .inertia
            .first_moment
            .array()
            .map(|h| h.to_f64() / size.mass);
        let shift = size.mass * size.com * size.com;
        // m (d² 1 − d dᵀ), taken off once for the description's inertia and once more for one about the joint.
        let offset = |i: usize, j: usize| {
            let [a, b] = [i, j].map(|k| com.get(k).copied().unwrap_or_default());
            (if i == j { shift } else { 0.0 }) - size.mass * a * b
        };
        let mut largest = 0.0_f64;
        for (i, row) in about_com.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry -= offset(i, j);
                if i == j {
                    largest = largest.max(*entry);
                }
                *entry -= offset(i, j);
            }
        }
        let share = shift / largest;
        if share > SHARE {
            far += 1;
            if moments_excess(about_com) > 1e-6 {
                return None;
            }
            if share > most {
                most = share;
                found = Some(Advice::InertiasAboutJoints {
                    body: link.name,
                    inertia: largest,
                    shift,
                });
            }
        }
    }
    if far > 1 && 2 * far >= bodies {
        found
    } else {
        None
    }
}

/// The joints that rotate about one axis.
fn rotations<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> impl Iterator<Item = (AdvisedJoint, &Link<R>)> {
    let rotates =
        |link: &&Link<R>| matches!(link.joint.kind, JointKind::Revolute | JointKind::Continuous);
    model.links.iter().filter(rotates).map(|link| {
        let (number, body) = (link.idx_v, Some(link.name));
        (AdvisedJoint { number, body }, link)
    })
}

/// [`Advice::PositionsInDegrees`], if most joints that state limits of position, rad, have one beyond four turns: published
/// robots have up to 1.6.
///
/// Limits that are infinite, zero or a power of ten of 100 or more state none.
///
/// ```
/// use dynamics_core::advice::{Advice, AdvisedJoint, positions_in_degrees};
/// let joint = |number| AdvisedJoint { number, body: None };
/// let advice = positions_in_degrees([(joint(0), [-170.0, 170.0]), (joint(1), [0.0, 120.0])].into_iter());
/// assert_eq!(advice, Some(Advice::PositionsInDegrees { joint: joint(0), limit: 170.0 }));
/// ```
pub fn positions_in_degrees(
    limits: impl Iterator<Item = (AdvisedJoint, [f64; 2])>,
) -> Option<Advice> {
    let placed = |x: f64| if is_stated(x) { x } else { 0.0 };
    let farther = limits.map(|(joint, ends)| {
        let [lower, upper] = ends.map(placed);
        (
            joint,
            if lower.abs() > upper.abs() {
                lower
            } else {
                upper
            },
        )
    });
    mostly_beyond(farther, TURNS).map(|(joint, limit)| Advice::PositionsInDegrees { joint, limit })
}

/// [`Advice::SpeedsInDegrees`], if most joints that state a limit of speed, rad/s, have one above 60: published robots have
/// a median of up to 32.
///
/// Limits that are infinite, zero or a power of ten of 100 or more state none.
///
/// ```
/// use dynamics_core::advice::{AdvisedJoint, speeds_in_degrees};
/// let joint = |number| AdvisedJoint { number, body: None };
/// assert_eq!(speeds_in_degrees([(joint(0), 3.14), (joint(1), 180.0)].into_iter()), None); // not most
/// assert!(speeds_in_degrees([(joint(0), 120.0), (joint(1), 180.0)].into_iter()).is_some());
/// ```
pub fn speeds_in_degrees(limits: impl Iterator<Item = (AdvisedJoint, f64)>) -> Option<Advice> {
    mostly_beyond(limits, SPEED).map(|(joint, limit)| Advice::SpeedsInDegrees { joint, limit })
}

/// The greatest limit, if most of those that are stated are greater than this.
fn mostly_beyond(
    joints: impl Iterator<Item = (AdvisedJoint, f64)>,
    most: f64,
) -> Option<(AdvisedJoint, f64)> {
    let (mut beyond, mut stated, mut greatest) = (0, 0, None::<(AdvisedJoint, f64)>);
    for (joint, limit) in joints.filter(|&(_, limit)| is_stated(limit)) {
        stated += 1;
        beyond += usize::from(limit.abs() > most);
        if greatest.is_none_or(|(_, before)| limit.abs() > before.abs()) {
            greatest = Some((joint, limit));
        }
    }
    if 2 * beyond > stated { greatest } else { None }
}
