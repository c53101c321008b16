//! The quantities of a hard case with loops, and their digests.

use dynamics_core::Core;
use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::{Coriolis, GravityVector, Inertia};
use dynamics_core::loops::{
    LoopError, Stabilisation, assemble, forward_dynamics, inverse_dynamics,
};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::state::State;
use firmware_demo::digest::Digest;

use super::super::GRAVITY;
use super::{FourBar, LoopProblem, PROBLEMS, RIG, Start};

pub type Scene<R> = (GravityVector<R>, Inertia, Coriolis);

/// A field of [`GRAVITY`] down.
pub fn scene<R: Real>() -> Scene<R> {
    let g = R::Vec3::new(R::ZERO, R::ZERO, R::from_f64(-GRAVITY));
    (GravityVector(g), Inertia, Coriolis)
}

/// An error in numbers.
fn numbers(error: LoopError) -> [f32; 2] {
    match error {
        LoopError::Open { error, .. } => [1.0, error as f32],
        LoopError::UnderActuated { joint, .. } => [2.0, joint as f32],
        LoopError::NotFinite { .. } => [3.0, 0.0],
        LoopError::NotPositiveDefinite(error) => [4.0, error.joint as f32],
        _ => [5.0, 0.0],
    }
}

/// Everything of a problem in f32: assembly, and inverse and forward dynamics where it ends.
#[inline(never)]
fn of_loops<const N: usize, const A: usize>(problem: &LoopProblem<N, A>) -> Digest {
    let (robot, loops, scene) = (problem.single, problem.loops, scene());
    let mut digest = Digest::EMPTY;
    for &[guess, qd, qdd] in problem.starts {
        let closed = match assemble(robot, loops, &guess, problem.moving) {
            Ok(closed) => closed.q,
            Err(error) => {
                digest.add(numbers(error));
                guess
            }
        };
        digest.add(closed);
        let mut state = State { q: closed, qd, qdd };
        let mut tau = [1.0; A];
        match inverse_dynamics(robot, loops, &state, &scene) {
            Ok(found) => {
                digest.add(found.tau);
                digest.add(found.lambda);
                digest.add(found.state.qdd);
                (state.qd, tau) = (found.state.qd, found.tau);
            }
            Err(error) => digest.add(numbers(error)),
        }
        match forward_dynamics(robot, loops, &state, &tau, Stabilisation::NONE, &scene) {
            Ok(found) => {
                digest.add(found.qdd);
                digest.add(found.lambda);
            }
            Err(error) => digest.add(numbers(error)),
        }
    }
    digest
}

/// The same of a four-bar as a cluster.
#[inline(never)]
fn of_cluster<const K: usize>(starts: &[Start<3>]) -> Digest
where
    FourBar<K>: ClusteredRobot<3, 3, 3, 1, 1>,
{
    let mut digest = Digest::EMPTY;
    for [q, qd, qdd] in starts.iter().map(|numbers| numbers.map(|[y, ..]| [y])) {
        let (y, scene) = (State { q, qd, qdd }, scene::<f32>());
        let tau = Clustered::<Core<FourBar<K>>>::rnea(&y, &scene);
        digest.add(tau.unwrap_or([f32::NAN]));
        let ydd = Clustered::<Core<FourBar<K>>>::aba(&y, &[1.0], &scene);
        digest.add(ydd.unwrap_or([f32::NAN]));
    }
    digest
}

/// Calls `report` with each problem's case and name, and the digest of all that is computed of it.
pub fn digests(mut report: impl FnMut(u32, &'static str, Digest)) {
    for problem in &PROBLEMS {
        report(problem.case, problem.name, of_loops(problem));
        // The code of the other linkages would be the same.
        let cluster = match problem.linkage {
            Some(1) => of_cluster::<1>(problem.starts),
            Some(2) => of_cluster::<2>(problem.starts),
            Some(5) => of_cluster::<5>(problem.starts),
            Some(7) => of_cluster::<7>(problem.starts),
            _ => continue,
        };
        report(problem.case, "as a cluster", cluster);
    }
    report(RIG.case, RIG.name, of_loops(&RIG));
}
