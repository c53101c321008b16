//! Inverse dynamics by Lagrange's equations of the file's links.
//!
//! d/dt ∂L/∂u̇ − ∂L/∂u = τ with L = Σ ½ tr(Ȧ J Ȧᵀ) + Σ m gᵀ c over all links of the file, A a
//! link's 4 × 4 pose and J its pseudo-inertia, is τᵢ = Σ tr(∂A/∂uᵢ J (Ä − G)ᵀ), G the acceleration
//! of gravity as such a matrix (Uicker 1965). A link outward of coordinate i has ∂A/∂uᵢ = Qᵢ A with
//! the same Qᵢ, so that the sum is one of A J (Ä − G)ᵀ over them, and the work grows with the
//! number of links (Hollerbach 1980). Ä and Qᵢ are derivatives by dual numbers. It shares no code
//! with the library, and nothing with the importer but the numbers of the file: no link is merged,
//! no axis is aligned, and a ball joint or a free joint is a chain of joints of one coordinate
//! each.

use dynamics_core::glam::DVec3;
use num_dual::{Dual, Dual2, DualNum};

use crate::description::{Description, Inertial, Joint, Kind, Pose};
use crate::inertia::{MassProperties, matrix};
pub use crate::rows::{Rows, rows};
use crate::selection::{Role, Selected};

/// A number that can be differentiated.
pub trait Number: DualNum<Primitive = f64> + Copy {}
impl<T: DualNum<Primitive = f64> + Copy> Number for T {}

/// g of [`dynamics_core::effects::Gravity::EARTH`], m/s².
const G: f64 = 9.81;

/// One-coordinate joints in place of a joint's, each with the component of its axis: turns about x,
/// y, z are 0 to 2, translations along them 3 to 5.
pub const BALL: [usize; 3] = [2, 1, 0];
/// Coordinates of a planar joint.
pub const PLANE: [usize; 3] = [3, 4, 2];
/// Coordinates of a free joint.
pub const FREE: [usize; 6] = [3, 4, 5, 2, 1, 0];

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
    /// Makes the energy of a selection.
    pub fn of(robot: &'a Description, selected: &'a Selected) -> Self {
        let mut coordinates = if selected.free_base { FREE.len() } else { 0 };
        let mut first = vec![0; robot.joints.len()];
        for &j in &selected.order {
            if selected.roles[j] == Role::Moves {
                first[j] = coordinates;
                coordinates += axes(robot.joints[j].kind).len();
            }
        }
        let masses = robot.links.iter().map(|link| link.inertial.as_ref().map(second_moments));
        Self { masses: masses.collect(), robot, selected, first, coordinates }
    }

    /// The forces on the coordinates u of a motion.
    pub fn torque<T: Number>(&self, u: &[T], ud: &[T], udd: &[T]) -> Vec<T> {
        let in_time = |k: usize| Dual2::new(u[k], ud[k], udd[k]);
        let in_time: Vec<_> = (0..self.coordinates).map(in_time).collect();
        let poses = self.poses(&in_time);
        let mut sums = vec![[[T::from(0.0); 3]; 4]; poses.len()];
        for ((sum, pose), mass) in sums.iter_mut().zip(&poses).zip(&self.masses) {
            if let (Some(pose), Some(mass)) = (pose, mass) {
                *sum = work(pose, mass);
            }
        }
        let mut torque = vec![T::from(0.0); self.coordinates];
        for &j in self.selected.order.iter().rev() {
            let joint = &self.robot.joints[j];
            let (Some(parent), true) = (&poses[joint.parent], poses[joint.child].is_some()) else {
                continue;
            };
            let sum = sums[joint.child];
            if self.selected.roles[j] == Role::Moves {
                let before = placed(&value(parent), &joint.origin);
                let own = self.first[j]..self.first[j] + axes(joint.kind).len();
                forces(before, &steps(joint), &u[own.clone()], &sum, &mut torque[own]);
            }
            add(&mut sums[joint.parent], &sum);
        }
        if self.selected.free_base {
            let own = 0..FREE.len();
            let sum = &sums[self.selected.base];
            let steps = FREE.map(step_along);
            forces(identity(), &steps, &u[own.clone()], sum, &mut torque[own]);
        }
        torque
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
            let all = steps(joint);
            poses[joint.child] = Some(match (self.selected.roles[j], all.as_slice()) {
                (Role::Moves, all) => {
                    let pairs = all.iter().zip(&u[self.first[j]..]);
                    pairs.fold(placed, |pose, (step, u)| product(&pose, &step.pose(*u)))
                }
                (Role::Locked(position), [step]) if position != 0.0 => {
                    product(&placed, &step.pose(T::from(position)))
                }
                (Role::Locked(_), _) => placed,
            });
        }
        poses
    }
}

