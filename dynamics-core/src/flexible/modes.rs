//! The modes of all links of a robot, in the form that the algorithms read.

use glam::{DMat3, DVec3, Mat3, Vec3};

use super::link::{FlexibleLink, ModeError, ModeProblem, Rows};
use crate::math::const_eval::{mul, mul_vec, transpose, vec3};
use crate::model::{Model, Robot, Text};
use crate::scalar::Real;

/// The M modes of a robot's links, beside its model: in the order of the links, and of a link in
/// that of its description.
///
/// ```
/// use dynamics_core::flexible::{Beam, FlexibleLink, Modes, Shape};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
/// const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]).tip(0.3, 1e-4);
/// const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1), Shape::BendZ(2)]) {
///     Ok(link) => link,
///     Err(_) => panic!("a beam without a length, a mass or a stiffness"),
/// };
/// struct Boom;
/// impl Robot<1, 1, 1> for Boom {
///     const MODEL: ArmModel<f64, 1> = ArmModel::new("boom", [
///         Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
///     ]);
/// }
/// static MODES: Modes<f32, 2> = Modes::new(&Boom::MODEL, &[LINK]).to_f32();
/// assert_eq!(MODES.links(), &[0, 0]);
/// ```
///
/// A mode without stiffness does not compile:
///
/// ```compile_fail,E0080
/// # use dynamics_core::flexible::{FlexibleLink, Mode, Modes};
/// # use dynamics_core::model::{ArmModel, BASE, Body, Joint};
/// const BOOM: ArmModel<f64, 1> = ArmModel::new("boom", [Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0]))
///     .mass(1.0).com([0.5, 0.0, 0.0]).inertia([0.1, 0.0, 0.0, 0.1, 0.0, 0.1])]);
/// let mut mode = Mode::ZERO;
/// # const LINK: FlexibleLink = {
/// #     let mut mode = Mode::ZERO;
/// mode.momentum[2] = 0.1;
/// #     let mut link = FlexibleLink::new(0, [1.0, 0.0, 0.0], &[mode]);
/// #     link.products[0][0][2][2] = 0.1;
/// #     link
/// # };
/// const MODES: Modes<f64, 1> = Modes::new(&BOOM, &[LINK]); // error: link `boom`, mode 0: its stiffness is not positive definite
/// # let _ = MODES;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modes<R: Real, const M: usize> {
    pub(super) links: [usize; M],
    /// A mode's integrals, in the aligned frame of its link.
    pub(super) each: [Integrals<R>; M],
    /// ∫ φₖ φₗᵀ dm; zero between modes of different links.
    pub(super) products: [[R::Mat3; M]; M],
    pub(super) stiffness: [[R; M]; M],
    pub(super) damping: [[R; M]; M],
}

/// One mode in the aligned frame of its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Integrals<R: Real> {
    /// ∫ φ dm.
    pub(super) momentum: R::Vec3,
    /// ∫ φ r₀ᵀ dm.
    pub(super) moments: R::Mat3,
    pub(super) shift: R::Vec3,
    /// ½ ψ.
    pub(super) half_turn: R::Vec3,
    /// The link's end.
    pub(super) end: R::Vec3,
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// The body of each mode.
    pub const fn links(&self) -> &[usize; M] {
        &self.links
    }

    /// The modes of body `i`: they follow each other.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of_body(&self, i: usize) -> core::ops::Range<usize> {
        let count = |is: fn(usize, usize) -> bool| {
            let links = self.links.iter();
            links.filter(|&&link| is(link, i)).count()
        };
        count(|link, i| link < i)..count(|link, i| link <= i)
    }
}

