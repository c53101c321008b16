//! A robot that balances on two wheels, each on a leg of five bars.

use core::f64::consts::PI;

use dynamics_core::clusters::{Branch, ClusteredRobot, Driven, FiveBar};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};
use dynamics_core::scalar::Real;

/// Two five-bar legs with wheels, 14 kg, 0.4 m wide, of 0.14 to 0.34 m from hip to axle.
///
/// The numbers are assumed, of the size of the robots that balance in RoboMaster's contests. x is
/// forward, y to the left, z up. The body moves by six coordinates, along x, y and z, then about z
/// (yaw), x (roll) and y (pitch); in each leg two cranks with motors, the rear and the front one,
/// carry rods whose ends meet at the axle, and the wheel turns against the rear rod. The angle of a
/// crank is that below x, of the front one of some 0 to 1.3 rad.
#[derive(Clone, Copy, Debug, Default)]
pub struct WheelLeg;

/// Independent coordinates: the body's six, then rear crank, front crank and wheel of the left leg,
/// and of the right one.
pub const COORDINATES: usize = 12;

impl WheelLeg {
    /// The body's place in the list.
    pub const BODY: usize = 5;
    /// Those of the wheels.
    pub const WHEELS: [usize; 2] = [10, 15];
    /// The pitch among the independent coordinates, and the first of the motors after it.
    pub const PITCH: usize = 5;
    /// A wheel's radius, m.
    pub const RADIUS: f64 = 0.1;
    /// From the middle to a leg, m.
    pub const SIDE: f64 = 0.2;
    /// Half the distance of a leg's cranks, m.
    pub const HIP: f64 = 0.075;
    /// A crank, m.
    pub const CRANK: f64 = 0.15;
    /// A rod, m.
    pub const ROD: f64 = 0.27;
    /// The ends of the skids in the body, m: forward, sideways, up.
    pub const SKID: [f64; 3] = [0.25, 0.15, -0.16];
    /// Torque and speed of a crank's motor and of a wheel's.
    pub const LIMITS: [JointLimits<f64>; 2] = [limits(30.0, 25.0), limits(8.0, 80.0)];
    /// The least and the greatest length of a leg, from hip to axle, m.
    pub const LENGTHS: [f64; 2] = [0.14, 0.34];
}

const fn limits(torque: f64, velocity: f64) -> JointLimits<f64> {
    JointLimits { lower: -1e4, upper: 1e4, velocity, torque }
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// Limits of joints without a drive.
const FREE: JointLimits<f64> = JointLimits { lower: -PI, upper: PI, velocity: 100.0, torque: 0.0 };

const fn bar(name: &'static str, parent: usize, place: [f64; 3], mass: f64, length: f64) -> Body {
    let across = mass * length * length / 12.0;
    Body::new(name, parent, Joint::revolute(Y))
        .xyz(place)
        .mass(mass)
        .com([0.5 * length, 0.0, 0.0])
        .inertia([1e-4, 0.0, 0.0, across, 0.0, across])
        .limits(FREE)
}

const fn crank(name: &'static str, x: f64, side: f64) -> Body {
    bar(name, WheelLeg::BODY, [x, side * WheelLeg::SIDE, 0.0], 0.3, WheelLeg::CRANK)
        .limits(WheelLeg::LIMITS[0])
}

const fn rod(name: &'static str, crank: usize) -> Body {
    bar(name, crank, [WheelLeg::CRANK, 0.0, 0.0], 0.25, WheelLeg::ROD)
}

/// With the stator of its motor, whose turning with the rod is small.
const fn wheel(name: &'static str, rod: usize) -> Body {
    Body::new(name, rod, Joint::revolute(Y))
        .xyz([WheelLeg::ROD, 0.0, 0.0])
        .mass(1.2)
        .inertia([0.0035, 0.0, 0.0, 0.006, 0.0, 0.0035])
        .limits(WheelLeg::LIMITS[1])
}

const fn massless(name: &'static str, parent: usize, joint: Joint<f64>) -> Body {
    Body::new(name, parent, joint).limits(FREE)
}

impl Robot<16, 16, 16> for WheelLeg {
    const MODEL: ArmModel<f64, 16> = Model::new(
        "wheel_leg",
        [
            massless("along", BASE, Joint::prismatic(X)),
            massless("across", 0, Joint::prismatic(Y)),
            massless("up", 1, Joint::prismatic(Z)),
            massless("yaw", 2, Joint::revolute(Z)),
            massless("roll", 3, Joint::revolute(X)),
            Body::new("body", 4, Joint::revolute(Y))
                .mass(9.4)
                .com([0.0, 0.0, 0.02])
                .inertia([0.12, 0.0, 0.0, 0.13, 0.0, 0.2])
                .limits(FREE),
            crank("left_rear_crank", -Self::HIP, 1.0),
            rod("left_rear_rod", 6),
            crank("left_front_crank", Self::HIP, 1.0),
            rod("left_front_rod", 8),
            wheel("left_wheel", 7),
            crank("right_rear_crank", -Self::HIP, -1.0),
            rod("right_rear_rod", 11),
            crank("right_front_crank", Self::HIP, -1.0),
            rod("right_front_rod", 13),
            wheel("right_wheel", 12),
        ],
    );
}

const LEG: FiveBar = FiveBar::new(
    2.0 * WheelLeg::HIP,
    [WheelLeg::CRANK, WheelLeg::ROD],
    [WheelLeg::CRANK, WheelLeg::ROD],
    Branch::Positive,
);

impl ClusteredRobot<16, 16, 16, COORDINATES, COORDINATES> for WheelLeg {
    type Clusters = (Driven<FiveBar, 4, 2>, Driven<FiveBar, 4, 2>);
    const CLUSTERS: Self::Clusters = (Driven::new("left_leg", LEG), Driven::new("right_leg", LEG));
    const COORDINATES: &'static [&'static [usize]] = &[&[6, 7, 8, 9], &[11, 12, 13, 14]];
}

const _: ArmModel<f64, 16> = WheelLeg::MODEL;

/// Angles of a leg whose axle is below the middle of its hips, rad: of the front crank and of the
/// rear rod, below x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Straight<R> {
    pub front: R,
    pub rear_rod: R,
    /// Their slopes by the length, rad/m.
    pub slopes: [R; 2],
}

impl<R: Real> Straight<R> {
    /// Of a length from hip to axle within [`WheelLeg::LENGTHS`], m.
    pub fn of_length(length: R) -> Self {
        let [hip, crank, rod] = [WheelLeg::HIP, WheelLeg::CRANK, WheelLeg::ROD].map(R::from_f64);
        // The triangle of crank, rod, and the line from the front hip to the axle.
        let line = (hip * hip + length * length).sqrt();
        let cos = (crank * crank + line * line - rod * rod) / (R::from_f64(2.0) * crank * line);
        let front = length.atan2(-hip) - (R::ONE - cos * cos).sqrt().atan2(cos);
        let (sin, cos) = front.sin_cos();
        let (x, down) = (hip + crank * cos, length - crank * sin);
        // ẋ = −l₁ sin β β̇ = −down φ̇, and the axle's ṡ = l₁ cos β β̇ + x φ̇.
        let by_front = R::ONE / (crank * cos + x * crank * sin / down);
        let slopes = [by_front, crank * sin / down * by_front];
        Self { front, rear_rod: down.atan2(x), slopes }
    }
}
