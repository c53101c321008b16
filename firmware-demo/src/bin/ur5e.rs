//! Runs the scene [`ur5e`](firmware_demo::scenes::ur5e).
#![no_std]
#![no_main]

use cortex_m::singleton;
use cortex_m_rt::entry;
use firmware_demo::plant::Wires;
use firmware_demo::scene::{App, Record};
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::target;
use heapless::spsc::Queue;

#[entry]
fn main() -> ! {
    static WIRES: Wires<6> = Wires::new();
    let queue = singleton!(: Queue<Record<6>, 32> = Queue::new());
    let Some((records, log)) = queue.map(Queue::split) else {
        target::fail("main ran twice");
    };
    let app = match App::new(&WIRES, records) {
        Ok(app) => singleton!(: App<PickAndPlace, 6, 6, 9> = app),
        Err(_) => target::fail("the way-points need more than the arm's limits"),
    };
    match app {
        Some(app) => target::run(app, log),
        None => target::fail("main ran twice"),
    }
}
