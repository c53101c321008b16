//! Effects as Python sees them: a scene is immutable, and scenes are added.

use std::hash::{Hash, Hasher};
use std::ops::Deref;
use std::sync::{Arc, LazyLock};

use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

use crate::arrays::{Argument, Dtype, arrays_of, dtype};
use crate::error::{Exception, wanted};
use crate::robot::{Array, argument};
use robot_dynamics_kernels::spec::{
    BodyRef, List, Nonzero, Number, Six, Spec, Table, Three, Unit, Wide,
};

/// Effects that act together on a robot.
///
/// An effect such as ``Gravity()`` is a scene of one; ``a + b`` has the effects of both. A function
/// that takes a scene takes a tuple of scenes, too. Two effects of a kind that cannot mean two
/// things are refused, as in the library.
#[pyclass(frozen, module = "robot_dynamics", name = "Scene", eq, hash)]
#[derive(Clone)]
pub struct PyScene {
    pub specs: Arc<Vec<Spec>>,
    /// Functions of `OwnEffect`.
    pub own: Arc<Vec<Py<PyAny>>>,
}

impl PartialEq for PyScene {
    fn eq(&self, other: &Self) -> bool {
        let same = |py: Python<'_>| {
            let mut each = self.own.iter().zip(&*other.own);
            each.all(|(a, b)| a.bind(py).eq(b).unwrap_or(false))
        };
        self.specs == other.specs && self.own.len() == other.own.len() && Python::attach(same)
    }
}

impl Hash for PyScene {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // Zeros of both signs are equal, and so is their text here.
        format!("{:?}", self.specs).replace('-', "").hash(state);
    }
}

impl Deref for PyScene {
    type Target = [Spec];
    fn deref(&self) -> &[Spec] {
        &self.specs
    }
}

impl From<Arc<Vec<Spec>>> for PyScene {
    fn from(specs: Arc<Vec<Spec>>) -> Self {
        Self { specs, own: NO_OWN.clone() }
    }
}

static NO_OWN: LazyLock<Arc<Vec<Py<PyAny>>>> = LazyLock::new(Arc::default);

/// Gravity of the earth, inertia and velocity products.
pub static RIGID_BODY: LazyLock<Arc<Vec<Spec>>> = LazyLock::new(|| {
    let gravity = Spec::Gravity([0.0, 0.0, -9.81]);
    Arc::new(vec![gravity, Spec::Inertia, Spec::Coriolis])
});

impl PyScene {
    /// Refuses numbers that are not finite: a scene is a constant, and NaN in it would be in every
    /// result.
    fn of(py: Python<'_>, spec: Spec) -> PyResult<Self> {
        if !spec.all_finite() {
            let text = format!("{}: a number is not finite", spec.name());
            return Err(refused(py, spec.name(), text));
        }
        if spec.is_negative_friction() {
            let text = format!("{}: friction below zero would drive the joint", spec.name());
            return Err(refused(py, spec.name(), text));
        }
        Ok(Arc::new(vec![spec]).into())
    }

    /// The effects of scenes together.
    pub fn checked(py: Python<'_>, scenes: &[Self]) -> PyResult<Self> {
        let specs: Vec<Spec> = scenes.iter().flat_map(|scene| scene.specs.to_vec()).collect();
        for (i, spec) in specs.iter().enumerate() {
            let again = specs[..i].iter().any(|other| other.name() == spec.name());
            if again && !spec.may_repeat() {
                let effect = spec.name();
                let message = format!(
                    "the scene contains {effect} twice: write one with the sum of both, or leave one out"
                );
                return Err(refused(py, effect, message));
            }
        }
        let own = scenes.iter().flat_map(|scene| scene.own.iter());
        let own = own.map(|function| function.clone_ref(py)).collect();
        Ok(Self { specs: Arc::new(specs), own: Arc::new(own) })
    }

    /// The torques of its functions at q and q̇, the first arguments of a call, in float64: none if
    /// it has no functions. Each is called once.
    pub fn own_torque<'py>(
        &self,
        py: Python<'py>,
        arguments: &[Argument<'_, 'py>],
    ) -> PyResult<Option<Array<'py>>> {
        if self.own.is_empty() {
            return Ok(None);
        }
        let refuse = |text: String| Err(refused(py, "OwnEffect", format!("OwnEffect: {text}")));
        if dtype(arguments)? == Dtype::Single {
            return refuse("it is computed in float64: arrays have to be float64".to_owned());
        }
        let (leading, arrays) = arrays_of::<f64>(arguments)?;
        let width = arguments[1].width();
        let mut sum =
            PyArrayDyn::<f64>::zeros(py, [&*leading, &[width]].concat(), false).into_any();
        for function in &*self.own {
            let given = function.bind(py).call1((&*arrays[0], &*arrays[1]))?;
            let (own, found) = arrays_of::<f64>(&[argument("OwnEffect", &given, width)])?;
            if own != leading && !own.is_empty() {
                return refuse(format!(
                    "its torques have the leading axes {own:?}, not {leading:?}"
                ));
            }
            sum = sum.add(&*found[0])?;
        }
        Ok(Some(sum))
    }
}

