//! Inverse dynamics of robots with clusters, and of their spanning trees with all angles given: `cargo xtask test
//! clusters` compares their cycles.
#![no_std]
#![no_main]

#[path = "../costs/mod.rs"]
mod costs;

use costs::row::Row;
use costs::{STATES, done};
use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::{Effect, Gravity, RIGID_BODY};
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine};
use firmware_demo::robots::{AnkleLeg, DeltaRobot, FourBarLeg, StewartPlatform};

/// Independent coordinates within `reach` of `centre`, from a fixed seed.
fn states<const Y: usize>(centre: [f32; Y], reach: [f32; Y]) -> [State<f32, Y, Y>; STATES] {
    let mut seed = 1_u32;
    let mut number = |bound: f32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 * (2.0 * bound / 16_777_216.0) - bound
    };
    [(); STATES].map(|()| State {
        q: core::array::from_fn(|k| centre[k] + number(reach[k])),
        qd: [(); Y].map(|()| number(3.0)),
        qdd: [(); Y].map(|()| number(10.0)),
    })
}

/// The rows of a robot under one set of effects: tree and clusters, by the engine and by the core.
fn rows<T, E, const N: usize, const Y: usize>(
    inputs: &'static str,
    states: &[State<f32, Y, Y>; STATES],
    effects: &E,
) where
    T: ClusteredRobot<N, N, N, Y, Y>,
    E: Effect<f32, N, N>,
{
    let trees = states
        .each_ref()
        .map(|y| match Clustered::<Core<T>>::motion(y) {
            Ok(motion) => *motion.state().state(),
            Err(_) => defmt::panic!("a cluster does not close"),
        });
    type Tree<E, const N: usize> = fn(&State<f32, N, N>, &E) -> [f32; N];
    type OfY<T, E, const Y: usize> = fn(&State<f32, Y, Y>, &E) -> Result<[f32; Y], T>;
    let trees_of: [(&str, Tree<E, N>); 2] = [
        ("engine", |state, effects| Engine::<T>::rnea(state, effects)),
        ("core", |state, effects| Core::<T>::rnea(state, effects)),
    ];
    for (form, run) in trees_of {
        let row = Row::of::<T, N, N>("rnea_tree", form, inputs, true);
        row.measure(run as usize, &trees, |state| run(state, effects));
    }
    let of_y: [(&str, OfY<_, E, Y>); 2] = [
        ("engine", Clustered::<Engine<T>>::rnea),
        ("core", Clustered::<Core<T>>::rnea),
    ];
    for (form, run) in of_y {
        let row = Row::of::<T, N, N>("rnea_clusters", form, inputs, true);
        row.measure(run as usize, states, |y| run(y, effects));
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let leg = states([0.0; 3], [2.0, 0.6, 2.0]);
    rows::<FourBarLeg, _, 5, 3>("full", &leg, &RIGID_BODY);
    rows::<FourBarLeg, _, 5, 3>("gravity", &leg, &Gravity::EARTH);
    let ankle = states([0.0; 3], [2.0, 0.45, 0.3]);
    rows::<AnkleLeg, _, 9, 3>("full", &ankle, &RIGID_BODY);
    rows::<AnkleLeg, _, 9, 3>("gravity", &ankle, &Gravity::EARTH);
    let delta = states([0.0; 3], [0.5; 3]);
    rows::<DeltaRobot, _, 12, 3>("full", &delta, &RIGID_BODY);
    rows::<DeltaRobot, _, 12, 3>("gravity", &delta, &Gravity::EARTH);
    let centre = [0.0, 0.0, 0.8, 0.0, 0.0, 0.0];
    let stewart = states(centre, [0.1, 0.1, 0.1, 0.3, 0.3, 0.3]);
    rows::<StewartPlatform, _, 24, 6>("full", &stewart, &RIGID_BODY);
    let aba = Clustered::<Core<FourBarLeg>>::aba::<f32, _, 5, 5, 5, 3, 3>;
    let row = Row::of::<FourBarLeg, 5, 5>("aba_clusters", "core", "full", true);
    row.measure(aba as *const () as usize, &leg, |y| {
        aba(y, &y.qdd, &RIGID_BODY)
    });
    done()
}
