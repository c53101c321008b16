//! Proven errors of the configurations of `cargo xtask accuracy`: kernels of sines and models,
//! against inverse dynamics of the whole model.
//!
//! A kernel of sines changes the inputs of the function alone, and the compiler may not change what
//! f32 is rounded to; so the expression that one walk reads is that of all of them, and each has
//! the error that trying every angle found ([`crate::sines`]). A model that leaves something out is
//! another expression. The distance of two expressions, their literals taken as they are, is a
//! trigonometric polynomial too, and is bounded by the same grid; then
//!
//!   |error| ≤ |computed − the model's expression| + |that − the whole expression|
//!             + |that − the whole model|,
//!
//! by operations and sines, by the distance, and by the literals of the whole expression.

use std::collections::BTreeMap;

use dynamics_core::trig::{Minimax, Table};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::bound::{Bounder, SineErrors};
use crate::branch;
use crate::certificate::in_parallel;
use crate::error::{Error, Result};
use crate::graph::{Graph, Node};
use crate::grid::{Counted, Program as Grid};
use crate::image::{self, Image};
use crate::interval::Interval;
use crate::program::Program;
use crate::sines::{self, Kernel};
use crate::state_box::{Joint, Robot};
use crate::walk::{Walked, walk};

/// The kernels by their names on the axis `trig`; the library's own has none.
fn kernels() -> [(&'static str, Kernel); 9] {
    [
        ("", Kernel::NATIVE),
        ("minimax3", Kernel::of::<Minimax<3, 2>>()),
        ("minimax5", Kernel::of::<Minimax<5, 2>>()),
        ("minimax7", Kernel::of::<Minimax<7, 2>>()),
        ("minimax7x3", Kernel::of::<Minimax<7, 3>>()),
        ("table", Kernel::of::<Table<256, 1>>()),
        ("table2", Kernel::of::<Table<256, 2>>()),
        ("table4", Kernel::of::<Table<64, 4>>()),
        ("table3x4", Kernel::of::<Table<128, 3, 4>>()),
    ]
}

/// The models by their names on the axis `model`, and the variables of the program; that of the
/// whole robot has none.
const MODELS: [(&str, &str); 11] = [
    ("", "CONFIGURED_FULL"),
    ("no_coriolis", "CONFIGURED_NO_CORIOLIS"),
    ("gravity", "CONFIGURED_GRAVITY"),
    ("params6", "CONFIGURED_PARAMS6"),
    ("params8", "CONFIGURED_PARAMS8"),
    ("params11", "CONFIGURED_PARAMS11"),
    ("pruned100", "CONFIGURED_PRUNED100_PPM"),
    ("pruned1000", "CONFIGURED_PRUNED1000_PPM"),
    ("pruned3000", "CONFIGURED_PRUNED3000_PPM"),
    ("pruned10000", "CONFIGURED_PRUNED10000_PPM"),
    ("pruned30000", "CONFIGURED_PRUNED30000_PPM"),
];

/// The configurations that have no bound here, and the reason for each.
const LEFT_OUT: [(&str, &str); 5] = [
    ("reduced rates", "the ticks between depend on the path, not on a state"),
    ("carried sines", "their error depends on the ticks before"),
    ("libm and micromath", "they are not the library's"),
    ("core", "its function is proven by itself"),
    ("f64", "its code calls routines for f64"),
];

/// The robots of `docs/accuracy.md`, and the accelerations that their paths there keep to: what is
/// measured lies in the box.
pub const PATHS: [(&str, f64); 3] = [("ur5e", 12.0), ("panda", 12.0), ("a1_leg", 300.0)];

/// The proven errors of a robot's configurations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Configurations {
    /// The name of the robot.
    pub robot: String,
    /// The box of states: the ranges of each joint.
    pub joints: Vec<Joint>,
    /// The hashes of the code and inputs that the proofs hold for: see [`hashes`].
    pub hashes: BTreeMap<String, String>,
    /// The greatest proven error of a joint, N·m or N, by the key of the configuration.
    pub proven: BTreeMap<String, f64>,
    /// The configurations that have no bound, and the reason for each.
    pub left_out: BTreeMap<String, String>,
}