/// A turn about an axis, or a translation along it.
#[derive(Clone, Copy, Debug)]
struct Step {
    is_turn: bool,
    axis: DVec3,
}

impl Step {
    fn pose<T: Number>(self, u: T) -> Rows<T> {
        match self.is_turn {
            true => turn(self.axis, u),
            false => slide(self.axis, u),
        }
    }
}

/// One of [`BALL`], [`PLANE`] or [`FREE`].
fn step_along(axis: usize) -> Step {
    Step { is_turn: axis < 3, axis: DVec3::AXES[axis % 3] }
}

/// The one-coordinate joints in place of a joint, with their axes.
fn steps(joint: &Joint) -> Vec<Step> {
    match joint.kind.has_axis() {
        true => vec![Step {
            is_turn: joint.kind != Kind::Prismatic,
            axis: joint.axis.normalize_or_zero(),
        }],
        false => axes(joint.kind).iter().map(|&axis| step_along(axis)).collect(),
    }
}

/// A J (Ä − G)ᵀ of a link: ∫ r (r̈ − g)ᵀ dm, with 1 as fourth component of r.
fn work<T: Number>(pose: &Rows<Dual2<T>>, (moments, first, mass): &Moments) -> [[T; 3]; 4] {
    let of_link = |i: usize, k: usize| match (i, k) {
        (3, 3) => *mass,
        (3, i) | (i, 3) => first[i],
        (i, k) => moments[i][k],
    };
    let mut out = [[T::from(0.0); 3]; 4];
    for (b, row) in pose.iter().enumerate() {
        let mut second = row.map(|entry| entry.v2);
        if b == 2 {
            second[3] += T::from(G);
        }
        // J (Ä − G)ᵀ, column b.
        let mut column = [T::from(0.0); 4];
        for (i, entry) in column.iter_mut().enumerate() {
            for (k, &x) in second.iter().enumerate() {
                *entry += x * of_link(i, k);
            }
        }
        for (a, row) in pose.iter().enumerate() {
            let pairs = row.iter().zip(column);
            let products = pairs.map(|(entry, x)| entry.re * x);
            out[a][b] = products.fold(T::from(0.0), |sum, x| sum + x);
        }
        out[3][b] = column[3];
    }
    out
}

fn add<T: Number>(sum: &mut [[T; 3]; 4], other: &[[T; 3]; 4]) {
    for (row, other) in sum.iter_mut().zip(other) {
        for (entry, &other) in row.iter_mut().zip(other) {
            *entry += other;
        }
    }
}

/// The forces tr(Qᵢ S) on the coordinates of a joint, of which `before` is the pose at zero.
fn forces<T: Number>(
    before: Rows<T>,
    steps: &[Step],
    u: &[T],
    sum: &[[T; 3]; 4],
    torque: &mut [T],
) {
    let mut pose = before;
    for ((step, &u), torque) in steps.iter().zip(u).zip(torque) {
        // Qᵢ = ∂A/∂uᵢ A⁻¹ of the pose after the step.
        let motion = step.pose(Dual::new(u, T::from(1.0)));
        let slope = product_of_parts(&pose, &motion.map(|row| row.map(|entry| entry.eps)), false);
        pose = product(&pose, &value_of(&motion));
        let mut force = T::from(0.0);
        for (slope, b) in slope.iter().zip(0..3) {
            let mut rest = slope[3];
            for a in 0..3 {
                let q = slope[0] * pose[a][0] + slope[1] * pose[a][1] + slope[2] * pose[a][2];
                force += q * sum[a][b];
                rest -= q * pose[a][3];
            }
            force += rest * sum[3][b];
        }
        *torque = force;
    }
}

