//! The robot on the ground: wheels that roll, slip and leave it, a kerb, skids, and pushes.

use core::f32::consts::PI;

use dynamics_core::clusters::ForwardError;
use dynamics_core::effects::{
    Armature, Contact, Coriolis, Coulomb, Effect, EndStops, Gravity, Inertia, Viscous, Width, hook,
};
use dynamics_core::model::Calibrated;
use dynamics_core::state::State;
use glam::{Mat3, Vec3};

use super::{EFFECTS, Order, Pitch, RESOLUTION, TICK};
use crate::plant::{ClusterPlant, Simulated};
use crate::robots::{COORDINATES, Straight, WheelLeg};
use crate::scene::PlantModel;
use crate::scenes::openarm_free_drive::plant::Random;

/// The plant's steps in a tick, of 250 µs.
const STEPS: usize = 8;
/// A tyre on concrete; the numbers are assumed.
const TYRE: Contact<f32, 0> = Contact {
    points: [],
    normal: Vec3::Z,
    height: 0.0,
    stiffness: 2e4,
    damping: 150.0,
    damping_depth: Width::f32(5e-4),
    friction: 0.8,
    slip_tolerance: 0.1,
};
/// Friction of the skids, of smooth plastic.
const SKID_FRICTION: f32 = 0.3;
/// The unit's error of the pitch, and the noise of angle and rate, rad and rad/s.
const SENSOR: [f32; 3] = [5e-3, 5e-4, 5e-3];

/// Level ground with a step up from `from` on, and a push at the body, in the base's coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Ground {
    /// Where the kerb begins, and its height, m.
    pub kerb: [f32; 2],
    pub friction: f32,
    /// N.
    pub push: Vec3,
}

impl Ground {
    fn height(&self, x: f32) -> f32 {
        if x > self.kerb[0] { self.kerb[1] } else { 0.0 }
    }

    /// Adds the force on the point at `arm` from a body's origin.
    fn touch(
        [normal, through]: [Vec3; 2],
        friction: f32,
        pos: Vec3,
        v: [Vec3; 2],
        arm: Vec3,
        sum: &mut [Vec3; 2],
    ) {
        let height = normal.dot(through);
        let contact = Contact { normal, height, friction, ..TYRE };
        let force = contact.force(pos + arm, v[0] + v[1].cross(arm));
        sum[0] += force;
        sum[1] += arm.cross(force);
    }

    /// Force and couple on a disc about `axle`.
    fn on_wheel(&self, pos: Vec3, v: [Vec3; 2], axle: Vec3) -> [Vec3; 2] {
        let mut sum = [Vec3::ZERO; 2];
        let [from, height] = self.kerb;
        let edge = Vec3::new(from, pos.y, height);
        let off = pos - edge;
        let kerb = if off.x >= 0.0 {
            Vec3::Z
        } else if off.z <= 0.0 {
            Vec3::NEG_X
        } else {
            Vec3::new(off.x, 0.0, off.z).normalize()
        };
        let planes = [[kerb, edge], [Vec3::Z, Vec3::ZERO]];
        for plane in planes.into_iter().take(if off.x >= 0.0 { 1 } else { 2 }) {
            let down = plane[0] - axle * plane[0].dot(axle);
            let arm = down * (-WheelLeg::RADIUS as f32 / down.length().max(0.1));
            Self::touch(plane, self.friction, pos, v, arm, &mut sum);
        }
        sum
    }

    /// The same on the skids.
    fn on_skids(&self, pos: Vec3, v: [Vec3; 2], to_base: Mat3) -> [Vec3; 2] {
        let mut sum = [Vec3::ZERO; 2];
        for arm in skids().map(|end| to_base * end) {
            let through = Vec3::Z * self.height((pos + arm).x);
            Self::touch([Vec3::Z, through], SKID_FRICTION, pos, v, arm, &mut sum);
        }
        sum
    }
}

fn skids() -> [Vec3; 4] {
    let [x, y, z] = WheelLeg::SKID.map(|x| x as f32);
    [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[a, b]| Vec3::new(a * x, b * y, z))
}

impl<const B: usize, const V: usize> Effect<f32, B, V> for Ground {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f32> =
        hook::Wrench::of_state(|ground, body, at, fx| {
            let is_wheel = WheelLeg::WHEELS.contains(&body);
            if !is_wheel && body != WheelLeg::BODY {
                return;
            }
            let (pos, to_base) = (at.pose.pos, at.pose.rot.transpose());
            let v = [to_base * at.velocity.lin, to_base * at.velocity.ang];
            let [force, couple] = if is_wheel {
                ground.on_wheel(pos, v, to_base * Vec3::Y)
            } else {
                let [force, couple] = ground.on_skids(pos, v, to_base);
                [force + ground.push, couple]
            };
            fx.lin += at.pose.rot * force;
            fx.ang += at.pose.rot * couple;
        });
}

