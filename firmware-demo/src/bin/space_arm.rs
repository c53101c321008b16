//! Runs the scene [`space_arm`](firmware_demo::scenes::space_arm).
#![no_std]
#![no_main]

use cortex_m::singleton;
use cortex_m_rt::entry;
use firmware_demo::scene::{App, QUEUE, Record};
use firmware_demo::scenes::space_arm::ReachOut;
use firmware_demo::{sim_io::Wires, target};
use heapless::spsc::Queue;

#[entry]
fn main() -> ! {
    static WIRES: Wires<6> = Wires::new();
    let queue = singleton!(: Queue<Record<6>, QUEUE> = Queue::new());
    target::scene(
        &WIRES,
        queue,
        |app| singleton!(: App<ReachOut, 7, 13, 12, 6> = app),
    )
}
