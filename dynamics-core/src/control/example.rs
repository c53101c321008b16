use dynamics_core::control::*;
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::{Core, robots::Ur5e, state::State};

pub type Effects = (Gravity, Inertia, Coriolis, Armature<f32, 6>);
pub const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]),
);
pub const TICK: f32 = 1e-3; // s
pub const RIDE: u32 = 5; // ticks of a fault that the observer bridges
pub const HOLD: u32 = 100; // ticks more until the brake
pub const REENTRY: u32 = 200; // ticks of the way back
pub const OMEGA_N: f32 = 25.0; // rad/s, of the feedback; the speed of a held arm decays as fast

/// What an arm's control loop remembers from tick to tick.
pub struct Loop {
    gains: Gains<f32, 6>,
    observer: Observer<f32, 6>,
    supervisor: Supervisor<f32, 6>,
    rejoin: Rejoin<f32, 6>,
    clock: u32,  // the trajectory's tick, which stands still during a fault
    blind: bool, // nothing measured for longer than is ridden through
    pub reference: State<f32, 6, 6>, // what the joints follow until the next tick
}

impl Loop {
    /// The loop of an arm at rest at the start of its trajectory.
    pub fn new(bounds: SafetyLimits<f32, 6>, start: [f32; 6]) -> Self {
        let m = Core::<Ur5e>::crba(&start, &EFFECTS);
        let diagonal = core::array::from_fn(|j| m.get(j, j));
        Self {
            gains: Gains::from_inertia(&diagonal, OMEGA_N, 1.0),
            observer: Observer::new(250.0, TICK),
            supervisor: Supervisor::new(bounds, TICK, HOLD, REENTRY).riding(RIDE),
            rejoin: Rejoin::new(TICK, OMEGA_N, REENTRY),
            clock: 0,
            blind: false,
            reference: State::at(start),
        }
    }

    /// One tick: from what the encoders latched in the tick before to what goes to the drives.
    pub fn tick(
        &mut self,
        trajectory: &impl Reference<f32, 6>,
        measured: Result<&[f32; 6], Fault>,
    ) -> Command<f32, 6> {
        let mode = self.supervisor.admit(measured);
        let (seen, q) = (self.supervisor.seen(), self.supervisor.last_good());
        match mode {
            Mode::Stopped if seen => self.observer.reset(q), // on its brake
            _ if seen & self.blind => self.observer.relocate(q),
            _ if seen => _ = self.observer.update_late(q, &self.reference.qdd),
            _ => _ = self.observer.predict(&self.reference.qdd),
        }
        self.blind = !seen & (mode != Mode::Full);
        let estimate = *self.observer.estimate();

        let full = self.supervisor.watch(&estimate.qd) == Mode::Full;
        let share = self.supervisor.authority();
        self.reference = if !full {
            // The clock stops about where the arm comes to rest; the way back starts anew in each of these ticks.
            self.clock = match self.rejoin.active() {
                true => self.rejoin.abandon(),
                false => self.rejoin.meet(self.clock),
            };
            self.rejoin.start(&estimate, self.clock);
            hold(&estimate, self.rejoin.decay())
        } else if self.rejoin.active() & (share < 1.0) {
            self.rejoin.at(trajectory, share)
        } else {
            if self.rejoin.active() {
                self.clock = self.rejoin.finish();
            }
            trajectory.at(self.clock)
        };

        let mut tau = Core::<Ur5e>::rnea(&self.reference, &EFFECTS);
        let pd = feedback(&self.gains, &self.reference, &estimate.q, &estimate.qd);
        for (tau, pd) in tau.iter_mut().zip(pd) {
            *tau += pd;
        }
        let command = self.supervisor.pass(&tau); // its torque and brake go to the drives
        let moving = (command.status.mode == Mode::Full) & !self.rejoin.active();
        self.clock += u32::from(moving);
        command
    }
}
