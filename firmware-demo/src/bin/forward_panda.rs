//! What M, forward dynamics and Jacobians cost on the Panda.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/engine.rs"]
mod engine;
#[path = "costs/forward.rs"]
mod forward;

use cortex_m_rt::entry;
use dynamics_core::robots::Panda;
use forward::Forms;

#[entry]
fn main() -> ! {
    forward::run::<Panda, 7, 7>(
        &costs::asks::<Panda, 7, 7>(),
        &[
            Forms::core::<Panda, 7>(),
            engine::engine::<Panda, 7, 7, 6>(),
        ],
    )
}
