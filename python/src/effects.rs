//! Effects as Python sees them: a scene is immutable, and scenes are added.

use std::sync::{Arc, LazyLock};

use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

use crate::error::{Exception, wanted};
use robot_dynamics_kernels::spec::{BodyRef, Spec};

/// Effects that act together on a robot.
///
/// An effect such as ``Gravity()`` is a scene of one; ``a + b`` has the effects of both. A function
/// that takes a scene takes a tuple of scenes, too. Two effects of a kind that cannot mean two
/// things are refused, as in the library.
#[pyclass(frozen, module = "robot_dynamics", name = "Scene", eq)]
#[derive(Clone, PartialEq)]
pub struct PyScene {
    pub specs: Arc<Vec<Spec>>,
}

/// Gravity of the earth, inertia and velocity products.
pub static RIGID_BODY: LazyLock<Arc<Vec<Spec>>> = LazyLock::new(|| {
    let gravity = Spec::Gravity([0.0, 0.0, -9.81]);
    Arc::new(vec![gravity, Spec::Inertia, Spec::Coriolis])
});

impl PyScene {
    fn of(spec: Spec) -> Self {
        Self {
            specs: Arc::new(vec![spec]),
        }
    }

    fn checked(py: Python<'_>, specs: Vec<Spec>) -> PyResult<Self> {
        for (i, spec) in specs.iter().enumerate() {
            let again = specs[..i].iter().any(|other| other.name() == spec.name());
            if again && !spec.may_repeat() {
                let effect = spec.name();
                let message = format!(
                    "the scene contains {effect} twice: write one with the sum of both, or leave one out"
                );
                let error = Exception::new(py, "EffectError", message).with("effect", effect);
                return Err(error.build());
            }
        }
        Ok(Self {
            specs: Arc::new(specs),
        })
    }
}

/// The effects of an argument: none are those of a rigid body.
pub fn given(argument: Option<&Bound<'_, PyAny>>) -> PyResult<Arc<Vec<Spec>>> {
    let Some(argument) = argument else {
        return Ok(RIGID_BODY.clone());
    };
    if let Ok(scene) = argument.cast::<PyScene>() {
        return Ok(scene.get().specs.clone());
    }
    let py = argument.py();
    let several = argument.is_instance_of::<PyTuple>() || argument.is_instance_of::<PyList>();
    let mut specs = Vec::new();
    let items = if several {
        argument.try_iter().ok()
    } else {
        None
    };
    for item in items.into_iter().flatten() {
        match item?.cast::<PyScene>() {
            Ok(scene) => specs.extend(scene.get().specs.iter().cloned()),
            Err(_) => return Err(no_effect(py)),
        }
    }
    if !several {
        return Err(no_effect(py));
    }
    Ok(PyScene::checked(py, specs)?.specs)
}

fn no_effect(py: Python<'_>) -> PyErr {
    let text = "effects are a Scene such as Gravity() + Inertia(), or a tuple of them";
    Exception::new(py, "EffectError", text)
        .with("effect", "")
        .build()
}

#[pymethods]
impl PyScene {
    /// The effects of all scenes.
    #[new]
    #[pyo3(signature = (*scenes))]
    fn new(scenes: &Bound<'_, PyTuple>) -> PyResult<Self> {
        given(Some(scenes.as_any())).map(|specs| Self { specs })
    }

    fn __add__(&self, other: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mut specs = self.specs.to_vec();
        specs.extend(given(Some(other))?.iter().cloned());
        Self::checked(other.py(), specs)
    }

    fn __radd__(&self, other: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mut specs = given(Some(other))?.to_vec();
        specs.extend(self.specs.iter().cloned());
        Self::checked(other.py(), specs)
    }

    fn __len__(&self) -> usize {
        self.specs.len()
    }

    fn __contains__(&self, name: &str) -> bool {
        self.specs.iter().any(|spec| spec.name() == name)
    }

    fn __repr__(&self) -> String {
        let names: Vec<String> = self.specs.iter().map(|spec| format!("{spec:?}")).collect();
        format!("Scene({})", names.join(" + "))
    }

    fn __copy__(scene: Py<Self>) -> Py<Self> {
        scene
    }

