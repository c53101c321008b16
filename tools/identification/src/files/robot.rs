//! The robot of a description, and its parameters.

use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};

use dynamics_core::algorithms::inertial_parameters;
use dynamics_core::glam::{DMat3, DQuat, DVec3, EulerRot};
use dynamics_core::model::ArmModel;
#[cfg(feature = "files")]
use robot_import::import::{self, Imported, Options};
use robot_import::model;
use robot_import::number::Attitude;
use robot_import::tree::Tree;
#[cfg(not(feature = "files"))]
use robot_import::{loops, selection::Selection, source, tree::Numbers};

use crate::OF_JOINT;

use super::error::{Error, Result};

/// The parameters of a joint in the order of [`crate::OfJoint`].
pub type OfJoint = [f64; OF_JOINT];

/// A model, the ten parameters of each body, and those of each joint.
pub type Described<const V: usize> = (ArmModel<f64, V>, [[f64; 10]; V], [OfJoint; V]);

/// A part of a description; the program's importer, which a wheel has not, tells more of it.
#[cfg(not(feature = "files"))]
#[derive(Debug)]
pub struct Imported {
    pub name: String,
    pub tree: Tree,
}

/// A robot whose joints have one coordinate each.
#[derive(Debug)]
pub struct Robot {
    pub path: PathBuf,
    pub imported: Imported,
    /// The direction of gravity in the frame of the base: a unit vector.
    pub gravity: [f64; 3],
}

/// The direction of gravity in the frame of an upright base.
pub const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

impl Robot {
    /// Imports a description under its own or another name, without a peer: the import itself has
    /// had one.
    ///
    /// # Errors
    /// [`Error::Robot`], and [`Error::Unsuitable`] if a joint has not one coordinate.
    #[cfg(feature = "files")]
    pub fn read(path: &Path, name: Option<&str>, options: &Options) -> Result<Self> {
        let args = import::Args {
            file: path.to_owned(),
            name: name.map(str::to_owned),
            options: options.clone(),
            ..import::Args::default()
        };
        let imported = import::import(&args, "this day")
            .map_err(|source| Error::Robot { path: path.to_owned(), source: source.into() })?;
        let has_loops = !imported.report.loops.is_empty();
        Self::single(path, imported, has_loops)
    }

    /// The part of a description with these joints, or all.
    ///
    /// # Errors
    /// [`Error::Robot`], and [`Error::Unsuitable`] if a joint has not one coordinate.
    #[cfg(not(feature = "files"))]
    pub fn read(path: &Path, joints: Vec<String>) -> Result<Self> {
        let selection = Selection { joints, ..Selection::default() };
        let read = source::read(path).and_then(|robot| {
            let tree = Tree::of(&robot, &selection.of(&robot)?, Numbers::Exact)?;
            let has_loops = !loops::closed(&robot, &tree).0.is_empty();
            Ok((Imported { name: robot.name, tree }, has_loops))
        });
        let (imported, has_loops) =
            read.map_err(|source| Error::Robot { path: path.to_owned(), source: source.into() })?;
        Self::single(path, imported, has_loops)
    }

    fn single(path: &Path, imported: Imported, has_loops: bool) -> Result<Self> {
        let unsuitable =
            |reason: &str| Error::Unsuitable { path: path.to_owned(), reason: reason.to_owned() };
        if !imported.tree.is_single() {
            return Err(unsuitable(
                "parameters are identified of robots whose joints have one coordinate each, on a \
                 base that stands still",
            ));
        }
        if has_loops {
            return Err(unsuitable(
                "parameters are identified of trees; this robot has loops: --without leaves out \
                 the link that closes one",
            ));
        }
        Ok(Self { path: path.to_owned(), imported, gravity: DOWN })
    }

    pub fn joints(&self) -> Vec<String> {
        self.imported.tree.bodies.iter().map(|body| body.joint.clone()).collect()
    }

    pub fn bodies(&self) -> Vec<String> {
        self.imported.tree.bodies.iter().map(|body| body.name.clone()).collect()
    }

    /// Its model on a base that stands so that gravity has this direction, the parameters of its
    /// bodies, and those of its joints.
    ///
    /// # Errors
    /// [`Error::Robot`].
    pub fn model<const V: usize>(&self, gravity: [f64; 3]) -> Result<Described<V>> {
        let arm: ArmModel<f64, V> = model::arm(&turned(&self.imported.tree, gravity))
            .map_err(|source| Error::Robot { path: self.path.clone(), source: source.into() })?;
        let joints = std::array::from_fn(|j| {
            let body = &self.imported.tree.bodies[j];
            [body.damping, body.friction, body.armature, 0.0, 0.0, 0.0]
        });
        Ok((arm, inertial_parameters(&arm, &()), joints))
    }
}

/// The tree on a base that is turned so that this direction of its frame points down.
fn turned(tree: &Tree, gravity: [f64; 3]) -> Tree {
    let mut tree = tree.clone();
    if gravity == DOWN {
        return tree;
    }
    let turn = DQuat::from_rotation_arc(DVec3::from_array(gravity), DVec3::from_array(DOWN));
    let turn = DMat3::from_quat(turn);
    for body in tree.bodies.iter_mut().filter(|body| body.parent.is_none()) {
        let [roll, pitch, yaw] = match body.attitude {
            Attitude::QuarterTurns(turns) => turns.map(|n| f64::from(n) * FRAC_PI_2),
            Attitude::Rpy(angles) => angles,
        };
        let own = DMat3::from_euler(EulerRot::ZYX, yaw, pitch, roll);
        body.attitude = Attitude::of(&(turn * own));
        body.xyz = (turn * DVec3::from_array(body.xyz)).to_array();
    }
    tree
}
