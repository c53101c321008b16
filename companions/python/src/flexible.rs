//! Links that bend as Python sees them.

use dynamics_core::flexible::{Beam, FlexibleLink, MODES_PER_LINK, Mode, ModeProblem, Shape};
use pyo3::prelude::*;
use robot_dynamics_kernels::flexible::{AnyModes, MOST_MODES, NoModes};

use crate::arrays::Argument;
use crate::error::{Exception, of_model, wanted};
use crate::methods::{Machine, methods};
use crate::robot::given::whole;
use crate::robot::{Array, Robot, argument};

/// Modes that cannot be used.
fn refused(py: Python<'_>, link: &str, mode: usize, problem: &str) -> PyErr {
    let text = format!("link `{link}`, mode {mode}: {problem}");
    Exception::new(py, "ModeError", text)
        .with("link", link)
        .with("mode", mode)
        .with("state", py.None())
        .build()
}

/// One assumed mode of a link: a displacement φ(r) η of every point r, in the frame of the link's
/// joint, with which it is clamped there.
///
/// ``momentum``: ∫ φ dm; ``moments``: ∫ φ rᵀ dm by rows of φ; ``shift`` and ``turn``: φ and the
/// rotation ½ curl φ at the link's end. φ has no unit where η is in m, and m/rad where it is in
/// rad; masses in kg.
#[pyclass(frozen, module = "robot_dynamics", name = "Mode")]
#[derive(Clone)]
pub struct PyMode(Mode);

#[pymethods]
impl PyMode {
    #[new]
    fn new(
        #[pyo3(from_py_with = wanted)] momentum: [f64; 3],
        #[pyo3(from_py_with = wanted)] moments: [[f64; 3]; 3],
        #[pyo3(from_py_with = wanted)] shift: [f64; 3],
        #[pyo3(from_py_with = wanted)] turn: [f64; 3],
    ) -> Self {
        Self(Mode { momentum, moments, shift, turn })
    }
}

/// A link that bends: its body by name or number, its end in the frame of its joint, m, on which
/// its children stand, up to 6 modes, and of each pair of modes the products ∫ φ φᵀ dm (n, n, 3,
/// 3), stiffness, N/m or N·m/rad, and damping, N·s/m or N·m·s/rad, each (n, n).
#[pyclass(frozen, module = "robot_dynamics", name = "FlexibleLink")]
pub struct PyFlexibleLink {
    body: Py<PyAny>,
    link: FlexibleLink,
}

#[pymethods]
impl PyFlexibleLink {
    #[new]
    fn new(
        py: Python<'_>,
        body: Py<PyAny>,
        #[pyo3(from_py_with = wanted)] end: [f64; 3],
        #[pyo3(from_py_with = wanted)] modes: Vec<Py<PyMode>>,
        #[pyo3(from_py_with = wanted)] products: Vec<Vec<[[f64; 3]; 3]>>,
        #[pyo3(from_py_with = wanted)] stiffness: Vec<Vec<f64>>,
        #[pyo3(from_py_with = wanted)] damping: Vec<Vec<f64>>,
    ) -> PyResult<Self> {
        let n = modes.len();
        let square =
            |table: &[Vec<f64>]| table.len() == n && table.iter().all(|row| row.len() == n);
        let of_products = products.len() == n && products.iter().all(|row| row.len() == n);
        if n > MODES_PER_LINK || !of_products || !square(&stiffness) || !square(&damping) {
            let text = format!(
                "{n} modes, of at most {MODES_PER_LINK}, and tables of as many rows and columns"
            );
            return Err(refused(py, &body.bind(py).to_string(), n, &text));
        }
        let modes: Vec<Mode> = modes.iter().map(|mode| mode.get().0).collect();
        let mut link = FlexibleLink::new(0, end, &modes);
        for k in 0..n {
            link.products[k][..n].copy_from_slice(&products[k]);
            link.stiffness[k][..n].copy_from_slice(&stiffness[k]);
            link.damping[k][..n].copy_from_slice(&damping[k]);
        }
        Ok(Self { body, link })
    }
}

