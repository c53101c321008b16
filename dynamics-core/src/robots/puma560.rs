//! Unimation PUMA 560.

use crate::effects::Armature;
use crate::model::{ArmModel, BASE, Body, Joint, Model, Robot};

/// Unimation PUMA 560: 6 revolute joints and a spherical wrist, the oldest benchmark of the field.
///
/// The joint frames are those of Denavit and Hartenberg's modified parameters, which the source
/// uses; the base frame is that of the first joint, on the level of the shoulder.
///
/// # Source
///
/// Armstrong, Khatib and Burdick, "The explicit dynamic model and inertial parameters of the PUMA
/// 560 arm", ICRA 1986, who took an arm apart and measured its links; the wrist's inertias are
/// estimates from its dimensions. The numbers were read from the transcription in
/// petercorke/robotics-toolbox-matlab (commit c0414b98, `models/mdl_puma560akb.m`, LGPL), of which
/// no code is used. Products of inertia were not measured. The source has no limits and no
/// friction.
///
/// # Changed
///
/// - Link 1: the source has Izz alone, 0.35 kg m². No body has that without moments about x and y,
///   so that Ixx = Iyy = 0.175, the least that are possible, and a mass of 13 kg on the axis stand
///   beside it. These three are no measurements, and on a fixed base they have no effect: the link
///   turns about a vertical axis through its centre of mass and does nothing else.
/// - The inertias of the rotors are [`Puma560::ARMATURE`], an effect as those of other robots, and
///   not a part of the links.
///
/// ```
/// use dynamics_core::effects::{Coriolis, Gravity, Inertia};
/// use dynamics_core::{Engine, robots::Puma560, state::State};
/// let scene = (Gravity::EARTH, Inertia, Coriolis, Puma560::ARMATURE);
/// let state = State { qdd: [0.0, 0.0, 0.0, 0.0, 0.0, 1.0], ..State::at([0.0_f32; 6]) };
/// // Behind its gear the rotor has 5000 times the inertia of the link that it turns, 4e-5 kg m².
/// assert!(Engine::<Puma560>::rnea(&state, &scene)[5] > 0.2);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Puma560;

impl Puma560 {
    /// The rotors' inertias as the joints feel them: the source's motors, kg m², times the squares
    /// of their gears.
    pub const ARMATURE: Armature<f32, 6> = Armature([
        at_joint(291e-6, 62.6111),
        at_joint(409e-6, 107.815),
        at_joint(299e-6, 53.7063),
        at_joint(35e-6, 76.0364),
        at_joint(35e-6, 71.923),
        at_joint(35e-6, 76.686),
    ]);
}

const fn at_joint(rotor: f64, gear: f64) -> f32 {
    (rotor * gear * gear) as f32
}

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A symmetric body's moments about its axes.
const fn moments([xx, yy, zz]: [f64; 3]) -> [f64; 6] {
    [xx, 0.0, 0.0, yy, 0.0, zz]
}

impl Robot<6, 6, 6> for Puma560 {
    const MODEL: ArmModel<f64, 6> = Model::new(
        "puma560",
        [
            Body::new("link_1", BASE, Joint::revolute(Z))
                .mass(13.0)
                .inertia(moments([0.175, 0.175, 0.35])),
            Body::new("link_2", 0, Joint::revolute(Z))
                .xyz([0.0, 0.2435, 0.0])
                .quarter_turns([-1, 0, 0])
                .mass(17.4)
                .com([0.068, 0.006, -0.016])
                .inertia(moments([0.13, 0.524, 0.539])),
            Body::new("link_3", 1, Joint::revolute(Z))
                .xyz([0.4318, 0.0, -0.0934])
                .mass(4.8)
                .com([0.0, -0.07, 0.014])
                .inertia(moments([0.066, 0.0125, 0.066])),
            Body::new("link_4", 2, Joint::revolute(Z))
                .xyz([-0.0203, -0.4331, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(0.82)
                .com([0.0, 0.0, -0.019])
                .inertia(moments([0.0018, 0.0018, 0.0013])),
            Body::new("link_5", 3, Joint::revolute(Z))
                .quarter_turns([-1, 0, 0])
                .mass(0.34)
                .inertia(moments([0.0003, 0.0003, 0.0004])),
            Body::new("link_6", 4, Joint::revolute(Z))
                .quarter_turns([1, 0, 0])
                .mass(0.09)
                .com([0.0, 0.0, 0.032])
                .inertia(moments([0.00015, 0.00015, 0.00004])),
        ],
    );
}

const _: ArmModel<f64, 6> = Puma560::MODEL;
