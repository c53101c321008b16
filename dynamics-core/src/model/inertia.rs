//! The inertia of a body as it is described: about its centre of mass, in the frame of its
//! description.

use super::{Calibrated, ImpossibleInertia, ModelError, Problem, Robot};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::SpatialInertia;

/// Mass, centre of mass and inertia of a body in the frame of its description, as [`super::Body`]
/// has them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BodyInertia<R> {
    /// Mass, kg.
    pub mass: R,
    /// Centre of mass, m; zero for a body without mass.
    pub com: [R; 3],
    /// Rotational inertia about the centre of mass: xx, xy, xz, yy, yz, zz in kg·m².
    pub inertia: [R; 6],
}

impl<R: Real> BodyInertia<R> {
    /// The first property that is not physical: numbers that are not finite, a negative mass,
    /// inertia without mass, or principal moments that violate the triangle inequality by more than
    /// `relative` of the largest.
    pub(crate) fn problem(&self, relative: f64) -> Option<Problem> {
        let about = self.about_origin();
        let finite = |v: &R::Vec3| v.array().iter().all(|x| x.is_finite());
        let columns = about.rotational.cols();
        if !(finite(&about.first_moment) && columns.iter().all(finite)) {
            return Some(Problem::NotFinite);
        }
        if !(self.mass.is_finite() && self.mass >= R::ZERO) {
            return Some(Problem::Mass(self.mass.to_f64()));
        }
        if self.mass == R::ZERO && self.inertia.iter().any(|&x| x != R::ZERO) {
            return Some(Problem::Massless);
        }
        let [xx, xy, xz, yy, yz, zz] = self.inertia.map(R::to_f64);
        let moments = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        ImpossibleInertia::beyond::<false>(moments, relative, 0.0).map(|found| found.problem())
    }

    /// The same about the origin. RBDA (2.63).
    pub(crate) fn about_origin(&self) -> SpatialInertia<R> {
        let ([xx, xy, xz, yy, yz, zz], [x, y, z]) = (self.inertia, self.com);
        let (mass, column) = (self.mass, |a, b, c| R::Vec3::new(a, b, c));
        SpatialInertia {
            mass,
            first_moment: column(x, y, z) * mass,
            rotational: R::Mat3::from_cols(
                column(xx + mass * (y * y + z * z), xy - mass * x * y, xz - mass * x * z),
                column(xy - mass * x * y, yy + mass * (x * x + z * z), yz - mass * y * z),
                column(xz - mass * x * z, yz - mass * y * z, zz + mass * (x * x + y * y)),
            ),
        }
    }

    /// The same inertia, given about the origin of the frame, such as an estimated one. The centre
    /// of mass of a body without mass is the origin.
    ///
    /// ```
    /// use dynamics_core::{effects::Payload, model::BodyInertia};
    /// let load = BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.5], inertia: [0.25, 0.0, 0.0, 0.25, 0.0, 0.125] };
    /// assert_eq!(BodyInertia::about_com(&Payload::<f64, 0>::from_inertia(load).0), load);
    /// ```
    pub fn about_com(about: &SpatialInertia<R>) -> Self {
        let mass = about.mass;
        let per = if mass == R::ZERO { R::ZERO } else { R::ONE / mass };
        let com = (about.first_moment * per).array();
        let [x, y, z] = com;
        let [cx, cy, cz] = about.rotational.cols().map(Vector::array);
        let ([xx, xy, xz], [_, yy, yz], [_, _, zz]) = (cx, cy, cz);
        Self {
            mass,
            com,
            inertia: [
                xx - mass * (y * y + z * z),
                xy + mass * x * y,
                xz + mass * x * z,
                yy - mass * (x * x + z * z),
                yz + mass * y * z,
                zz - mass * (x * x + y * y),
            ],
        }
    }
}

impl<T, R: Real, const B: usize, const Q: usize, const V: usize> Calibrated<T, R, B, Q, V>
where
    T: Robot<B, Q, V>,
{
    /// Sets the inertia of the body of this number, in the frame of its description, as identified
    /// in URDF's conventions. [`super::Model::body`] looks a number up.
    ///
    /// Principal moments may violate the triangle inequality by `relative` of the largest: some
    /// 10⁻⁶ for numbers rounded to f32, `f64::INFINITY` for numbers that must be accepted
    /// unchecked. Not for the tick: it computes principal moments in f64. The algorithms of
    /// [`crate::algorithms`] accept the robot by reference; the engine accepts its base parameters
    /// ([`BaseParameters`](crate::effects::BaseParameters)).
    ///
    /// ```
    /// use dynamics_core::model::{BodyInertia, Calibrated, Problem, Robot};
    /// use dynamics_core::{algorithms::rnea, effects::RIGID_BODY, robots::Ur5e, state::State};
    /// const UPPER_ARM: usize = Ur5e::MODEL.body("upper_arm");
    /// let mut arm = Calibrated::<Ur5e, f32, 6, 6, 6>::nominal();
    /// let at = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);
    /// let before = rnea(&arm, &at, &RIGID_BODY);
    ///
    /// let described = arm.inertia(UPPER_ARM).expect("the robot has this body");
    /// let identified = BodyInertia { mass: described.mass + 0.4, ..described };
    /// arm.set_inertia(UPPER_ARM, identified, 1e-6)?;
    /// assert!(rnea(&arm, &at, &RIGID_BODY)[1].abs() > before[1].abs() + 0.1);
    ///
    /// let error = arm.set_inertia(UPPER_ARM, BodyInertia { mass: -1.0, ..identified }, 1e-6).unwrap_err();
    /// assert_eq!((error.body, error.problem), ("upper_arm", Problem::Mass(-1.0)));
    /// # Ok::<(), dynamics_core::model::ModelError>(())
    /// ```
    ///
    /// # Errors
    /// [`ModelError`] names the body and what is not physical: [`Problem::Mass`] with the mass,
    /// [`Problem::NegativeMoment`] with the moment, [`Problem::Triangle`] with the excess,
    /// [`Problem::Massless`] or [`Problem::NotFinite`]; for an index without a body it names the
    /// robot and the index ([`Problem::NoBody`]). The robot is then unchanged.
    pub fn set_inertia(
        &mut self,
        body: usize,
        inertia: BodyInertia<R>,
        relative: f64,
    ) -> Result<(), ModelError> {
        let none = ModelError { body: self.model.name, problem: Problem::NoBody(body) };
        let link = self.model.links.get_mut(body).ok_or(none)?;
        if let Some(problem) = inertia.problem(relative) {
            return Err(ModelError { body: link.name, problem });
        }
        let (about, frame) = (inertia.about_origin(), link.to_joint_frame);
        link.inertia = SpatialInertia {
            mass: about.mass,
            first_moment: frame * about.first_moment,
            rotational: frame * about.rotational * frame.transpose(),
        };
        Ok(())
    }

    /// The inertia of the body of this number, in the frame of its description; none for a number
    /// that no body has.
    pub fn inertia(&self, body: usize) -> Option<BodyInertia<R>> {
        let link = self.model.links.get(body)?;
        let (about, back) = (&link.inertia, link.to_joint_frame.transpose());
        Some(BodyInertia::about_com(&SpatialInertia {
            mass: about.mass,
            first_moment: back * about.first_moment,
            rotational: back * about.rotational * link.to_joint_frame,
        }))
    }
}
