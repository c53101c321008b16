//! The robots, each with a way to go.

use dynamics_core::model::{Robot, model};
use dynamics_core::robots::{A1Leg, Panda, Ur5e};
use firmware_demo::scene::TICK;
use firmware_demo::trajectories::PICK_AND_PLACE;
use motion_control::{MotionLimits, Trajectory, TrajectoryError, WayPoint};

use crate::Own;
use crate::trajectories::{LEG_STEPS, PANDA_PICK_AND_PLACE};

/// A robot of N joints and B bodies, its way through W points, and all ways to compute its torques.
pub trait Compared<const B: usize, const N: usize, const W: usize>: Robot<B, N, N> + Sized {
    /// The name of the recording whose first coordinates are this robot's; none if nothing was
    /// recorded of it.
    const RECORDED: Option<&'static str>;
    /// Greatest acceleration, rad/s².
    const ACCELERATION: f32;

    fn points() -> [WayPoint<f32, N>; W];

    /// The trajectory, tick by tick.
    ///
    /// # Errors
    /// Way-points that the limits do not allow.
    fn way() -> Result<Trajectory<f32, N, W>, TrajectoryError> {
        let speeds = speeds::<Self, B, N>(Self::ACCELERATION);
        Trajectory::new(&Self::points(), TICK, &speeds)
    }
}

/// The largest |q|, rad or m, and |q̇|, rad/s or m/s, of a joint without limits along the path.
const UNLIMITED: [f32; 2] = [1.5, 2.0];
/// The share of the position limits within which a robot from a file stays.
const WITHIN: f32 = 0.6;
/// rad or m: a joint with a larger range counts as one without limits.
const RANGE: f32 = 13.0;
/// The way-points of a robot from a file but for the middle, where it starts and ends, as shares of
/// what it stays within: of three joints, and in turn of those after them.
const SHARES: [[f32; 3]; 3] = [[1.0, -0.7, 0.5], [-0.6, 1.0, -1.0], [0.3, -1.0, 0.8]];

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
            // A file may state no limit.
            let limit = link.limits.velocity;
            speed.velocity = if limit.is_finite() {
                limit
            } else {
                UNLIMITED[1]
            };
        }
    }
    speeds
}

impl Compared<6, 6, 9> for Ur5e {
    const RECORDED: Option<&'static str> = Some("ur5e");
    const ACCELERATION: f32 = 12.0;

    fn points() -> [WayPoint<f32, 6>; 9] {
        PICK_AND_PLACE
    }
}

impl Compared<7, 7, 7> for Panda {
    const RECORDED: Option<&'static str> = Some("panda");
    const ACCELERATION: f32 = 12.0;

    fn points() -> [WayPoint<f32, 7>; 7] {
        PANDA_PICK_AND_PLACE
    }
}

impl Compared<4, 3, 7> for A1Leg {
    const RECORDED: Option<&'static str> = Some("a1");
    const ACCELERATION: f32 = 300.0;

    fn points() -> [WayPoint<f32, 3>; 7] {
        LEG_STEPS
    }
}

impl<T: Robot<N, N, N>, const N: usize> Compared<N, N, 5> for Own<T> {
    const RECORDED: Option<&'static str> = None;
    const ACCELERATION: f32 = 12.0;

    fn points() -> [WayPoint<f32, N>; 5] {
        let speeds = speeds::<Self, N, N>(Self::ACCELERATION);
        let (mut middle, mut half) = ([0.0; N], [UNLIMITED[0]; N]);
        for link in &model::<f32, Self, N, N, N>().links {
            let range = link.limits.upper - link.limits.lower;
            if range <= RANGE {
                middle[link.idx_v] = 0.5 * (link.limits.lower + link.limits.upper);
                half[link.idx_v] = 0.5 * WITHIN * range;
            }
        }
        let stop = |q| WayPoint {
            q,
            qd: [0.0; N],
            ticks: 0,
        };
        let mut points = [stop(middle); 5];
        for k in 1..5 {
            if let Some(shares) = SHARES.get(k - 1) {
                points[k].q = core::array::from_fn(|j| middle[j] + shares[j % 3] * half[j]);
            }
            // A quintic from rest to rest takes peaks of 15/8 D/T and 10/√3 D/T².
            let times = core::array::from_fn::<_, N, _>(|j| {
                let step = (points[k].q[j] - points[k - 1].q[j]).abs();
                let by_acceleration = libm::sqrtf(5.8 * step / speeds[j].acceleration);
                by_acceleration.max(1.9 * step / speeds[j].velocity)
            });
            let time = times.into_iter().fold(TICK, f32::max);
            points[k].ticks = libm::ceilf(time / TICK) as u32;
        }
        points
    }
}
