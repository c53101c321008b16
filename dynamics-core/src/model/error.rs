//! The errors of a robot's description.

use core::fmt;

/// A robot's description that cannot be used, with the body concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ModelError {
    /// The body's name (the robot's, where the whole is concerned).
    pub body: &'static str,
    /// The problem.
    pub problem: Problem,
}

/// The problem of a body's description.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Problem {
    /// The parent is not listed before the body.
    Parent,
    /// The joint's axis is zero or not finite.
    Axis,
    /// The axes of a universal joint are not at right angles.
    RightAngles,
    /// The pitch of a helical joint is not finite.
    Pitch,
    /// Roll, pitch or yaw exceeds a whole turn, 2π rad: usually an angle in degrees.
    Angle,
    /// The mass, kg, is negative or not finite.
    Mass(f64),
    /// A length, an angle or an inertia is not finite, or so large that a result is not finite.
    NotFinite,
    /// A limit is NaN, the lower one exceeds the upper, or that of speed or torque is negative.
    Limits,
    /// The placement of its joint is not that of the description, which the engine has as
    /// constants.
    Placement,
    /// The robot has no body of this number.
    NoBody(usize),
    /// The joints do not add up to the model's Q position and V velocity coordinates.
    Coordinates {
        /// The numbers of position and velocity coordinates of the joints, which Q and V must
        /// equal.
        expected: [usize; 2],
        /// The model's Q and V.
        given: [usize; 2],
    },
    /// Another number of the robot's bodies moves than the merged model has.
    Bodies {
        /// The number of bodies on joints that move.
        expected: usize,
        /// The number of bodies of the merged model.
        given: usize,
    },
    /// The body has inertia but no mass.
    Massless,
    /// A body before it has the same name, by [`super::Model::check`].
    Name,
    /// A principal moment of the inertia about the centre of mass, kg·m², is negative.
    NegativeMoment(f64),
    /// The same, kg·m², of six numbers that are possible in the order xx, yy, zz, xy, xz, yz.
    InertiaOrder(f64),
    /// The principal moments violate the triangle inequality by this amount, relative to the
    /// largest.
    Triangle(f64),
    /// The inertia matrix is asymmetric by this amount, relative to its largest entry.
    Asymmetric(f64),
}

impl Problem {
    /// The number of an impossible inertia, with the words before and after it.
    pub(crate) const fn amount(self) -> Option<(&'static str, f64, &'static str)> {
        match self {
            Self::NegativeMoment(moment) | Self::InertiaOrder(moment) => {
                Some((": ", moment, " kg·m²"))
            }
            Self::Triangle(excess) | Self::Asymmetric(excess) => {
                Some((" by ", excess, " of the largest"))
            }
            _ => None,
        }
    }

    pub(crate) const fn text(self) -> &'static str {
        match self {
            Self::Parent => "its parent is not listed before it",
            Self::Axis => "its joint axis is zero or not finite",
            Self::Mass(_) => "its mass is negative or not finite",
            Self::NotFinite => "a length, an angle or an inertia is not finite",
            Self::Limits => {
                "a limit is not a number, lower exceeds upper, or a speed or torque limit is \
                 negative"
            }
            Self::Placement => {
                "the placement of its joint differs from the description, whose geometry is \
                 constant in the engine"
            }
            Self::NoBody(_) => "the robot has no body of this number",
            Self::RightAngles => "the two axes of its joint are not at right angles",
            Self::Pitch => "the pitch of its joint is not finite",
            Self::Angle => "its roll, pitch or yaw is beyond 2 pi: angles are in rad",
            Self::Coordinates { .. } => "its joints have other numbers of coordinates",
            Self::Bodies { .. } => "another number of its bodies moves",
            Self::Massless => "it has inertia but no mass",
            Self::Name => "a body before it has the same name",
            Self::NegativeMoment(_) => "a principal moment of its inertia is negative",
            Self::InertiaOrder(_) => {
                "in the order xx, xy, xz, yy, yz, zz its inertia has a negative principal moment, \
                 in the order xx, yy, zz, xy, xz, yz it has none"
            }
            Self::Triangle(_) => "its moments of inertia break the triangle inequality",
            Self::Asymmetric(_) => "its inertia matrix is not symmetric",
        }
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Problem::Coordinates { expected, given } = self.problem {
            let ([q, v], [given_q, given_v]) = (expected, given);
            let name = self.body;
            return write!(
                out,
                "robot `{name}`: its joints make Q = {q} and V = {v}, not Q = {given_q} and V = \
                 {given_v}"
            );
        }
        if let Problem::Bodies { expected, given } = self.problem {
            let name = self.body;
            return write!(out, "robot `{name}`: {expected} of its bodies move, not M = {given}");
        }
        write!(out, "body `{}`: {}", self.body, self.problem.text())?;
        if let Problem::Mass(mass) = self.problem {
            write!(out, ": {mass} kg")?;
        }
        if let Problem::NoBody(number) = self.problem {
            write!(out, ": {number}")?;
        }
        if let Some((before, amount, unit)) = self.problem.amount() {
            write!(out, "{before}{amount:.2e}{unit}")?;
        }
        Ok(())
    }
}

