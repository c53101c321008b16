//! A robot as its file describes it: links, joints and loops, in SI units, before anything is
//! merged.

use dynamics_core::glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::error::{ImportError, Problem};
use crate::limits::{MOST_COMPARED, MOST_SHOWN};

/// A format of descriptions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// The Unified Robot Description Format, versions 1.0 to 1.2.
    Urdf,
    /// MuJoCo's format.
    Mjcf,
}

/// A robot as its file describes it.
#[derive(Clone, Debug)]
pub struct Description {
    /// The robot's name.
    pub name: String,
    /// The file's format.
    pub format: Format,
    /// The licence, where the file states one.
    pub licence: Option<String>,
    /// The links, in the order of the file.
    pub links: Vec<Link>,
    /// The joints, in the order of the file; each link but one is the child of one of them.
    pub joints: Vec<Joint>,
    /// Joints that close loops.
    pub loops: Vec<Loop>,
    /// Notes on what the import leaves out, and on what it takes other than XML does, a sentence
    /// each.
    pub notes: Vec<String>,
    /// The files that it includes.
    pub files: Vec<std::path::PathBuf>,
}

/// A link.
#[derive(Clone, Debug)]
pub struct Link {
    /// The name of the link.
    pub name: String,
    /// The line of the file.
    pub line: u32,
    /// Its inertia; none is no mass.
    pub inertial: Option<Inertial>,
    /// The numbers of the frame of its inertia that are roundings, with what they are rounded from.
    pub snapped: Vec<Snap>,
    /// Whether its mass is that of a mesh, which is not read: the link must not move.
    pub of_mesh: bool,
}

/// Mass, centre of mass and rotational inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// Mass, kg.
    pub mass: f64,
    /// The frame of the inertia in the link's: its origin is the centre of mass.
    pub frame: Pose,
    /// `frame` with exact values in place of roundings.
    pub exact: Pose,
    /// xx, xy, xz, yy, yz, zz about the centre of mass, along the axes of `frame`, kg·m².
    pub inertia: [f64; 6],
}

/// A frame's position and attitude in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The place of the frame's origin, m.
    pub position: DVec3,
    /// The axes of the frame, as columns.
    pub rotation: DMat3,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// The name of the joint.
    pub name: String,
    /// The line of the file.
    pub line: u32,
    /// The kind of the joint.
    pub kind: Kind,
    /// The index of the parent link.
    pub parent: usize,
    /// The index of the child link.
    pub child: usize,
    /// The child's frame in the parent's at q = 0.
    pub origin: Pose,
    /// The numbers of the file's origin that are roundings, with what they are rounded from.
    pub snapped: Vec<Snap>,
    /// `origin` with the exact values in place of the roundings.
    pub exact: Pose,
    /// Axis in the child's frame, as the file gives it.
    pub axis: DVec3,
    /// Limits, where the file states them.
    pub limits: Limits,
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub damping: f64,
    /// Coulomb friction, N·m or N.
    pub friction: f64,
    /// Rotor inertia reflected to the joint, kg·m² or kg.
    pub armature: f64,
    /// Stiffness (N·m/rad or N/m) and rest position (rad or m) of a spring; no stiffness is none.
    pub spring: [f64; 2],
    /// Whether the file has a motor on it; of URDF, whether it states the torque of one.
    pub driven: bool,
    /// Position = multiplier · (position of another joint) + offset.
    pub mimic: Option<Mimic>,
}

/// A kind of joint, in URDF's words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    /// The joint does not move.
    Fixed,
    /// The joint rotates within limits.
    Revolute,
    /// The joint rotates without end.
    Continuous,
    /// The joint slides.
    Prismatic,
    /// The joint is a ball joint.
    Spherical,
    /// Motion in the plane of x and y.
    Planar,
    /// The body moves freely.
    Free,
}

/// Limits of a joint; `None` where the file states none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Least and greatest position, rad or m.
    pub position: Option<[f64; 2]>,
    /// Greatest speed, rad/s or m/s.
    pub velocity: Option<f64>,
    /// Greatest torque or force, N·m or N.
    pub effort: Option<f64>,
}

/// A joint that follows another.
#[derive(Clone, Debug, PartialEq)]
pub struct Mimic {
    /// The name of the joint that it follows.
    pub joint: String,
    /// The ratio of follower and leader.
    pub multiplier: f64,
    /// The offset, rad or m.
    pub offset: f64,
}

/// A number of the file that is a rounding, and the value it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Snap {
    /// The attribute, such as `rpy`.
    pub attribute: String,
    /// The file's text.
    pub text: String,
    /// The exact value, in words such as `π/2`.
    pub exact: String,
    /// The difference, rad or m.
    pub difference: f64,
}

