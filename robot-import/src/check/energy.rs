//! Inverse dynamics by Lagrange's equations, from the energy of the file's links.
//!
//! d/dt ∂L/∂u̇ − ∂L/∂u = τ with L = Σ ½ tr(Ȧ J Ȧᵀ) + Σ m gᵀ c over all links of the file, A a link's 4 × 4 pose and J
//! its pseudo-inertia (Uicker 1965); poses, velocities and Lagrange's derivatives by dual numbers. It shares no code
//! with the library, and nothing with the importer but the numbers of the file: no link is merged, no axis is aligned,
//! and a ball joint or a free joint is a chain of joints of one coordinate each.

use dynamics_core::glam::DVec3;

use super::dual::{Dual, Number};
use crate::description::{Description, Inertial, Joint, Kind, Pose};
use crate::inertia::{MassProperties, matrix};
use crate::selection::{Role, Selected};

/// g of [`dynamics_core::effects::Gravity::EARTH`], m/s².
const G: f64 = 9.81;

/// One-coordinate joints in place of a joint's, each with the component of its axis: turns about x, y, z are 0 to 2,
/// translations along them 3 to 5.
pub const BALL: [usize; 3] = [2, 1, 0];
/// Of a planar joint.
pub const PLANE: [usize; 3] = [3, 4, 2];
/// Of a free joint.
pub const FREE: [usize; 6] = [3, 4, 5, 2, 1, 0];

/// A pose: the upper three rows of a 4 × 4 matrix.
pub type Rows<T> = [[T; 4]; 3];

/// ∫ r rᵀ dm about the link's origin, m c and m.
type Moments = ([[f64; 3]; 3], [f64; 3], f64);

/// The links of a file with what of them a selection moves.
#[derive(Debug)]
pub struct Energy<'a> {
    robot: &'a Description,
    selected: &'a Selected,
    /// The first coordinate of each joint that moves.
    first: Vec<usize>,
    /// Pseudo-inertia of each link: ∫ r rᵀ dm, m c and m.
    masses: Vec<Option<Moments>>,
    /// The number of coordinates.
    pub coordinates: usize,
}

impl<'a> Energy<'a> {
    /// Of a selection.
    pub fn of(robot: &'a Description, selected: &'a Selected) -> Self {
        let mut coordinates = if selected.free_base { FREE.len() } else { 0 };
        let mut first = vec![0; robot.joints.len()];
        for &j in &selected.order {
            if selected.roles[j] == Role::Moves {
                first[j] = coordinates;
                coordinates += axes(robot.joints[j].kind).len();
            }
        }
        let masses = robot
            .links
            .iter()
            .map(|link| link.inertial.as_ref().map(second_moments));
        Self {
            masses: masses.collect(),
            robot,
            selected,
            first,
            coordinates,
        }
    }

    /// The forces on the coordinates u of a motion.
    pub fn torque(&self, u: &[f64], ud: &[f64], udd: &[f64]) -> Vec<f64> {
        let along = |i: usize| {
            // ∂L/∂u_i.
            let unit = |k: usize| if k == i { 1.0 } else { 0.0 };
            let dual = |values: &[f64], moves: bool| -> Vec<Dual<f64>> {
                let rate = |k| if moves { unit(k) } else { 0.0 };
                values
                    .iter()
                    .enumerate()
                    .map(|(k, &x)| Dual::new(x, rate(k)))
                    .collect()
            };
            let slope = self.lagrangian(&dual(u, true), &dual(ud, false)).rate;
            // d/dt ∂L/∂u̇_i: the outer rate is that of u̇_i, the inner one that of time.
            let still = Dual::new(0.0, 0.0);
            let in_time = |x: &[f64], rates: &[f64], moves: bool| -> Vec<Dual<Dual<f64>>> {
                let pairs = x.iter().zip(rates).enumerate();
                let outer = |k| {
                    if moves {
                        Dual::new(unit(k), 0.0)
                    } else {
                        still
                    }
                };
                pairs
                    .map(|(k, (&x, &rate))| Dual::new(Dual::new(x, rate), outer(k)))
                    .collect()
            };
            let momentum = self.lagrangian(&in_time(u, ud, false), &in_time(ud, udd, true));
            momentum.rate.rate - slope
        };
        (0..self.coordinates).map(along).collect()
    }

    /// Kinetic minus potential energy.
    fn lagrangian<T: Number>(&self, u: &[T], ud: &[T]) -> T {
        let u: Vec<Dual<T>> = u.iter().zip(ud).map(|(&u, &ud)| Dual::new(u, ud)).collect();
        let mut energy = T::constant(0.0);
        for (pose, mass) in self.poses(&u).iter().zip(&self.masses) {
            let (Some(pose), Some((moments, first, mass))) = (pose, mass) else {
                continue;
            };
            for row in pose {
                let rate = row.map(|entry| entry.rate);
                for (a, &x) in rate.iter().enumerate() {
                    for (b, &y) in rate.iter().enumerate() {
                        let weight = match (a, b) {
                            (3, 3) => *mass,
                            (3, i) | (i, 3) => first[i],
                            (i, k) => moments[i][k],
                        };
                        energy = energy + (x * y).scaled(0.5 * weight);
                    }
                }
            }
            let [_, _, z] = pose;
            for (entry, &h) in z.iter().zip(first.iter().chain([mass])) {
                energy = energy - entry.value.scaled(G * h);
            }
        }
        energy
    }

