//! Runs the scene [`gimbal_ship`](firmware_demo::scenes::gimbal_ship).
#![no_std]
#![no_main]

use cortex_m::singleton;
use cortex_m_rt::entry;
use firmware_demo::scene::{App, QUEUE, Record};
use firmware_demo::scenes::gimbal_ship::OnWatch;
use firmware_demo::{sim_io::Wires, target};
use heapless::spsc::Queue;

#[entry]
fn main() -> ! {
    static WIRES: Wires<3> = Wires::new();
    let queue = singleton!(: Queue<Record<3>, QUEUE> = Queue::new());
    target::scene(
        &WIRES,
        queue,
        |app| singleton!(: App<OnWatch, 3, 3, 3, 3> = app),
    )
}
