//! What can be wrong with a robot's description.

use core::fmt;

/// A robot's description that cannot be used, with the body concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ModelError {
    /// The body's name (the robot's, where the whole is concerned).
    pub body: &'static str,
    /// What is wrong with it.
    pub problem: Problem,
}

/// What is wrong with a body's description.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Problem {
    /// The parent is not listed before the body.
    Parent,
    /// The joint's axis is zero or not finite.
    Axis,
    /// The mass is negative or not finite.
    Mass,
    /// A length, an angle or an inertia is not finite, or so large that what follows from it is not.
    NotFinite,
    /// A limit is NaN, the lower one exceeds the upper, or that of speed or torque is negative.
    Limits,
    /// There is inertia about the centre of mass without mass.
    Massless,
    /// The robot has no body of this number.
    NoBody(usize),
    /// The joints do not add up to Q position and V velocity coordinates.
    Coordinates,
    /// The principal moments break the triangle inequality by this much, relative to the largest.
    Triangle(f64),
    /// The inertia matrix is not symmetric by this much, relative to its largest entry.
    Asymmetric(f64),
}

impl Problem {
    const fn text(self) -> &'static str {
        match self {
            Self::Parent => "its parent is not listed before it",
            Self::Axis => "its joint axis is zero or not finite",
            Self::Mass => "its mass is negative or not finite",
            Self::NotFinite => "a length, an angle or an inertia is not finite",
            Self::Limits => {
                "a limit is not a number, lower exceeds upper, or a speed or torque limit is negative"
            }
            Self::Massless => "it has inertia but no mass",
            Self::NoBody(_) => "the robot has no body of this number",
            Self::Coordinates => {
                "the joints do not add up to Q position and V velocity coordinates"
            }
            Self::Triangle(_) => "its moments of inertia break the triangle inequality",
            Self::Asymmetric(_) => "its inertia matrix is not symmetric",
        }
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "body `{}`: {}", self.body, self.problem.text())?;
        if let Problem::NoBody(number) = self.problem {
            write!(out, ": {number}")?;
        }
        if let Problem::Triangle(excess) | Problem::Asymmetric(excess) = self.problem {
            write!(out, " by {excess:.2e} of the largest")?;
        }
        Ok(())
    }
}

impl core::error::Error for ModelError {}

impl ModelError {
    /// Panics with the same words as `Display`, in a way that a `const` evaluation can print.
    pub(super) const fn panic(self) -> ! {
        panic(&["body `", self.body, "`: ", self.problem.text()])
    }
}

/// Panics with these parts of a sentence, of 160 bytes or less, in a way that a `const` evaluation can print.
pub(super) const fn panic(parts: &[&str]) -> ! {
    let (mut text, mut at, mut part) = ([b' '; 160], 0, 0);
    while part < parts.len() {
        let (bytes, mut i) = (parts[part].as_bytes(), 0);
        while i < bytes.len() && at < text.len() {
            text[at] = bytes[i];
            at += 1;
            i += 1;
        }
        part += 1;
    }
    match core::str::from_utf8(text.split_at(at).0) {
        Ok(text) => panic!("{}", text),
        // A letter of several bytes was cut.
        Err(_) => panic!("{}", parts[parts.len() - 1]),
    }
}
