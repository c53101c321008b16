//! The robots, each with a way to go.

use dynamics_core::control::{MotionLimits, RestToRest, Trajectory, TrajectoryError, WayPoint};
use dynamics_core::drivetrain::{ElasticJoints, ElasticReference};
use dynamics_core::model::{Robot, model};
use dynamics_core::robots::{A1Leg, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

use crate::scene::TICK;
use crate::trajectories::{
    LEG_STEPS, PANDA_PICK_AND_PLACE, PANDA_SWING, PICK_AND_PLACE, UR5E_SWING,
};

/// A robot of N joints and B bodies, its way through W points, and all ways to compute its torques.
pub trait Compared<const B: usize, const N: usize, const W: usize>: Robot<B, N, N> + Sized {
    /// The name of the recording whose first coordinates are this robot's.
    const RECORDED: &'static str;
    /// Through these points.
    const POINTS: [WayPoint<f32, N>; W];
    /// Greatest acceleration, rad/s².
    const ACCELERATION: f32;

    /// Where it goes, tick by tick.
    ///
    /// # Errors
    /// Way-points that the limits do not allow.
    fn way() -> Result<Trajectory<f32, N, W>, TrajectoryError> {
        let speeds = speeds::<Self, B, N>(Self::ACCELERATION);
        Trajectory::new(&Self::POINTS, TICK, &speeds)
    }
}

/// An arm with joints that give way, and a swing of so many stops that leaves them time.
pub trait Swung<const N: usize>: Robot<N, N, N> + Sized {
    /// From stop to stop.
    const STOPS: [WayPoint<f32, N>; 4];
    /// Stiffness, N·m/rad, reflected inertia of the rotor, kg·m², and friction, N·m·s/rad: assumed, of the order of
    /// harmonic drives of this size.
    const JOINTS: [[f64; N]; 3];

    /// The joints in a scalar.
    fn joints<R: Real>() -> ElasticJoints<R, N> {
        let [stiffness, rotor, friction] = Self::JOINTS.map(|numbers| numbers.map(R::from_f64));
        ElasticJoints {
            stiffness,
            rotor,
            friction,
        }
    }

    /// Where it goes, tick by tick.
    ///
    /// # Errors
    /// End stops that the limits do not allow.
    fn swing() -> Result<RestToRest<f32, N, 4>, TrajectoryError> {
        RestToRest::new(&Self::STOPS, TICK, &speeds::<Self, N, N>(8.0))
    }
}

fn speeds<T: Robot<B, N, N>, const B: usize, const N: usize>(
    acceleration: f32,
) -> [MotionLimits<f32>; N] {
    let velocity = 0.0;
    let mut speeds = [MotionLimits {
        velocity,
        acceleration,
    }; N];
    for link in &model::<f32, T, B, N, N>().links {
        if let Some(speed) = speeds.get_mut(link.idx_v) {
            speed.velocity = link.limits.velocity;
        }
    }
    speeds
}

/// A state that nothing is known of beyond.
pub fn momentary<const N: usize>(state: State<f32, N, N>) -> ElasticReference<f32, N, N> {
    let [jerk, snap] = [[0.0; N]; 2];
    ElasticReference { state, jerk, snap }
}

impl Compared<6, 6, 9> for Ur5e {
    const RECORDED: &'static str = "ur5e";
    const POINTS: [WayPoint<f32, 6>; 9] = PICK_AND_PLACE;
    const ACCELERATION: f32 = 12.0;
}

impl Compared<7, 7, 7> for Panda {
    const RECORDED: &'static str = "panda";
    const POINTS: [WayPoint<f32, 7>; 7] = PANDA_PICK_AND_PLACE;
    const ACCELERATION: f32 = 12.0;
}

impl Compared<4, 3, 7> for A1Leg {
    const RECORDED: &'static str = "a1";
    const POINTS: [WayPoint<f32, 3>; 7] = LEG_STEPS;
    const ACCELERATION: f32 = 300.0;
}

impl Swung<6> for Ur5e {
    const STOPS: [WayPoint<f32, 6>; 4] = UR5E_SWING;
    const JOINTS: [[f64; 6]; 3] = [
        [1.5e4, 1.5e4, 1e4, 4e3, 4e3, 4e3],
        [0.9, 0.9, 0.9, 0.25, 0.25, 0.25],
        [12.0, 12.0, 8.0, 2.0, 2.0, 1.5],
    ];
}

impl Swung<7> for Panda {
    const STOPS: [WayPoint<f32, 7>; 4] = PANDA_SWING;
    const JOINTS: [[f64; 7]; 3] = [
        [1.4e4, 1.4e4, 1.4e4, 1.4e4, 9e3, 9e3, 9e3],
        [0.6, 0.6, 0.5, 0.5, 0.2, 0.2, 0.2],
        [5.0, 5.0, 5.0, 5.0, 2.0, 2.0, 2.0],
    ];
}
