//! The regressors: torques are linear in inertial parameters and in coefficients of friction.

use dynamics_core::algorithms;
use dynamics_core::effects::Width;
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use super::*;

/// q, q̇ and q̈ of a row, of which a scene's terms see so many.
#[inline(always)]
fn felt<R: Real, const Q: usize, const V: usize>(
    row: &impl Row<R>,
    counts: Counts,
    parts: &Parts<R, V>,
) -> State<R, Q, V> {
    let state = state(row, counts, 3);
    let none = [R::ZERO; V];
    let Terms { inertia, coriolis, .. } = parts.terms;
    State {
        qd: if coriolis { state.qd } else { none },
        qdd: if inertia { state.qdd } else { none },
        ..state
    }
}

algorithm! {
    /// Y with τ = Y φ, of the bodies from the first to the one before the end.
    Regressor { first: usize, end: usize }, rigid, |this, robot, counts, scene, row| {
        let state = felt(row, counts, parts_of(scene));
        let bodies = this.end - this.first;
        for body in this.first..this.end {
            let columns = algorithms::regressor_columns(robot, &state, scene, body);
            for (i, parameters) in columns.iter().enumerate().take(counts.v) {
                put(row, 0, (i * bodies + body - this.first) * 10, parameters);
            }
        }
    }
}

algorithm! {
    /// The row of Y of a velocity coordinate.
    RegressorRow { coordinate: usize }, rigid, |this, robot, counts, scene, row| {
        let state = felt(row, counts, parts_of(scene));
        let found = algorithms::regressor_row(robot, &state, scene, this.coordinate);
        put(row, 0, 0, found[..counts.bodies].as_flattened());
    }
}

algorithm! {
    /// The inertial parameters φ of all bodies.
    InertialParameters, rigid, |this, robot, counts, scene, row| {
        let found = algorithms::inertial_parameters(robot, scene);
        put(row, 0, 0, found[..counts.bodies].as_flattened());
    }
}

algorithm! {
    /// The columns of viscous and of Coulomb friction of q̇.
    FrictionRegressor { width: f64 }, none, |this, robot, counts, scene, row| {
        let (qd, width) = (filled::<R, V>(row, 0, counts.v), R::from_f64(this.width));
        let found = algorithms::friction_regressor(&qd, Width::new(width));
        put(row, 0, 0, found[..counts.v].as_flattened());
    }
}