    /// The poses of the links below the base.
    pub fn poses<T: Number>(&self, u: &[T]) -> Vec<Option<Rows<T>>> {
        let mut poses = vec![None; self.robot.links.len()];
        let at_base = match self.selected.free_base {
            true => moved(identity(), &FREE, u),
            false => identity(),
        };
        // A base that stands still has no energy that changes.
        poses[self.selected.base] = Some(at_base);
        for &j in &self.selected.order {
            let joint = &self.robot.joints[j];
            let Some(parent) = poses[joint.parent] else {
                continue;
            };
            let placed = placed(&parent, &joint.origin);
            let motion = match self.selected.roles[j] {
                Role::Moves if joint.kind.has_axis() => along_axis(joint, u[self.first[j]]),
                Role::Moves => moved(identity(), axes(joint.kind), &u[self.first[j]..]),
                Role::Locked(position) => along_axis(joint, T::constant(position)),
            };
            poses[joint.child] = Some(product(&placed, &motion));
        }
        poses
    }
}

/// The one-coordinate joints in place of a joint.
pub fn axes(kind: Kind) -> &'static [usize] {
    match kind {
        Kind::Fixed => &[],
        Kind::Revolute | Kind::Continuous | Kind::Prismatic => &[0],
        Kind::Spherical => &BALL,
        Kind::Planar => &PLANE,
        Kind::Free => &FREE,
    }
}

fn second_moments(inertial: &Inertial) -> Moments {
    let own = MassProperties::in_frame(inertial.mass, &inertial.frame, inertial.inertia);
    let about_com = matrix(own.inertia);
    let half_trace = 0.5 * (about_com.x_axis.x + about_com.y_axis.y + about_com.z_axis.z);
    let c = own.com;
    let moments = std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            let diagonal = if i == k { half_trace } else { 0.0 };
            diagonal - about_com.col(k)[i] + own.mass * c[i] * c[k]
        })
    });
    (moments, c.map(|x| own.mass * x), own.mass)
}

/// No displacement.
pub fn identity<T: Number>() -> Rows<T> {
    std::array::from_fn(|i| std::array::from_fn(|k| T::constant(if i == k { 1.0 } else { 0.0 })))
}

/// The product of two poses.
pub fn product<T: Number>(a: &Rows<T>, b: &Rows<T>) -> Rows<T> {
    // Loops: closures that return arrays of arrays are copied more often than they are computed.
    let mut out = *a;
    for (out, a) in out.iter_mut().zip(a) {
        for (k, out) in out.iter_mut().enumerate() {
            let sum = a[0] * b[0][k] + a[1] * b[1][k] + a[2] * b[2][k];
            *out = if k == 3 { sum + a[3] } else { sum };
        }
    }
    out
}

/// A pose as rows.
pub fn rows(pose: &Pose) -> Rows<f64> {
    std::array::from_fn(|i| {
        std::array::from_fn(|k| match k {
            3 => pose.position[i],
            _ => pose.rotation.col(k)[i],
        })
    })
}

/// A pose followed by the placement of a joint, as the file gives it.
fn placed<T: Number>(pose: &Rows<T>, origin: &Pose) -> Rows<T> {
    let origin = rows(origin);
    let mut out = *pose;
    for (out, a) in out.iter_mut().zip(pose) {
        for (k, out) in out.iter_mut().enumerate() {
            let [x, y, z] = [0, 1, 2].map(|j| a[j].scaled(origin[j][k]));
            let sum = x + y + z;
            *out = if k == 3 { sum + a[3] } else { sum };
        }
    }
    out
}

/// A turn about, or a translation along, a joint's axis: Rodrigues' formula.
fn along_axis<T: Number>(joint: &Joint, u: T) -> Rows<T> {
    let n = joint.axis.normalize_or_zero();
    match joint.kind {
        Kind::Revolute | Kind::Continuous => turn(n, u),
        Kind::Prismatic => slide(n, u),
        _ => identity(),
    }
}

/// A pose followed by one-coordinate joints.
pub fn moved<T: Number>(mut pose: Rows<T>, axes: &[usize], u: &[T]) -> Rows<T> {
    for (&axis, &u) in axes.iter().zip(u) {
        let n = DVec3::AXES[axis % 3];
        pose = product(&pose, &if axis < 3 { turn(n, u) } else { slide(n, u) });
    }
    pose
}

fn slide<T: Number>(n: DVec3, u: T) -> Rows<T> {
    let mut pose = identity();
    for (row, n) in pose.iter_mut().zip(n.to_array()) {
        row[3] = u.scaled(n);
    }
    pose
}

fn turn<T: Number>(n: DVec3, u: T) -> Rows<T> {
    let (sin, cos) = u.sin_cos();
    let cross = [[0.0, -n.z, n.y], [n.z, 0.0, -n.x], [-n.y, n.x, 0.0]];
    let rest = T::constant(1.0) - cos;
    let mut pose = identity();
    for (i, row) in pose.iter_mut().enumerate() {
        for (k, entry) in row.iter_mut().take(3).enumerate() {
            let diagonal = if i == k { cos } else { T::constant(0.0) };
            *entry = diagonal + sin.scaled(cross[i][k]) + rest.scaled(n[i] * n[k]);
        }
    }
    pose
}
