//! Picks of a Delta robot: the path of its platform, and the cranks' motion in closed form.

use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use motion_control::limits::MotionLimits;
use motion_control::reference::{Reference, Trajectory, TrajectoryError, WayPoint};

use crate::robots::PickDelta;
use crate::robots::pick_delta::SIDES;
use crate::scene::TICK;

/// The height of a move, m: manufacturers state the speed of such robots for 25 mm up, 305 mm
/// across and 25 mm down.
pub const LIFT: f32 = 0.025;
/// The horizontal distance of a move, m: see [`LIFT`].
pub const REACH: f32 = 0.305;
/// The place of the parts, m.
pub const FEEDER: [f32; 3] = [-0.16, -0.06, -0.95];
/// The duration of a move, ticks: with the return half a second, 120 picks a minute.
pub const MOVE: u32 = 250;
/// [`SIDES`] in f32: nothing is converted in a tick.
const SINGLE: [[f32; 2]; 3] = {
    let mut single = [[0.0; 2]; 3];
    let mut i = 0;
    while i < single.len() {
        single[i] = [SIDES[i][0] as f32, SIDES[i][1] as f32];
        i += 1;
    }
    single
};
/// cos and sin of the directions from the feeder to the places of the parts: −30°, 0°, 30°, 60°.
const PLACES: [[f32; 2]; 4] =
    [[0.866_025_4, -0.5], [1.0, 0.0], [0.866_025_4, 0.5], [0.5, 0.866_025_4]];

/// The duration of a lift, and of lowering, ticks.
const UP: u32 = 60;
/// The horizontal distance from the ends of a move at which it has its full height, m, and its
/// speed there, m/s.
const CORNER: f32 = 0.02;
const SPEED: f32 = 1.5;

/// The number of way-points: the feeder, and three of each move.
const POINTS: usize = 1 + 6 * PLACES.len();

/// The path of the platform.
const WAY: [WayPoint<f32, 3>; POINTS] = {
    let start = WayPoint { q: FEEDER, qd: [0.0; 3], ticks: 0 };
    let (mut way, mut i) = ([start; POINTS], 0);
    while i < PLACES.len() {
        let [cos, sin] = PLACES[i];
        // The move, and the return.
        let mut k = 0;
        while k < 2 {
            let (from, to, sign) = if k == 0 { (0.0, REACH, 1.0) } else { (REACH, 0.0, -1.0) };
            let first = 1 + 6 * i + 3 * k;
            let speed = sign * SPEED;
            way[first] = point([cos, sin], from + sign * CORNER, LIFT, speed, UP);
            way[first + 1] = point([cos, sin], to - sign * CORNER, LIFT, speed, MOVE - 2 * UP);
            way[first + 2] = point([cos, sin], to, 0.0, 0.0, UP);
            k += 1;
        }
        i += 1;
    }
    way
};

/// A way-point at these distances from the feeder, along a horizontal direction and upward, with a
/// speed in this direction.
const fn point(
    [cos, sin]: [f32; 2],
    along: f32,
    lift: f32,
    speed: f32,
    ticks: u32,
) -> WayPoint<f32, 3> {
    let [x, y, z] = FEEDER;
    WayPoint {
        q: [x + cos * along, y + sin * along, z + lift],
        qd: [cos * speed, sin * speed, 0.0],
        ticks,
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Picks {
    platform: Trajectory<f32, 3, POINTS>,
}

impl Picks {
    /// The path, within ten times the acceleration of gravity and 3 m/s.
    ///
    /// # Errors
    /// [`TrajectoryError`] where the path exceeds these limits.
    pub fn new() -> Result<Self, TrajectoryError> {
        let limits = MotionLimits { velocity: 3.0, acceleration: 98.1 };
        let platform = Trajectory::new(&WAY, TICK, &[limits; 3])?;
        Ok(Self { platform })
    }

    /// The platform's position, velocity and acceleration at a tick, m, m/s and m/s².
    pub fn platform(&self, tick: u32) -> State<f32, 3, 3> {
        self.platform.at(tick)
    }
}

impl Reference<f32, 3> for Picks {
    #[inline(always)]
    fn at(&self, tick: u32) -> State<f32, 3, 3> {
        cranks(&self.platform.at(tick))
    }

    fn ticks(&self) -> u32 {
        self.platform.ticks()
    }
}

/// The cranks' motion at that of the platform, with the crank's end on the outer side; NaN where a
/// rod does not reach.
///
/// With e from the crank's end to the platform: a cos θ + b sin θ = k from |e| = l, e·ė = 0, and
/// its derivative.
#[inline(always)]
pub fn cranks<R: Real>(platform: &State<R, 3, 3>) -> State<R, 3, 3> {
    let [radius, l, k0] = const {
        let (l, rod) = (PickDelta::CRANK, PickDelta::ROD);
        [PickDelta::BASE - PickDelta::PLATFORM, l, l * l - rod * rod]
    }
    .map(R::from_f64);
    let half_inv = R::from_f64(const { 0.5 / PickDelta::CRANK });
    let mut cranks = State::at([R::ZERO; 3]);
    for (j, (double, single)) in SIDES.into_iter().zip(SINGLE).enumerate() {
        let [cos, sin] = [0, 1].map(|i| R::select(double[i], single[i]));
        let turned = |[x, y, z]: [R; 3]| [cos * x + sin * y, cos * y - sin * x, z];
        let [x, y, z] = turned(platform.q);
        let (pd, pdd) = (turned(platform.qd), turned(platform.qdd));
        let (a, b) = (x - radius, -z);
        let k = (a * a + y * y + b * b + k0) * half_inv;
        let r2 = a * a + b * b;
        let h = (r2 - k * k).sqrt();
        let r2_inv = R::ONE / r2;
        let (c, s) = ((a * k + b * h) * r2_inv, (b * k - a * h) * r2_inv);
        // e, of the crank's end (l c, 0, −l s), which moves along t = (−l s, 0, −l c) per rad: e·t
        // = l h.
        let e = [a - l * c, y, l * s - b];
        let inv = R::ONE / (l * h);
        let rate = dot(e, pd) * inv;
        let ed = [pd[0] + l * s * rate, pd[1], pd[2] + l * c * rate];
        let inward = e[0] * c - e[2] * s;
        let accel = (dot(e, pdd) + l * inward * rate * rate + dot(ed, ed)) * inv;
        (cranks.q[j], cranks.qd[j], cranks.qdd[j]) = (s.atan2(c), rate, accel);
    }
    cranks
}

/// a·b
fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