    // A scene does not change.
    fn __deepcopy__(scene: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        scene
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let text = serde_json::to_string(&*self.specs).map_err(|error| of_pickle(py, &error))?;
        let maker = py.import("robot_dynamics._native")?.getattr("_scene")?;
        (maker, (text,)).into_pyobject(py)
    }

    /// The names of its effects, in their order.
    #[getter]
    fn names(&self) -> Vec<&'static str> {
        self.specs.iter().map(Spec::name).collect()
    }
}

/// The scene of effects that were pickled.
#[pyfunction(name = "_scene")]
fn scene(py: Python<'_>, effects: &str) -> PyResult<PyScene> {
    let specs = serde_json::from_str(effects).map_err(|error| of_pickle(py, &error))?;
    PyScene::checked(py, specs)
}

fn of_pickle(py: Python<'_>, error: &serde_json::Error) -> PyErr {
    Exception::new(py, "EffectError", format!("pickle: {error}"))
        .with("effect", "")
        .build()
}

fn body(py: Python<'_>, given: &Bound<'_, PyAny>) -> PyResult<BodyRef> {
    if let Ok(number) = given.extract::<usize>() {
        return Ok(BodyRef::Number(number));
    }
    given.extract::<String>().map(BodyRef::Name).map_err(|_| {
        let text = "a body is a name or a number from 0";
        Exception::new(py, "UnknownBody", text)
            .with("body", given)
            .build()
    })
}

/// Refuses numbers that are not finite: a scene is a constant, and NaN in it would be in every
/// result.
fn finite(py: Python<'_>, scene: PyScene, values: &[&[f64]]) -> PyResult<PyScene> {
    if values.iter().all(|list| list.iter().all(|x| x.is_finite())) {
        return Ok(scene);
    }
    let effect = scene.specs.first().map_or("", Spec::name);
    let text = format!("{effect}: a number is not finite");
    Err(Exception::new(py, "EffectError", text)
        .with("effect", effect)
        .build())
}

/// Refuses a width of zero, which would divide by it.
pub fn wide(py: Python<'_>, effect: &'static str, widths: &[f64]) -> PyResult<()> {
    if widths
        .iter()
        .all(|&width| width.is_finite() && width != 0.0)
    {
        return Ok(());
    }
    let text = format!("{effect}: a width or speed is zero or not finite");
    Err(Exception::new(py, "EffectError", text)
        .with("effect", effect)
        .build())
}

/// Refuses a direction that has not the length 1.
fn unit(py: Python<'_>, effect: &'static str, what: &str, direction: [f64; 3]) -> PyResult<()> {
    let squared: f64 = direction.iter().map(|x| x * x).sum();
    // NaN is in no range.
    if (1.0 - 1e-9..=1.0 + 1e-9).contains(&squared) {
        return Ok(());
    }
    let length = squared.sqrt();
    let text = format!("{effect}: a {what} is a vector of length 1, not {length}");
    Err(Exception::new(py, "EffectError", text)
        .with("effect", effect)
        .build())
}

/// Gravity: ``g`` in m/s² along ``direction`` in the base's axes, a vector of length 1.
#[pyfunction(name = "Gravity")]
#[pyo3(signature = (g = 9.81, direction = [0.0, 0.0, -1.0]))]
fn gravity(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] g: f64,
    #[pyo3(from_py_with = wanted)] direction: [f64; 3],
) -> PyResult<PyScene> {
    unit(py, "Gravity", "direction", direction)?;
    let vector = direction.map(|x| x * g);
    finite(py, PyScene::of(Spec::Gravity(vector)), &[&vector])
}

/// The products of inertia and acceleration, M q̈.
#[pyfunction(name = "Inertia")]
fn inertia() -> PyScene {
    PyScene::of(Spec::Inertia)
}

/// The products of velocities, C(q, q̇) q̇.
#[pyfunction(name = "Coriolis")]
fn coriolis() -> PyScene {
    PyScene::of(Spec::Coriolis)
}

/// A base that moves: spatial velocity (rad/s, m/s) and acceleration (rad/s², m/s²), angular part
/// first, at its origin and in its axes.
#[pyfunction(name = "MovingBase")]
#[pyo3(signature = (velocity, acceleration))]
fn moving_base(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] velocity: [f64; 6],
    #[pyo3(from_py_with = wanted)] acceleration: [f64; 6],
) -> PyResult<PyScene> {
    let spec = Spec::MovingBase {
        velocity,
        acceleration,
    };
    finite(py, PyScene::of(spec), &[&velocity, &acceleration])
}

