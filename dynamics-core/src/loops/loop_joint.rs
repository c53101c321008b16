//! The description of one loop: its joint, and the frames on two bodies that it joins.

use glam::DMat3;

use super::error::LoopProblem;
use super::joint_constraint::counts;
use crate::algorithms::Pose;
use crate::math::const_eval as m;
use crate::model::{BASE, Joint};

/// A frame that is fixed on a body, one end of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyFrame {
    pub(super) body: usize,
    pub(super) position: [f64; 3],
    pub(super) rotation: DMat3,
    /// The largest of roll, pitch and yaw, rad.
    largest_angle: f64,
}

impl BodyFrame {
    /// The body's own frame. `body` is an index in the model's list, or [`BASE`].
    pub const fn new(body: usize) -> Self {
        Self { body, position: [0.0; 3], rotation: DMat3::IDENTITY, largest_angle: 0.0 }
    }

    /// Its origin in the body's frame, m.
    pub const fn xyz(mut self, position: [f64; 3]) -> Self {
        self.position = position;
        self
    }

    /// Its attitude in the body's frame, as [`crate::model::Body::rpy`].
    pub const fn rpy(mut self, rpy: [f64; 3]) -> Self {
        self.largest_angle = rpy[0].abs().max(rpy[1].abs()).max(rpy[2].abs());
        self.rotation = m::rotation(m::sin_cos(rpy[0]), m::sin_cos(rpy[1]), m::sin_cos(rpy[2]));
        self
    }

    /// The same in quarter turns, exactly.
    pub const fn quarter_turns(mut self, rpy: [i32; 3]) -> Self {
        self.largest_angle = 0.0;
        self.rotation = m::rotation(m::quarter(rpy[0]), m::quarter(rpy[1]), m::quarter(rpy[2]));
        self
    }

    /// The body that it is fixed on.
    pub const fn body(&self) -> usize {
        self.body
    }

    /// Its pose in the body's own frame.
    pub const fn pose(&self) -> Pose<f64> {
        Pose { rot: self.rotation, pos: m::vec3(self.position) }
    }

    const fn problem(&self, bodies: usize) -> Option<LoopProblem> {
        if self.body != BASE && self.body >= bodies {
            return Some(LoopProblem::NoBody(self.body));
        }
        let [x, y, z] = self.position;
        let sum = x * 0.0 + y * 0.0 + z * 0.0 + self.largest_angle * 0.0;
        if sum != 0.0 || !self.rotation.x_axis.x.is_finite() {
            return Some(LoopProblem::NotFinite);
        }
        if self.largest_angle > core::f64::consts::TAU {
            return Some(LoopProblem::Angle);
        }
        None
    }
}

/// A joint that closes a loop, between a predecessor and a successor.
///
/// Any kind of [`Joint`]; its axes are given in the loop frames. If the joint's coordinates are
/// zero, the frame on the successor coincides with that on the predecessor. Which of two bodies is
/// the predecessor matters for the sign of its force, and for the first axis of a universal joint,
/// which is fixed on the predecessor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopJoint {
    pub(super) name: &'static str,
    pub(super) joint: Joint<f64>,
    pub(super) ends: [BodyFrame; 2],
}

impl LoopJoint {
    /// A joint from a frame on the predecessor to one on the successor.
    pub const fn new(name: &'static str, joint: Joint<f64>, ends: [BodyFrame; 2]) -> Self {
        Self { name, joint, ends }
    }

    /// Its name.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The joint, its axes in the loop frames.
    pub const fn joint(&self) -> &Joint<f64> {
        &self.joint
    }

    /// The frames on its predecessor and on its successor.
    pub const fn ends(&self) -> &[BodyFrame; 2] {
        &self.ends
    }

    /// Its predecessor and its successor, as indices in the model's list or [`BASE`].
    pub const fn bodies(&self) -> [usize; 2] {
        [self.ends[0].body, self.ends[1].body]
    }

    /// The mistake in it in a model of this many bodies, whatever their sizes.
    pub(super) const fn problem(&self, bodies: usize) -> Option<LoopProblem> {
        let mut end = 0;
        while end < 2 {
            if let Some(problem) = self.ends[end].problem(bodies) {
                return Some(problem);
            }
            end += 1;
        }
        if self.ends[0].body == self.ends[1].body {
            return Some(LoopProblem::SameBody);
        }
        if let Some(problem) = self.joint.problem() {
            return Some(LoopProblem::Joint(problem));
        }
        let [rotations, translations] = counts(self.joint.kind);
        if rotations + translations == 0 {
            return Some(LoopProblem::Unconstrained);
        }
        None
    }
}
