//! A four-bar linkage, by general loops and as a linkage, and a beam with an arm:
//! `tests/machines.py` has them as files.

use dynamics_core::Core;
use dynamics_core::clusters::{Branch, Clustered, ClusteredRobot, Differential, Driven, FourBar};
use dynamics_core::effects::{Elasticity, RIGID_BODY};
use dynamics_core::flexible::{self, Beam, FlexibleLink, Modes, Shape};
use dynamics_core::loops::{self, BodyFrame, LoopJoint, LoopRobot, Loops, Stabilisation};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot, Static};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// Crank, coupler on it, and rocker, in the x-y plane.
pub struct Bars;

const fn bar(name: &'static str, parent: usize, x: f64, mass: f64) -> Body {
    Body::new(name, parent, Joint::revolute(Z))
        .xyz([x, 0.0, 0.0])
        .mass(mass)
        .com([0.1, 0.01, 0.02])
        .inertia([0.001, 0.0002, 0.0001, 0.004, 0.0003, 0.004])
}

impl Robot<3, 3, 3> for Bars {
    const MODEL: ArmModel<f64, 3> = Model::new(
        "bars",
        [bar("crank", BASE, 0.0, 0.5), bar("coupler", 0, 0.2, 1.0), bar("rocker", BASE, 0.6, 0.8)],
    );
}

impl LoopRobot<3, 3, 3, 1, 5, 1> for Bars {
    const LOOPS: Loops<1, 5, 1> = Loops::new(
        &Self::MODEL,
        [LoopJoint::new(
            "pin",
            Joint::revolute(Z),
            [BodyFrame::new(1).xyz([0.5, 0.0, 0.0]), BodyFrame::new(2).xyz([0.4, 0.0, 0.0])],
        )],
        [0],
    );
}

impl ClusteredRobot<3, 3, 3, 1, 1> for Bars {
    type Clusters = (Driven<FourBar, 3, 1>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("bars", FourBar::new(0.6, 0.2, 0.5, 0.4, Branch::Positive)),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
}

/// The results of the library for the bars.
pub fn bars(quantity: &str, numbers: &[f32]) -> Option<Vec<f32>> {
    let (robot, of) = (&Static::<Bars>::NEW, &Bars::LOOPS);
    let mut out = Vec::new();
    for row in numbers.chunks_exact(12) {
        let part = |at: usize| std::array::from_fn(|i| row[at + i]);
        let (q, qd, qdd) = (part(0), part(3), part(6));
        let state = State { q, qd, qdd };
        match quantity {
            "loops inverse" => {
                let found = loops::inverse_dynamics(robot, of, &state, &RIGID_BODY).ok()?;
                let State { qd, qdd, .. } = found.state;
                out.extend(found.tau.iter().chain(&qd).chain(&qdd).chain(&found.lambda));
            }
            "loops forward" => {
                let stabilisation = Stabilisation { position: 100.0, velocity: 20.0 };
                let tau = [row[9]];
                let found =
                    loops::forward_dynamics(robot, of, &state, &tau, stabilisation, &RIGID_BODY);
                let found = found.ok()?;
                out.extend(found.qdd.iter().chain(&found.lambda));
            }
            "linkages" => {
                let y = State { q: [row[0]], qd: [row[3]], qdd: [row[6]] };
                out.extend(Clustered::<Core<Bars>>::rnea(&y, &RIGID_BODY).ok()?);
            }
            _ => return None,
        }
    }
    Some(out)
}

/// The UR5e with a differential for its last two joints: a chain.
pub struct Wrist;

impl Robot<6, 6, 6> for Wrist {
    const MODEL: ArmModel<f64, 6> = Ur5e::MODEL;
}

impl ClusteredRobot<6, 6, 6, 6, 6> for Wrist {
    type Clusters = (Driven<Differential, 2, 2>,);
    const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 2.5])),);
    const COORDINATES: &'static [&'static [usize]] = &[&[4, 5]];
}

/// The results of the library for the wrist.
pub fn wrist(numbers: &[f32]) -> Option<Vec<f32>> {
    let rows = numbers.chunks_exact(24).map(|row| {
        let part = |at: usize| std::array::from_fn(|i| row[at + i]);
        let (q, qd, qdd) = (part(0), part(6), part(12));
        Clustered::<Core<Wrist>>::rnea(&State { q, qd, qdd }, &RIGID_BODY).ok()
    });
    Some(rows.collect::<Option<Vec<_>>>()?.concat())
}

/// A beam that turns about y, and a rigid arm on its end.
pub struct Boom;

const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 6.0]).tip(0.3, 1e-4).damping_ratio(0.02);

const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1), Shape::BendZ(2), Shape::BendY(1)])
{
    Ok(link) => link,
    Err(_) => panic!("a beam without a length, a mass or a stiffness"),
};

impl Robot<2, 2, 2> for Boom {
    const MODEL: ArmModel<f64, 2> = Model::new(
        "boom",
        [
            Body::new("beam", BASE, Joint::revolute([0.0, 1.0, 0.0]))
                .mass(BEAM.mass())
                .com(BEAM.com())
                .inertia(BEAM.inertia()),
            bar("arm", 0, 0.5, 0.4),
        ],
    );
}

static MODES: Modes<f32, 3> = Modes::new(&Boom::MODEL, &[LINK]).to_f32();

/// The results of the library for the boom, from rows of q, q̇, q̈, τ, η, η̇ and η̈.
pub fn boom(quantity: &str, numbers: &[f32]) -> Option<Vec<f32>> {
    let (robot, scene) = (&Static::<Boom>::NEW, &(RIGID_BODY, Elasticity));
    let mut out = Vec::new();
    for row in numbers.chunks_exact(17) {
        let pair = |at: usize| [row[at], row[at + 1]];
        let three = |at: usize| std::array::from_fn(|i| row[at + i]);
        let state = State { q: pair(0), qd: pair(2), qdd: pair(4) };
        let bent = State { q: three(8), qd: three(11), qdd: three(14) };
        let found = match quantity {
            "rnea" => flexible::rnea(robot, &MODES, &state, &bent, scene),
            "forward" => {
                flexible::forward_dynamics(robot, &MODES, &state, &bent, &pair(6), scene).ok()?
            }
            _ => return None,
        };
        out.extend(found.joints.iter().chain(&found.modes));
    }
    Some(out)
}
