//! A leg with a four-bar knee.

use core::f64::consts::{FRAC_PI_2, PI};

use dynamics_core::clusters::{Branch, ClusteredRobot, Driven, FourBar};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Hip, knee and ankle in one plane, 7.2 kg, 0.7 m: a crank at the hip drives the knee by a rod
/// behind the thigh's front.
///
/// The numbers are assumed, of the size of legs of humanoids. All joints turn about y; straight
/// down at q = 0, crank and the shank's lever point forward. The tree's coordinates are hip, crank,
/// rod, knee, ankle; the independent ones hip, crank, ankle. The loop is cut between the ends of
/// rod and lever.
#[derive(Clone, Copy, Debug, Default)]
pub struct FourBarLeg;

/// From the crank's joint to the knee.
pub const GROUND: f64 = 0.3;
pub const CRANK: f64 = 0.06;
pub const ROD: f64 = 0.3;
pub const LEVER: f64 = 0.05;

const Y: [f64; 3] = [0.0, 1.0, 0.0];

const LIMITS: JointLimits<f64> =
    JointLimits { lower: -PI, upper: PI, velocity: 20.0, torque: 100.0 };

impl Robot<5, 5, 5> for FourBarLeg {
    const MODEL: ArmModel<f64, 5> = Model::new(
        "four_bar_leg",
        [
            Body::new("thigh", BASE, Joint::revolute(Y))
                .xyz([0.0, 0.1, 0.0])
                .mass(4.0)
                .com([0.01, 0.02, -0.14])
                .inertia([0.05, 0.0, 0.001, 0.05, 0.0, 0.008])
                .limits(LIMITS),
            Body::new("crank", 0, Joint::revolute(Y))
                .xyz([0.0, 0.0, -0.05])
                .mass(0.15)
                .com([0.025, 0.0, 0.0])
                .inertia([0.00002, 0.0, 0.0, 0.00008, 0.0, 0.00008])
                .limits(LIMITS),
            Body::new("rod", 1, Joint::revolute(Y))
                .xyz([CRANK, 0.0, 0.0])
                .mass(0.25)
                .com([0.002, 0.0, -0.15])
                .inertia([0.0019, 0.0, 0.0, 0.0019, 0.0, 0.00001])
                .limits(LIMITS),
            Body::new("shank", 0, Joint::revolute(Y))
                .xyz([0.0, 0.0, -0.35])
                .mass(2.0)
                .com([0.005, 0.0, -0.13])
                .inertia([0.02, 0.0, 0.0005, 0.02, 0.0, 0.002])
                .limits(LIMITS),
            Body::new("foot", 3, Joint::revolute(Y))
                .xyz([0.0, 0.0, -0.35])
                .mass(0.8)
                .com([0.04, 0.0, -0.03])
                .inertia([0.0008, 0.0, 0.0002, 0.003, 0.0, 0.003])
                .limits(LIMITS),
        ],
    );
}

impl ClusteredRobot<5, 5, 5, 3, 3> for FourBarLeg {
    type Clusters = (Driven<FourBar, 3, 1>,);
    const CLUSTERS: Self::Clusters = (Driven::new(
        "knee",
        FourBar::new(GROUND, CRANK, ROD, LEVER, Branch::Negative)
            .zeros([-FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2]),
    ),);
    const COORDINATES: &'static [&'static [usize]] = &[&[1, 2, 3]];
}

const _: ArmModel<f64, 5> = FourBarLeg::MODEL;
