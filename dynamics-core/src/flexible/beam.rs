//! Modes of a uniform beam.

use super::check::is_finite;
use super::link::{FlexibleLink, MODES_PER_LINK, Mode, ModeProblem, Row, Rows};
use super::shape::{Line, POINTS, point};
use crate::math::const_eval::sqrt;

/// A uniform beam along the x axis of its link, from the joint to a body at its end.
///
/// Euler–Bernoulli: without shear and without the rotary inertia of sections in bending. The body
/// at the end has its centre of mass there and the same inertia about each axis: a motor, a
/// gripper. It is part of the link, and so of the mass, the centre of mass and the inertia that the
/// robot's description gives the body: [`Beam::mass`], [`Beam::com`] and [`Beam::inertia`].
///
/// ```
/// use dynamics_core::flexible::{Beam, Shape};
/// use dynamics_core::model::{BASE, Body, Joint};
/// /// An aluminium tube of 20 x 1 mm.
/// const TUBE: Beam = Beam::new(0.5, 0.161).bending([189.0, 189.0]).tip(0.3, 1e-4);
/// const UPPER: Body = Body::new("upper", BASE, Joint::revolute([0.0, 1.0, 0.0]))
///     .mass(TUBE.mass()).com(TUBE.com()).inertia(TUBE.inertia());
/// let link = TUBE.link(0, &[Shape::BendZ(1), Shape::BendZ(2)])?;
/// let omega = (link.stiffness[0][0] / link.products[0][0][2][2]).sqrt(); // almost: the tip's inertia is small
/// assert!((omega / 119.0 - 1.0).abs() < 0.02, "{omega} rad/s");
/// # Ok::<(), dynamics_core::flexible::ModeProblem>(())
/// ```
///
/// # Source
/// Book (1984); Meirovitch, *Fundamentals of Vibrations* (2001), chapter 8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    length: f64,
    mass_per_length: f64,
    bending: [f64; 2],
    torsion: f64,
    sections: [f64; 2],
    tip: [f64; 2],
    damping_ratio: f64,
}

/// A shape of a beam, counted from one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Bending along y; η is the displacement of the end, m.
    BendY(usize),
    /// Bending along z; η is the displacement of the end, m.
    BendZ(usize),
    /// Torsion; η is the rotation of the end about x, rad.
    Twist(usize),
}

impl Beam {
    /// A beam of this length, m, and mass per length ρA, kg/m, which does not yet bend.
    pub const fn new(length: f64, mass_per_length: f64) -> Self {
        Self {
            length,
            mass_per_length,
            bending: [0.0; 2],
            torsion: 0.0,
            sections: [0.0; 2],
            tip: [0.0; 2],
            damping_ratio: 0.0,
        }
    }

    /// With the stiffness EI of bending along y and along z, N·m².
    #[must_use]
    pub const fn bending(mut self, ei: [f64; 2]) -> Self {
        self.bending = ei;
        self
    }

    /// With the stiffness GJ of torsion, N·m².
    #[must_use]
    pub const fn torsion(mut self, gj: f64) -> Self {
        self.torsion = gj;
        self
    }

    /// With the second moments of mass of a section per length, ρ∫z² dA and ρ∫y² dA, kg·m: the
    /// inertia of torsion. For a line they are zero.
    #[must_use]
    pub const fn sections(mut self, moments: [f64; 2]) -> Self {
        self.sections = moments;
        self
    }

    /// With a body at the end of this mass, kg, and inertia about each axis through its centre,
    /// kg·m².
    #[must_use]
    pub const fn tip(mut self, mass: f64, inertia: f64) -> Self {
        self.tip = [mass, inertia];
        self
    }

    /// With modal damping D = 2 ζ ω M of every mode: some 0.002 of metal alone, 0.01 with joints
    /// and cables.
    #[must_use]
    pub const fn damping_ratio(mut self, zeta: f64) -> Self {
        self.damping_ratio = zeta;
        self
    }

    /// The mass with that of the body at the end, kg.
    pub const fn mass(&self) -> f64 {
        self.mass_per_length * self.length + self.tip[0]
    }

