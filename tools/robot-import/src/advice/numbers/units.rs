//! Units of a description: masses against the reach, radii of gyration, limits of most joints.
//!
//! The thresholds lie between what the robots of the library and of published ones have and what
//! the same robots have in another unit; the figures are beside each.

use dynamics_core::advice::{AdvisedJoint, positions_in_degrees, speeds_in_degrees};
use dynamics_core::model::{BASE, ImpossibleInertia, JointKind, Link, Model};
use dynamics_core::scalar::{Matrix, Real, Vector};

use super::NumberAdvice;

/// Mass over the cube of the reach, kg/m³. Robots have 3 to 132, in grams therefore 3,000 or more.
const DENSE: f64 = 2000.0;
/// The same of lengths in mm: at most 132 · 10⁻⁹, in grams 1.3 · 10⁻⁴.
const THIN: f64 = 1e-2;
/// A reach, m. Robots have 0.16 to 1.8; no crane's is thinner than [`THIN`].
const FAR: f64 = 20.0;
/// m over the cube of the radius of gyration of a solid sphere of steel, 9 · 7,850 kg/m³: compact
/// weights have less, though their mass over the cube of the reach may be large.
const SOLID: f64 = 9.0 * 7850.0;
/// Radius of gyration over reach. Robots have a median of 0.03 to 0.74, in kg·mm² 28 or more.
const GYRATION: f64 = 10.0;
/// The same of one body among others. Published robots have up to 1.5, of placeholders.
const ONE_GYRATION: f64 = 3.0;
/// Mass over the cube of the radius of gyration of one body, kg/m³. Bodies are at most of solid
/// steel, 7 · 10⁴, and have in kg·mm² 10⁻⁹ of it; a propeller with a placeholder of an inertia has
/// 0.4, and a wheel about its centre, which has no reach, is not thin.
const AIRY: f64 = 0.01;
/// The share of a body's largest moment of inertia beyond which m d² would be of note.
const SHARE: f64 = 0.5;
/// The same of one body among others, and the square of its radius of gyration, of the largest that
/// its joints allow: a link of the G1 has 0.60 and 2.0, one of the Gen3 0.89 and 0.99; a rod about
/// its end has 0.75 and 1.33. At a tip, where nothing says how long it is, a calf with a heavy foot
/// has a share of 0.94.
const ONE_SHARE: f64 = 0.65;
const SPAN: f64 = 1.2;
const TIP_SHARE: f64 = 0.9;

/// The units that look wrong.
pub(super) fn of<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> impl Iterator<Item = NumberAdvice> {
    let size = Size::of(model);
    let millimetres = size.reach > FAR && size.density(1.0) < THIN;
    let (robot, mass, reach) = (model.name, size.mass, size.reach);
    let grams = if millimetres {
        // Inertias may be in either unit: the density of the whole decides.
        size.density(1e-3) > DENSE
    } else {
        size.density(1.0) > DENSE && size.solid > 0.5 * size.mass
    };
    let whole = [
        grams.then_some(NumberAdvice::MassesInGrams { robot, mass, reach }),
        millimetres.then_some(NumberAdvice::LengthsInMillimetres { robot, mass, reach }),
    ];
    let limits = [
        positions_in_degrees(rotations(model).map(|(joint, link)| {
            let ends = [link.limits.lower, link.limits.upper];
            (joint, ends.map(R::to_f64))
        })),
        speeds_in_degrees(
            rotations(model).map(|(joint, link)| (joint, link.limits.velocity.to_f64())),
        ),
    ];
    let bodies = gyrations(model, reach).filter(move |_| !millimetres);
    let whole = whole.into_iter().flatten();
    let limits = limits.into_iter().flatten().map(NumberAdvice::Limit);
    whole.chain(bodies).chain(about_joints(model)).chain(limits)
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
        let mut size = Self { mass: 0.0, reach: 0.0, solid: 0.0 };
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
            let body = MassSize::of(link);
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
struct MassSize {
    mass: f64,
    com: f64,
    gyration: f64,
}

impl MassSize {
    fn of<R: Real>(link: &Link<R>) -> Self {
        let mass = link.inertia.mass.to_f64();
        if mass <= 0.0 {
            return Self { mass: 0.0, com: 0.0, gyration: 0.0 };
        }
        let com = length::<R>(link.inertia.first_moment) / mass;
        let [[x, ..], [_, y, _], [.., z]] = moments(link);
        let squared = 0.5 * (x + y + z) / mass - com * com;
        Self { mass, com, gyration: if squared > 0.0 { Real::sqrt(squared) } else { 0.0 } }
    }
}

fn moments<R: Real>(link: &Link<R>) -> [[f64; 3]; 3] {
    link.inertia.rotational.cols().map(|column| column.array().map(R::to_f64))
}

fn length<R: Real>(v: R::Vec3) -> f64 {
    let [x, y, z] = v.array().map(R::to_f64);
    let squared = x * x + y * y + z * z;
    if squared > 0.0 { Real::sqrt(squared) } else { 0.0 }
}

/// The largest radius of gyration, if most are beyond all reach; else each that is.
fn gyrations<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    reach: f64,
) -> impl Iterator<Item = NumberAdvice> {
    let (mut beyond, mut bodies, mut largest, mut body) = (0, 0, 0.0, "");
    for link in &model.links {
        let MassSize { mass, gyration: k, .. } = MassSize::of(link);
        if k > 0.0 {
            bodies += 1;
            beyond += usize::from(k > GYRATION * reach && is_airy(mass, k));
            if k > largest {
                (largest, body) = (k, link.name);
            }
        }
    }
    let most = reach > 0.0 && 2 * beyond > bodies;
    let all =
        most.then_some(NumberAdvice::InertiasInMillimetres { body, gyration: largest, reach });
    let each = model.links.iter().filter_map(move |link| {
        let MassSize { mass, gyration, .. } = MassSize::of(link);
        let beyond = gyration > ONE_GYRATION * reach && is_airy(mass, gyration);
        (beyond && !most).then_some(NumberAdvice::InertiaInMillimetres {
            body: link.name,
            gyration,
            reach,
        })
    });
    all.into_iter().chain(each)
}