/// A pose without its derivatives in time.
fn value<T: Number>(pose: &Rows<Dual2<T>>) -> Rows<T> {
    pose.map(|row| row.map(|entry| entry.re))
}

fn value_of<T: Number>(pose: &Rows<Dual<T>>) -> Rows<T> {
    pose.map(|row| row.map(|entry| entry.re))
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

/// The placement without a displacement.
pub fn identity<T: Number>() -> Rows<T> {
    std::array::from_fn(|i| std::array::from_fn(|k| T::from(if i == k { 1.0 } else { 0.0 })))
}

/// The product of two poses.
pub fn product<T: Number>(a: &Rows<T>, b: &Rows<T>) -> Rows<T> {
    product_of_parts(a, b, true)
}

/// The product of a pose with another, or with the derivative of one, whose last row is zero.
fn product_of_parts<T: Number>(a: &Rows<T>, b: &Rows<T>, is_pose: bool) -> Rows<T> {
    // Loops: closures that return arrays of arrays are copied more often than they are computed.
    let mut out = *a;
    for (out, a) in out.iter_mut().zip(a) {
        for (k, out) in out.iter_mut().enumerate() {
            let sum = a[0] * b[0][k] + a[1] * b[1][k] + a[2] * b[2][k];
            *out = if k == 3 && is_pose { sum + a[3] } else { sum };
        }
    }
    out
}

/// A pose followed by the placement of a joint, as the file gives it.
fn placed<T: Number>(pose: &Rows<T>, origin: &Pose) -> Rows<T> {
    let origin = rows(origin);
    let mut out = *pose;
    for (out, a) in out.iter_mut().zip(pose) {
        for (k, out) in out.iter_mut().enumerate() {
            let [x, y, z] = [0, 1, 2].map(|j| a[j] * origin[j][k]);
            let sum = x + y + z;
            *out = if k == 3 { sum + a[3] } else { sum };
        }
    }
    out
}

/// A pose followed by one-coordinate joints.
pub fn moved<T: Number>(mut pose: Rows<T>, axes: &[usize], u: &[T]) -> Rows<T> {
    for (&axis, &u) in axes.iter().zip(u) {
        pose = product(&pose, &step_along(axis).pose(u));
    }
    pose
}

fn slide<T: Number>(n: DVec3, u: T) -> Rows<T> {
    let mut pose = identity();
    for (row, n) in pose.iter_mut().zip(n.to_array()) {
        row[3] = u * n;
    }
    pose
}

fn turn<T: Number>(n: DVec3, u: T) -> Rows<T> {
    let (sin, cos) = u.sin_cos();
    let cross = [[0.0, -n.z, n.y], [n.z, 0.0, -n.x], [-n.y, n.x, 0.0]];
    let rest = T::from(1.0) - cos;
    let mut pose = identity();
    for (i, row) in pose.iter_mut().enumerate() {
        for (k, entry) in row.iter_mut().take(3).enumerate() {
            let diagonal = if i == k { cos } else { T::from(0.0) };
            *entry = diagonal + sin * cross[i][k] + rest * (n[i] * n[k]);
        }
    }
    pose
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;
    use std::hint::black_box;
    use std::path::Path;
    use std::time::Instant;

    use super::*;
    use crate::selection::Selection;
    use crate::source::parse;

    /// Kinetic minus potential energy.
    fn lagrangian<T: Number>(energy: &Energy<'_>, u: &[T], ud: &[T]) -> T {
        let u: Vec<Dual<T>> = u.iter().zip(ud).map(|(&u, &ud)| Dual::new(u, ud)).collect();
        let mut sum = T::from(0.0);
        for (pose, mass) in energy.poses(&u).iter().zip(&energy.masses) {
            let (Some(pose), Some((moments, first, mass))) = (pose, mass) else {
                continue;
            };
            for row in pose {
                let rate = row.map(|entry| entry.eps);
                for (a, &x) in rate.iter().enumerate() {
                    for (b, &y) in rate.iter().enumerate() {
                        let weight = match (a, b) {
                            (3, 3) => *mass,
                            (3, i) | (i, 3) => first[i],
                            (i, k) => moments[i][k],
                        };
                        sum += x * y * (0.5 * weight);
                    }
                }
            }
            let [_, _, z] = pose;
            for (entry, &h) in z.iter().zip(first.iter().chain([mass])) {
                sum -= entry.re * (G * h);
            }
        }
        sum
    }

    /// d/dt ∂L/∂u̇ᵢ − ∂L/∂uᵢ by dual numbers, coordinate by coordinate.
    fn by_derivatives(energy: &Energy<'_>, u: &[f64], ud: &[f64], udd: &[f64]) -> Vec<f64> {
        let along = |i: usize| {
            let unit = |k: usize| if k == i { 1.0 } else { 0.0 };
            let moved: Vec<_> = (0..u.len()).map(|k| Dual::new(u[k], unit(k))).collect();
            let still: Vec<_> = ud.iter().map(|&x| Dual::new(x, 0.0)).collect();
            let slope = lagrangian(energy, &moved, &still).eps;
            // The outer rate is that of u̇ᵢ, the inner one that of time.
            let in_time = |x: f64, rate: f64, outer: f64| {
                Dual::new(Dual::new(x, rate), Dual::new(outer, 0.0))
            };
            let u: Vec<_> = (0..u.len()).map(|k| in_time(u[k], ud[k], 0.0)).collect();
            let ud: Vec<_> = (0..u.len()).map(|k| in_time(ud[k], udd[k], unit(k))).collect();
            lagrangian(energy, &u, &ud).eps.eps - slope
        };
        (0..u.len()).map(along).collect()
    }

    #[test]
    fn the_sum_over_links_is_lagranges_derivative_of_the_energy() {
        let text = include_str!("../../tests/urdf/zoo.urdf");
        let robot = parse(text, Path::new(".")).expect("a robot");
        for free_base in [false, true] {
            let selection = Selection {
                free_base,
                lock: vec![("turn".to_owned(), -0.3)],
                ..Selection::default()
            };
            let selected = selection.of(&robot).expect("a selection");
            let energy = Energy::of(&robot, &selected);
            let number = |size: f64, phase: f64| -> Vec<f64> {
                let each = 0..energy.coordinates;
                each.map(|i| size * (1.7 * i as f64 + phase).sin()).collect()
            };
            let (u, ud, udd) = (number(1.2, 0.3), number(2.0, 1.1), number(5.0, 2.3));
            let expected = by_derivatives(&energy, &u, &ud, &udd);
            let found = energy.torque(&u, &ud, &udd);
            let scale = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!(scale > 1.0, "{expected:?}");
            for (a, b) in found.iter().zip(&expected) {
                assert!((a - b).abs() < 1e-13 * scale, "{a} {b}");
            }
        }
    }
    /// The least time of a state of a chain of joints, s.
    fn time(joints: usize) -> f64 {
        let mut text = String::from("<robot name='r'><link name='l0'/>");
        for i in 1..=joints {
            let _ = write!(
                text,
                "<link name='l{i}'><inertial><origin xyz='0 0 0.1'/><mass value='1'/><inertia \
                 ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><joint \
                 name='j{i}' type='continuous'><origin xyz='0 0 0.2'/><parent link='l{}'/><child \
                 link='l{i}'/><axis xyz='0 1 0'/></joint>",
                i - 1
            );
        }
        let robot = parse(&(text + "</robot>"), Path::new(".")).expect("a robot");
        let selected = Selection::default().of(&robot).expect("all joints");
        let energy = Energy::of(&robot, &selected);
        let [u, ud, udd] = [0.3, 0.7, 1.1].map(|x| vec![x; joints]);
        let once = || {
            let start = Instant::now();
            black_box(energy.torque(&u, &ud, &udd));
            start.elapsed().as_secs_f64()
        };
        (0..20).map(|_| once()).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_work_of_a_state_grows_with_the_number_of_joints() {
        // If the work grew with the square, eight times as many joints would take 64 times as long.
        let [few, most] = [17, 136].map(time);
        assert!(most < 24.0 * few, "{few} s, {most} s");
    }
}
