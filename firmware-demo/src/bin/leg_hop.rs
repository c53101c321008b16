//! Runs the scene [`leg_hop`](firmware_demo::scenes::leg_hop).
#![no_std]
#![no_main]

use cortex_m::singleton;
use cortex_m_rt::entry;
use firmware_demo::scene::{App, QUEUE, Record};
use firmware_demo::scenes::leg_hop::Hopping;
use firmware_demo::{sim_io::Wires, target};
use heapless::spsc::Queue;

#[entry]
fn main() -> ! {
    static WIRES: Wires<3> = Wires::new();
    let queue = singleton!(: Queue<Record<3>, QUEUE> = Queue::new());
    target::scene(
        &WIRES,
        queue,
        |app| singleton!(: App<Hopping, 5, 4, 4, 3> = app),
    )
}
