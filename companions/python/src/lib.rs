//! The extension module `robot_dynamics._native`: the algorithms of `dynamics-core` over numpy's
//! arrays.

mod angles;
mod arrays;
mod compute;
mod costs;
mod effects;
mod error;
mod failure;
mod flexible;
mod goal;
mod identify;
mod library;
mod linkages;
mod loops;
mod methods;
mod names;
mod request;
mod robot;
mod sensor;
mod thermal;

use pyo3::prelude::*;

/// The names of the library's robots.
#[pyfunction]
fn robots() -> Vec<&'static str> {
    library::ROBOTS.iter().map(|(name, _)| *name).collect()
}

/// The number of threads that a batch uses.
#[pyfunction]
fn threads() -> usize {
    robot_dynamics_kernels::job::cores()
}

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<robot::Robot>()?;
    module.add_class::<robot::said::PyAdvice>()?;
    module.add_class::<robot::said::PyCoupling>()?;
    module.add_function(wrap_pyfunction!(robot::pickled::robot, module)?)?;
    module.add_class::<costs::Cost>()?;
    module.add_class::<loops::PyLoopJoint>()?;
    module.add_class::<loops::PyLoops>()?;
    module.add_class::<goal::PyMovingGoal>()?;
    module.add_class::<robot::tip::PyPoseSolver>()?;
    module.add_class::<robot::tip::PyTipMotion>()?;
    module.add_class::<sensor::PySensorLoad>()?;
    module.add_class::<thermal::PyThermalLimit>()?;
    module.add_function(wrap_pyfunction!(identify::identify, module)?)?;
    module.add_function(wrap_pyfunction!(robots, module)?)?;
    module.add_function(wrap_pyfunction!(threads, module)?)?;
    linkages::register(module)?;
    flexible::register(module)?;
    effects::register(module)
}