/// Viscous friction b q̇: b of each velocity coordinate, N·m·s/rad or N·s/m.
#[pyfunction(name = "Viscous")]
fn viscous(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] coefficients: Vec<f64>,
) -> PyResult<PyScene> {
    let scene = PyScene::of(Spec::Viscous(coefficients.clone()));
    finite(py, scene, &[&coefficients])
}

/// Dry friction: the torque of each velocity coordinate, N·m or N, which is full beyond the speed
/// ``width``, rad/s or m/s.
#[pyfunction(name = "Coulomb")]
fn coulomb(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] torque: Vec<f64>,
    #[pyo3(from_py_with = wanted)] width: f64,
) -> PyResult<PyScene> {
    wide(py, "Coulomb", &[width])?;
    let scene = PyScene::of(Spec::Coulomb {
        torque: torque.clone(),
        width,
    });
    finite(py, scene, &[&torque])
}

/// Dry friction that differs by direction: torques N·m or N, width rad/s or m/s.
#[pyfunction(name = "AsymmetricCoulomb")]
fn asymmetric_coulomb(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] forward: Vec<f64>,
    #[pyo3(from_py_with = wanted)] backward: Vec<f64>,
    #[pyo3(from_py_with = wanted)] width: f64,
) -> PyResult<PyScene> {
    wide(py, "AsymmetricCoulomb", &[width])?;
    let scene = PyScene::of(Spec::AsymmetricCoulomb {
        forward: forward.clone(),
        backward: backward.clone(),
        width,
    });
    finite(py, scene, &[&forward, &backward])
}

/// The excess of friction at low speed, N·m or N, which falls with the speed ``stribeck_speed``;
/// widths rad/s or m/s.
#[pyfunction(name = "Stribeck")]
fn stribeck(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] excess: Vec<f64>,
    #[pyo3(from_py_with = wanted)] stribeck_speed: f64,
    #[pyo3(from_py_with = wanted)] width: f64,
) -> PyResult<PyScene> {
    wide(py, "Stribeck", &[stribeck_speed, width])?;
    let scene = PyScene::of(Spec::Stribeck {
        excess: excess.clone(),
        stribeck_speed,
        width,
    });
    finite(py, scene, &[&excess])
}

/// The LuGre model at a given deflection of its bristles, rad or m: stiffness, damping, viscous,
/// sliding and excess of each velocity coordinate. The bristles stand still here; a simulation
/// advances them.
#[pyfunction(name = "Lugre")]
#[allow(
    clippy::too_many_arguments,
    reason = "the model has as many parameters, which have names in Python"
)]
fn lugre(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] stiffness: Vec<f64>,
    #[pyo3(from_py_with = wanted)] damping: Vec<f64>,
    #[pyo3(from_py_with = wanted)] viscous: Vec<f64>,
    #[pyo3(from_py_with = wanted)] sliding: Vec<f64>,
    #[pyo3(from_py_with = wanted)] excess: Vec<f64>,
    #[pyo3(from_py_with = wanted)] stribeck_speed: f64,
    #[pyo3(from_py_with = wanted)] bristle: Vec<f64>,
) -> PyResult<PyScene> {
    wide(py, "Lugre", &[stribeck_speed])?;
    let values = [stiffness, damping, viscous, sliding, excess, bristle];
    let scene = PyScene::of(Spec::Lugre {
        values: values.clone(),
        stribeck_speed,
    });
    finite(py, scene, &values.each_ref().map(Vec::as_slice))
}

/// Friction of gears that grows with the load: the factors when driving and when driven, and a
/// width, rad/s or m/s.
#[pyfunction(name = "LoadFriction")]
fn load_friction(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] driving: Vec<f64>,
    #[pyo3(from_py_with = wanted)] backdriving: Vec<f64>,
    #[pyo3(from_py_with = wanted)] width: f64,
) -> PyResult<PyScene> {
    wide(py, "LoadFriction", &[width])?;
    let scene = PyScene::of(Spec::LoadFriction {
        driving: driving.clone(),
        backdriving: backdriving.clone(),
        width,
    });
    finite(py, scene, &[&driving, &backdriving])
}

