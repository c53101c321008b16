//! A swing to and fro with a pause after each: there through a shaper, and back without; and the
//! motion of modes under it.

use core::cell::Cell;

use dynamics_core::effects::Inertia;
use dynamics_core::flexible::{ModalFeedforward, Modes, crba};
use dynamics_core::model::RobotModel;
use dynamics_core::state::State;
use motion_control::limits::MotionLimits;
use motion_control::reference::{
    Reference, Shaped, Shaper, Trajectory, TrajectoryError, Vibration, WayPoint,
};

use crate::scene::TICK;

/// Impulses of ZV shapers of two vibrations.
pub const IMPULSES: usize = 9;

/// A rest-to-rest motion in `TICKS` ticks.
pub type Move = Trajectory<f32, 2, 2>;

/// From one pose to another and rest.
///
/// # Errors
/// A motion beyond the limits.
pub fn rest_to_rest(
    from: [f32; 2],
    to: [f32; 2],
    ticks: u32,
    limits: &[MotionLimits<f32>; 2],
) -> Result<Move, TrajectoryError> {
    let point = |q, ticks| WayPoint { q, qd: [0.0; 2], ticks };
    Trajectory::new(&[point(from, 0), point(to, ticks)], TICK, limits)
}

/// The shaper of a robot's two slowest vibrations at a pose.
pub fn shaper<D>(robot: &D, modes: &Modes<f32, 4>, q: [f32; 2]) -> Option<Shaper<f32, IMPULSES>>
where
    D: RobotModel<f32, 2, 2, 2>,
{
    let inertia = crba(robot, modes, &q, &[0.0; 4], &Inertia);
    let omega = modes.frequencies(&inertia).ok()?;
    let of = |mode: usize| Vibration { link: "arm", mode, omega: omega[mode], damping_ratio: 0.01 };
    Shaper::zv(&[of(0), of(1)], TICK).ok()
}

/// There through a shaper, a pause, and back without.
#[derive(Debug)]
pub struct SwingAndBack {
    pub there: Shaped<Move, f32, IMPULSES>,
    pub back: Move,
    /// Ticks of the pause.
    pub pause: u32,
    /// The modes under the reference: the tick to which they have moved, and their motion at the
    /// tick before.
    modal: Cell<(u32, State<f32, 4, 4>)>,
}

impl SwingAndBack {
    pub fn new(there: Shaped<Move, f32, IMPULSES>, back: Move, pause: u32) -> Self {
        Self { there, back, pause, modal: Cell::new((u32::MAX, State::at([0.0; 4]))) }
    }

    /// The modes before a tick: the next after the last call, the same, or the first, at which
    /// `start` is called.
    pub fn modes_before(
        &self,
        tick: u32,
        start: impl Fn() -> State<f32, 4, 4>,
        advance: impl Fn(&mut ModalFeedforward<f32, 4>, &State<f32, 2, 2>),
    ) -> State<f32, 4, 4> {
        let (at, bent) = self.modal.get();
        if tick == 0 && at != 0 {
            self.modal.set((0, start()));
        } else if tick == at.wrapping_add(1) {
            let mut modes = ModalFeedforward { bent };
            advance(&mut modes, &Reference::at(self, at));
            self.modal.set((tick, modes.bent));
        }
        self.modal.get().1
    }
}

impl Reference<f32, 2> for SwingAndBack {
    fn at(&self, tick: u32) -> State<f32, 2, 2> {
        match tick.checked_sub(self.there.ticks() + self.pause) {
            None => self.there.at(tick),
            Some(later) => self.back.at(later),
        }
    }

    fn ticks(&self) -> u32 {
        self.there.ticks() + self.back.ticks() + 2 * self.pause
    }
}
