//! The cost of dynamics of robots with clusters, and of inverse dynamics of their spanning trees
//! with all angles given.
#![no_std]
#![no_main]

mod costs;

use costs::row::{Row, numbers};
use costs::{STATES, done};
use dynamics_core::algorithms::Pose;
use dynamics_core::clusters::{Clustered, ClusteredRobot, MotorTorques, Stewart, TreeMotion};
use dynamics_core::effects::{Effect, Gravity, RIGID_BODY};
use dynamics_core::spatial::Motion;
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine};
use firmware_demo::robots::{AnkleLeg, FourBarLeg, PickDelta, StewartPlatform};
use glam::{Mat3, Vec3};

/// Independent coordinates within `reach` of `centre`, from a fixed seed.
fn states<const Y: usize>(centre: [f32; Y], reach: [f32; Y]) -> [State<f32, Y, Y>; STATES] {
    let mut number = numbers();
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
    let trees = states.each_ref().map(|y| match Clustered::<Core<T>>::motion(y) {
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
    let of_y: [(&str, OfY<_, E, Y>); 2] =
        [("engine", Clustered::<Engine<T>>::rnea), ("core", Clustered::<Core<T>>::rnea)];
    for (form, run) in of_y {
        let row = Row::of::<T, N, N>("rnea_clusters", form, inputs, true);
        row.measure(run as usize, states, |y| run(y, effects));
    }
}

/// Pose, twist and acceleration of a Stewart platform.
type Moving = (Pose<f32>, Motion<f32>, Motion<f32>);

#[inline(never)]
fn of_legs((pose, twist, acceleration): &Moving) -> Option<MotorTorques<f32, 6>> {
    let y = Stewart::coordinates(pose, *twist, *acceleration).ok()?;
    Clustered::<Engine<StewartPlatform>>::rnea_of_motors(&y, &RIGID_BODY).ok()
}

/// From pose, twist and acceleration to the forces of the legs, and of that the forces of the legs
/// alone, away from a dead point and near one.
fn legs(states: &[State<f32, 6, 6>; STATES]) {
    let moving = states.each_ref().map(|y| {
        let [x, up, z, yaw, pitch, roll] = y.q;
        let rot =
            Mat3::from_rotation_z(yaw) * Mat3::from_rotation_y(pitch) * Mat3::from_rotation_x(roll);
        let motion = |of: &[f32; 6]| Motion {
            ang: Vec3::new(of[3], of[4], of[5]),
            lin: Vec3::new(of[0], of[1], of[2]),
        };
        let pos = Vec3::new(x, up, z);
        (Pose { rot, pos }, motion(&y.qd), motion(&y.qdd))
    });
    let row = Row::of::<StewartPlatform, 24, 24>("rnea_legs", "engine", "full", true);
    row.measure(of_legs as *const () as usize, &moving, of_legs);
    for (inputs, yaw) in [("regular", 0.0), ("singular", 1.55)] {
        // A motion takes 2 KB.
        let [a, b, c, d, ..] = states;
        let motions = [a, b, c, d].map(|y| {
            let [x, up, z, of_yaw, ..] = y.q;
            let y = State::at([x, up, z, yaw + 0.1 * of_yaw, 0.0, 0.0]);
            match Clustered::<Core<StewartPlatform>>::motion(&y) {
                Ok(motion) => motion,
                Err(_) => defmt::panic!("the legs have a length"),
            }
        });
        let row = Row::of::<StewartPlatform, 24, 24>("to_motors", "core", inputs, false);
        row.measure(to_motors as *const () as usize, &motions, to_motors);
    }
}

/// The forces of the legs that do the work of torques at the platform.
#[inline(never)]
fn to_motors(
    platform: &TreeMotion<f32, StewartPlatform, 24, 24, 24, 6, 6>,
) -> Option<MotorTorques<f32, 6>> {
    platform.to_motors(&[1.0, 2.0, 100.0, 1.0, 2.0, 3.0]).ok()
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
    rows::<PickDelta, _, 12, 3>("full", &delta, &RIGID_BODY);
    rows::<PickDelta, _, 12, 3>("gravity", &delta, &Gravity::EARTH);
    let centre = [0.0, 0.0, 0.8, 0.0, 0.0, 0.0];
    let stewart = states(centre, [0.1, 0.1, 0.1, 0.3, 0.3, 0.3]);
    rows::<StewartPlatform, _, 24, 6>("full", &stewart, &RIGID_BODY);
    legs(&stewart);
    let aba = Clustered::<Core<FourBarLeg>>::aba::<f32, _, 5, 5, 5, 3, 3>;
    let row = Row::of::<FourBarLeg, 5, 5>("aba_clusters", "core", "full", true);
    row.measure(aba as *const () as usize, &leg, |y| aba(y, &y.qdd, &RIGID_BODY));
    let forward = Clustered::<Engine<FourBarLeg>>::forward_dynamics::<f32, _, 5, 5, 5, 3, 3>;
    let row = Row::of::<FourBarLeg, 5, 5>("forward_clusters", "engine", "full", true);
    row.measure(forward as *const () as usize, &leg, |y| forward(y, &y.qdd, &RIGID_BODY));
    done()
}
