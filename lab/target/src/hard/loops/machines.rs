//! Planar linkages in numbers that f32 has: four-bars as loops and as clusters, a slider-crank, a
//! rig with three motors.

use dynamics_core::clusters::{Branch, ClusteredRobot, Driven};
use dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};

const Y: [f64; 3] = [0.0, 1.0, 0.0];

#[derive(Clone, Copy, Debug)]
pub struct Linkage {
    /// Lengths of crank, coupler, rocker and ground, m.
    pub lengths: [f64; 4],
    /// Masses of crank, coupler and rocker, kg.
    pub masses: [f64; 3],
}

const PLAIN: [f64; 4] = [0.1875, 0.5, 0.4375, 0.625];
const MASSES: [f64; 3] = [0.5, 1.0, 0.75];
/// 2²⁰.
const MILLION: f64 = 1_048_576.0;

/// The four-bars, by the K of [`FourBar`].
pub const LINKAGES: [Linkage; 8] = [
    of(PLAIN, MASSES),
    of([0.25, 0.5, 0.25, 0.5], MASSES),
    of([0.125, 0.625, 0.25, 0.5], MASSES),
    of(PLAIN, [1.0, 1.0, MILLION]),
    of(PLAIN, [1.0, 1.0 / MILLION, 1.0]),
    of(PLAIN, [1.0, 0.0, 1.0]),
    of([1.0 / 1024.0, 1.0, 1.0 / 64.0, 1.0], MASSES),
    of([0.25, 0.25, 0.125, 0.3125], MASSES),
];

const fn of(lengths: [f64; 4], masses: [f64; 3]) -> Linkage {
    Linkage { lengths, masses }
}

/// The K-th of [`LINKAGES`], driven at its crank.
#[derive(Clone, Copy, Debug)]
pub struct FourBar<const K: usize>;

const fn bar(name: &'static str, parent: usize, x: f64, mass: f64, length: f64) -> Body {
    let body = Body::new(name, parent, Joint::revolute(Y)).xyz([x, 0.0, 0.0]);
    if mass == 0.0 {
        return body;
    }
    let i = mass * length * length / 16.0;
    let inertia = [0.25 * i, 0.0, 0.0625 * i, i, 0.0, i];
    body.mass(mass)
        .com([0.5 * length, 0.0, 0.125 * length])
        .inertia(inertia)
}

const fn pin(name: &'static str, [p, s]: [(usize, f64); 2]) -> LoopJoint {
    let ends = [
        BodyFrame::new(p.0).xyz([p.1, 0.0, 0.0]),
        BodyFrame::new(s.0).xyz([s.1, 0.0, 0.0]),
    ];
    LoopJoint::new(name, Joint::revolute(Y), ends)
}

impl<const K: usize> Robot<3, 3, 3> for FourBar<K> {
    const MODEL: ArmModel<f64, 3> = {
        let [a, b, c, d] = LINKAGES[K].lengths;
        let [crank, coupler, rocker] = LINKAGES[K].masses;
        let bodies = [
            bar("crank", BASE, 0.0, crank, a),
            bar("coupler", 0, a, coupler, b),
            bar("rocker", BASE, d, rocker, c),
        ];
        Model::new("four_bar", bodies)
    };
}

impl<const K: usize> LoopRobot<3, 3, 3, 1, 5, 1> for FourBar<K> {
    const LOOPS: Loops<1, 5, 1> = {
        let [_, b, c, _] = LINKAGES[K].lengths;
        Loops::new(&Self::MODEL, [pin("pin", [(1, b), (2, c)])], [0])
    };
}

impl<const K: usize> ClusteredRobot<3, 3, 3, 1, 1> for FourBar<K> {
    type Clusters = (Driven<dynamics_core::clusters::FourBar, 3, 1>,);
    const CLUSTERS: Self::Clusters = {
        let [a, b, c, d] = LINKAGES[K].lengths;
        let linkage = dynamics_core::clusters::FourBar::new(d, a, b, c, Branch::Positive);
        (Driven::new("four_bar", linkage),)
    };
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
}

/// A slider-crank that its piston drives.
#[derive(Clone, Copy, Debug)]
pub struct SliderCrank;

impl Robot<3, 3, 3> for SliderCrank {
    const MODEL: ArmModel<f64, 3> = {
        let bodies = [
            bar("crank", BASE, 0.0, 0.5, 0.125),
            bar("rod", 0, 0.125, 1.0, 0.5),
            Body::new("piston", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(0.75),
        ];
        Model::new("slider_crank", bodies)
    };
}

impl LoopRobot<3, 3, 3, 1, 5, 1> for SliderCrank {
    const LOOPS: Loops<1, 5, 1> = Loops::new(&Self::MODEL, [pin("pin", [(2, 0.0), (1, 0.5)])], [2]);
}

/// Two cranks whose couplers meet, with a third motor at the root of a coupler.
#[derive(Clone, Copy, Debug)]
pub struct Rig;

impl Robot<4, 4, 4> for Rig {
    const MODEL: ArmModel<f64, 4> = {
        let bodies = [
            bar("left_crank", BASE, -0.125, 0.5, 0.25),
            bar("left_coupler", 0, 0.25, 0.75, 0.375),
            bar("right_crank", BASE, 0.125, 0.5, 0.25),
            bar("right_coupler", 2, 0.25, 0.75, 0.375),
        ];
        Model::new("rig", bodies)
    };
}

impl LoopRobot<4, 4, 4, 1, 5, 3> for Rig {
    const LOOPS: Loops<1, 5, 3> = {
        let ends = [(1, 0.375), (3, 0.375)];
        Loops::new(&Self::MODEL, [pin("tip", ends)], [0, 1, 2])
    };
}
