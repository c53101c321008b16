//! A row of a table: announced in the log, then run between the meter's markers.
//!
//! ```text
//! config ROBOT ALGORITHM FORM INPUTS TRIG JOINTS STATES ADDRESS STACK
//! ```
//!
//! TRIG is 1 if sines and cosines are computed inside; ADDRESS is the function's, and STACK the
//! bytes that it and all that it calls were seen to use.

use core::arch::asm;
use core::hint::black_box;

use dynamics_core::model::Robot;
use firmware_demo::marker::measured;

/// Words painted below the stack pointer: more than any of these functions takes.
const DEPTH: usize = 24 * 1024 / size_of::<u32>();
const PAINT: u32 = 0x5eed_a51c;

/// A row of the table, as the log names it.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    pub robot: &'static str,
    pub algorithm: &'static str,
    pub form: &'static str,
    pub inputs: &'a str,
    pub trig: bool,
    pub joints: usize,
}

impl<'a> Row<'a> {
    /// The row of an algorithm on the robot T.
    #[inline(always)]
    pub fn of<T: Robot<B, N, N>, const B: usize, const N: usize>(
        algorithm: &'static str,
        form: &'static str,
        inputs: &'a str,
        trig: bool,
    ) -> Self {
        Self { robot: T::MODEL.name, algorithm, form, inputs, trig, joints: N }
    }

    /// Logs the row, then runs the function of this address once for each ask in region 0. Taking
    /// the address also keeps the compiler from shaping the function to its calls.
    #[inline(always)]
    pub fn measure<'b, A, T>(self, address: usize, asks: &'b [A], mut run: impl FnMut(&'b A) -> T) {
        let stack = asks.iter().map(|ask| stack_of(|| run(black_box(ask)))).max();
        defmt::println!(
            "config {=str} {=str} {=str} {=str} {=u8} {=usize} {=usize} {=usize} {=usize}",
            self.robot,
            self.algorithm,
            self.form,
            self.inputs,
            u8::from(self.trig),
            self.joints,
            asks.len(),
            // The lowest bit of a function's address says Thumb.
            address & !1,
            stack.unwrap_or_default()
        );
        for ask in asks {
            let ask = black_box(ask);
            black_box(measured::<0, _>(|| run(ask)));
        }
    }
}

/// Numbers within a bound, from a fixed seed.
#[allow(dead_code, reason = "not every bin that measures rows draws its states")]
pub fn numbers() -> impl FnMut(f32) -> f32 {
    let mut seed = 1_u32;
    move |bound| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 * (2.0 * bound / 16_777_216.0) - bound
    }
}

/// Bytes of stack that a call writes to.
#[inline(always)]
fn stack_of<T>(run: impl FnOnce() -> T) -> usize {
    let sp: *mut u32;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) sp, options(nomem, nostack, preserves_flags)) };
    for word in 1..=DEPTH {
        // SAFETY: RAM below the stack pointer, aligned, which nobody uses: no interrupt is enabled.
        unsafe { sp.sub(word).write_volatile(PAINT) };
    }
    black_box(run());
    // SAFETY: the same words.
    let painted = |word: &usize| unsafe { sp.sub(*word).read_volatile() } == PAINT;
    let untouched = (1..=DEPTH).rev().take_while(painted).count();
    (DEPTH - untouched) * size_of::<u32>()
}
