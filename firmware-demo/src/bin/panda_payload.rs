//! Runs the scene [`panda_payload`](firmware_demo::scenes::panda_payload).
#![no_std]
#![no_main]

use cortex_m::singleton;
use cortex_m_rt::entry;
use firmware_demo::scene::{App, QUEUE, Record};
use firmware_demo::scenes::panda_payload::Carry;
use firmware_demo::{sim_io::Wires, target};
use heapless::spsc::Queue;

#[entry]
fn main() -> ! {
    static WIRES: Wires<7> = Wires::new();
    let queue = singleton!(: Queue<Record<7>, QUEUE> = Queue::new());
    target::scene(
        &WIRES,
        queue,
        |app| singleton!(: App<Carry, 7, 7, 7, 7> = app),
    )
}