    /// The centre of mass of both in the link's frame, m.
    pub const fn com(&self) -> [f64; 3] {
        let first = (0.5 * self.mass_per_length * self.length + self.tip[0]) * self.length;
        [first / self.mass(), 0.0, 0.0]
    }

    /// The inertia of both about their centre of mass, kg·m²: xx, xy, xz, yy, yz, zz.
    pub const fn inertia(&self) -> [f64; 6] {
        let (l, beam, [tip, own]) = (self.length, self.mass_per_length * self.length, self.tip);
        let [y, z] = [self.sections[0] * l, self.sections[1] * l];
        // About the joint, less that of the whole at the centre of mass.
        let com = self.com()[0];
        let across = beam * l * l / 3.0 + tip * l * l - self.mass() * com * com + own;
        [y + z + own, 0.0, 0.0, across + y, 0.0, across + z]
    }

    /// The link of these shapes: those of the beam with the body at its end, which are orthogonal.
    ///
    /// # Cost
    /// On the host or while compiling; not for the control tick.
    ///
    /// # Errors
    /// [`ModeProblem::Beam`] if the beam has no length, no mass, not the stiffness of a shape
    /// (torsion: nor the inertia), or a negative property; [`ModeProblem::NotFinite`] if one is
    /// infinite, such as the stiffness of a beam that does not bend, whose link has no modes;
    /// [`ModeProblem::NoShape`] if there is no such shape; [`ModeProblem::Count`] if there are more
    /// than [`MODES_PER_LINK`].
    ///
    /// ```
    /// use dynamics_core::flexible::{Beam, ModeProblem, Shape};
    /// let rigid = Beam::new(0.5, 0.161).bending([f64::INFINITY; 2]);
    /// assert_eq!(rigid.link(0, &[Shape::BendZ(1)]), Err(ModeProblem::NotFinite));
    /// ```
    pub const fn link(&self, body: usize, shapes: &[Shape]) -> Result<FlexibleLink, ModeProblem> {
        if shapes.len() > MODES_PER_LINK {
            return Err(ModeProblem::Count);
        }
        let mut fields = [Field::NONE; MODES_PER_LINK];
        let mut k = 0;
        while k < shapes.len() {
            match self.field(shapes[k]) {
                Ok(field) => fields[k] = field,
                Err(problem) => return Err(problem),
            }
            k += 1;
        }
        let mut link = FlexibleLink::new(body, [self.length, 0.0, 0.0], &[]);
        link.count = shapes.len();
        k = 0;
        while k < link.count {
            link.modes[k] = self.mode(&fields[k]);
            let mut l = 0;
            while l < link.count {
                link.products[k][l] = self.product(&fields[k], &fields[l]);
                l += 1;
            }
            let [[xx, _, _], [_, yy, _], [_, _, zz]] = link.products[k][k];
            let (inertia, omega) = (xx + yy + zz, fields[k].omega);
            link.stiffness[k][k] = inertia * omega * omega;
            link.damping[k][k] = 2.0 * self.damping_ratio * omega * inertia;
            if !is_finite(&link, k) {
                return Err(ModeProblem::NotFinite);
            }
            k += 1;
        }
        Ok(link)
    }