/// An effect that cannot be.
pub fn refused(py: Python<'_>, effect: &str, text: impl Into<String>) -> PyErr {
    let error = Exception::new(py, "EffectError", text);
    error.with("effect", effect).build()
}

/// The effects of an argument, without `OwnEffect`: none are those of a rigid body.
pub fn given(argument: Option<&Bound<'_, PyAny>>) -> PyResult<PyScene> {
    let scene = with_own(argument)?;
    match argument {
        Some(argument) if !scene.own.is_empty() => {
            let text = "OwnEffect acts in rnea, bias, aba and forward_dynamics of a Robot alone";
            Err(refused(argument.py(), "OwnEffect", text))
        }
        _ => Ok(scene),
    }
}

/// The effects of an argument: none are those of a rigid body.
pub fn with_own(argument: Option<&Bound<'_, PyAny>>) -> PyResult<PyScene> {
    let Some(argument) = argument else {
        return Ok(RIGID_BODY.clone().into());
    };
    if let Ok(scene) = argument.cast::<PyScene>() {
        return Ok(scene.get().clone());
    }
    let py = argument.py();
    let several = argument.is_instance_of::<PyTuple>() || argument.is_instance_of::<PyList>();
    let mut scenes = Vec::new();
    let items = if several { argument.try_iter().ok() } else { None };
    for item in items.into_iter().flatten() {
        match item?.cast::<PyScene>() {
            Ok(scene) => scenes.push(scene.get().clone()),
            Err(_) => return Err(no_effect(py)),
        }
    }
    if !several {
        return Err(no_effect(py));
    }
    PyScene::checked(py, &scenes)
}

fn no_effect(py: Python<'_>) -> PyErr {
    let text = "effects are a Scene such as Gravity() + Inertia(), or a tuple of them";
    refused(py, "", text)
}

#[pymethods]
impl PyScene {
    /// The effects of all scenes.
    #[new]
    #[pyo3(signature = (*scenes))]
    fn new(scenes: &Bound<'_, PyTuple>) -> PyResult<Self> {
        with_own(Some(scenes.as_any()))
    }

    fn __add__(&self, other: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::checked(other.py(), &[self.clone(), with_own(Some(other))?])
    }

    fn __radd__(&self, other: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::checked(other.py(), &[with_own(Some(other))?, self.clone()])
    }

    fn __len__(&self) -> usize {
        self.names().len()
    }

    fn __contains__(&self, name: &str) -> bool {
        self.names().contains(&name)
    }

    fn __repr__(&self) -> String {
        let mut names: Vec<String> = self.specs.iter().map(|spec| format!("{spec:?}")).collect();
        names.extend(self.own.iter().map(|function| format!("OwnEffect({function})")));
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
        let own: Vec<_> = self.own.iter().map(|function| function.bind(py)).collect();
        (maker, (text, own)).into_pyobject(py)
    }

    /// The names of its effects, in their order.
    #[getter]
    fn names(&self) -> Vec<&'static str> {
        let own = self.own.iter().map(|_| "OwnEffect");
        self.specs.iter().map(Spec::name).chain(own).collect()
    }
}

/// The scene of effects that were pickled.
#[pyfunction(name = "_scene")]
#[pyo3(signature = (effects, own = None))]
fn scene(py: Python<'_>, effects: &str, own: Option<Vec<Py<PyAny>>>) -> PyResult<PyScene> {
    let specs: Vec<Spec> = serde_json::from_str(effects).map_err(|error| of_pickle(py, &error))?;
    let own = Arc::new(own.unwrap_or_default());
    PyScene::checked(py, &[PyScene { specs: Arc::new(specs), own }])
}

/// A torque of one's own: ``function(q, qd)`` returns the torques (…, nv), N·m or N, that motors
/// supply, as of `Viscous`, for q (…, nq) and q̇ (…, nv) of all states of a call at once, float64.
///
/// It acts in `rnea`, `bias`, `aba` and `forward_dynamics` of a `Robot`.
#[pyfunction(name = "OwnEffect")]
fn own_effect(function: &Bound<'_, PyAny>) -> PyResult<PyScene> {
    if !function.is_callable() {
        let text = "OwnEffect: it needs a function of q and q̇";
        return Err(refused(function.py(), "OwnEffect", text));
    }
    Ok(PyScene { specs: Arc::default(), own: Arc::new(vec![function.clone().unbind()]) })
}

fn of_pickle(py: Python<'_>, error: &serde_json::Error) -> PyErr {
    refused(py, "", format!("pickle: {error}"))
}

