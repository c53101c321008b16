//! What the drives and their bus say, in words.

use dynamics_core::algorithms::MassMatrix;
use dynamics_core::effects::{Effect, Inertia};
use dynamics_core::{Core, Engine, state::State};
use embedded_can::ErrorKind;
use joint_drivers::JointError;
use joint_drivers::can::{CanError, Component};
use joint_drivers::mit::damiao::{PMAX, TMAX, VMAX};

use super::SCALES;
use crate::say::Line;
use crate::scene::{Arm, EFFECTS, N, home};

/// No drive answers.
pub const SILENT: Line = Line::of_all(
    "no drive answers",
    "their supply, the cable, 1 Mbit/s in board and drives, 120 Ω at both ends, CAN_H and CAN_L swapped",
);

/// Drives answer now and then.
pub const LOSSY: Line = Line::of_all(
    "some answers are lost, and others come",
    "120 Ω at both ends and nowhere else, ground, a plug, two drives of one number",
);

/// This joint and those behind it do not answer.
pub const fn broken(joint: usize) -> Line {
    Line::of(
        joint,
        "its drive and all behind it do not answer",
        "the cable or the plug in front of this drive, its supply, the terminator behind the last one",
    )
}

/// An error of a drive, or of the bus.
pub fn line(JointError { joint, error }: JointError<CanError>) -> Line {
    const NUMBER: &str = "give it the number of its joint (ESC_ID), 0x10 + this as MST_ID, with the other drives unplugged";
    const CLEAR: &str = "the button clears this error";
    let (seen, remedy) = match error {
        CanError::NoReply => (
            "its drive does not answer",
            "its number (ESC_ID), a second drive of its number, its plug and supply, another maker's drive",
        ),
        CanError::Identifier => ("frames came, none of them from its drive", NUMBER),
        CanError::Full => (
            "the bus has no room for its command",
            "no drive takes a frame (supply, cable, bit rate), or the board's queue has fewer places than there are joints",
        ),
        CanError::Bus(ErrorKind::Acknowledge) => ("no drive acknowledges a frame", SILENT.remedy),
        CanError::Bus(ErrorKind::Overrun) => (
            "more frames came than a tick can take",
            "another board or program sends on this bus: switch it off",
        ),
        CanError::Bus(ErrorKind::Other) => {
            ("the board is off the bus after too many errors", SILENT.remedy)
        }
        CanError::Bus(_) => (
            "frames are destroyed",
            "1 Mbit/s in board and drives, 120 Ω at both ends alone, two drives of one number, ground",
        ),
        CanError::Scale(PMAX) => {
            ("its register PMAX is not that of SCALES", "write what it has into SCALES in board.rs")
        }
        CanError::Scale(VMAX) => (
            "its register VMAX is not that of SCALES",
            "write what it has into SCALES in board.rs: 48 V motors have another one",
        ),
        CanError::Scale(TMAX) => (
            "its register TMAX is not that of SCALES",
            "write what it has into SCALES in board.rs: is it the motor of this joint?",
        ),
        CanError::Mode(_) => (
            "its drive is in another control mode than MIT",
            "write 1 into its register 10 (CTRL_MODE) and store it",
        ),
        CanError::Missing(_) => (
            "its drive does not say this register",
            "its line above, if there is one; else it is no drive of this maker, or its firmware is old",
        ),
        CanError::NotReady => (
            "its drive is not enabled",
            "hold the button; if it stays so, its supply came back, or another program disables it",
        ),
        CanError::OverTemperature(Component::Motor) => (
            "its motor is too hot",
            "let it cool, and load it less; then the button clears this error",
        ),
        CanError::OverTemperature(Component::Drive) => (
            "its drive is too hot",
            "let it cool, and load it less; then the button clears this error",
        ),
        CanError::OverVoltage => (
            "its supply has too much voltage",
            "a braking arm feeds its supply back: a brake resistor or a battery; the button clears this error",
        ),
        CanError::UnderVoltage => (
            "its supply has too little voltage",
            "the limit of current of the supply, thin wires; the button clears this error",
        ),
        CanError::OverCurrent => ("a phase of its motor had too much current", CLEAR),
        CanError::Overload => ("it was overloaded", CLEAR),
        CanError::LostCommunication => (
            "its drive has missed its commands for its TIMEOUT",
            "this board stood still, or register 9 is below some 10 ms; the button clears this error",
        ),
        CanError::LostTurn => (
            "its drive lost its supply, and may have lost its turns",
            "stand it at its home and restart the board, or place_near of the drives",
        ),
        CanError::Range => (
            "its position is at the end of the drive's scale",
            "turn it back; its zero is far off, or the drive stops its count there",
        ),
        CanError::Encoder => {
            ("its encoder failed or is not calibrated", "calibrate it by the maker's tool")
        }
        CanError::Fault(_) => ("its drive reports a fault", CLEAR),
        CanError::Remote | CanError::Length(_) | CanError::Short => (
            "a frame in place of its answer is none of this protocol",
            "another board or another maker's drive sends with its MST_ID",
        ),
        CanError::Node | CanError::Torque => (
            "impossible: the number or the greatest torque of its drive",
            "number and SCALES in board.rs, its limit of torque in scene.rs",
        ),
        _ => ("a frame has what the protocol does not have", "another board sends on this bus"),
    };
    let number = match error {
        CanError::Scale(number) | CanError::Mode(number) => Some(number.into()),
        CanError::Missing(number) | CanError::Fault(number) => Some(number),
        _ => None,
    };
    let joint = Some(joint).filter(|_| !matches!(error, CanError::Bus(_)));
    Line { joint, seen, number, remedy }
}

/// What the description lacks, or has more of than the motors: these are its limits of torque.
pub fn advice(torques: &[f32; N], mut say: impl FnMut(Line)) {
    for (joint, (scale, most)) in SCALES.iter().zip(torques).enumerate() {
        if *most > scale.torque {
            say(Line::of(
                joint,
                "its limit of torque is above its motor's greatest, which is what it gets",
                "is it the motor of this joint (SCALES in board.rs)? Else lower its limit in scene.rs",
            ));
        }
    }
    let [has_rotor, has_friction] = terms(&EFFECTS);
    if !has_rotor || !has_friction {
        say(Line::of_all(
            match (has_rotor, has_friction) {
                (false, false) => "the description has no rotors (armature) and no friction",
                (false, true) => "the description has no rotors (armature)",
                _ => "the description has no friction",
            },
            "a geared joint may not break away, and counts as frozen: state them there, import it again and add them to EFFECTS",
        ));
    }
}

/// Whether effects have rotors and friction.
pub fn terms<E: Effect<f32, N, N>>(effects: &E) -> [bool; 2] {
    let q = home();
    let [own, links]: [MassMatrix<f32, N>; 2] =
        [Core::<Arm>::crba(&q, effects), Core::<Arm>::crba(&q, &Inertia)];
    let has_rotor = (0..N).any(|joint| own.get(joint, joint) > links.get(joint, joint));
    // Friction alone changes its sign with the velocity.
    let has_friction = (0..N).any(|joint| {
        let [forth, back] = [1.0, -1.0].map(|speed| {
            let qd = core::array::from_fn(|k| if k == joint { speed } else { 0.0 });
            Engine::<Arm>::rnea(&State { q, qd, qdd: [0.0; N] }, effects)[joint]
        });
        (forth - back).abs() > 1e-6 * (forth.abs() + back.abs())
    });
    [has_rotor, has_friction]
}
