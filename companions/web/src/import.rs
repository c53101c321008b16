//! A robot from a URDF or MJCF that was dropped on the page: hostile until it is read.

use std::path::Path;

use robot_import::description::Kind;
use robot_import::error::ImportError;
use robot_import::inertia::MassProperties;
use robot_import::model::arm;
use robot_import::number::Attitude;
use robot_import::selection::Selection;
use robot_import::tree::{Numbers, Tree};
use robot_import::{estimate, source, write};

use crate::machine::{Friction, Machine, Sized};

/// The robot that a file was imported as.
pub struct Imported {
    pub machine: Box<dyn Machine>,
    pub name: String,
    pub type_name: String,
    /// The Rust file of the robot.
    pub source: String,
    /// The importer's estimate of inverse dynamics, where it has one: cycles and bytes.
    pub cycles: Option<u64>,
    pub flash: Option<u64>,
    /// The links that are part of a body, or of the base (none): origin and axes of each in its
    /// frame, as in `Computed::poses`.
    pub links: Vec<(String, Option<usize>, [f64; 12])>,
}

/// Speed at which Coulomb friction of a file is full, rad/s: that of the scenes.
const WIDTH: f64 = 0.05;

/// The robot that a text describes.
///
/// # Errors
/// The importer's, with line and element; more joints than the page has sizes for.
pub fn import(text: &str, date: String) -> Result<Imported, String> {
    // The page has no options of a command line.
    let words = |error: ImportError| {
        let text = error.to_string();
        text.split("`--").next().unwrap_or_default().trim_end_matches([' ', ':', ';']).to_owned()
    };
    let robot = source::parse(text, Path::new("")).map_err(words)?;
    let selected = Selection::default().of(&robot).map_err(words)?;
    let tree = Tree::of(&robot, &selected, Numbers::Exact).map_err(words)?;
    let machine = match tree.bodies.len() {
        0..=8 => sized::<8>(&tree),
        9..=16 => sized::<16>(&tree),
        17..=40 => sized::<40>(&tree),
        more => Err(format!("{more} joints: the page takes at most 40")),
    }?;
    let name = robot.name.clone();
    let type_name = write::type_name(&name);
    let origin = write::Origin {
        file: "a file dropped on the page".to_owned(),
        licence: robot.licence.clone(),
        date,
        notes: Vec::new(),
    };
    let links = robot.links.iter().zip(&tree.links).filter_map(|(link, place)| {
        let (body, pose) = (*place)?;
        let (p, axes) = (pose.position.to_array(), pose.rotation.to_cols_array());
        let pose = std::array::from_fn(|i| if i < 3 { p[i] } else { axes[i - 3] });
        Some((link.name.clone(), body, pose))
    });
    Ok(Imported {
        machine,
        links: links.collect(),
        source: write::source(&tree, &name, &type_name, &origin),
        cycles: estimate::cycles(&tree),
        flash: estimate::flash(&tree),
        name,
        type_name,
    })
}

/// The tree behind as many massless bodies on the base as fill up N.
fn sized<const N: usize>(tree: &Tree) -> Result<Box<dyn Machine>, String> {
    let fillers = N - tree.bodies.len();
    let Some(first) = tree.bodies.first() else {
        return Err("no joint moves".to_owned());
    };
    let mut filler = first.clone();
    filler.parent = None;
    filler.kind = Kind::Revolute;
    filler.axis = [0.0, 0.0, 1.0];
    filler.xyz = [0.0; 3];
    filler.attitude = Attitude::QuarterTurns([0; 3]);
    filler.inertia = MassProperties::default();
    filler.follows = None;
    let mut filled = tree.clone();
    for body in &mut filled.bodies {
        body.parent = body.parent.map(|parent| parent + fillers);
        body.follows = None;
    }
    let bodies = std::iter::repeat_n(filler, fillers).chain(filled.bodies);
    filled.bodies = bodies.collect();
    let model = arm::<N>(&filled).map_err(|error| match tree.is_single() {
        true => error.to_string(),
        false => {
            "the page moves joints of one coordinate only: `cargo xtask import` takes this file"
                .to_owned()
        }
    })?;
    let of = |part: fn(&robot_import::tree::Body) -> f64| tree.bodies.iter().map(part).collect();
    let friction = Friction {
        viscous: of(|body| body.damping),
        coulomb: of(|body| body.friction),
        armature: of(|body| body.armature),
        width: WIDTH,
    };
    let all = [&friction.viscous, &friction.coulomb, &friction.armature];
    let given = all.into_iter().flatten().any(|x: &f64| *x != 0.0);
    let names = tree.bodies.iter().map(|body| body.joint.clone()).collect();
    Ok(Sized::filled(model, names, fillers, given.then_some(friction)))
}
