//! Runs the scene [`flexible_joint`](firmware_demo::scenes::flexible_joint).
#![no_std]
#![no_main]

use cortex_m::singleton;
use cortex_m_rt::entry;
use firmware_demo::scene::{App, QUEUE, Record};
use firmware_demo::scenes::flexible_joint::CompliantArm;
use firmware_demo::{sim_io::Wires, target};
use heapless::spsc::Queue;

#[entry]
fn main() -> ! {
    static WIRES: Wires<7> = Wires::new();
    let queue = singleton!(: Queue<Record<7>, QUEUE> = Queue::new());
    target::scene(
        &WIRES,
        queue,
        |app| singleton!(: App<CompliantArm, 7, 7, 7, 7> = app),
    )
}
