//! The control tick as a task of Embassy.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod program {
    use embassy_executor::Spawner;
    use embassy_time::{Duration, Ticker};
    use guide_firmware::{Arm, board};
    use panic_halt as _;

    // page: begin
    #[embassy_executor::main]
    async fn main(_spawner: Spawner) {
        let mut arm = Arm::new();
        let mut ticker = Ticker::every(Duration::from_hz(1_000));
        loop {
            let measured = board::positions();
            board::drive(&arm.tick(measured.as_ref().map_err(|fault| *fault)));
            ticker.next().await;
        }
    }
    // page: end
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