/// Points of the grids, and parts of the box.
#[derive(Clone, Copy, Debug)]
pub struct Spent {
    /// The most points of a grid of angles.
    pub points: usize,
    /// The most points of the finer grid on which two models are compared.
    pub fine: usize,
    /// The parts that the box of each result is split into, for each kernel.
    pub parts: usize,
}

/// The key of a kernel and a model, as `fixtures::accuracy::key` prints it.
fn key(kernel: &str, model: &str) -> String {
    let axes = [("trig", kernel), ("model", model)];
    let changed = axes.iter().filter(|(_, value)| !value.is_empty());
    let words: Vec<String> = changed.map(|(axis, value)| format!("{axis}={value}")).collect();
    match words.is_empty() {
        true => "default".to_owned(),
        false => words.join(","),
    }
}

/// The expression of each model, in their order.
fn expressions(image: &Image) -> Result<Vec<Walked>> {
    let (effects, _) = image.variable("CERTIFIED_EFFECTS")?;
    let each = MODELS.iter().map(|(_, variable)| {
        let address = image.variable(variable)?.1[0];
        walk(image, address, [None, None, None, Some(effects)])
    });
    each.collect()
}

/// SHA-256 of what proofs are of: of the machine code of each model, by the variable that points to
/// it, and of `inputs`, the box and the bits of each kernel's sines at some ten thousand angles.
///
/// # Errors
/// [`Error::Declined`], [`Error::Missing`].
pub fn hashes(image: &Image, robot: &Robot) -> Result<BTreeMap<String, String>> {
    let walked = expressions(image)?;
    let of_model = |((_, variable), walked): (&(_, &str), &Walked)| {
        ((*variable).to_owned(), image.hash(&walked.visited))
    };
    let mut hashes: BTreeMap<_, _> = MODELS.iter().zip(&walked).map(of_model).collect();
    hashes.insert("inputs".to_owned(), inputs(robot));
    Ok(hashes)
}

/// The hash of the box and of the kernels' bits over it: see [`hashes`].
pub fn inputs(robot: &Robot) -> String {
    let (kernels, mut hash) = (kernels(), Sha256::new());
    for joint in &robot.joints {
        let Interval { low, high } = joint.position;
        for x in [low, high, joint.speed, joint.acceleration] {
            hash.update(x.to_le_bytes());
        }
        let most = joint.position.magnitude() as f32;
        // A step that is no power of two, so that no digit of the angles stays the same.
        let angles = (2.0_f32.powi(-30).to_bits()..=most.to_bits()).step_by(24_593);
        for q in angles.map(f32::from_bits).filter(|_| joint.turns) {
            for (sine, cosine) in kernels.iter().map(|(_, kernel)| kernel.pair(joint, q)) {
                hash.update(sine.to_le_bytes());
                hash.update(cosine.to_le_bytes());
            }
        }
    }
    image::hexadecimal(hash)
}

/// Fails unless a record is of what is there today.
///
/// # Errors
/// [`Error::Unproven`], with the robot and what of it is other.
pub fn check(
    recorded: &[Configurations],
    robot: &str,
    today: &BTreeMap<String, String>,
) -> Result<()> {
    let recorded = recorded.iter().find(|one| one.robot == robot);
    let is_known = |(what, hash): &(&String, &String)| {
        recorded.is_some_and(|recorded| recorded.hashes.get(*what) == Some(*hash))
    };
    match today.iter().find(|one| !is_known(one)) {
        None => Ok(()),
        Some((what, _)) => Err(Error::Unproven { robot: robot.to_owned(), what: what.clone() }),
    }
}

