//! Chains of revolute joints in Denavit and Hartenberg's parameters, with general inertias, for the
//! ancestors and for today's core.
//!
//! Frame i is fixed in link i at its outer end; joint i turns about z of frame i − 1; frame i
//! follows from frame i − 1 by Rot(z, q_i) Trans(z, d_i) Trans(x, a_i) Rot(x, α_i).

use core::array::from_fn;

use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};

use crate::matrix::Mat;
use crate::number::Number;

pub const LONGEST: usize = 12;
/// Gravity in the base's frame, m/s².
pub const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// A link: a, d, α, and in the frame at its inner joint, whose z is that joint's axis: mass, centre
/// of mass, and the inertia about it: xx, xy, xz, yy, yz, zz.
struct Given {
    a: f64,
    d: f64,
    alpha: f64,
    mass: f64,
    com: [f64; 3],
    inertia: [f64; 6],
}

/// No number of a link is zero, and no two links are the same.
const fn given(i: usize) -> Given {
    let k = i as f64;
    let turn = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    Given {
        a: 0.3 - 0.02 * k,
        d: 0.05 + 0.01 * k,
        alpha: turn * (1.1 - 0.05 * k),
        mass: 3.0 - 0.2 * k,
        com: [0.12 - 0.01 * k, 0.02 * turn, 0.03 + 0.004 * k],
        inertia: [0.02, 1e-3 * turn, -2e-3, 0.03 - 1e-3 * k, 1.5e-3, 0.025],
    }
}

/// The chain of N links as a robot of today's core.
pub struct Rods<const N: usize>;

impl<const N: usize> Robot<N, N, N> for Rods<N> {
    const MODEL: ArmModel<f64, N> = ArmModel::new("rods", bodies());
}