/// A uniform beam along x: length, m, and mass per length, kg/m; bending stiffness in the planes of
/// y and z and torsion stiffness, N·m²; the sections' second moments of mass, kg·m; a tip's mass,
/// kg, and inertia, kg·m²; the damping ratio of its modes.
#[pyclass(frozen, module = "robot_dynamics", name = "Beam")]
pub struct PyBeam(Beam);

#[pymethods]
impl PyBeam {
    #[new]
    #[pyo3(signature = (length, mass_per_length, bending = [0.0; 2], torsion = 0.0, sections = [0.0; 2], tip = [0.0; 2], damping_ratio = 0.0), text_signature = "(length, mass_per_length, bending=[0.0, 0.0], torsion=0.0, sections=[0.0, 0.0], tip=[0.0, 0.0], damping_ratio=0.0)")]
    fn new(
        #[pyo3(from_py_with = wanted)] length: f64,
        #[pyo3(from_py_with = wanted)] mass_per_length: f64,
        #[pyo3(from_py_with = wanted)] bending: [f64; 2],
        #[pyo3(from_py_with = wanted)] torsion: f64,
        #[pyo3(from_py_with = wanted)] sections: [f64; 2],
        #[pyo3(from_py_with = wanted)] tip: [f64; 2],
        #[pyo3(from_py_with = wanted)] damping_ratio: f64,
    ) -> Self {
        let beam = Beam::new(length, mass_per_length)
            .bending(bending)
            .torsion(torsion)
            .sections(sections)
            .tip(tip[0], tip[1])
            .damping_ratio(damping_ratio);
        Self(beam)
    }

    /// The mass with its tip, kg: that of the robot's body.
    #[getter]
    fn mass(&self) -> f64 {
        self.0.mass()
    }
    /// The centre of mass from the joint, m.
    #[getter]
    fn com(&self) -> [f64; 3] {
        self.0.com()
    }
    /// Ixx, Ixy, Ixz, Iyy, Iyz, Izz about the centre of mass, kg·m².
    #[getter]
    fn inertia(&self) -> [f64; 6] {
        self.0.inertia()
    }

    /// The link of a body with modes by their shapes, such as ``[("bend_z", 1), ("twist", 1)]``:
    /// "bend_y", "bend_z" or "twist", counted from 1.
    fn link(
        &self,
        py: Python<'_>,
        body: Py<PyAny>,
        #[pyo3(from_py_with = wanted)] shapes: Vec<(String, usize)>,
    ) -> PyResult<PyFlexibleLink> {
        let label = body.bind(py).to_string();
        let mut all = Vec::new();
        for (i, (name, index)) in shapes.iter().enumerate() {
            all.push(match &**name {
                "bend_y" => Shape::BendY(*index),
                "bend_z" => Shape::BendZ(*index),
                "twist" => Shape::Twist(*index),
                _ => return Err(refused(py, &label, i, &ModeProblem::NoShape.to_string())),
            });
        }
        let link = self.0.link(0, &all);
        let link = link.map_err(|problem| refused(py, &label, 0, &problem.to_string()))?;
        Ok(PyFlexibleLink { body, link })
    }
}

/// A robot of up to 16 coordinates with links that bend, of up to 8 modes in all. The links' stiffness and damping act in
/// every scene.
///
/// Shapes: nm is the number of modes, in the order of the bodies. η of a mode is in m or rad, as
/// its shape is scaled.
#[pyclass(frozen, module = "robot_dynamics", name = "FlexibleRobot")]
pub struct PyFlexibleRobot {
    robot: Py<Robot>,
    modes: AnyModes,
}

impl Machine for PyFlexibleRobot {
    fn robot(&self) -> &Robot {
        self.robot.get()
    }
}

impl PyFlexibleRobot {
    fn m<'a, 'py>(&self, name: &'static str, given: &'a Array<'py>) -> Argument<'a, 'py> {
        argument(name, given, self.modes.count)
    }
}