/// Whether a body of this mass and radius of gyration would be thinner than [`AIRY`].
fn is_airy(mass: f64, gyration: f64) -> bool {
    mass < AIRY * gyration * gyration * gyration
}

/// A body's inertia as one about its joint.
struct AboutJoint {
    /// m d² of its largest moment.
    share: f64,
    /// Whether what is left without m d² is one that a body may have.
    is_possible: bool,
    /// Whether it is wider than masses between its joint and the next one are; of a tip, whether it
    /// is no rod with a mass at its end.
    is_wide: bool,
    largest: f64,
    shift: f64,
}

impl AboutJoint {
    /// The size of a body with a centre of mass beside its joint; `next` is the distance of the
    /// farthest joint on it, m; none of a tip.
    fn of<R: Real>(link: &Link<R>, next: Option<f64>) -> Option<Self> {
        let size = MassSize::of(link);
        if size.mass == 0.0 || size.com == 0.0 || size.gyration == 0.0 {
            return None;
        }
        let mut about_com = moments(link);
        let com = link.inertia.first_moment.array().map(|h| h.to_f64() / size.mass);
        let shift = size.mass * size.com * size.com;
        // m (d² 1 − d dᵀ), taken off once for the description's inertia and once more for one about
        // the joint.
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
        // Masses on a line of length L have a variance of at most d (L − d) (Bhatia and Davis
        // 2000).
        let is_wide = match next {
            Some(next) => {
                let widest = size.com * (next - size.com);
                next > size.com && size.gyration * size.gyration > SPAN * widest
            }
            None => shift < TIP_SHARE * largest,
        };
        let [[xx, xy, xz], [_, yy, yz], [.., zz]] = about_com;
        let moments = [xx, xy, xz, yy, yz, zz];
        Some(Self {
            share: shift / largest,
            is_possible: ImpossibleInertia::of(moments, 1e-6).is_none(),
            is_wide,
            largest,
            shift,
        })
    }
}

/// A body whose inertia is mostly the distance of its centre, if those of all such bodies could be
/// about their joints; else each that is wider than its joints allow.
fn about_joints<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> impl Iterator<Item = NumberAdvice> {
    let of = |i: usize, link: &Link<R>| {
        let on_it = model.links.iter().filter(|other| other.parent == i);
        let joints = on_it.map(|other| length::<R>(other.placement.pos));
        AboutJoint::of(link, joints.reduce(f64::max))
    };
    let (mut bodies, mut far, mut most, mut found, mut all) = (0, 0, 0.0, None, true);
    for (i, link) in model.links.iter().enumerate() {
        let Some(about) = of(i, link) else {
            continue;
        };
        bodies += 1;
        if about.share > SHARE {
            far += 1;
            all &= about.is_possible;
            if about.share > most {
                most = about.share;
                found = Some(NumberAdvice::InertiasAboutJoints {
                    body: link.name,
                    inertia: about.largest,
                    shift: about.shift,
                });
            }
        }
    }
    let all = all && far > 1 && 2 * far >= bodies;
    let each = model.links.iter().enumerate().filter_map(move |(i, link)| {
        let about = of(i, link)?;
        let is_about_joint = about.share > ONE_SHARE && about.is_wide && about.is_possible;
        (!all && is_about_joint).then_some(NumberAdvice::InertiaAboutJoint {
            body: link.name,
            inertia: about.largest,
            shift: about.shift,
        })
    });
    found.filter(|_| all).into_iter().chain(each)
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
