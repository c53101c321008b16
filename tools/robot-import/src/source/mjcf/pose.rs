//! Placements: a position and an orientation in one of five forms, with exact values in place of
//! roundings.

use dynamics_core::glam::{DMat3, DQuat, DVec3};

use super::compiler::Compiler;
use super::defaults::{ORIENTATIONS, View};
use super::element::Element;
use crate::description::{Pose, Snap};
use crate::error::Result;
use crate::snap;

/// The difference from quarter turns of a rotation that an exporter has computed from 1.5708 or
/// 3.1416 is 3.7e-6 or 7.3e-6 rad, whatever the last digits of its numbers are:
/// `quat="0.707105 0.707108 0 0"`.
const CONVERTED: f64 = 1e-5;

/// A placement as the file has it, and with exact values in place of roundings.
#[derive(Clone)]
pub struct Placement {
    /// As the file has it.
    pub pose: Pose,
    /// The pose with exact values.
    pub exact: Pose,
    /// The differences of the exact values.
    pub snapped: Vec<Snap>,
}

impl Placement {
    /// The placement without a displacement.
    pub const IDENTITY: Self =
        Self { pose: Pose::IDENTITY, exact: Pose::IDENTITY, snapped: Vec::new() };

    /// The placement of `inner`, which is given in this one.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            pose: self.pose.then(&inner.pose),
            exact: self.exact.then(&inner.exact),
            snapped: [self.snapped.as_slice(), inner.snapped.as_slice()].concat(),
        }
    }

    /// The placement of `inner` without the list of differences, which grows along the tree.
    pub fn poses(&self, inner: &Self) -> Self {
        Self {
            pose: self.pose.then(&inner.pose),
            exact: self.exact.then(&inner.exact),
            snapped: Vec::new(),
        }
    }

    /// The inverse of the placement.
    pub fn inverse(&self) -> Self {
        Self { pose: self.pose.inverse(), exact: self.exact.inverse(), snapped: Vec::new() }
    }

    /// Attributes `pos` and those of the orientation.
    ///
    /// # Errors
    /// Numbers that are none, or two orientations.
    pub fn read(view: View<'_>, compiler: &Compiler) -> Result<Self> {
        let mut placement = Self::position(view, "pos")?;
        placement.rotate(orientation(view, compiler)?);
        Ok(placement)
    }

    /// A translation by an attribute.
    ///
    /// # Errors
    /// Numbers that are none.
    pub fn position(view: View<'_>, attribute: &str) -> Result<Self> {
        let position = view.numbers::<3>(attribute)?.unwrap_or_default();
        let mut snapped = Vec::new();
        let mut exact = position;
        for (x, name) in exact.iter_mut().zip(["x", "y", "z"]) {
            if *x != 0.0 && x.abs() < snap::NO_LENGTH {
                snapped.push(Snap {
                    attribute: name.to_owned(),
                    text: format!("{x}"),
                    exact: "0".to_owned(),
                    difference: *x,
                });
                *x = 0.0;
            }
        }
        Ok(Self {
            pose: Pose::translation(DVec3::from_array(position)),
            exact: Pose::translation(DVec3::from_array(exact)),
            snapped,
        })
    }

    fn rotate(&mut self, turn: Turn) {
        self.pose.rotation = turn.given;
        self.exact.rotation = turn.exact;
        self.snapped.extend(turn.snapped);
    }

    /// A displacement that no text states, such as one by a reference position; exact where it is
    /// right angles.
    pub fn computed(pose: Pose) -> Self {
        let exact = snap::permutation(&pose.rotation, 0.0);
        let exact = exact.map_or(pose.rotation, |(exact, _)| exact);
        Self { pose, exact: Pose { position: pose.position, rotation: exact }, snapped: Vec::new() }
    }
}

/// A rotation about an axis.
struct Turn {
    given: DMat3,
    exact: DMat3,
    snapped: Vec<Snap>,
}