/// Proves the errors of all configurations of a robot.
///
/// # Errors
/// [`Error::Declined`], [`Error::Missing`].
pub fn prove(program: &Program, robot: &Robot, spent: Spent) -> Result<Configurations> {
    let image = Image::read(&program.elf)?;
    let (names, kernels): (Vec<_>, Vec<_>) = kernels().into_iter().unzip();
    let errors = sines::enumerate_each(&robot.joints, &kernels);
    let mut all = Configurations {
        robot: program.robot.clone(),
        joints: robot.joints.clone(),
        hashes: hashes(&image, robot)?,
        left_out: LEFT_OUT.map(|(what, why)| (what.to_owned(), why.to_owned())).into(),
        ..Configurations::default()
    };
    let expressions = expressions(&image)?;
    let whole = Whole::of(&expressions[0].graph, robot, spent.points);
    for ((model, _), own) in MODELS.iter().zip(&expressions) {
        let bounds = match (model.is_empty(), &whole) {
            (true, _) => each(&own.graph, None, robot, &errors, spent),
            (false, Some(whole)) => each(&own.graph, Some(whole), robot, &errors, spent),
            (false, None) => None,
        };
        match bounds {
            Some(bounds) => {
                let keys = names.iter().map(|kernel| key(kernel, model));
                all.proven.extend(keys.zip(bounds));
            }
            None if model.is_empty() => {
                return Err(Error::Missing("an input that the box bounds".to_owned()));
            }
            None => {
                let why = "no grid bounds how far it is from the whole model: a joint slides, or --points are too few";
                all.left_out.insert(format!("model={model}"), why.to_owned());
            }
        }
    }
    Ok(all)
}

/// The whole model, with which others are compared.
#[derive(Clone, Debug)]
pub struct Whole<'a> {
    graph: &'a Graph,
    /// For each result, the greatest difference from the robot's exact model that the literals
    /// cause.
    literals: Vec<f64>,
}

impl<'a> Whole<'a> {
    /// By a grid of at most so many points; `None` if there is none.
    pub fn of(graph: &'a Graph, robot: &Robot, points: usize) -> Option<Self> {
        let literals = in_parallel(graph.outputs.len(), |output| {
            let one = graph.of_output(output);
            let none = [SineErrors::default()];
            let bounds = Grid::new(&one, robot)?.prove_each(
                &one,
                robot,
                &none,
                Counted::LiteralsAlone,
                points,
            );
            Some(bounds?.pop()?.total())
        });
        Some(Self { graph, literals: literals.into_iter().collect::<Option<_>>()? })
    }
}

/// The greatest error of a joint by each kernel, of a model's expression; beside the whole one if
/// it is another.
pub fn each(
    own: &Graph,
    whole: Option<&Whole<'_>>,
    robot: &Robot,
    errors: &[SineErrors],
    spent: Spent,
) -> Option<Vec<f64>> {
    let joints = in_parallel(own.outputs.len(), |output| {
        let graph = own.of_output(output);
        let by_parts = |sines: &SineErrors| {
            let mut bounder = Bounder::new(own, output, robot, *sines)?;
            let proven = branch::prove(&mut bounder, &robot.whole(), spent.parts);
            Some(proven.bound.total())
        };
        let parts: Vec<f64> = errors.iter().map(by_parts).collect::<Option<_>>()?;
        let grid = Grid::new(&graph, robot);
        let counted = match whole {
            Some(_) => Counted::WithoutLiterals,
            None => Counted::All,
        };
        let by_grid =
            grid.and_then(|grid| grid.prove_each(&graph, robot, errors, counted, spent.points));
        let mut bounds = parts;
        if let Some(by_grid) = by_grid {
            for (bound, other) in bounds.iter_mut().zip(by_grid) {
                *bound = bound.min(other.total());
            }
        }
        let Some(whole) = whole else {
            return Some(bounds);
        };
        let place = own.outputs[output].0;
        let same = whole.graph.outputs.iter().position(|(offset, _)| *offset == place)?;
        let apart = difference(&graph, &whole.graph.of_output(same));
        let apart = Grid::new(&apart, robot)?.greatest_value(spent.points, spent.fine)?;
        let literals = whole.literals[same];
        Some(bounds.into_iter().map(|bound| bound + apart + literals).collect())
    });
    let mut most = vec![0.0_f64; errors.len()];
    for bounds in joints {
        for (most, bound) in most.iter_mut().zip(bounds?) {
            *most = most.max(bound * (1.0 + 1e-12));
        }
    }
    Some(most)
}

/// The expression of the difference of two.
pub fn difference(a: &Graph, b: &Graph) -> Graph {
    let (mut nodes, first) = (a.nodes.clone(), a.nodes.len());
    nodes.extend(b.nodes.iter().map(|node| node.moved(|a| a + first)));
    let last = nodes.len() - 1;
    nodes.push(Node::Sub(first - 1, last));
    Graph { outputs: vec![(a.outputs[0].0, last + 1)], nodes }
}
