//! Trials that run to their end in one call, without an interrupt and a timer: one after the other
//! with their figures in the log, or over and over with each tick sent.

#[cfg(not(feature = "telemetry"))]
pub use log::scene;
#[cfg(feature = "telemetry")]
pub use watch::scene;

#[cfg(not(feature = "telemetry"))]
mod log {
    use cortex_m_semihosting::debug;

    use crate::scene::PlantModel::{self, Exact, Mismatched};
    use crate::scene::{Batch, Less};
    use crate::target::{SAMPLE, Words, begin, fail, figures, head, leave, stack_peak};

    /// Runs the trials to their end and leaves the emulator.
    pub fn scene<T: Batch<N>, const N: usize>() -> ! {
        head::<T, N>(1, T::of_scene(Less::NOTHING, Exact).ticks());
        for effect in T::TERMS {
            defmt::println!("effect {=str} {=usize}", (effect.name)(), effect.bytes);
        }
        for plant in [Exact, Mismatched] {
            for (law, less) in [("feedforward", Less::NOTHING), ("pd", T::BASELINE)] {
                run(plant, less.name(&[], law), &T::of_scene(less, plant));
            }
        }
        if let Some((law, trial)) = T::OTHER {
            run(Exact, ["", law], &trial());
        }
        for less in (0..T::TERMS.len()).map(|term| Less(term as u8)) {
            run(Exact, less.name(T::TERMS, ""), &T::of_scene(less, Exact));
        }
        defmt::println!("stack {=usize}", stack_peak());
        defmt::println!("done");
        leave(debug::EXIT_SUCCESS)
    }

    /// Runs a trial and logs its figures: of one error, as of one joint. Inlined, each of its calls
    /// would have a copy of the trial.
    #[inline(never)]
    fn run<T: Batch<N>, const N: usize>(plant: PlantModel, law: [&str; 2], trial: &T) {
        let see = |telemetry: &joint_drivers::Telemetry<N>, error: f32| {
            if !error.is_nan() && telemetry.tick.is_multiple_of(SAMPLE) {
                let (reference, error) = (Words(&[0.0]), Words(core::slice::from_ref(&error)));
                defmt::println!("sample {=u32}{}{}", telemetry.tick, reference, error);
            }
        };
        begin(plant, law, T::tick_at(&see));
        let Some(out) = trial.run(see) else {
            fail("the simulated robot failed: it has no forward dynamics, or there is no such law");
        };
        let out = T::figures(&out);
        figures(&[out.rms], &[out.max], out.rms, out.start, out.status);
    }
}

#[cfg(feature = "telemetry")]
mod watch {
    use cortex_m_semihosting::debug;
    use machine_link::{Axis, Message, Sample};
    use stm32f4xx_hal::pac;

    use crate::scene::{Batch, Less, PlantModel};
    use crate::target::watch::{MACHINE, argument, port, send};
    use crate::target::{fail, leave};
    use crate::watched::{fill, machine_of};

    /// Sends each tick, for as many as the command line says.
    pub fn scene<T: Batch<N>, const N: usize>() -> ! {
        let Some(Ok(mut port)) = pac::Peripherals::take().map(port) else {
            fail("the serial port is taken, or cannot have this rate");
        };
        let axes = T::LIMITS.into_iter().map(|limits| Axis { limits, prismatic: false });
        let constants: Message<N> = Message::Machine(machine_of(T::NAME, T::TICK, 0, axes));
        // Zero has no end.
        let last = argument(b"ticks").unwrap_or(0);
        let mut sample = Sample::<N>::default();
        let mut see = |telemetry: &_, _| {
            fill(&mut sample, telemetry);
            if sample.number.is_multiple_of(MACHINE) {
                send(&constants, &mut port);
            }
            send(&Message::Tick(sample.message(0)), &mut port);
            sample.number = sample.number.wrapping_add(1);
            if sample.number == last {
                defmt::println!("sent {=u32} of {=u32} ticks", last, last);
                defmt::println!("done");
                leave(debug::EXIT_SUCCESS);
            }
        };
        loop {
            if T::of_scene(Less::NOTHING, PlantModel::Exact).run(&mut see).is_none() {
                fail("the simulated robot has no forward dynamics any more");
            }
        }
    }
}
