//! The motion of a gimbal on a ship's mast that keeps its camera on its target.

use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use motion_control::reference::Reference;

use crate::robots::Ship;
use crate::robots::ship::Swing;
use crate::scene::TICK;

/// A camera on a roll, a pitch and a pan axis that stays level on a ship and sweeps a sector of the
/// horizon.
///
/// The first two axes undo the ship's last two turns, the third its first: the angles are those of
/// the ship, and no inverse of a sine is needed. It goes on after its end, as the ship does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watch<R: Real> {
    pub ship: Ship<R>,
    /// The direction of view relative to the course, rad.
    pub sweep: Swing<R>,
    /// Ticks of the watch.
    pub ticks: u32,
}

impl<R: Real> Watch<R> {
    /// The joints after t seconds.
    #[inline(always)]
    pub fn after(&self, t: R) -> State<R, 3, 3> {
        let Ship { roll, pitch, yaw, .. } = &self.ship;
        let (roll, pitch, yaw, sweep) = (roll.at(t), pitch.at(t), yaw.at(t), self.sweep.at(t));
        let joints = |k: usize| [-roll[k], -pitch[k], sweep[k] - yaw[k]];
        State { q: joints(0), qd: joints(1), qdd: joints(2) }
    }
}

impl Reference<f32, 3> for Watch<f32> {
    #[inline(always)]
    fn at(&self, tick: u32) -> State<f32, 3, 3> {
        self.after(tick as f32 * TICK)
    }

    fn ticks(&self) -> u32 {
        self.ticks
    }
}
