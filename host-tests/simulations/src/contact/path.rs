//! The pick and place without a wall: what the detector reports there, and when it finds a push.

use dynamics_core::effects::{Coulomb, Effect, Lugre, Viscous};
use firmware_demo::scenes::ur5e;
use firmware_demo::trajectories::HOME;
use motion_control::Trajectory;

use super::firmware::{Cell, Firmware, Sensing};
use super::plant::{Plant, bristles, coulomb};

/// Steps of the plant in a tick.
const STEPS: u32 = 4;

/// By how much a plant differs from the model: its inertias and its friction, as shares of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Off {
    /// The share of each body's inertia.
    pub inertia: [f32; 6],
    /// The share of each joint's friction.
    pub friction: [f32; 6],
}

impl Off {
    /// Each share 1 more or less by these sizes, with signs by the bits of a number.
    pub fn by(inertia: f32, friction: f32, signs: u32) -> Self {
        let of = |size: f32, first: usize| {
            core::array::from_fn(|i| match (signs >> (first + i)) & 1 {
                0 => 1.0 - size,
                _ => 1.0 + size,
            })
        };
        Self {
            inertia: of(inertia, 0),
            friction: of(friction, 6),
        }
    }

    /// With the friction of the model's kind.
    pub fn smooth(&self) -> (Viscous<f32, 6>, Coulomb<f32, 6>) {
        let (.., Coulomb { width, .. }, _) = ur5e::EFFECTS;
        coulomb(self.friction, width)
    }

    pub fn sticking(&self) -> Lugre<f32, 6> {
        bristles(self.friction)
    }
}

/// A torque on one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    pub joint: usize,
    /// N·m.
    pub torque: f32,
}

/// Follows the path once and reports the [excess](Firmware::excess) of each tick. Every `every`
/// ticks, copies of the arm are pushed: the push, and the excess of each of the next `ticks`, are
/// reported to the second function.
///
/// Nothing if the motion exceeds the arm's limits or the arm has no forward dynamics.
pub fn lap<F: Effect<f32, 6, 6> + Clone>(
    sensing: Sensing,
    (inertia, friction): ([f32; 6], F),
    mut free: impl FnMut(u32, f32),
    (every, pushes, ticks): (u32, &[Push], u32),
    mut pushed: impl FnMut(Push, u32, &mut dyn Iterator<Item = f32>),
) -> Option<()> {
    let mut motion = Trajectory::REST;
    ur5e::plan(&mut motion).ok()?;
    let plant = Plant::new(HOME, inertia, friction);
    let mut cell = Cell::new(Firmware::new(sensing, None).ok()?, plant);
    for tick in 0..motion.ticks() {
        cell.tick(&motion, STEPS).ok()?;
        free(tick, cell.firmware.excess());
        if !pushes.is_empty() && tick % every == every - 1 {
            for &push in pushes {
                let mut copy = cell.clone();
                copy.plant.pushed[push.joint] = push.torque;
                let mut excess = (0..ticks).map_while(|_| {
                    copy.tick(&motion, STEPS).ok()?;
                    Some(copy.firmware.excess())
                });
                pushed(push, tick, &mut excess);
            }
        }
    }
    Some(())
}
