//! The control loop of a scene without a simulated robot: the encoders show the reference of each
//! tick, quantised, and a digest of the commanded torques says whether two processors compute the
//! same bits.
//!
//! Nothing here depends on a processor: `cores` runs it on the cores of QEMU, and firmware of a
//! board can do so too.

use core::fmt;

use joint_drivers::{Probe, Telemetry};
use motion_control::limits::{Mode, Status};
use motion_control::reference::Reference;

use crate::digest::Digest;
use crate::scene::{Full, Scene, SimLoop, StartError, marked_tick, simulated_loop};
use crate::sim_io::Wires;

/// The control loop of a scene on wires whose encoders follow the reference exactly.
///
/// ```
/// use motion_control::limits::Mode;
/// use firmware_demo::{replay::Replay, scenes::scara_table::Serve, sim_io::Wires};
///
/// static WIRES: Wires<3> = Wires::new();
/// let mut replay = Replay::<Serve, 3, 3, 3, 3>::new(&WIRES)?;
/// replay.show();
/// assert_eq!(replay.tick().status.mode, Mode::Full);
/// # Ok::<(), firmware_demo::scene::StartError>(())
/// ```
pub struct Replay<
    S: Scene<B, Q, V, N>,
    const B: usize,
    const Q: usize,
    const V: usize,
    const N: usize,
> {
    reference: S::Reference,
    wires: &'static Wires<N>,
    control: SimLoop<N>,
    ticks: u32,
}

/// A tick did not run under the full law: the digest of its torques would say nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted {
    /// Ticks from the start.
    pub tick: u32,
    pub status: Status,
}

impl fmt::Display for Interrupted {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "tick {} is not undisturbed: ", self.tick)?;
        fmt::Debug::fmt(&self.status, out)
    }
}

impl core::error::Error for Interrupted {}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Replay<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    /// The loop before its first tick.
    ///
    /// # Errors
    /// [`StartError`].
    pub fn new(wires: &'static Wires<N>) -> Result<Self, StartError> {
        let reference = S::reference().map_err(StartError::Trajectory)?;
        wires.publish(&reference.at(0).q);
        let control =
            simulated_loop::<S, _, B, Q, V, N>(&reference, wires, ()).map_err(StartError::Setup)?;
        Ok(Self { reference, wires, control, ticks: 0 })
    }

    /// The ticks from the start of the reference to its end.
    pub fn length(&self) -> u32 {
        self.reference.ticks()
    }

    /// Shows the encoders the reference of the next tick.
    pub fn show(&self) {
        self.wires.publish(&self.reference.at(self.ticks).q);
    }

    /// One tick of the control loop under the full feed-forward.
    #[inline(always)]
    pub fn tick(&mut self) -> Telemetry<N> {
        let environment = S::environment(&self.reference, self.ticks as f32);
        self.ticks += 1;
        marked_tick::<Full<S, B, Q, V>, _, _, N>(&mut self.control, &self.reference, &environment)
    }

    /// The same with a probe in place of the meter's markers.
    #[inline(never)]
    pub fn tick_probed(&mut self, probe: &mut impl Probe<N>) -> Telemetry<N> {
        let environment = S::environment(&self.reference, self.ticks as f32);
        self.ticks += 1;
        self.control.tick_probed::<Full<S, B, Q, V>, _, _>(&self.reference, &environment, probe)
    }

    /// Runs this many ticks, each by `tick` (which calls [`Self::tick`] and may measure it): the
    /// digest of the bits of every commanded torque.
    ///
    /// # Errors
    /// A tick with a fault, or under another law than the full one.
    pub fn run(
        &mut self,
        ticks: u32,
        mut tick: impl FnMut(&mut Self) -> Telemetry<N>,
    ) -> Result<Digest, Interrupted> {
        let mut digest = Digest::EMPTY;
        for number in 0..ticks {
            self.show();
            let Telemetry { status, torque, .. } = tick(self);
            if !matches!(status.mode, Mode::Full) || status.fault.is_some() {
                return Err(Interrupted { tick: number, status });
            }
            digest.add(torque);
        }
        Ok(digest)
    }
}
