//! The cost of a whole tick of the scene `openarm_free_drive`, and of its law alone.
#![no_std]
#![no_main]

mod costs;
#[path = "costs/on_bus.rs"]
mod on_bus;

use core::cell::RefCell;

use costs::STATES;
use costs::row::Row;
use dynamics_core::state::State;
use firmware_demo::scenes::openarm_free_drive::{Free, FreeDrive};
use joint_drivers::Law;
use motion_control::{estimate::Estimate, law::Gains};
use on_bus::{Arm, Q, replies, tick};

/// The law alone.
#[inline(never)]
fn torque(law: &FreeDrive, estimate: &Estimate<f32, 7>) -> [f32; 7] {
    let gains = Gains { kp: [0.0; 7], kd: [0.0; 7] };
    Free::torque(&gains, &State::at(Q), estimate, law)
}

fn row(inputs: &'static str) -> Row<'static> {
    Row::of::<robots::OpenArm, 7, 7>("free_drive", "engine", inputs, true)
}

fn measure(arm: &mut Arm<'_>) {
    let law = arm.2;
    let all = RefCell::new(arm);
    let came: Option<_> = (|| {
        let mut came = [replies(0)?; STATES];
        for (k, came) in came.iter_mut().enumerate() {
            *came = replies(k)?;
        }
        Some(came)
    })();
    let Some(came) = came else { return };
    let address = tick as *const () as usize;
    row("tick").measure(address, &came, |came| tick(&mut all.borrow_mut(), came));
    let estimates: [_; STATES] = core::array::from_fn(|k| Estimate {
        q: Q.map(|q| q + 1e-3 * k as f32),
        qd: [1e-3 * k as f32; 7],
    });
    row("law").measure(torque as *const () as usize, &estimates, |estimate| torque(law, estimate));
}

fn run() -> ! {
    let _ = on_bus::with(measure);
    costs::done()
}

costs::main!(run());
