//! The library's robots in the form that the peers read. It holds the numbers that are in our
//! source, and is no maker's URDF with rounded angles.

use std::fmt::Write as _;

use serde::Deserialize;

use crate::peers::{ALGORITHMS, PRECISIONS, forms as forms_of};
use xtask::kit::error::Result;
use xtask::kit::host_bin;
use xtask::kit::workspace::Workspace;

/// A robot as `export_robots` prints it.
#[derive(Deserialize)]
pub struct Robot {
    pub name: String,
    /// Its bodies, parents first.
    bodies: Vec<Body>,
}

#[derive(Deserialize)]
struct Body {
    name: String,
    parent: i64,
    joint: String,
    axis: [f64; 3],
    placement: Placement,
    mass: f64,
    com: [f64; 3],
    inertia_com: [f64; 6],
}

#[derive(Deserialize)]
struct Placement {
    rotation: [f64; 9],
    position: [f64; 3],
}

/// The library's robots that are compared: of revolute joints, as the peers' form is, and a free
/// base.
const COMPARED: [&str; 8] = ["ur5e", "panda", "iiwa14", "xarm7", "a1", "a1_free", "g1", "g1_free"];
/// The comparison of a free base and of a robot with many joints.
const DYNAMICS: [&str; 3] = ["rnea", "crba", "aba"];

/// More joints than a robot has that is compared everywhere and in every precision.
const MANY: usize = 16;

/// Asks the library for its robots.
pub fn export(workspace: &Workspace) -> Result<Vec<Robot>> {
    let mut robots: Vec<Robot> = host_bin::json(workspace, "export_robots")?;
    robots.retain(|robot| COMPARED.contains(&&*robot.name));
    for body in robots.iter_mut().flat_map(|robot| &mut robot.bodies) {
        // The library holds inertias about the link's origin. Inertias that are converted back to
        // the centre of mass are off by rounding, and CasADi drops products with exact zeros only.
        let [xx, _, _, yy, _, zz] = body.inertia_com;
        for entry in &mut body.inertia_com {
            if entry.abs() < 1e-15 * (xx + yy + zz) {
                *entry = 0.0;
            }
        }
    }
    Ok(robots)
}

impl Robot {
    /// The number of its bodies, of its position and of its velocity coordinates.
    pub fn size(&self) -> [usize; 3] {
        let joints = self.bodies.iter().filter(|body| body.moves()).count();
        let free = usize::from(self.is_free());
        [self.bodies.len(), joints + 6 * free, joints + 5 * free]
    }

    /// The library's type of it.
    pub fn type_name(&self) -> String {
        let words = self.name.split('_').map(|word| {
            let (first, rest) = word.split_at(1);
            first.to_uppercase() + rest
        });
        // The one name with two capitals.
        words.collect::<String>().replace("Xarm", "XArm")
    }

    /// Whether its base is free.
    pub fn is_free(&self) -> bool {
        self.bodies[0].joint == "free"
    }

    /// Whether no body has two children.
    pub fn is_chain(&self) -> bool {
        let mut bodies = (-1..).zip(&self.bodies);
        bodies.all(|(before, body)| body.parent == before)
    }

    /// The algorithms that are compared of it.
    pub fn algorithms(&self) -> &'static [&'static str] {
        match self.is_free() || self.has_many_joints() {
            true => &DYNAMICS,
            false if self.is_chain() => &ALGORITHMS,
            // A tree has no tip.
            false => &ALGORITHMS[..5],
        }
    }

    /// The precisions on the host.
    pub fn precisions(&self) -> &'static [&'static str] {
        if self.has_many_joints() { &PRECISIONS[1..] } else { &PRECISIONS }
    }

    /// Whether its joints are many.
    pub fn has_many_joints(&self) -> bool {
        self.size()[2] - 5 * usize::from(self.is_free()) > MANY
    }

    /// Whether it is compared on the target, too: of many joints the harder case alone.
    pub fn is_on_target(&self) -> bool {
        self.is_free() || !self.has_many_joints()
    }

    /// The functions of it that CasADi is to write: `cs` ones, which take cosines, are for the
    /// target. An algorithm, the ends of its form's name, its inputs and its precision.
    pub fn casadi(&self) -> impl Iterator<Item = [&'static str; 4]> {
        let angles = self.precisions().iter().map(|precision| ["q", precision]);
        let target = PRECISIONS.iter().map(|precision| ["cs", precision]);
        let target = target.filter(|_| self.is_on_target());
        let forms: Vec<_> = angles.chain(target).collect();
        self.algorithms().iter().flat_map(move |algorithm| {
            let forms = forms.clone().into_iter();
            forms.flat_map(move |[inputs, precision]| {
                let names = forms_of(algorithm).iter();
                names.map(move |[form, _]| [*algorithm, *form, inputs, precision])
            })
        })
    }

    pub fn text(&self) -> String {
        let mut text = format!("{} {}\n", self.name, self.bodies.len());
        for body in &self.bodies {
            let Placement { rotation, position } = &body.placement;
            let numbers =
                [&body.axis[..], rotation, position, &[body.mass], &body.com, &body.inertia_com];
            let (name, numbers) = (&body.name, spaced(&numbers.concat()));
            let _ = writeln!(text, "{name} {} {} {numbers}", body.parent, body.joint);
        }
        text
    }
}

impl Body {
    fn moves(&self) -> bool {
        self.joint != "fixed"
    }
}

/// Shortest decimals that read back to the same f64.
fn spaced(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}
