//! The cost of a whole tick of the scene `openarm_free_drive`: replies of seven drives unpacked, the
//! law and the gate, and commands packed, on a bus in memory.
#![no_std]
#![no_main]

mod costs;

use core::cell::RefCell;

use costs::STATES;
use costs::row::Row;
use dynamics_core::state::State;
use embedded_can::{Frame, StandardId};
use firmware_demo::scenes::openarm_free_drive::{
    Free, FreeDrive, Joints, Kept, RESOLUTION, TOOL, breakaway, controller, guiding, joints,
};
use joint_drivers::can::ClassicFrame;
use joint_drivers::{ControlLoop, Law, NoBrake};
use motion_control::{Estimate, Gains, MotionController};

type Loop<'a> = ControlLoop<Kept<'a, &'a Joints>, &'a Joints, NoBrake, 7>;

/// The positions of the arm, rad.
const Q: [f32; 7] = [0.5, 0.6, 0.2, 1.0, 0.1, -0.2, 0.3];

/// The replies of a tick in which each joint is a few steps further.
fn replies(tick: usize) -> Option<[ClassicFrame; 7]> {
    let reply = |joint: usize| {
        let count = ((Q[joint] + 12.5) / RESOLUTION) as u64 + (tick / 4) as u64;
        let word = (0x11 + joint as u64) << 56 | count << 40 | 0x800 << 28 | 0x800 << 16 | 0x1f19;
        ClassicFrame::new(StandardId::new(0x11 + joint as u16)?, &word.to_be_bytes())
    };
    let [a, b, c, d, e, f, g] = core::array::from_fn(reply);
    Some([a?, b?, c?, d?, e?, f?, g?])
}

/// A tick from the frames that came to those that are sent.
#[inline(never)]
fn tick(
    (control, joints, law): &mut (Loop<'_>, &Joints, &FreeDrive),
    came: &[ClassicFrame; 7],
) -> [Option<ClassicFrame>; 7] {
    for frame in came {
        joints.receive(frame);
    }
    control.tick::<Free, _, _>(&State::at(Q), *law);
    joints.commands()
}

/// The law alone.
#[inline(never)]
fn torque(law: &FreeDrive, estimate: &Estimate<f32, 7>) -> [f32; 7] {
    let gains = Gains { kp: [0.0; 7], kd: [0.0; 7] };
    Free::torque(&gains, &State::at(Q), estimate, law)
}

fn measure() -> Option<()> {
    let mut law = FreeDrive::new(guiding().ok()?, breakaway()).ok()?;
    law.tool = TOOL;
    let joints = joints(&Q).ok()?;
    let gate = MotionController::try_new(controller()).ok()?;
    let gains = Gains { kp: [0.0; 7], kd: [0.0; 7] };
    let control = ControlLoop::new(Kept(&joints, &law), &joints, NoBrake, gains, gate, ());
    let _ = joints.commands();
    let all = RefCell::new((control, &joints, &law));
    let mut came = [replies(0)?; STATES];
    for (k, came) in came.iter_mut().enumerate() {
        *came = replies(k)?;
    }
    let run = tick;
    Row::of::<robots::OpenArm, 7, 7>("free_drive", "tick", "full", true).measure(
        run as *const () as usize,
        &came,
        |came| run(&mut all.borrow_mut(), came),
    );
    let estimates: [_; STATES] = core::array::from_fn(|k| Estimate {
        q: Q.map(|q| q + 1e-3 * k as f32),
        qd: [1e-3 * k as f32; 7],
    });
    let run = torque;
    Row::of::<robots::OpenArm, 7, 7>("free_drive", "law", "full", true).measure(
        run as *const () as usize,
        &estimates,
        |estimate| run(&law, estimate),
    );
    Some(())
}

fn run() -> ! {
    let _ = measure();
    costs::done()
}

costs::main!(run());