#[pymethods]
impl PyFlexibleRobot {
    #[new]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted)] robot: Py<Robot>,
        #[pyo3(from_py_with = wanted)] links: Vec<Py<PyFlexibleLink>>,
    ) -> PyResult<Self> {
        let (of, mut all) = (robot.get(), Vec::new());
        for link in &links {
            let link = link.get();
            all.push(FlexibleLink { body: of.body(link.body.bind(py))?, ..link.link });
        }
        let count: usize = all.iter().map(|link| link.count).sum();
        if count > MOST_MODES {
            let text = format!("{count} modes in all, at most {MOST_MODES}");
            return Err(refused(py, of.label(), count, &text));
        }
        let modes = AnyModes::of(&of.described, &all).map_err(|error| match error {
            NoModes::Model(error) => of_model(py, &error, &[]),
            NoModes::Modes(error) => {
                let body = error.link.parse().ok().and_then(|i| of.body_name(i));
                let problem = error.problem.to_string();
                refused(py, body.unwrap_or(of.label()), error.mode, &problem)
            }
        })?;
        Ok(Self { robot, modes })
    }

    /// The number of modes of the links.
    #[getter]
    fn nm(&self) -> usize {
        self.modes.count
    }
}

methods! {
    PyFlexibleRobot, of => (modes, v, m) = (&of.modes, of.robot().counts.v, of.modes.count);

    /// Inverse dynamics: the torques of the joints (…, nv), N·m or N, and the forces on the modes
    /// (…, nm), N or N·m, which are zero where the modes move freely; q (…, nq), q̇ and q̈ (…, nv),
    /// η, η̇ and η̈ (…, nm).
    rnea(q: q, qd: v, qdd: v, eta: m, etad: m, etadd: m; under effects whole) = several(FlexibleRnea { modes }): [v], [m];

    /// The inertia of joints and modes in blocks: of joints (…, nv, nv), between modes and joints
    /// (…, nm, nv), and of modes (…, nm, nm), kg, kg·m or kg·m²; q (…, nq), η (…, nm).
    crba(q: q, eta: m; under effects whole) = several(FlexibleCrba { modes }): [v, v], [m, v], [m, m];

    /// The natural frequencies of the modes with the joints clamped (…, nm), rad/s, in ascending
    /// order; q (…, nq), η (…, nm).
    frequencies(q: q, eta: m; under effects whole) = one(Frequencies { modes }): [m];

    /// Forward dynamics: q̈ (…, nv), rad/s² or m/s², and η̈ (…, nm), m/s² or rad/s², for q (…, nq),
    /// q̇ and τ (…, nv), η and η̇ (…, nm).
    forward_dynamics(q: q, qd: v, tau: v, eta: m, etad: m; under effects whole) = several(FlexibleForward { modes }): [v], [m];

    /// η̈ (…, nm), m/s² or rad/s², along a motion of the joints, q (…, nq), q̇ and q̈ (…, nv),
    /// whatever torques it takes; η and η̇ (…, nm).
    modal_dynamics(q: q, qd: v, qdd: v, eta: m, etad: m; under effects whole) = one(ModalDynamics { modes }): [m];

    /// A tick of feed-forward of h seconds: the torques (…, nv), N·m or N, at which the joints'
    /// motion is a reference, q (…, nq), q̇ and q̈ (…, nv), and η, η̇ and η̈ (…, nm) of the modes
    /// after it, from those before.
    tick(q: q, qd: v, qdd: v, eta: m, etad: m, etadd: m; given h: f64; under effects whole) = several(FeedforwardTick { modes, h }): [v], [m], [m], [m];

    /// η (…, nm), m or rad, at rest under the scene's gravity at q (…, nq).
    ///
    /// Raises ModeError of a link that is too soft for its weight.
    at_rest(q: q; under effects whole) = one(ModesAtRest { modes }): [m];
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyMode>()?;
    module.add_class::<PyFlexibleLink>()?;
    module.add_class::<PyBeam>()?;
    module.add_class::<PyFlexibleRobot>()
}