    const fn field(&self, shape: Shape) -> Result<Field, ModeProblem> {
        let [mass, inertia] = self.tip;
        let (l, polar) = (self.length, self.sections[0] + self.sections[1]);
        let (beam, twisted) = (self.mass_per_length * l, polar * l);
        let (index, stiffness, rod) = match shape {
            Shape::BendY(index) => (index, self.bending[0], beam),
            Shape::BendZ(index) => (index, self.bending[1], beam),
            Shape::Twist(index) => (index, self.torsion, twisted),
        };
        let no_less_than_zero = mass >= 0.0
            && inertia >= 0.0
            && self.sections[0] >= 0.0
            && self.sections[1] >= 0.0
            && self.damping_ratio >= 0.0;
        if !(l > 0.0 && rod > 0.0 && stiffness > 0.0 && no_less_than_zero) {
            return Err(ModeProblem::Beam);
        }
        let line = match shape {
            Shape::Twist(_) => Line::torsion(index, inertia / rod),
            _ => Line::bending(index, [mass / rod, inertia / (rod * l * l)]),
        };
        let Some(line) = line else {
            return Err(ModeProblem::NoShape);
        };
        let (wave, slope) = (line.wave, line.at(1.0)[1] / l);
        let unit = match shape {
            // GJ (β/L)² = ω² ρI_p
            Shape::Twist(_) => wave * sqrt(stiffness / (rod * l)),
            // EI (β/L)⁴ = ω² ρA
            _ => wave * wave * sqrt(stiffness / (rod * l * l * l)),
        };
        let (shift, turn) = match shape {
            Shape::BendY(_) => ([0.0, 1.0, 0.0], [0.0, 0.0, slope]),
            Shape::BendZ(_) => ([0.0, 0.0, 1.0], [0.0, -slope, 0.0]),
            Shape::Twist(_) => ([0.0; 3], [1.0, 0.0, 0.0]),
        };
        Ok(Field { line: Some(line), shift, turn, omega: unit })
    }

    /// The integrals of one shape.
    const fn mode(&self, field: &Field) -> Mode {
        let [mut zeroth, mut first] = [0.0; 2];
        let mut k = 0;
        while k < POINTS {
            let [u, weight] = point(k);
            let value = field.value(u) * weight * self.length;
            zeroth += value;
            first += value * u * self.length;
            k += 1;
        }
        let (rho, [mass, inertia], [yy, zz]) = (self.mass_per_length, self.tip, self.sections);
        let mut mode = Mode { shift: field.shift, turn: field.turn, ..Mode::ZERO };
        let mut i = 0;
        while i < 3 {
            mode.momentum[i] = (rho * zeroth + mass) * field.shift[i];
            mode.moments[i][0] = (rho * first + mass * self.length) * field.shift[i];
            i += 1;
        }
        if field.is_twist() {
            // (0, −z, y) θ
            mode.moments[1][2] -= yy * zeroth;
            mode.moments[2][1] += zz * zeroth;
        }
        // The body at the end by ψ × d: ∫ (ψ × d) dᵀ dm = ψ× J/2.
        let cross = cross_matrix(field.turn);
        i = 0;
        while i < 9 {
            mode.moments[i / 3][i % 3] += 0.5 * inertia * cross[i / 3][i % 3];
            i += 1;
        }
        mode
    }

    /// ∫ φₖ φₗᵀ dm.
    const fn product(&self, a: &Field, b: &Field) -> Rows {
        let (mut line, mut k) = (0.0, 0);
        while k < POINTS {
            let [u, weight] = point(k);
            line += a.value(u) * b.value(u) * weight * self.length;
            k += 1;
        }
        let (rho, [mass, inertia], [yy, zz]) = (self.mass_per_length, self.tip, self.sections);
        let (turn_a, turn_b) = (cross_matrix(a.turn), cross_matrix(b.turn));
        let (mut product, mut i) = ([[0.0; 3]; 3], 0);
        while i < 9 {
            let (row, column) = (i / 3, i % 3);
            let [x, y, z] = turn_a[row];
            let [u, v, w] = turn_b[column];
            product[row][column] = (rho * line + mass) * a.shift[row] * b.shift[column]
                + 0.5 * inertia * (x * u + y * v + z * w);
            i += 1;
        }
        if a.is_twist() && b.is_twist() {
            product[1][1] += yy * line;
            product[2][2] += zz * line;
        }
        product
    }
}

/// A shape with its directions.
#[derive(Clone, Copy)]
struct Field {
    line: Option<Line>,
    shift: Row,
    turn: Row,
    omega: f64,
}

impl Field {
    const NONE: Self = Self { line: None, shift: [0.0; 3], turn: [0.0; 3], omega: 0.0 };

    const fn is_twist(&self) -> bool {
        self.turn[0] != 0.0
    }

    const fn value(&self, u: f64) -> f64 {
        match self.line {
            Some(line) => line.at(u)[0],
            None => 0.0,
        }
    }
}

const fn cross_matrix([x, y, z]: Row) -> Rows {
    [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
}