/// A spring at each joint: stiffness N·m/rad or N/m, rest position rad or m.
#[pyfunction(name = "Spring")]
fn spring(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] stiffness: Vec<f64>,
    #[pyo3(from_py_with = wanted)] rest: Vec<f64>,
) -> PyResult<PyScene> {
    let scene = PyScene::of(Spec::Spring {
        stiffness: stiffness.clone(),
        rest: rest.clone(),
    });
    finite(py, scene, &[&stiffness, &rest])
}

/// Stops at both ends of each joint: positions rad or m, stiffness N·m/rad, damping N·m·s/rad from
/// a depth of ``damping_depth`` rad on.
#[pyfunction(name = "EndStops")]
fn end_stops(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] lower: Vec<f64>,
    #[pyo3(from_py_with = wanted)] upper: Vec<f64>,
    #[pyo3(from_py_with = wanted)] stiffness: f64,
    #[pyo3(from_py_with = wanted)] damping: f64,
    #[pyo3(from_py_with = wanted)] damping_depth: f64,
) -> PyResult<PyScene> {
    wide(py, "EndStops", &[damping_depth])?;
    let scene = PyScene::of(Spec::EndStops {
        lower: lower.clone(),
        upper: upper.clone(),
        stiffness,
        damping,
        damping_depth,
    });
    finite(py, scene, &[&lower, &upper, &[stiffness, damping]])
}

/// Cogging: periods per turn of each joint, and per joint the torques of up to 8 harmonics, N·m.
/// Periods times angle may be up to 10⁴ rad in float32 and 10⁵ rad in float64.
#[pyfunction(name = "Cogging")]
fn cogging(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] per_turn: Vec<f64>,
    #[pyo3(from_py_with = wanted)] cos: Vec<Vec<f64>>,
    #[pyo3(from_py_with = wanted)] sin: Vec<Vec<f64>>,
) -> PyResult<PyScene> {
    let lists: Vec<&[f64]> = std::iter::once(&per_turn)
        .chain(&cos)
        .chain(&sin)
        .map(Vec::as_slice)
        .collect();
    let scene = PyScene::of(Spec::Cogging {
        per_turn: per_turn.clone(),
        cos: cos.clone(),
        sin: sin.clone(),
    });
    finite(py, scene, &lists)
}

/// A constant torque that the motor of each joint supplies in any state, N·m or N: the offset of a
/// sensor, or the mean of a friction that differs with direction.
#[pyfunction(name = "ConstantTorque")]
fn constant_torque(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] torque: Vec<f64>,
) -> PyResult<PyScene> {
    let scene = PyScene::of(Spec::ConstantTorque(torque.clone()));
    finite(py, scene, &[&torque])
}

/// The inertia of each motor at its joint, kg·m² or kg.
#[pyfunction(name = "Armature")]
fn armature(py: Python<'_>, #[pyo3(from_py_with = wanted)] inertia: Vec<f64>) -> PyResult<PyScene> {
    finite(
        py,
        PyScene::of(Spec::Armature(inertia.clone())),
        &[&inertia],
    )
}

/// Rotors that spin on the links before their joints: moment of inertia of each about its axis,
/// kg·m², and the ratio of its gear, rad of the rotor per rad or m of the joint, negative for the
/// opposite sense; zeros where there is none.
///
/// `Armature` of I ρ² has their inertia at the joints alone. `centroidal_matrix` and `osim_inverse`
/// do not take them.
#[pyfunction(name = "GyroscopicRotors")]
fn gyroscopic_rotors(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] inertia: Vec<f64>,
    #[pyo3(from_py_with = wanted)] ratio: Vec<f64>,
) -> PyResult<PyScene> {
    let scene = PyScene::of(Spec::GyroscopicRotors {
        inertia: inertia.clone(),
        ratio: ratio.clone(),
    });
    finite(py, scene, &[&inertia, &ratio])
}

