//! What M, forward dynamics and Jacobians cost on the iiwa 14.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/engine.rs"]
mod engine;
#[path = "costs/forward.rs"]
mod forward;

use cortex_m_rt::entry;
use dynamics_core::robots::Iiwa14;
use forward::Forms;

#[entry]
fn main() -> ! {
    forward::run::<Iiwa14, 7, 7>(
        &costs::asks::<Iiwa14, 7, 7>(),
        &[
            Forms::core::<Iiwa14, 7>(),
            engine::engine::<Iiwa14, 7, 7, 6>(),
        ],
    )
}
