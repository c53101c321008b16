//! Torques, poses and inertia of a model that is built at run time.

use dynamics_core::algorithms::{crba, poses, rnea};
use dynamics_core::effects::{Gravity, Inertia, RIGID_BODY};
use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
use dynamics_core::model::{BASE, Joint};
use dynamics_core::state::State;

use super::{AnyModel, Motion, Sized};
use crate::description::{Kind, Pose};
use crate::loops::Closed;
use crate::number::Attitude;
use crate::rows::{Rows, rows};

impl AnyModel {
    /// The poses of its bodies in the base's frame at q, and of the fillers.
    pub fn poses(&self, q: &[f64]) -> Vec<Rows<f64>> {
        match self {
            Self::Small(model) => model.poses(q),
            Self::Middle(model) => model.poses(q),
            Self::Large(model) => model.poses(q),
        }
    }

    /// Why the library refuses a loop on the bodies, if it does.
    pub fn problem_of(&self, closed: &Closed) -> Option<String> {
        match self {
            Self::Small(model) => model.problem_of(closed),
            Self::Middle(model) => model.problem_of(closed),
            Self::Large(model) => model.problem_of(closed),
        }
    }

    /// The torques that hold it at rest at q, N·m or N.
    pub fn gravity(&self, q: &[f64]) -> Vec<f64> {
        match self {
            Self::Small(model) => model.gravity(q),
            Self::Middle(model) => model.gravity(q),
            Self::Large(model) => model.gravity(q),
        }
    }

    /// Inverse dynamics at a state, N·m or N.
    pub fn torque(&self, motion: &Motion) -> Vec<f64> {
        match self {
            Self::Small(model) => model.torque(motion),
            Self::Middle(model) => model.torque(motion),
            Self::Large(model) => model.torque(motion),
        }
    }

    /// The torques, computed in f32.
    pub fn torque_f32(&self, motion: &Motion) -> Vec<f64> {
        match self {
            Self::Small(model) => model.torque_f32(motion),
            Self::Middle(model) => model.torque_f32(motion),
            Self::Large(model) => model.torque_f32(motion),
        }
    }

    /// M of its v velocity coordinates at q, row by row.
    pub fn inertia(&self, q: &[f64], v: usize) -> Vec<Vec<f64>> {
        match self {
            Self::Small(model) => model.inertia(q, v),
            Self::Middle(model) => model.inertia(q, v),
            Self::Large(model) => model.inertia(q, v),
        }
    }
}

impl<const N: usize, const Q: usize> Sized<N, Q> {
    /// q with the unit quaternions (x, y, z, w) of the fillers.
    fn position(&self, q: &[f64]) -> [f64; Q] {
        let mut filled = filled::<Q>(q);
        let fillers = filled[q.len()..].chunks_mut(4).take(self.balls);
        fillers.for_each(|quaternion| quaternion[3] = 1.0);
        filled
    }

    fn poses(&self, q: &[f64]) -> Vec<Rows<f64>> {
        let poses = poses(&self.exact, &self.position(q));
        let rows = poses.map(|pose| rows(&Pose { position: pose.pos, rotation: pose.rot }));
        rows.to_vec()
    }

    fn problem_of(&self, closed: &Closed) -> Option<String> {
        let joint = match closed.kind {
            Kind::Fixed => Joint::fixed(),
            _ => Joint::spherical(),
        };
        let ends = closed.ends.map(|(body, xyz, attitude)| {
            let frame = BodyFrame::new(body.unwrap_or(BASE)).xyz(xyz);
            match attitude {
                Attitude::QuarterTurns(turns) => frame.quarter_turns(turns),
                Attitude::Rpy(rpy) => frame.rpy(rpy),
            }
        });
        let joint = [LoopJoint::new("loop", joint, ends)];
        // All coordinates are actuated here: their number is looked at elsewhere.
        let all = std::array::from_fn(|i| i);
        let refused = match closed.kind {
            Kind::Fixed => Loops::<1, 6, N>::try_new(&self.exact, joint, all).err(),
            _ => Loops::<1, 3, N>::try_new(&self.exact, joint, all).err(),
        };
        refused.map(|error| {
            let text = error.to_string();
            let problem = text.strip_prefix("loop `loop`: ").map(str::to_owned);
            problem.unwrap_or(text)
        })
    }

    fn gravity(&self, q: &[f64]) -> Vec<f64> {
        let torque = rnea(&self.exact, &State::at(self.position(q)), &Gravity::EARTH);
        torque[..q.len()].to_vec()
    }

    fn torque(&self, motion: &Motion) -> Vec<f64> {
        let state =
            State { q: self.position(&motion.q), qd: filled(&motion.qd), qdd: filled(&motion.qdd) };
        rnea(&self.exact, &state, &RIGID_BODY)[..motion.qd.len()].to_vec()
    }

    fn torque_f32(&self, motion: &Motion) -> Vec<f64> {
        let (qd, qdd) = (filled::<N>(&motion.qd), filled::<N>(&motion.qdd));
        let state = State {
            q: self.position(&motion.q).map(|x| x as f32),
            qd: qd.map(|x| x as f32),
            qdd: qdd.map(|x| x as f32),
        };
        let torque = rnea(&self.rounded, &state, &RIGID_BODY);
        let own = torque[..motion.qd.len()].iter();
        own.map(|&x| f64::from(x)).collect()
    }

    fn inertia(&self, q: &[f64], v: usize) -> Vec<Vec<f64>> {
        let m = crba(&self.exact, &self.position(q), &(Inertia,));
        let row = |i| (0..v).map(|j| m.get(i, j)).collect();
        (0..v).map(row).collect()
    }
}

/// Coordinates with zeros for the fillers.
fn filled<const N: usize>(values: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| values.get(i).copied().unwrap_or_default())
}