fn orientation(view: View<'_>, compiler: &Compiler) -> Result<Turn> {
    let stated = |element: &Element| ORIENTATIONS.iter().any(|name| element.get(name).is_some());
    let Some(element) = view.levels().find(|element| stated(element)) else {
        return Ok(Turn { given: DMat3::IDENTITY, exact: DMat3::IDENTITY, snapped: Vec::new() });
    };
    let mut all = ORIENTATIONS.iter().filter_map(|name| Some((*name, element.get(name)?)));
    let (name, text) = all.next().unwrap_or_default();
    if let Some((other, _)) = all.next() {
        return Err(element.value(format!("`{name}` and `{other}` exclude each other")));
    }
    let numbers = |count| view.parsed(name, text, [count, count]);
    if name == "euler" {
        return Ok(euler(compiler, text, &numbers(3)?));
    }
    let direction = |numbers: &[f64]| {
        let vector = DVec3::from_slice(numbers);
        let length = vector.length();
        match (1e-10..1e10).contains(&length) {
            true => Ok(vector / length),
            false => Err(element.value(format!("`{name}=\"{text}\"` has no direction"))),
        }
    };
    // By how much an entry of the matrix changes with the last digits of the numbers.
    let mut digits = text.split_ascii_whitespace().map(snap::resolution).fold(0.0, f64::max);
    let given = match name {
        "quat" => {
            let [w, x, y, z] = <[f64; 4]>::try_from(numbers(4)?).unwrap_or_default();
            let given = DQuat::from_xyzw(x, y, z, w);
            let length = given.length();
            if !(1e-10..1e10).contains(&length) {
                return Err(element.value(format!("`{name}=\"{text}\"` is no rotation")));
            }
            digits *= match snap::states_a_small_entry(&[w, x, y, z].map(|x| x / length)) {
                true => 0.0,
                false => 2.0 / length,
            };
            DMat3::from_quat(given / length)
        }
        "axisangle" => {
            let numbers = numbers(4)?;
            let axis = direction(&numbers[..3])?;
            let angle = text.split_ascii_whitespace().last().unwrap_or_default();
            let small = snap::states_a_small_entry(axis.as_ref())
                || (numbers[3] * compiler.angle).abs() < std::f64::consts::FRAC_PI_4;
            digits = match small {
                true => 0.0,
                false => rounding(angle, compiler),
            };
            DMat3::from_axis_angle(axis, numbers[3] * compiler.angle)
        }
        "xyaxes" => {
            // Directions along axes are of zeros and ones, which have no digits to lose.
            digits = 0.0;
            let numbers = numbers(6)?;
            let x = direction(&numbers[..3])?;
            let y = DVec3::from_slice(&numbers[3..]);
            let y = direction((y - x * x.dot(y)).as_ref())?;
            DMat3::from_cols(x, y, x.cross(y))
        }
        _ => {
            digits = 0.0;
            to_axis(direction(&numbers(3)?)?)
        }
    };
    let mut turn = Turn { given, exact: given, snapped: Vec::new() };
    if let Some((exact, difference)) = snap::permutation(&given, digits.max(CONVERTED)) {
        turn.exact = exact;
        // Less than this is the rounding of the computation here, not of the text.
        if difference > 1e-15 {
            turn.snapped.push(Snap {
                attribute: name.to_owned(),
                text: text.to_owned(),
                exact: "quarter turns".to_owned(),
                difference,
            });
        }
    }
    Ok(turn)
}

/// The unit of an angle's last digit; 0 in degrees, in which a right angle needs no rounding: 90.1
/// is none of 90.
fn rounding(text: &str, compiler: &Compiler) -> f64 {
    match compiler.angle == 1.0 {
        true => snap::resolution(text),
        false => 0.0,
    }
}

/// The least rotation that turns z into this direction; half a turn about x if it is opposite.
pub fn to_axis(direction: DVec3) -> DMat3 {
    let normal = DVec3::Z.cross(direction);
    let sine = normal.length();
    let axis = match sine < 1e-10 {
        true => DVec3::X,
        false => normal / sine,
    };
    DMat3::from_axis_angle(axis, sine.atan2(direction.z))
}

/// Turns about the axes of the sequence: moving axes are small letters, fixed ones capitals.
fn euler(compiler: &Compiler, text: &str, angles: &[f64]) -> Turn {
    let mut turn = Turn { given: DMat3::IDENTITY, exact: DMat3::IDENTITY, snapped: Vec::new() };
    // 90 degrees exactly: a text in degrees is no rounding then.
    let quarter = match compiler.angle == 1.0 {
        true => std::f64::consts::FRAC_PI_2,
        false => 90.0,
    };
    let each = text.split_ascii_whitespace().zip(angles).zip(compiler.eulerseq);
    for ((word, angle), letter) in each {
        let radians = angle * compiler.angle;
        let mut exact = radians.sin_cos();
        if let Some(turns) = snap::quarter_turns(radians, rounding(word, compiler)) {
            exact = snap::sin_cos(turns);
            let difference = (angle - f64::from(turns) * quarter) * compiler.angle;
            if difference != 0.0 {
                turn.snapped.push(Snap {
                    attribute: format!("euler {letter}"),
                    text: word.to_owned(),
                    exact: snap::words(turns).to_owned(),
                    difference,
                });
            }
        }
        let about = |sin_cos| {
            let none = (0.0, 1.0);
            snap::rpy(match letter.to_ascii_lowercase() {
                'x' => [sin_cos, none, none],
                'y' => [none, sin_cos, none],
                _ => [none, none, sin_cos],
            })
        };
        let (given, exact) = (about(radians.sin_cos()), about(exact));
        if letter.is_ascii_lowercase() {
            turn.given *= given;
            turn.exact *= exact;
        } else {
            turn.given = given * turn.given;
            turn.exact = exact * turn.exact;
        }
    }
    turn
}
