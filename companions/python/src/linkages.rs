//! Loops of closed form as Python sees them: linkages, and a robot with them.

#![allow(non_snake_case, reason = "functions with names of Python")]

use std::panic::{AssertUnwindSafe, catch_unwind};

use dynamics_core::clusters::{self, Branch, Leg, Rod};
use pyo3::prelude::*;
use robot_dynamics_kernels::linkages::{self, Linkage, MOST_COEFFICIENTS};

use crate::angles::{Position, Positions, Use};
use crate::arrays::Argument;
use crate::error::{Exception, wanted};
use crate::methods::{Machine, methods};
use crate::robot::given::whole;
use crate::robot::{Array, Robot, argument};

/// A linkage whose coordinates are a function of fewer independent ones, such as `FourBar(...)`.
#[pyclass(frozen, module = "robot_dynamics", name = "Linkage")]
#[derive(Clone)]
pub struct PyLinkage {
    linkage: Linkage,
}

#[pymethods]
impl PyLinkage {
    /// The number of coordinates that it drives.
    #[getter]
    fn driven(&self) -> usize {
        self.linkage.sizes()[0]
    }
    /// The number of independent ones.
    #[getter]
    fn independent(&self) -> usize {
        self.linkage.sizes()[1]
    }
}

/// A linkage that cannot be described so.
fn refused(py: Python<'_>, name: &str, text: &str) -> PyErr {
    let error = Exception::new(py, "LinkageError", format!("{name}: {text}"));
    error.with("linkage", name).with("state", py.None()).build()
}

/// A linkage of the library, which panics with a text where its numbers are impossible.
fn linkage(
    py: Python<'_>,
    name: &'static str,
    numbers: &[&[f64]],
    of: impl Fn() -> Linkage,
) -> PyResult<PyLinkage> {
    if !numbers.iter().all(|list| list.iter().all(|x| x.is_finite())) {
        return Err(refused(py, name, "a number is not finite"));
    }
    match catch_unwind(AssertUnwindSafe(of)) {
        Ok(linkage) => Ok(PyLinkage { linkage }),
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
            let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
            Err(refused(py, name, &text.unwrap_or_default()))
        }
    }
}

fn branch(positive: bool) -> Branch {
    match positive {
        true => Branch::Positive,
        false => Branch::Negative,
    }
}

/// Three points, a length and a sign.
type RodNumbers = ([f64; 3], [f64; 3], [f64; 3], f64, bool);

/// Functions that make linkages of their arguments, with the lists of numbers that have to be
/// finite, and what adds them to a module.
macro_rules! functions {
    ($(
        $(#[$doc:meta])*
        $name:ident($($field:ident: $kind:ty $(= $default:tt)?),*) $($text:literal)?, [$($numbers:expr),*] => $make:expr;
    )*) => {
        $(
            $(#[$doc])*
            #[pyfunction]
            #[pyo3(signature = ($($field $(= $default)?),*) $(, text_signature = $text)?)]
            fn $name(
                py: Python<'_>,
                $(#[pyo3(from_py_with = wanted)] $field: $kind),*
            ) -> PyResult<PyLinkage> {
                linkage(py, stringify!($name), &[$(&$numbers),*], || Linkage::$name($make))
            }
        )*

        fn add_functions(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_function(wrap_pyfunction!($name, module)?)?;)*
            Ok(())
        }
    };
}

functions! {
    /// A planar four-bar: the lengths, m, of ground, crank, coupler and rocker; the coordinates are
    /// the angles of crank, coupler on the crank, and rocker. ``positive``: of the two ways to
    /// assemble it, that in which the coupler's joint on the rocker is to the left of the line from
    /// the crank's end to the rocker's joint. ``zeros``, rad: the angle of each link at q = 0 from
    /// the ground, and of the coupler from the crank.
    FourBar(ground: f64, crank: f64, coupler: f64, rocker: f64, positive: bool = true, zeros: [f64; 3] = [0.0; 3])
    "(ground, crank, coupler, rocker, positive=True, zeros=[0.0, 0.0, 0.0])",
    [[ground, crank, coupler, rocker], zeros] =>
        clusters::FourBar::new(ground, crank, coupler, rocker, branch(positive)).zeros(zeros);

    /// A planar five-bar: the distance of the cranks, m, and the lengths of crank and rod of each;
    /// the coordinates are the angles of crank, rod, other crank and other rod.
    FiveBar(ground: f64, first: [f64; 2], second: [f64; 2], positive: bool = true, zeros: [f64; 4] = [0.0; 4])
    "(ground, first, second, positive=True, zeros=[0.0, 0.0, 0.0, 0.0])",
    [[ground], first, second, zeros] =>
        clusters::FiveBar::new(ground, first, second, branch(positive)).zeros(zeros);

    /// A differential of two motors: half the sum and half the difference of their angles, over the
    /// two ratios.
    Differential(ratios: [f64; 2]), [ratios] => clusters::Differential::new(ratios);

    /// An ankle of pitch and roll that two cranks drive by rods. Each rod is given by the joint of
    /// its crank, the crank's end and the rod's end on the foot, m, its length, m, and whether its
    /// root is positive.
    ParallelAnkle(rods: [RodNumbers; 2]), [] => clusters::ParallelAnkle::new(rods.map(
        |(joint, crank, foot, length, positive)| Rod {
            joint, crank, foot, length, branch: branch(positive),
        },
    ));

    /// A Delta robot: the radii of base and platform, and the lengths of cranks and rods, m.
    Delta(base: f64, crank: f64, rod: f64, platform: f64), [[base, crank, rod, platform]] =>
        clusters::Delta::new(base, crank, rod, platform);

    /// A Stewart platform: of each leg its joints on base and platform, and its length at q = 0, m.
    Stewart(legs: [([f64; 3], [f64; 3], f64); 6]), [] =>
        clusters::Stewart::new(legs.map(|(base, platform, length)| Leg { base, platform, length }));
}

/// A belt or gear: the driven angle as a polynomial of the driving one, up to 8 coefficients from
/// the constant on.
#[pyfunction(name = "Belt")]
fn belt(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] coefficients: Vec<f64>,
) -> PyResult<PyLinkage> {
    if coefficients.len() > MOST_COEFFICIENTS {
        return Err(refused(py, "Belt", "it has more than 8 coefficients"));
    }
    let mut all = [0.0; MOST_COEFFICIENTS];
    all[..coefficients.len()].copy_from_slice(&coefficients);
    linkage(py, "Belt", &[&all], || Linkage::Belt(clusters::Belt::new(all)))
}

/// A robot with linkages: ``linkages`` has of each a name, the linkage, and the velocity
/// coordinates that it drives, or their joints, in the linkage's order.
///
/// y has, in the order of the bodies, the coordinates in no linkage, and the independent ones of
/// each linkage in the place of its first body. Shapes: py is the number of y, ny that of ẏ.
#[pyclass(frozen, module = "robot_dynamics", name = "Linkages")]
pub struct PyLinkages {
    robot: Py<Robot>,
    linkages: linkages::Linkages,
    names: Vec<String>,
    /// The positions of y that are in no linkage.
    outside: Vec<Position>,
}

impl PyLinkages {
    /// Rates at y, or torques.
    fn of_y<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        argument(name, given, self.linkages.sizes[1])
    }

    /// An argument y whose angles are used as they are.
    fn of_positions<'a, 'py>(
        &self,
        name: &'static str,
        given: &'a Array<'py>,
    ) -> Argument<'a, 'py> {
        argument(name, given, self.linkages.sizes[0])
    }

    /// y, of which sines and cosines alone matter. The kernels look at the angles of linkages.
    fn y<'a, 'py>(&'a self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        Argument {
            positions: Some(Positions { by: Use::Sines, at: &self.outside }),
            ..self.of_positions(name, given)
        }
    }
}

