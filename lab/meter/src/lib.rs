//! Instructions, modelled Cortex-M4F cycles and floating-point operations between two markers.
//!
//! Built as a shared library this is a plugin for QEMU's system emulator:
//!
//! ```text
//! qemu-system-arm … -plugin libcycle_meter.so,out=samples.txt -kernel firmware
//! ```
//!
//! The firmware opens region k (0 to 7) with the instruction `dbg #2k` and closes it with
//! `dbg #2k+1`, a hint that does nothing on silicon. Regions may nest and overlap. When QEMU exits,
//! the plugin writes a line for each closed region (see [`parse_samples`]). As an ordinary library
//! it reads that file, and decodes Thumb code for whoever checks a firmware ([`decode()`],
//! [`operation()`], [`relative()`]). It must be the only plugin that runs, on a machine with one
//! processor, under QEMU 4.2 or later. It speaks versions 1 to [`NEWEST_INTERFACE`] of QEMU's
//! plugin interface and looks at the QEMU that loads it to choose one; the environment variable
//! [`INTERFACE`] sets another version, for a QEMU that refuses that one. QEMU's functions are
//! looked up when the library is loaded, so it links anywhere.
//!
//! # Counted exactly
//!
//! Instructions: each one that QEMU executes between the markers is counted once,
//! a predicated one whether its condition holds or not, and those of an interrupt
//! that is served in between. Markers count nothing and cost nothing, so marking the
//! phases of a region leaves the region's figures as they were. Under `-icount` two
//! runs give the same file; without it, interrupts come when the host pleases.
//!
//! Floating-point operations: sums, differences, products, quotients and roots one each,
//! multiply-accumulates two; moves, signs, comparisons and conversions none.
//!
//! # Modelled
//!
//! Cycles, after the instruction timings in the Cortex-M4 Technical Reference Manual
//! (ARM 100166, sections 3.3 and 7.2.3 with their notes), for memory that never waits:
//!
//! | instructions | cycles |
//! |---|---|
//! | data processing, `MUL`, `MLA`, `UMULL`, `SMLAL` …, `IT`, `NOP`, `DMB`, `DSB` | 1 |
//! | `SDIV`, `UDIV` | 12, the worst of 2 to 12 |
//! | `MRS`, `MSR`, `CPS`; `ISB` | 2; 3 |
//! | branch not taken; taken (also calls, returns, loads into the PC) | 1; 2 more |
//! | `TBB`, `TBH` | 2 and the branch |
//! | `LDR`, `LDREX`, `STREX`, `VLDR.32` | 2; 1 right behind another of them, unless its address depends on that one |
//! | `STR`, `VSTR.32` | 1 |
//! | `LDM`, `STM`, `PUSH`, `POP`, `LDRD`, `STRD`, `VLDM`, `VSTM`, `VLDR.64`, `VSTR.64` | 1 + words |
//! | address from a register that the previous instruction wrote | 1 more |
//! | `VADD`, `VSUB`, `VMUL`, `VCVT`, `VCMP`, `VMOV`, `VABS`, `VNEG`, `VMRS`, `VMSR` | 1 |
//! | `VMOV` of two words between core and floating-point registers | 2 |
//! | `VMLA`, `VMLS`, `VFMA`, `VFMS` and their negations | 3 |
//! | result of a sum, product, quotient, conversion … used by the next instruction | 1 more |
//! | `VDIV`, `VSQRT` | 1, and 13 more which the next floating-point instruction waits for |
//!
//! The manual leaves room, and these are the choices:
//!
//! - The manual charges the address interlock after data processing; we charge it after a load too.
//!   A base register that is only updated (`[r0], #4`, `PUSH`) interlocks nothing.
//! - `VSTR` is given 1 cycle like `STR`, which the manual gives 2: the store buffer takes it.
//! - An `IT` is often folded into its predecessor and then free; we charge it. A
//!   predicated instruction costs the same whether its condition holds or not.
//! - The multiply-accumulate takes its addend a cycle later than its factors; we charge all three
//!   alike.
//! - Whether a branch was taken is told by the address after it. One to the very
//!   next address counts as not taken.
//! - A division still running when its region is closed is charged to whoever waits for it.
//! - The refill is 1 to 3 cycles, by the alignment and the width of the target; we take 2.
//!
//! The manual leaves room in these choices too:
//!
//! | choice | least | chosen | most |
//! |---|---|---|---|
//! | refill after a branch | 1 | 2 | 3 |
//! | address from a register that a load wrote in the previous instruction | not pipelined | 1 more | 1 more |
//! | `VLDR.32` right behind a load; `VSTR.32` | 1; 1 | 1; 1 | 2; 2 |
//! | `IT` | 0 | 1 | 1 |
//! | addend of a multiply-accumulate from the previous instruction | 0 | 1 more | 1 more |
//! | `SDIV`, `UDIV` | 2 | 12 | 12 |
//!
//! The page `silicon.md` of the laboratory compares the model with cycles that others counted on
//! chips.
//!
//! # Flash that waits
//!
//! Beside these cycles a sample has those that code in a flash with wait states takes more, for
//! each of [`FLASHES`]: an STM32G474 (RM0440, 3.3) and an STM32F405 (RM0090, 3.5). Code in memory
//! that is coupled to the core, or linked to [`COUPLED`] in its place, waits for none.
//!
//! - The core fetches a word a cycle, up to three words ahead of the instruction that it decodes.
//!   An executed branch empties this queue.
//! - The flash gives a line at a time, after its wait states. It reads lines in the order in which
//!   they were asked for, and breaks none off. The first word of each line asks for the next line
//!   too.
//! - A cache for code and one for data keep lines; the one that was not used for longest is
//!   replaced. Every line that was read for code enters, one that was read ahead too.
//! - A load from flash that its cache does not hold stops the core, and is read after those lines.
//! - RAM on the system bus, from 0x2000_0000 on, gives a word in two cycles. Chips are slower
//!   still, since code and data compete there: the author of RobotDynamics counted up to 61 % more
//!   than from the flash of an STM32G474.
//! - While no region is open, caches stay as they are: a tick finds them as the tick before left
//!   them. Firmware that runs between two ticks makes them colder.
//!
//! The manuals leave open which lines enter, which of them share a place, and what goes first.
//! `silicon.md` has what was tried, and how far the model is from chips.
//!
//! # Not modelled
//!
//! Contention on the buses (with DMA, and between code and data in RAM), unaligned access, a full
//! write buffer, entry to and return from an interrupt (12 and 10 cycles at least), waiting in
//! `WFI` and `WFE`, and any other core: the Cortex-M7 issues two instructions at once and is
//! nothing like this.
//!
//! # Method
//!
//! Code is decoded once, when QEMU translates a block of it, and its costs are
//! summed then; at run time there is one call for each block and one for each marker.
//! A block is charged when its successor is known. Stalls from one
//! block to the next are followed, so where QEMU cuts its blocks does not show. While a region is
//! open, the memories that wait see each instruction, and QEMU calls for each load.

mod block;
mod decode;
mod fetch;
#[cfg(unix)]
mod ffi;
mod hand_counted;
mod insn;
mod meter;
mod model;
#[cfg(unix)]
mod plugin;
mod samples;

pub use decode::{Operation, Relative, decode, operation, relative, size};
pub use fetch::{COUPLED, F405, FLASHES, Flash, G474};
pub use hand_counted::check_hand_counted;
pub use insn::{Class, Insn, Marker};
pub use model::Pipe;
/// The newest version of QEMU's plugin interface that the plugin knows.
pub const NEWEST_INTERFACE: i32 = 7;
/// The environment variable that sets the version of the interface which the plugin asks QEMU for.
pub const INTERFACE: &str = "CYCLE_METER_INTERFACE";

pub use samples::{Error, HEADER, Sample, Summary, parse_samples};