/// A body by its number or its name.
struct OnBody(BodyRef);

impl<'py> FromPyObject<'_, 'py> for OnBody {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(number) = given.extract::<usize>() {
            return Ok(Self(BodyRef::Number(number)));
        }
        let name = given.extract::<String>().map_err(|_| {
            let text = "a body is a name or a number from 0";
            let error = Exception::new(given.py(), "UnknownBody", text);
            error.with("body", &*given).build()
        })?;
        Ok(Self(BodyRef::Name(name)))
    }
}

/// Refuses a width of zero, which would divide by it.
pub fn wide(py: Python<'_>, effect: &str, width: f64) -> PyResult<()> {
    if width.is_finite() && width != 0.0 {
        return Ok(());
    }
    let text = format!("{effect}: a width or speed is zero or not finite");
    Err(refused(py, effect, text))
}

/// Refuses a direction that has not the length 1.
fn unit(py: Python<'_>, effect: &str, what: &str, direction: [f64; 3]) -> PyResult<()> {
    let squared: f64 = direction.iter().map(|x| x * x).sum();
    // NaN is in no range.
    if (1.0 - 1e-9..=1.0 + 1e-9).contains(&squared) {
        return Ok(());
    }
    let length = squared.sqrt();
    let text = format!("{effect}: a {what} is a vector of length 1, not {length}");
    Err(refused(py, effect, text))
}

/// Gravity: ``g`` in m/s² along ``direction`` in the base's axes, a vector of length 1.
#[pyfunction(name = "Gravity")]
#[pyo3(signature = (g = 9.81, direction = [0.0, 0.0, -1.0]), text_signature = "(g=9.81, direction=[0.0, 0.0, -1.0])")]
fn gravity(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted)] g: f64,
    #[pyo3(from_py_with = wanted)] direction: [f64; 3],
) -> PyResult<PyScene> {
    unit(py, "Gravity", "direction", direction)?;
    PyScene::of(py, Spec::Gravity(direction.map(|x| x * g)))
}

/// The products of inertia and acceleration, M q̈.
#[pyfunction(name = "Inertia")]
fn inertia(py: Python<'_>) -> PyResult<PyScene> {
    PyScene::of(py, Spec::Inertia)
}

/// The products of velocities, C(q, q̇) q̇.
#[pyfunction(name = "Coriolis")]
fn coriolis(py: Python<'_>) -> PyResult<PyScene> {
    PyScene::of(py, Spec::Coriolis)
}

/// Functions that make the effects of the table, and what adds them to a module.
macro_rules! functions {
    (@from BodyRef) => { OnBody };
    (@from Points) => { Vec<(OnBody, Three)> };
    (@from $kind:ident) => { $kind };
    (@take BodyRef $given:ident) => { $given.0 };
    (@take Points $given:ident) => {
        $given.into_iter().map(|(OnBody(body), point)| (body, point)).collect()
    };
    (@take $kind:ident $given:ident) => { $given };
    (@check Wide $py:ident $name:ident $given:ident) => { wide($py, stringify!($name), $given)? };
    (@check Nonzero $py:ident $name:ident $given:ident) => { wide($py, stringify!($name), $given)? };
    (@check Unit $py:ident $name:ident $given:ident) => {
        unit($py, stringify!($name), stringify!($given), $given)?
    };
    (@check $kind:ident $py:ident $name:ident $given:ident) => {};
    ($($(#[$doc:meta])* $name:ident {
        $($field:ident: $kind:ident $(= $default:expr)?),*
    } $($text:literal)?)*) => {
        $(
            $(#[$doc])*
            #[pyfunction]
            #[pyo3(signature = ($($field $(= $default)?),*) $(, text_signature = $text)?)]
            #[allow(non_snake_case, clippy::too_many_arguments, reason = "names in Python")]
            fn $name(
                py: Python<'_>,
                $(#[pyo3(from_py_with = wanted)] $field: functions!(@from $kind)),*
            ) -> PyResult<PyScene> {
                $(functions!(@check $kind py $name $field);)*
                PyScene::of(py, Spec::$name { $($field: functions!(@take $kind $field)),* })
            }
        )*

        fn add_functions(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_function(wrap_pyfunction!($name, module)?)?;)*
            Ok(())
        }
    };
}

robot_dynamics_kernels::effects!(functions);

/// Adds all of them to a module.
pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyScene>()?;
    let rigid_body = PyScene::from(RIGID_BODY.clone());
    module.add_function(wrap_pyfunction!(own_effect, module)?)?;
    module.add("RIGID_BODY", rigid_body)?;
    module.add_function(wrap_pyfunction!(scene, module)?)?;
    module.add_function(wrap_pyfunction!(gravity, module)?)?;
    module.add_function(wrap_pyfunction!(inertia, module)?)?;
    module.add_function(wrap_pyfunction!(coriolis, module)?)?;
    add_functions(module)
}