const fn bodies<const N: usize>() -> [Body; N] {
    let mut bodies = [Body::new("rod", BASE, Joint::fixed()); N];
    let mut i = 0;
    while i < N {
        let link = given(i);
        let mut body = Body::new("rod", BASE, Joint::revolute([0.0, 0.0, 1.0]));
        if i > 0 {
            let before = given(i - 1);
            body = Body::new("rod", i - 1, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([before.a, 0.0, before.d])
                .rpy([before.alpha, 0.0, 0.0]);
        }
        bodies[i] = body.mass(link.mass).com(link.com).inertia(link.inertia);
        i += 1;
    }
    bodies
}

/// A link's constants, in its own frame i, computed once.
#[derive(Clone, Copy, Debug)]
pub struct Link<T> {
    pub a: T,
    pub d: T,
    /// cos α.
    pub cos_alpha: T,
    /// sin α.
    pub sin_alpha: T,
    /// m.
    pub mass: T,
    /// Mass of the link and of all links behind it.
    pub mass_from_here: T,
    /// Its reciprocal.
    pub one_by_mass_from_here: T,
    /// p*: from the origin of frame i − 1 to that of frame i.
    pub p: [T; 3],
    /// s, r: from the origin of frame i to the centre of mass.
    pub s: [T; 3],
    /// p* + s.
    pub p_plus_s: [T; 3],
    /// Rotational inertia about the centre of mass.
    pub inertia: Mat<T, 3>,
    /// ∫ ρ dm about the origin of frame i.
    pub first_moment: [T; 3],
    /// ∫ ρ ρᵀ dm about the same.
    pub second_moment: Mat<T, 3>,
    /// Both, and the mass, in one matrix.
    pub pseudo_inertia: Mat<T, 4>,
    /// m (s, 1).
    pub first_moment_4: [T; 4],
    /// ∫ ρ dm about the origin of frame i − 1, of the link with all masses behind it put in the
    /// origin of frame i.
    pub augmented_first: [T; 3],
    /// ∫ ρ ρᵀ dm of the same.
    pub augmented_second: Mat<T, 3>,
}

#[derive(Clone, Copy, Debug)]
pub struct Chain<T, const N: usize> {
    /// From the base to the tip.
    pub links: [Link<T>; N],
    /// Gravity in the base's frame.
    pub gravity: [T; 3],
}

/// Sines and cosines of the joints, their speeds and accelerations.
#[derive(Clone, Copy, Debug)]
pub struct State<T, const N: usize> {
    /// cos q.
    pub cos: [T; N],
    /// sin q.
    pub sin: [T; N],
    pub qd: [T; N],
    pub qdd: [T; N],
}

impl<T: Number, const N: usize> State<T, N> {
    /// A state, its sines and cosines computed in f64.
    pub fn new(q: &[f64; N], qd: &[f64; N], qdd: &[f64; N]) -> Self {
        Self {
            cos: q.map(|q| T::of(libm::cos(q))),
            sin: q.map(|q| T::of(libm::sin(q))),
            qd: qd.map(T::of),
            qdd: qdd.map(T::of),
        }
    }
}

impl<T: Number, const N: usize> Default for Chain<T, N> {
    fn default() -> Self {
        let from_here = |i| (i..N).map(|j| given(j).mass).sum();
        Self { links: from_fn(|i| Link::new(&given(i), from_here(i))), gravity: GRAVITY.map(T::of) }
    }
}

impl<T: Number> Link<T> {
    fn new(given: &Given, mass_from_here: f64) -> Self {
        let (cos, sin) = (libm::cos(given.alpha), libm::sin(given.alpha));
        // Rot(x, α)ᵀ v.
        let turned = |v: [f64; 3]| [v[0], cos * v[1] + sin * v[2], cos * v[2] - sin * v[1]];
        let m = given.mass;
        let p = turned([given.a, 0.0, given.d]);
        let p_plus_s = turned(given.com);
        let s: [f64; 3] = from_fn(|i| p_plus_s[i] - p[i]);
        let [xx, xy, xz, yy, yz, zz] = given.inertia;
        let half = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(turned);
        let inertia: Mat<f64, 3> = from_fn(|i| turned(from_fn(|j| half[j][i])));
        let trace = inertia[0][0] + inertia[1][1] + inertia[2][2];
        // ∫ ρ ρᵀ dm about a point from which the centre of mass is at c.
        let moment = |c: &[f64; 3]| -> Mat<f64, 3> {
            from_fn(|i| {
                from_fn(|j| {
                    f64::from(u8::from(i == j)) * trace / 2.0 - inertia[i][j] + m * c[i] * c[j]
                })
            })
        };
        let second = moment(&s);
        let inner = moment(&p_plus_s);
        let behind = mass_from_here - m;
        let first_4 = [m * s[0], m * s[1], m * s[2], m];
        let pseudo: Mat<f64, 4> = from_fn(|i| match i {
            3 => first_4,
            _ => from_fn(|j| if j == 3 { first_4[i] } else { second[i][j] }),
        });
        let of = |a: Mat<f64, 3>| a.map(|row| row.map(T::of));
        Self {
            a: T::of(given.a),
            d: T::of(given.d),
            cos_alpha: T::of(cos),
            sin_alpha: T::of(sin),
            mass: T::of(m),
            mass_from_here: T::of(mass_from_here),
            one_by_mass_from_here: T::of(1.0 / mass_from_here),
            p: p.map(T::of),
            s: s.map(T::of),
            p_plus_s: p_plus_s.map(T::of),
            inertia: of(inertia),
            second_moment: of(second),
            first_moment: s.map(|x| T::of(m * x)),
            pseudo_inertia: pseudo.map(|row| row.map(T::of)),
            first_moment_4: first_4.map(T::of),
            augmented_first: from_fn(|i| T::of(m * p_plus_s[i] + behind * p[i])),
            augmented_second: of(from_fn(|i| from_fn(|j| inner[i][j] + behind * p[i] * p[j]))),
        }
    }

    /// (r, 1): the centre of mass.
    #[inline(always)]
    pub fn com_4(&self) -> [T; 4] {
        let [x, y, z] = self.s;
        [x, y, z, T::of(1.0)]
    }

    /// A_i's rotation, from frame i to frame i − 1: 4 products.
    #[inline(always)]
    pub fn rotation(&self, cos: T, sin: T) -> Mat<T, 3> {
        let (ca, sa) = (self.cos_alpha, self.sin_alpha);
        [[cos, -(ca * sin), sa * sin], [sin, ca * cos, -(sa * cos)], [T::ZERO, sa, ca]]
    }

    /// A_i, from frame i to frame i − 1: 6 products.
    #[inline(always)]
    pub fn transform(&self, cos: T, sin: T) -> Mat<T, 4> {
        let [[r00, r01, r02], [r10, r11, r12], [r20, r21, r22]] = self.rotation(cos, sin);
        [
            [r00, r01, r02, self.a * cos],
            [r10, r11, r12, self.a * sin],
            [r20, r21, r22, self.d],
            [T::ZERO, T::ZERO, T::ZERO, T::of(1.0)],
        ]
    }

    /// A v by two planar rotations: 8 products, 4 sums.
    #[inline(always)]
    pub fn turn(&self, cos: T, sin: T, v: &[T; 3]) -> [T; 3] {
        let y = self.cos_alpha * v[1] - self.sin_alpha * v[2];
        let z = self.sin_alpha * v[1] + self.cos_alpha * v[2];
        [cos * v[0] - sin * y, sin * v[0] + cos * y, z]
    }

    /// Aᵀ v by two planar rotations: 8 products, 4 sums.
    #[inline(always)]
    pub fn turn_back(&self, cos: T, sin: T, v: &[T; 3]) -> [T; 3] {
        let x = cos * v[0] + sin * v[1];
        let y = cos * v[1] - sin * v[0];
        let (ca, sa) = (self.cos_alpha, self.sin_alpha);
        [x, ca * y + sa * v[2], ca * v[2] - sa * y]
    }
}
