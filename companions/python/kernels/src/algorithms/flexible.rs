//! The algorithms for robots whose links bend.

use dynamics_core::effects::Elasticity;
use dynamics_core::flexible::{self, ModalFeedforward};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use super::*;
use crate::flexible::{AnyModes, MOST_MODES};

/// η, and so many of η̇ and η̈, from this argument on.
#[inline(always)]
fn bent<R: Real>(
    row: &impl Row<R>,
    modes: &AnyModes,
    input: usize,
    given: usize,
) -> State<R, MOST_MODES, MOST_MODES> {
    let part = |k: usize| match k < given {
        true => filled(row, input + k, modes.count),
        false => [R::ZERO; MOST_MODES],
    };
    State { q: part(0), qd: part(1), qdd: part(2) }
}

/// Calls a function of the scene with the elasticity of the links.
macro_rules! flexible {
    ($(#[$doc:meta])* $name:ident { $($field:ident: $type:ty),* }, |$this:ident, $robot:ident, $counts:ident, $modes:ident, $scene:ident, $row:ident| $body:expr) => {
        algorithm! {
            $(#[$doc])*
            $name<'a> { modes: &'a AnyModes $(, $field: $type)* }, bending,
            |$this, $robot, $counts, scene, $row| {
                let $modes = $this.modes.get::<R>();
                let $scene = &(Scene::<R, V, true, true, X, false>(parts_of(scene), true), Elasticity);
                $body
            }
        }
    };
}

flexible! {
    /// Torques of the joints and forces on the modes, of the states of both.
    FlexibleRnea {}, |this, robot, counts, modes, scene, row| {
        let state = state(row, counts, 3);
        let found = flexible::rnea(robot, modes, &state, &bent(row, this.modes, 3, 3), scene);
        put(row, 0, 0, &found.joints[..counts.v]);
        put(row, 1, 0, &found.modes[..this.modes.count]);
    }
}

flexible! {
    /// M of joints and modes in blocks, of q and η.
    FlexibleCrba {}, |this, robot, counts, modes, scene, row| {
        let (q, count) = (filled::<R, Q>(row, 0, counts.q), this.modes.count);
        let found = flexible::crba(robot, modes, &q, &filled(row, 1, count), scene);
        put_matrix(row, 0, &found.joints, counts.v);
        put_rows(row, 1, &found.coupling[..count], counts.v);
        put_matrix(row, 2, &found.modes, count);
    }
}

flexible! {
    /// Natural frequencies of the modes with the joints clamped, of q and η.
    Frequencies {}, |this, robot, counts, modes, scene, row| {
        let (q, count) = (filled::<R, Q>(row, 0, counts.q), this.modes.count);
        let inertia = flexible::crba(robot, modes, &q, &filled(row, 1, count), scene);
        put(row, 0, 0, &modes.frequencies(&inertia)?[..count]);
    }
}

flexible! {
    /// q̈ and η̈ of q, q̇, τ, η and η̇.
    FlexibleForward {}, |this, robot, counts, modes, scene, row| {
        let (state, tau) = (state(row, counts, 2), filled(row, 2, counts.v));
        let bent = bent(row, this.modes, 3, 2);
        let found = flexible::forward_dynamics(robot, modes, &state, &bent, &tau, scene)?;
        put(row, 0, 0, &found.joints[..counts.v]);
        put(row, 1, 0, &found.modes[..this.modes.count]);
    }
}

flexible! {
    /// η̈ along a motion of the joints.
    ModalDynamics {}, |this, robot, counts, modes, scene, row| {
        let bent = bent(row, this.modes, 3, 2);
        let found = flexible::modal_dynamics(robot, modes, &state(row, counts, 3), &bent, scene)?;
        put(row, 0, 0, &found[..this.modes.count]);
    }
}

flexible! {
    /// η at rest, of q.
    ModesAtRest {}, |this, robot, counts, modes, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let found = ModalFeedforward::at_rest(robot, modes, &q, scene)?;
        put(row, 0, 0, &found.bent.q[..this.modes.count]);
    }
}

flexible! {
    /// Torques along a reference at a tick, and η, η̇ and η̈ after it.
    FeedforwardTick { h: f64 }, |this, robot, counts, modes, scene, row| {
        let mut feedforward = ModalFeedforward { bent: bent(row, this.modes, 3, 3) };
        let (reference, h) = (state(row, counts, 3), R::from_f64(this.h));
        let tau = feedforward.tick(robot, modes, &reference, scene, h)?;
        put(row, 0, 0, &tau[..counts.v]);
        let State { q, qd, qdd } = feedforward.bent;
        for (i, values) in [q, qd, qdd].iter().enumerate() {
            put(row, 1 + i, 0, &values[..this.modes.count]);
        }
    }
}