impl<const M: usize> Modes<f64, M> {
    /// The modes of these links, which are in the order of their bodies.
    ///
    /// # Panics
    /// While compiling in a `const`; as [`Modes::try_new`] has errors.
    pub const fn new<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
        links: &[FlexibleLink],
    ) -> Self {
        match Self::try_new(model, links) {
            Ok(modes) => modes,
            Err(ModeError { link, mode, problem }) => Text::EMPTY
                .with("link `")
                .with(link)
                .with("`, mode ")
                .number(mode)
                .with(": ")
                .with(problem.text())
                .panic(),
        }
    }

    /// The same without a panic.
    ///
    /// # Errors
    /// [`ModeError`] names the link and the mode: data that is not positive definite, a stiffness
    /// that is not positive, a mode without mass or that is in part a rigid motion of its link,
    /// links that are not in order, another number of modes than M.
    pub const fn try_new<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
        links: &[FlexibleLink],
    ) -> Result<Self, ModeError> {
        const NONE: Integrals<f64> = Integrals {
            momentum: DVec3::ZERO,
            moments: DMat3::ZERO,
            shift: DVec3::ZERO,
            half_turn: DVec3::ZERO,
            end: DVec3::ZERO,
        };
        let mut modes = Self {
            links: [usize::MAX; M],
            each: [NONE; M],
            products: [[DMat3::ZERO; M]; M],
            stiffness: [[0.0; M]; M],
            damping: [[0.0; M]; M],
        };
        let (mut first, mut i) = (0, 0);
        while i < links.len() {
            let link = &links[i];
            if link.body >= B {
                return Err(problem(model.name, 0, ModeProblem::NoBody));
            }
            let body = &model.links[link.body];
            if i > 0 && links[i - 1].body >= link.body {
                return Err(problem(body.name, 0, ModeProblem::Order));
            }
            if let Some((mode, what)) =
                super::check::problem(link, &body.inertia, &body.to_joint_frame)
            {
                return Err(problem(body.name, mode, what));
            }
            if first + link.count > M {
                return Err(problem(model.name, M, ModeProblem::Count));
            }
            modes = modes.with(link, &body.to_joint_frame, first);
            first += link.count;
            i += 1;
        }
        if first != M {
            return Err(problem(model.name, first, ModeProblem::Count));
        }
        Ok(modes)
    }

    /// With the modes of one link from `first` on.
    const fn with(mut self, link: &FlexibleLink, frame: &DMat3, first: usize) -> Self {
        let mut k = 0;
        while k < link.count {
            let (mode, at) = (&link.modes[k], first + k);
            let [x, y, z] = mode.turn;
            self.links[at] = link.body;
            self.each[at] = Integrals {
                momentum: mul_vec(frame, vec3(mode.momentum)),
                moments: turned(frame, &mode.moments),
                shift: mul_vec(frame, vec3(mode.shift)),
                half_turn: mul_vec(frame, vec3([0.5 * x, 0.5 * y, 0.5 * z])),
                end: mul_vec(frame, vec3(link.end)),
            };
            let mut l = 0;
            while l < link.count {
                self.products[at][first + l] = turned(frame, &link.products[k][l]);
                self.stiffness[at][first + l] = link.stiffness[k][l];
                self.damping[at][first + l] = link.damping[k][l];
                l += 1;
            }
            k += 1;
        }
        self
    }

    /// The same in f32.
    pub const fn to_f32(&self) -> Modes<f32, M> {
        const NONE: Integrals<f32> = Integrals {
            momentum: Vec3::ZERO,
            moments: Mat3::ZERO,
            shift: Vec3::ZERO,
            half_turn: Vec3::ZERO,
            end: Vec3::ZERO,
        };
        let mut modes = Modes {
            links: self.links,
            each: [NONE; M],
            products: [[Mat3::ZERO; M]; M],
            stiffness: [[0.0; M]; M],
            damping: [[0.0; M]; M],
        };
        let mut k = 0;
        while k < M {
            let mode = &self.each[k];
            modes.each[k] = Integrals {
                momentum: vector(mode.momentum),
                moments: matrix(&mode.moments),
                shift: vector(mode.shift),
                half_turn: vector(mode.half_turn),
                end: vector(mode.end),
            };
            let mut l = 0;
            while l < M {
                modes.products[k][l] = matrix(&self.products[k][l]);
                modes.stiffness[k][l] = self.stiffness[k][l] as f32;
                modes.damping[k][l] = self.damping[k][l] as f32;
                l += 1;
            }
            k += 1;
        }
        modes
    }
}

/// A robot whose links bend, known at compile time. One robot may have several tables, of different
/// numbers of modes M.
///
/// An example is that of [`Bending`](super::Bending).
pub trait BendingRobot<const B: usize, const Q: usize, const V: usize, const M: usize>:
    Robot<B, Q, V>
{
    /// The modes of all links.
    const MODES: Modes<f64, M>;
}

const fn problem(link: &'static str, mode: usize, problem: ModeProblem) -> ModeError {
    ModeError { link, mode, problem }
}

/// E m Eᵀ of a matrix by rows.
const fn turned(frame: &DMat3, m: &Rows) -> DMat3 {
    let rows = DMat3::from_cols(vec3(m[0]), vec3(m[1]), vec3(m[2]));
    mul(&mul(frame, &transpose(&rows)), &transpose(frame))
}

const fn vector(v: DVec3) -> Vec3 {
    Vec3::new(v.x as f32, v.y as f32, v.z as f32)
}

const fn matrix(m: &DMat3) -> Mat3 {
    Mat3::from_cols(vector(m.x_axis), vector(m.y_axis), vector(m.z_axis))
}
