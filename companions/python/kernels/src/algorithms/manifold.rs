//! Configurations: their differences and sums with velocities.

use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;
use dynamics_core::state::manifold;

use super::*;

algorithm! {
    /// The configuration q ⊕ δ that a step δ leads to.
    Integrate, none, |this, robot, counts, scene, row| {
        let (q, delta) = (filled::<R, Q>(row, 0, counts.q), filled::<R, V>(row, 1, counts.v));
        let found = manifold::integrate(robot, &q, &delta);
        put(row, 0, 0, &found[..counts.q]);
    }
}

algorithm! {
    /// q with quaternions of unit length, and angles of continuous joints within half a turn.
    Normalise, none, |this, robot, counts, scene, row| {
        let mut q = filled::<R, Q>(row, 0, counts.q);
        manifold::normalise(robot, &mut q)?;
        put(row, 0, 0, &q[..counts.q]);
    }
}

algorithm! {
    /// The step q₁ ⊖ q₀ between two configurations.
    Difference, none, |this, robot, counts, scene, row| {
        let (from, to) = (filled::<R, Q>(row, 0, counts.q), filled::<R, Q>(row, 1, counts.q));
        let found = manifold::difference(robot, &from, &to);
        put(row, 0, 0, &found[..counts.v]);
    }
}

algorithm! {
    /// The configuration of rest.
    Neutral, none, |this, robot, counts, scene, row| {
        put(row, 0, 0, &manifold::neutral::<R, D, B, Q, V>(robot)[..counts.q]);
    }
}