/// A constraint that closes a loop between two links.
#[derive(Clone, Debug)]
pub struct Loop {
    /// The name of the loop.
    pub name: String,
    /// The line of the file.
    pub line: u32,
    /// `Spherical` for a common point, `Fixed` for a common frame, or the joint that closes it.
    pub kind: Kind,
    /// The two links that it connects.
    pub links: [usize; 2],
    /// The frames of the closing joint in the two links.
    pub frames: [Pose; 2],
    /// The axis of the closing joint in its frame.
    pub axis: DVec3,
}

impl Pose {
    /// The pose without a displacement.
    pub const IDENTITY: Self = Self { position: DVec3::ZERO, rotation: DMat3::IDENTITY };

    /// Makes a pose that only translates.
    pub const fn translation(position: DVec3) -> Self {
        Self { position, rotation: DMat3::IDENTITY }
    }

    /// The pose of `inner`, which is given in this frame, in the frame that this one is given in.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            position: self.position + self.rotation * inner.position,
            rotation: self.rotation * inner.rotation,
        }
    }

    /// The inverse of the pose.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { position: -(rotation * self.position), rotation }
    }
}

impl Kind {
    /// The numbers of coordinates that it has in q and in q̇.
    pub const fn coordinates(self) -> [usize; 2] {
        match self {
            Self::Fixed => [0, 0],
            Self::Revolute | Self::Continuous | Self::Prismatic => [1, 1],
            Self::Planar => [3, 3],
            Self::Spherical => [4, 3],
            Self::Free => [7, 6],
        }
    }

    /// Whether it has an axis.
    pub const fn has_axis(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous | Self::Prismatic)
    }
}

impl Description {
    /// The index of the link of this name.
    ///
    /// # Errors
    /// [`Problem::NoSuch`], with the most similar name.
    pub fn link(&self, name: &str) -> Result<usize, ImportError> {
        index_of(name, "link", self.links.iter().map(|link| link.name.as_str()))
    }

    /// The index of the joint of this name.
    ///
    /// # Errors
    /// [`Problem::NoSuch`], with the most similar name.
    pub fn joint(&self, name: &str) -> Result<usize, ImportError> {
        let names = self.joints.iter().map(|joint| joint.name.as_str());
        index_of(name, "joint", names)
    }
}

/// The index of a name, or an error with the most similar one.
pub(crate) fn index_of<'a>(
    name: &str,
    what: &'static str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<usize, ImportError> {
    if let Some(i) = names.clone().position(|other| other == name) {
        return Ok(i);
    }
    let suggestion = match most_similar(name, names) {
        Some(other) => format!("; did you mean `{}`?", shortened(other)),
        None => String::new(),
    };
    let name = shortened(name);
    Err(Problem::NoSuch { what, name, suggestion }.into())
}

/// The name that differs by the fewest letters, if that is at most a third of them; otherwise the
/// one with the longest common beginning, if that is more than one letter.
pub fn most_similar<'a>(
    name: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Option<&'a str> {
    let most = name.chars().take(MOST_COMPARED).count() / 3;
    let nearest = names.clone().map(|other| (edits(name, other), other));
    let nearest = nearest.min_by_key(|(edits, _)| *edits);
    if let Some((_, other)) = nearest.filter(|(edits, _)| *edits <= most) {
        return Some(other);
    }
    let shared = |other: &str| {
        let same = std::iter::zip(other.chars(), name.chars());
        same.take_while(|(a, b)| a.eq_ignore_ascii_case(b)).count()
    };
    let like = names.max_by_key(|other| shared(other));
    like.filter(|other| shared(other) > 1)
}

/// By how many letters that are inserted, left out, replaced or exchanged with the next one two
/// names differ.
fn edits(a: &str, b: &str) -> usize {
    let letters = |text: &str| -> Vec<char> {
        let lower = text.chars().map(|letter| letter.to_ascii_lowercase());
        lower.take(MOST_COMPARED).collect()
    };
    let (a, b) = (letters(a), letters(b));
    let mut rows = vec![(0..=b.len()).collect::<Vec<usize>>()];
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let replaced = rows[i][j] + usize::from(a[i] != b[j]);
            let mut least = replaced.min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

/// A text of a file for a message: at most [`MOST_SHOWN`] characters.
pub(crate) fn shortened(text: &str) -> String {
    cut(text, MOST_SHOWN)
}

/// The beginning of a text that is longer than this many characters.
pub(crate) fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
