//! The controller of a scene without its robot: encoder frames in, duties out.

use heapless::Vec;
use joint_drivers::Telemetry;
use telemetry::pil::{Commanded, Measured};
use telemetry::{Sample, Tick};

use crate::scene::{Full, Scene, SimLoop, StartError, marked_tick, simulated_loop};
use crate::sim_io::Wires;
use crate::watched::fill;

/// A scene's control loop on wires whose other ends are elsewhere.
pub struct Controlled<
    S: Scene<B, Q, V, N>,
    const B: usize,
    const Q: usize,
    const V: usize,
    const N: usize,
> {
    reference: S::Reference,
    wires: &'static Wires<N>,
    control: SimLoop<N>,
    last: Commanded<N>,
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Controlled<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    /// The loop at the start of its trajectory.
    ///
    /// # Errors
    /// [`StartError`].
    pub fn new(wires: &'static Wires<N>) -> Result<Self, StartError> {
        let reference = S::reference().map_err(StartError::Trajectory)?;
        Ok(Self {
            control: simulated_loop::<S, _, B, Q, V, N>(&reference, wires, ())
                .map_err(StartError::Setup)?,
            reference,
            wires,
            last: Commanded::default(),
        })
    }

    /// One tick on these frames; the reply of before if their number came before.
    pub fn tick(&mut self, measured: &Measured<N>) -> &Commanded<N> {
        let number = measured.number;
        if number > 0 && number == self.last.tick.number {
            return &self.last;
        }
        self.wires.answer(&measured.answers);
        // It started before: the limits are the same.
        if let (0, Ok(control)) = (
            number,
            simulated_loop::<S, _, B, Q, V, N>(&self.reference, self.wires, ()),
        ) {
            self.control = control;
        }
        let environment = S::environment(&self.reference, number as f32);
        let telemetry = marked_tick::<Full<S, B, Q, V>, _, _, N>(
            &mut self.control,
            &self.reference,
            &environment,
        );
        self.last = Commanded {
            duties: Vec::from_array(self.wires.counts()),
            tick: tick(number, telemetry),
        };
        &self.last
    }
}

/// The controller's data of a tick.
fn tick<const N: usize>(number: u32, telemetry: Telemetry<N>) -> Tick<N> {
    let mut sample = Sample::default();
    fill(&mut sample, &telemetry);
    sample.number = number;
    sample.message(0)
}