type Scene = (
    Gravity,
    Inertia,
    Coriolis,
    Viscous<f32, 16>,
    Coulomb<f32, 16>,
    Armature<f32, 16>,
    Ground,
    EndStops<f32, 16>,
);

#[derive(Debug)]
pub struct Plant {
    pub robot: ClusterPlant<WheelLeg, Scene, 16, 16, COORDINATES>,
    random: Random,
    /// The error of the pitch, rad.
    bias: f32,
    noise: f32,
}

/// Rubber at the cranks, 0.8 rad above level and 1.4 rad below it.
fn stops() -> EndStops<f32, 16> {
    let (mut lower, mut upper) = ([-1e6; 16], [1e6; 16]);
    for rear in [WheelLeg::BODY + 1, WheelLeg::BODY + 6] {
        (lower[rear], upper[rear]) = (PI - 1.4, PI + 0.8);
        (lower[rear + 2], upper[rear + 2]) = (-0.8, 1.4);
    }
    EndStops { lower, upper, stiffness: 500.0, damping: 2.0, damping_depth: Width::f32(1e-2) }
}

impl Plant {
    /// At rest with the legs of [`Order::STAND`], heading this way, rad; with a robot, friction and
    /// sensors that are drawn, or those of the model.
    pub fn new(model: PlantModel, kerb: [f32; 2], heading: f32, mut random: Random) -> Self {
        let off = if model == PlantModel::Exact { 0.0 } else { 1.0 };
        let mut factor = |share: f32| random.within(1.0 - off * share, 1.0 + off * share);
        let mut robot = Calibrated::nominal();
        for inertia in robot.inertias() {
            let factor = factor(0.03);
            inertia.mass *= factor;
            inertia.first_moment *= factor;
            inertia.rotational *= factor;
        }
        let (gravity, inertia, coriolis, mut viscous, mut coulomb, rotors) = EFFECTS;
        viscous.0.iter_mut().for_each(|x| *x *= factor(0.3));
        coulomb.torque.iter_mut().for_each(|x| *x *= factor(0.3));
        let ground = Ground { kerb, friction: 0.8 * factor(0.1), push: Vec3::ZERO };
        let scene = (gravity, inertia, coriolis, viscous, coulomb, rotors, ground, stops());
        let Straight { front, .. } = Straight::of_length(Order::STAND.length);
        let rear = PI - front;
        let up = WheelLeg::RADIUS as f32 + Order::STAND.length;
        let y = [0.0, 0.0, up, heading, 0.0, 0.0, rear, front, 0.0, rear, front, 0.0];
        let bias = off * SENSOR[0] * random.within(-1.0, 1.0);
        Self { robot: ClusterPlant::new(robot, scene, y), random, bias, noise: off }
    }

    pub fn state(&self) -> &State<f32, COORDINATES, COORDINATES> {
        &self.robot.y
    }

    pub fn ground(&mut self) -> &mut Ground {
        &mut self.robot.effects.6
    }

    /// The encoders' positions and the unit's pitch.
    pub fn measured(&mut self) -> ([f32; 6], Pitch) {
        let y = self.robot.y;
        let count = |q: f32| libm::roundf(q / RESOLUTION) * RESOLUTION;
        let q = core::array::from_fn(|j| count(y.q[WheelLeg::PITCH + 1 + j]));
        let mut noise = |most: f32| self.noise * most * self.random.within(-1.0, 1.0);
        let (angle, rate) = (noise(SENSOR[1]), noise(SENSOR[2]));
        let pitch = Pitch {
            angle: y.q[WheelLeg::PITCH] + self.bias + angle,
            rate: y.qd[WheelLeg::PITCH] + rate,
        };
        (q, pitch)
    }

    /// The least height of a skid's end above the ground, m.
    pub fn clearance(&self) -> f32 {
        let y = &self.robot.y.q;
        let turn =
            Mat3::from_rotation_z(y[3]) * Mat3::from_rotation_x(y[4]) * Mat3::from_rotation_y(y[5]);
        let ends = skids().map(|end| Vec3::new(y[0], y[1], y[2]) + turn * end);
        let ground = self.robot.effects.6;
        ends.into_iter().map(|end| end.z - ground.height(end.x)).fold(f32::MAX, f32::min)
    }

    /// A tick under the motors' torques.
    ///
    /// # Errors
    /// As forward dynamics.
    pub fn tick(&mut self, torque: &[f32; 6]) -> Result<(), ForwardError> {
        let mut tau = [0.0; COORDINATES];
        tau[WheelLeg::PITCH + 1..].copy_from_slice(torque);
        for _ in 0..STEPS {
            Simulated::<(), COORDINATES>::step(&mut self.robot, &tau, &(), TICK / STEPS as f32)?;
        }
        Ok(())
    }
}
