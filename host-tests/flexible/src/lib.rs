//! Two arms of two links that bend, and states of them.

use dynamics_core::flexible::{Beam, BendingRobot, FlexibleLink, Modes, Shape};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
use dynamics_core::state::State;

pub mod referee;

const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// The upper link, and a motor at its end.
pub const UPPER: Beam =
    Beam::new(0.5, 0.8).bending([4.0, 4.0]).torsion(3.0).sections([2e-5, 2e-5]).tip(0.3, 1e-4);
/// The lower link, and a gripper at its end.
pub const LOWER: Beam =
    Beam::new(0.4, 0.4).bending([1.0, 1.0]).torsion(0.8).sections([1e-5, 1e-5]).tip(0.1, 2e-5);

/// The link of a beam, in a `const`.
pub const fn link(beam: &Beam, body: usize, shapes: &[Shape]) -> FlexibleLink {
    match beam.link(body, shapes) {
        Ok(link) => link,
        Err(_) => panic!("a beam without a length, a mass or a stiffness, or without the shape"),
    }
}

const fn body(name: &'static str, parent: usize, axis: [f64; 3], beam: &Beam) -> Body {
    Body::new(name, parent, Joint::revolute(axis))
        .mass(beam.mass())
        .com(beam.com())
        .inertia(beam.inertia())
}

const fn arm(name: &'static str, first: [f64; 3]) -> ArmModel<f64, 2> {
    ArmModel::new(
        name,
        [body("upper", BASE, first, &UPPER), body("lower", 0, Y, &LOWER).xyz([0.5, 0.0, 0.0])],
    )
}

/// Two links in a vertical plane, with two modes each.
#[derive(Clone, Copy, Debug)]
pub struct Planar;

impl Robot<2, 2, 2> for Planar {
    const MODEL: ArmModel<f64, 2> = arm("planar", Y);
}

pub const PLANAR: Modes<f64, 4> = Modes::new(
    &Planar::MODEL,
    &[
        link(&UPPER, 0, &[Shape::BendZ(1), Shape::BendZ(2)]),
        link(&LOWER, 1, &[Shape::BendZ(1), Shape::BendZ(2)]),
    ],
);

impl BendingRobot<2, 2, 2, 4> for Planar {
    const MODES: Modes<f64, 4> = PLANAR;
}

/// Two links, the first about the vertical, that bend in two planes and twist.
#[derive(Clone, Copy, Debug)]
pub struct Spatial;

impl Robot<2, 2, 2> for Spatial {
    const MODEL: ArmModel<f64, 2> = arm("spatial", Z);
}

pub const SPATIAL: Modes<f64, 6> = Modes::new(
    &Spatial::MODEL,
    &[
        link(&UPPER, 0, &[Shape::BendY(1), Shape::BendZ(1), Shape::Twist(1)]),
        link(&LOWER, 1, &[Shape::BendZ(1), Shape::BendZ(2), Shape::BendY(1)]),
    ],
);

impl BendingRobot<2, 2, 2, 6> for Spatial {
    const MODES: Modes<f64, 6> = SPATIAL;
}

/// A number within ±1 of a sequence.
#[derive(Debug)]
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn draw(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A state with positions, rates and accelerations up to these sizes.
    pub fn state<const N: usize>(&mut self, [q, qd, qdd]: [f64; 3]) -> State<f64, N, N> {
        State {
            q: core::array::from_fn(|_| q * self.draw()),
            qd: core::array::from_fn(|_| qd * self.draw()),
            qdd: core::array::from_fn(|_| qdd * self.draw()),
        }
    }
}

/// The sizes of q, q̇, q̈ of joints and of modes.
pub const JOINTS: [f64; 3] = [2.0, 3.0, 20.0];
/// The sizes of the same quantities of modes.
pub const MODES: [f64; 3] = [0.05, 1.0, 50.0];

pub mod hard;

pub mod recording {
    //! The recording of `host-tests/oracle/beam.py`.

    use std::collections::BTreeMap;
    use std::sync::OnceLock;

    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    pub struct Recording {
        /// Robots, by name.
        pub dynamics: BTreeMap<String, Dynamics>,
        pub frequencies: Frequencies,
        /// Deflections at rest, by link.
        pub r#static: BTreeMap<String, Static>,
        /// A link on a given motion.
        pub forced: Forced,
    }

    /// States, and the forces on joints and modes at each.
    #[derive(Debug, Deserialize)]
    pub struct Dynamics {
        pub q: Vec<Vec<f64>>,
        pub qd: Vec<Vec<f64>>,
        pub qdd: Vec<Vec<f64>>,
        pub eta: Vec<Vec<f64>>,
        pub etad: Vec<Vec<f64>>,
        pub etadd: Vec<Vec<f64>>,
        pub tau: Vec<Vec<f64>>,
        pub modal: Vec<Vec<f64>>,
        pub kinetic: Vec<f64>,
    }

    /// Frequencies of links, by name.
    #[derive(Debug, Deserialize)]
    pub struct Frequencies {
        pub bending: BTreeMap<String, Vibrations>,
        pub torsion: BTreeMap<String, Vibrations>,
    }

    /// The first four.
    #[derive(Debug, Deserialize)]
    pub struct Vibrations {
        /// ω, rad/s.
        pub omega: Vec<f64>,
        /// The slope at the end of the shape that is one there.
        #[serde(default)]
        pub tip_slope: Vec<f64>,
        pub modal_mass: Vec<f64>,
    }

    /// A cantilever under its weight.
    #[derive(Debug, Deserialize)]
    pub struct Static {
        /// At four places.
        pub x_deflection_slope: Vec<[f64; 3]>,
        /// Deflection of the end with 1 to 8 modes.
        pub tip_of_modes: Vec<f64>,
    }

    /// The upper link on a given motion of its joint.
    #[derive(Debug, Deserialize)]
    pub struct Forced {
        /// The whole angle of the joint's motion.
        pub angle: f64,
        pub duration: f64,
        pub t: Vec<f64>,
        /// The end's deflection.
        pub tip: Vec<f64>,
        /// With 1 to 6 modes.
        pub tip_of_modes: Vec<Vec<f64>>,
        /// The joint's torque with 1 to 6 modes.
        pub torque_of_modes: Vec<Vec<f64>>,
    }

    /// The recording.
    ///
    /// # Panics
    /// If the file is missing or has another form.
    pub fn recording() -> &'static Recording {
        static RECORDING: OnceLock<Recording> = OnceLock::new();
        RECORDING.get_or_init(|| host_tests::recordings::read("beam"))
    }
}
