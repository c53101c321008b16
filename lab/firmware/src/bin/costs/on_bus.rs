//! A whole tick of the scene `openarm_free_drive`: replies of seven drives unpacked, the law and
//! the gate, and commands packed, on a bus in memory.

use dynamics_core::state::State;
use embedded_can::{Frame, StandardId};
use firmware_demo::scenes::openarm_free_drive::{
    Free, FreeDrive, Joints, Kept, RESOLUTION, TOOL, breakaway, controller, guiding, joints,
};
use joint_drivers::can::ClassicFrame;
use joint_drivers::{ControlLoop, NoBrake};
use motion_control::{law::Gains, motion::MotionController};

/// The positions of the arm, rad.
pub const Q: [f32; 7] = [0.5, 0.6, 0.2, 1.0, 0.1, -0.2, 0.3];

/// The loop, the drives on their bus, and the law.
pub type Arm<'a> =
    (ControlLoop<Kept<'a, &'a Joints>, &'a Joints, NoBrake, 7>, &'a Joints, &'a FreeDrive);

/// Runs with an arm that has a tool; `None` if it were not one.
pub fn with(run: impl FnOnce(&mut Arm<'_>)) -> Option<()> {
    let law = FreeDrive::new(guiding().ok()?, breakaway()).ok()?;
    law.tool.set(TOOL);
    let joints = joints(&Q).ok()?;
    let gate = MotionController::try_new(controller()).ok()?;
    let gains = Gains { kp: [0.0; 7], kd: [0.0; 7] };
    let control = ControlLoop::new(Kept(&joints, &law), &joints, NoBrake, gains, gate, ());
    let _ = joints.commands();
    run(&mut (control, &joints, &law));
    Some(())
}

/// The replies of a tick in which each joint is a few steps further.
pub fn replies(tick: usize) -> Option<[ClassicFrame; 7]> {
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
pub fn tick(
    (control, joints, law): &mut Arm<'_>,
    came: &[ClassicFrame; 7],
) -> [Option<ClassicFrame>; 7] {
    for frame in came {
        joints.receive(frame);
    }
    control.tick::<Free, _, _>(&State::at(Q), *law);
    joints.commands()
}