impl Machine for PyLinkages {
    fn robot(&self) -> &Robot {
        self.robot.get()
    }
    fn names(&self) -> &[String] {
        &self.names
    }
}

#[pymethods]
impl PyLinkages {
    #[new]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] robot: Py<Robot>,
        #[pyo3(from_py_with = wanted)] linkages: Vec<(
            String,
            Py<PyLinkage>,
            Vec<Bound<'_, PyAny>>,
        )>,
    ) -> PyResult<Self> {
        let of = robot.get();
        let (mut names, mut all) = (Vec::new(), Vec::new());
        for (name, linkage, coordinates) in linkages {
            let mut driven = Vec::new();
            for coordinate in coordinates {
                driven.extend(of.coordinates_of(&coordinate)?);
            }
            all.push((linkage.get().linkage, driven));
            names.push(name);
        }
        let found = linkages::Linkages::of(&of.described, all);
        let linkages = found.map_err(|(at, text)| refused(py, &names[at], &text))?;
        let position = |&[of_tree, column]: &[usize; 2]| {
            let mut all = of.positions.iter();
            let found = all.find(|position| position.column == of_tree)?;
            Some(Position { column, ..*found })
        };
        let outside = linkages.outside().iter().filter_map(position).collect();
        Ok(Self { robot, linkages, names, outside })
    }

    /// The names of the linkages.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }
    /// The number of independent positions.
    #[getter]
    fn py(&self) -> usize {
        self.linkages.sizes[0]
    }
    /// The number of independent velocities.
    #[getter]
    fn ny(&self) -> usize {
        self.linkages.sizes[1]
    }
}

methods! {
    PyLinkages, of => (linkages, nq, v, n) =
        (&of.linkages, of.robot().counts.q, of.robot().counts.v, of.linkages.sizes[1]);

    /// The motion of the tree: q (…, nq), q̇ and q̈ (…, nv), rad and m, G (…, nv, ny) with q̇ = G
    /// ẏ, and whether a linkage is near a singularity, where G is damped, (…), 1 or 0; y (…, py), ẏ
    /// and ÿ (…, ny).
    ///
    /// Raises LinkageError with the linkage whose links do not reach each other.
    motion(y: of_positions, yd: of_y, ydd: of_y) = several(LinkageMotion { linkages }): [nq], [v], [v], [v, n], [];

    /// Inverse dynamics: the torques at the independent coordinates (…, ny), N·m or N, for y (…,
    /// py), ẏ and ÿ (…, ny).
    ///
    /// Raises LinkageError. Scenes have Inertia and Coriolis, and no friction of gears.
    rnea(y: y, yd: of_y, ydd: of_y; under effects whole) = one(LinkageRnea { linkages }): [n];

    /// Forward dynamics: ÿ (…, ny), rad/s² or m/s², for y (…, py), ẏ and the torques at the
    /// independent coordinates (…, ny), N·m or N.
    ///
    /// Raises LinkageError. Scenes have Inertia and Coriolis, and no friction of gears.
    forward_dynamics(y: y, yd: of_y, tau: of_y; under effects whole) = one(LinkageForward { linkages }): [n];
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyLinkage>()?;
    module.add_class::<PyLinkages>()?;
    module.add_function(wrap_pyfunction!(belt, module)?)?;
    add_functions(module)
}
