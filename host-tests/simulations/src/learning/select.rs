//! The selection of what the firmware knows before its arm moves: a nominal model that is off by 30
//! %, and the base parameters of its motion. In f64.

use super::arm::{DAMPING, GEARS};
use super::firmware::STATED;
use super::parameters::{Known, N, OWN, P, WIDTH};
use super::run::excitation;
use dynamics_core::Core;
use dynamics_core::algorithms::{friction_regressor, inertial_parameters};
use dynamics_core::effects::{Payload, RIGID_BODY, Width};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::So101;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use firmware_demo::scenes::so101_teach::{ARMATURE, COULOMB};
use motion_control::Excitation;

fn own() -> [f64; OWN] {
    let (_, gears) = GEARS;
    [
        DAMPING,
        COULOMB,
        ARMATURE,
        gears.driving[0],
        gears.backdriving[0],
    ]
    .map(f64::from)
}

pub fn truth() -> [f64; N] {
    let bodies = inertial_parameters(&So101::MODEL, &());
    let mut all = bodies
        .as_flattened()
        .iter()
        .copied()
        .chain([own(); 6].into_iter().flatten());
    core::array::from_fn(|_| all.next().expect("as many"))
}

/// Each mass, each component of each centre of mass, each inertia about the centre and each
/// parameter of a joint 30 % more or less, by the bits of a seed (Marsaglia's xorshift32, 2003).
pub fn nominal(seed: u32) -> [f64; N] {
    let mut random = seed.wrapping_mul(2_654_435_761) | 1;
    let mut factor = || {
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        if random & 0x100 == 0 { 0.7 } else { 1.3 }
    };
    let mut all = truth();
    let (bodies, joints) = all.split_at_mut(60);
    for body in bodies.as_chunks_mut::<10>().0 {
        let about = BodyInertia::about_com(&SpatialInertia::from_parameters(*body));
        let inertia = factor();
        let off = BodyInertia {
            mass: about.mass * factor(),
            com: about.com.map(|c| c * factor()),
            inertia: about.inertia.map(|x| x * inertia),
        };
        *body = Payload::<f64, 0>::from_inertia(off).0.parameters();
    }
    joints.iter_mut().for_each(|x| *x *= factor());
    all
}

/// A row of all parameters, with the load-dependent friction of the torque that they give.
fn row(joint: usize, state: &State<f64, 6, 6>, all: &[f64; N]) -> [f64; N] {
    let width = Width::new(f64::from(WIDTH.get()));
    let bodies = Core::<So101>::regressor_row(state, &RIGID_BODY, joint);
    let [viscous, sign] = friction_regressor(&state.qd, width)[joint];
    let mut own = [viscous, sign, state.qdd[joint], 0.0, 0.0];
    let still = Excitation::<N>::row(joint, &bodies, &own);
    let load: f64 = still.iter().zip(all).map(|(y, x)| y * x).sum();
    let (even, odd) = (0.5 * sign * load.abs(), 0.5 * sign * sign * load);
    (own[3], own[4]) = (even + odd, even - odd);
    Excitation::<N>::row(joint, &bodies, &own)
}

/// The nominal model of a seed, and the base parameters of the motion by it.
///
/// # Panics
/// If the motion shows fewer parameters.
pub fn known(seed: u32) -> Known {
    selected(nominal(seed))
}

/// The same of a nominal model.
///
/// # Panics
/// If the motion shows fewer parameters.
pub fn selected(nominal: [f64; N]) -> Known {
    let mut motion: Box<Excitation<N>> = Box::default();
    for k in 0..600 {
        let State { q, qd, qdd } = excitation(0.05 * k as f32);
        let state = State {
            q: q.map(f64::from),
            qd: qd.map(f64::from),
            qdd: qdd.map(f64::from),
        };
        for (joint, noise) in STATED.into_iter().enumerate() {
            motion.add(&row(joint, &state, &nominal), f64::from(noise));
        }
    }
    let base = motion.select::<f32, 6, P>(&nominal, 0.4);
    Known {
        nominal: nominal.map(|x| x as f32),
        base: base.expect("enough columns"),
    }
}

pub const SEED: u32 = 1;
/// The file with what the firmware knows.
pub const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/learning/selected.rs");

/// The expected text of that file.
pub fn source() -> String {
    let Known { nominal, base } = known(SEED);
    let lines = |numbers: &[f32]| -> String {
        let chunks = numbers.chunks(10);
        chunks
            .map(|chunk| format!("        {},\n", words(chunk)))
            .collect()
    };
    let spread: String = base
        .spread
        .iter()
        .map(|row| format!("            [{}],\n", words(row)))
        .collect();
    format!(
        "//! The firmware's knowledge before the arm moves: written by\n\
         //! host-tests/simulations/tests/learning.rs with TABLES_WRITE=1.\n\n\
         use motion_control::SelectedParameters;\n\nuse super::parameters::Known;\n\n\
         /// A nominal model whose parameters are off by 30 %, and the base parameters of the \
         motion by it.\n\
         pub const KNOWN: Known = Known \
         {{\n    nominal: [\n{}    ],\n    base: SelectedParameters {{\n\
         \x20       columns: {:?},\n        prior: [{}],\n        spread: \
         [\n{spread}        ],\n    }},\n}};\n",
        lines(&nominal),
        base.columns,
        words(&base.prior),
    )
}

fn words(numbers: &[f32]) -> String {
    let words = numbers.iter().map(|x| {
        if *x == 0.0 {
            "0.0".to_owned()
        } else {
            format!("{x:e}")
        }
    });
    words.collect::<Vec<_>>().join(", ")
}