/// A load on a body: mass kg, centre of mass m in the body's frame, inertia about it (xx, xy, xz,
/// yy, yz, zz) kg·m².
#[pyfunction(name = "Payload")]
#[pyo3(signature = (body, mass, com = [0.0; 3], inertia = [0.0; 6]))]
fn payload(
    py: Python<'_>,
    #[pyo3(from_py_with = self::any)] body: Py<PyAny>,
    #[pyo3(from_py_with = wanted)] mass: f64,
    #[pyo3(from_py_with = wanted)] com: [f64; 3],
    #[pyo3(from_py_with = wanted)] inertia: [f64; 6],
) -> PyResult<PyScene> {
    let body = self::body(py, body.bind(py))?;
    let spec = Spec::Payload {
        body,
        mass,
        com,
        inertia,
    };
    finite(py, PyScene::of(spec), &[&[mass], &com, &inertia])
}

fn any(given: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
    Ok(given.clone().unbind())
}

/// A wrench on a body in its own frame: couple N·m, then force N.
#[pyfunction(name = "BodyWrench")]
fn body_wrench(
    py: Python<'_>,
    #[pyo3(from_py_with = self::any)] body: Py<PyAny>,
    #[pyo3(from_py_with = wanted)] wrench: [f64; 6],
) -> PyResult<PyScene> {
    let body = self::body(py, body.bind(py))?;
    finite(
        py,
        PyScene::of(Spec::BodyWrench { body, wrench }),
        &[&wrench],
    )
}

/// A wrench at a body's origin in the base's axes: couple N·m, then force N.
#[pyfunction(name = "WorldWrench")]
fn world_wrench(
    py: Python<'_>,
    #[pyo3(from_py_with = self::any)] body: Py<PyAny>,
    #[pyo3(from_py_with = wanted)] wrench: [f64; 6],
) -> PyResult<PyScene> {
    let body = self::body(py, body.bind(py))?;
    finite(
        py,
        PyScene::of(Spec::WorldWrench { body, wrench }),
        &[&wrench],
    )
}

/// Points of bodies that touch a plane n·x = height (m), n being ``normal``, a vector of length 1:
/// stiffness N/m, damping N·s/m from ``damping_depth`` m on, coefficient of friction, and the speed
/// below which friction sticks, m/s.
#[pyfunction(name = "Contact")]
#[pyo3(signature = (points, normal, height, stiffness, damping, damping_depth, friction, slip_tolerance))]
#[allow(
    clippy::too_many_arguments,
    reason = "the model has as many parameters, which have names in Python"
)]
fn contact(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] points: Vec<(Bound<'_, PyAny>, [f64; 3])>,
    #[pyo3(from_py_with = wanted)] normal: [f64; 3],
    #[pyo3(from_py_with = wanted)] height: f64,
    #[pyo3(from_py_with = wanted)] stiffness: f64,
    #[pyo3(from_py_with = wanted)] damping: f64,
    #[pyo3(from_py_with = wanted)] damping_depth: f64,
    #[pyo3(from_py_with = wanted)] friction: f64,
    #[pyo3(from_py_with = wanted)] slip_tolerance: f64,
) -> PyResult<PyScene> {
    wide(py, "Contact", &[damping_depth, slip_tolerance])?;
    unit(py, "Contact", "normal", normal)?;
    let points: PyResult<Vec<_>> = points
        .iter()
        .map(|(on, point)| Ok((body(py, on)?, *point)))
        .collect();
    let values = [height, stiffness, damping, friction, slip_tolerance];
    let points = points?;
    let places: Vec<f64> = points.iter().flat_map(|(_, point)| *point).collect();
    let scene = PyScene::of(Spec::Contact {
        points,
        normal,
        values,
        damping_depth,
    });
    finite(py, scene, &[&normal, &values, &places])
}

/// Adds all of them to a module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyScene>()?;
    let rigid_body = PyScene {
        specs: RIGID_BODY.clone(),
    };
    module.add("RIGID_BODY", rigid_body)?;
    macro_rules! functions {
        ($($name:ident),*) => { $(module.add_function(wrap_pyfunction!($name, module)?)?;)* };
    }
    functions!(
        scene,
        gravity,
        inertia,
        coriolis,
        moving_base,
        viscous,
        coulomb,
        asymmetric_coulomb,
        stribeck,
        lugre,
        load_friction,
        spring,
        end_stops,
        cogging,
        constant_torque,
        armature,
        gyroscopic_rotors,
        payload,
        body_wrench,
        world_wrench,
        contact
    );
    Ok(())
}