impl core::error::Error for ModelError {}

impl ModelError {
    /// Panics with the text of `Display`, in a form that a `const` evaluation can print.
    #[track_caller]
    pub(super) const fn panic(self) -> ! {
        let text = match self.problem {
            Problem::Coordinates { expected, given } => Text::EMPTY
                .with("robot `")
                .with(self.body)
                .with("`: its joints make Q = ")
                .number(expected[0])
                .with(" and V = ")
                .number(expected[1])
                .with(", not Q = ")
                .number(given[0])
                .with(" and V = ")
                .number(given[1]),
            Problem::Bodies { expected, given } => Text::EMPTY
                .with("robot `")
                .with(self.body)
                .with("`: ")
                .number(expected)
                .with(" of its bodies move, not M = ")
                .number(given),
            problem => {
                let text = Text::EMPTY.with("body `").with(self.body).with("`: ");
                let text = text.with(problem.text());
                match problem.amount() {
                    Some((before, amount, unit)) => text.with(before).scientific(amount).with(unit),
                    None => text,
                }
            }
        };
        text.panic()
    }
}

/// Panics with these parts of a sentence, in a form that a `const` evaluation can print.
#[track_caller]
pub(super) const fn panic(parts: &[&str]) -> ! {
    let (mut text, mut part) = (Text::EMPTY, 0);
    while part < parts.len() {
        text = text.with(parts[part]);
        part += 1;
    }
    text.panic()
}

/// The length of a message: the names of a humanoid's bodies.
const LONGEST: usize = 1024;

/// A message that is put together while compiling, where there is no `format!`.
pub(crate) struct Text {
    bytes: [u8; LONGEST],
    length: usize,
}

impl Text {
    pub(crate) const EMPTY: Self = Self { bytes: [b' '; LONGEST], length: 0 };

    pub(crate) const fn with(mut self, text: &str) -> Self {
        let (bytes, mut i) = (text.as_bytes(), 0);
        while i < bytes.len() && self.length < self.bytes.len() {
            self.bytes[self.length] = bytes[i];
            self.length += 1;
            i += 1;
        }
        self
    }

    /// Whether these words still have their place, with some more.
    pub(super) const fn has_room_for(&self, text: &str) -> bool {
        self.length + text.len() + 20 < LONGEST
    }

    pub(crate) const fn number(self, x: usize) -> Self {
        let digits = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
        let text = if x > 9 { self.number(x / 10) } else { self };
        text.with(digits[x % 10])
    }

    /// A number with three digits, as `{:.2e}` writes it.
    const fn scientific(self, x: f64) -> Self {
        let (mut size, mut power) = (x.abs(), 0_usize);
        if !size.is_finite() {
            return self.with("infinite or no number");
        }
        let is_small = size > 0.0 && size < 1.0;
        while size >= 10.0 || (size > 0.0 && size < 1.0) {
            size *= if is_small { 10.0 } else { 0.1 };
            power += 1;
        }
        let mut digits = (100.0 * size + 0.5) as usize;
        if digits == 1000 {
            digits = 100;
            power = if is_small { power - 1 } else { power + 1 };
        }
        let text = self.with(if x < 0.0 { "-" } else { "" });
        let text = text.number(digits / 100).with(".");
        let text = text.number(digits / 10 % 10).number(digits % 10);
        text.with(if is_small { "e-" } else { "e" }).number(power)
    }

    #[track_caller]
    pub(crate) const fn panic(self) -> ! {
        match core::str::from_utf8(self.bytes.split_at(self.length).0) {
            Ok(text) => panic!("{}", text),
            Err(_) => panic!("a letter of the message was cut"),
        }
    }
}
