//! The effect of bad frames on the arm.

use motion_control::limits::{Fault, Mode};

use host_tests::measured::largest;

use super::{Arm, REENTRY};

/// The effect of an interval of bad frames of joint 0 on the arm.
pub struct Outcome {
    /// Worst error against the reference of the tick, from the first bad frame on.
    pub worst: f64,
    /// The most that a joint that moved one way moved back, rad/s.
    pub reversal: f64,
    /// Ticks from the last bad frame until the error stays below 1 mrad on the trajectory.
    pub back: u32,
    /// Faults other than the frames'.
    pub others: Vec<Fault>,
    pub modes: Vec<Mode>,
}

/// The arm on its way, with a number of bad frames of joint 0 from the tick `at` on.
pub fn bad_frames(at: u32, ticks: u32, mask: u16) -> Outcome {
    let mut arm = Arm::new();
    arm.run(at);
    let direction = arm.rig.plant.state.qd.map(f32::signum);
    let fast = arm.rig.plant.state.qd.map(|qd| qd.abs() > 0.3);
    let (mut errors, mut reversals) = (vec![], vec![]);
    let mut out =
        Outcome { worst: f64::NAN, reversal: f64::NAN, back: 0, others: vec![], modes: vec![] };
    for tick in 0..ticks + REENTRY + 200 {
        arm.corrupt(0, if tick < ticks { mask } else { 0 });
        let actual = arm.rig.plant.state.q;
        let telemetry = arm.tick();
        let error = Arm::error(&telemetry.reference, &actual);
        errors.push(error);
        let late = tick >= ticks;
        if late && (error > 1e-3 || telemetry.status.fault.is_some()) {
            out.back = tick - ticks + 1;
        }
        for j in (0..6).filter(|&j| fast[j] && tick < ticks + REENTRY) {
            reversals.push(-arm.rig.plant.state.qd[j] * direction[j]);
        }
        let frame = Fault::Encoder { joint: 0 };
        out.others.extend(telemetry.status.fault.filter(|&fault| fault != frame));
        assert_eq!(telemetry.status.fault == Some(frame), !late);
        out.modes.push(telemetry.status.mode);
    }
    (out.worst, out.reversal) = (largest(errors), largest(reversals));
    out
}
