//! Unitree G1 with its pelvis held, and free.

mod limbs;

use crate::model::{ArmModel, BASE, Body, Joint, Model, Robot, attach_to};
use limbs::{arm, leg, waist};

/// Unitree G1 humanoid with its pelvis welded to the base: 29 revolute joints (6 a leg, 3 in the
/// waist, 7 an arm), no fingers, 29.5 kg of moving mass.
///
/// The order is left leg, right leg, waist, left arm, right arm. The base frame is the pelvis': x
/// ahead, y left, z up.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/g1_description/urdf/g1_29dof_rev_1_0.urdf`,
///   which states as its origin unitreerobotics/unitree_ros (`robots/g1_description`) and
///   BSD-3-Clause as the licence.
///
/// # Changed
///
/// Left and right are written once and mirrored where the source's are exact mirror images; where
/// they are not (the sign of one product of inertia at the knee, 10 µm at the shoulder) both
/// numbers stand here. Head and palms are welded to torso and wrists. Omitted are frames without
/// mass and the contour and the logo, 1 g each, and the pelvis since it does not move. Limits are
/// the degrees that the source rounds.
#[derive(Clone, Copy, Debug, Default)]
pub struct G1;

/// `bodies` into `all` from index `first`.
const fn put<const N: usize>(all: &mut [Body; 29], first: usize, bodies: [Body; N]) {
    let mut i = 0;
    while i < N {
        all[first + i] = bodies[i];
        i += 1;
    }
}

/// The bodies on the pelvis.
const LIMBS: [Body; 29] = {
    let mut all = [Body::new("", BASE, Joint::fixed()); 29];
    let left = [
        "left_hip_pitch",
        "left_hip_roll",
        "left_hip_yaw",
        "left_knee",
        "left_ankle_pitch",
        "left_ankle_roll",
    ];
    let right = [
        "right_hip_pitch",
        "right_hip_roll",
        "right_hip_yaw",
        "right_knee",
        "right_ankle_pitch",
        "right_ankle_roll",
    ];
    put(&mut all, 0, leg(left, 0, 1.0));
    put(&mut all, 6, leg(right, 6, -1.0));
    put(&mut all, 12, waist(12));
    let left = [
        "left_shoulder_pitch",
        "left_shoulder_roll",
        "left_shoulder_yaw",
        "left_elbow",
        "left_wrist_roll",
        "left_wrist_pitch",
        "left_wrist_yaw",
    ];
    let right = [
        "right_shoulder_pitch",
        "right_shoulder_roll",
        "right_shoulder_yaw",
        "right_elbow",
        "right_wrist_roll",
        "right_wrist_pitch",
        "right_wrist_yaw",
    ];
    put(&mut all, 15, arm(left, 14, 15, 1.0, 0.10022));
    put(&mut all, 22, arm(right, 14, 22, -1.0, -0.10021));
    all
};

impl Robot<29, 29, 29> for G1 {
    const MODEL: ArmModel<f64, 29> = Model::new("g1", LIMBS);
}

const _: ArmModel<f64, 29> = G1::MODEL;

/// Unitree G1 on a free joint: the pelvis of 3.8 kg, then the limbs of [`G1`]; 30 bodies, 35
/// degrees of freedom, 33.3 kg. Source and licence as [`G1`].
#[derive(Clone, Copy, Debug, Default)]
pub struct G1Free;

const PELVIS: Body = Body::new("pelvis", BASE, Joint::free())
    .mass(3.813)
    .com([0.0, 0.0, -0.07605])
    .inertia([0.010549, 0.0, 2.1e-6, 0.0093089, 0.0, 0.0079184]);

impl Robot<30, 36, 35> for G1Free {
    const MODEL: Model<f64, 30, 36, 35> = Model::new("g1_free", attach_to(PELVIS, &LIMBS));
}

const _: Model<f64, 30, 36, 35> = G1Free::MODEL;
