//! The algorithms for robots with kinematic loops.

use dynamics_core::loops::{self, Drive, Moving, Stabilisation};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use super::*;
use crate::loops::AnyLoops;

/// Numbers of the motors in their places of all coordinates.
#[inline(always)]
fn spread<R: Real, const V: usize>(row: &impl Row<R>, input: usize, loops: &AnyLoops) -> [R; V] {
    let mut all = [R::ZERO; V];
    for (column, &joint) in loops.actuated.iter().enumerate() {
        all[joint] = row.get(input, column);
    }
    all
}

#[inline(always)]
fn count<R: Real>(number: usize) -> R {
    R::from_f64(number as f64)
}

algorithm! {
    /// q of closed loops, from a guess of which the passive coordinates move, or all.
    Assemble<'a> { loops: &'a AnyLoops, moving: Moving }, none, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let found = loops::assemble(robot, this.loops.get::<V>(), &q, this.moving)?;
        put(row, 0, 0, &found.q[..counts.q]);
    }
}

algorithm! {
    /// K, k, φ and K q̇ of q and q̇.
    LoopConstraints<'a> { loops: &'a AnyLoops }, none, |this, robot, counts, scene, row| {
        let found = loops::constraints(robot, this.loops.get::<V>(), &state(row, counts, 2));
        let rows = this.loops.rows;
        put_rows(row, 0, &found.jacobian[..rows], counts.v);
        for (i, values) in [found.bias, found.position, found.velocity].iter().enumerate() {
            put(row, 1 + i, 0, &values[..rows]);
        }
    }
}

algorithm! {
    /// G of q by rows, and the number of degrees of freedom.
    CoordinateMapOf<'a> { loops: &'a AnyLoops }, none, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let map = loops::coordinate_map(robot, this.loops.get::<V>(), &q)?;
        let motors = this.loops.motors();
        for j in 0..motors {
            let unit = std::array::from_fn(|i| if i == j { R::ONE } else { R::ZERO });
            for (i, &g) in map.velocity(&unit).iter().enumerate().take(counts.v) {
                row.put(0, i * motors + j, g);
            }
        }
        // The bodies that fill the model up move freely, and do not count.
        row.put(1, 0, count(map.degrees_of_freedom() + counts.v - V));
    }
}

algorithm! {
    /// The degrees of freedom at q, and at configurations near by.
    MobilityOf<'a> { loops: &'a AnyLoops }, none, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let found = loops::mobility(robot, this.loops.get::<V>(), &q)?;
        row.put(0, 0, count(found.here + counts.v - V));
        row.put(1, 0, count(found.usual + counts.v - V));
    }
}

algorithm! {
    /// Torques of the motors, q̇, q̈, λ, and how many motors are redundant, of q and the motors'
    /// rates and accelerations: −1 where they are near a dead point.
    LoopInverse<'a> { loops: &'a AnyLoops }, machine, |this, robot, counts, scene, row| {
        let given = State {
            qd: spread(row, 1, this.loops),
            qdd: spread(row, 2, this.loops),
            ..State::at(filled::<R, Q>(row, 0, counts.q))
        };
        let found = loops::inverse_dynamics(robot, this.loops.get::<V>(), &given, scene)?;
        put(row, 0, 0, &found.tau[..this.loops.motors()]);
        put(row, 1, 0, &found.state.qd[..counts.v]);
        put(row, 2, 0, &found.state.qdd[..counts.v]);
        put(row, 3, 0, &found.lambda[..this.loops.rows]);
        row.put(4, 0, match found.drive {
            Drive::LeastNorm { redundancy } => count(redundancy),
            Drive::Singular { .. } => -R::ONE,
            _ => R::ZERO,
        });
    }
}

algorithm! {
    /// q̈, λ and the rank of K, of q, q̇ and the motors' torques.
    LoopForward<'a> { loops: &'a AnyLoops, stabilisation: [f64; 2] }, machine,
    |this, robot, counts, scene, row| {
        let [position, velocity] = this.stabilisation.map(R::from_f64);
        let tau = filled(row, 2, this.loops.motors());
        let found = loops::forward_dynamics(
            robot,
            this.loops.get::<V>(),
            &state(row, counts, 2),
            &tau,
            Stabilisation { position, velocity },
            scene,
        )?;
        put(row, 0, 0, &found.qdd[..counts.v]);
        put(row, 1, 0, &found.lambda[..this.loops.rows]);
        row.put(2, 0, count(found.rows.rank()));
    }
}
