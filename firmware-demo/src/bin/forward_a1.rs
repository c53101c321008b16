//! What M, forward dynamics and Jacobians cost on the A1, by the core: the engine's build takes too long for a test.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/forward.rs"]
mod forward;

use cortex_m_rt::entry;
use dynamics_core::robots::A1;
use forward::Forms;

#[entry]
fn main() -> ! {
    forward::run::<A1, 16, 12>(&costs::asks::<A1, 16, 12>(), &[Forms::core::<A1, 16>()])
}
