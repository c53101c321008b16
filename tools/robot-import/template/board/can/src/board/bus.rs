//! What the drives and their bus say, in words.

use dynamics_core::effects::{Effect, Inertia};
use dynamics_core::{Core, Engine, state::State};
use embedded_can::ErrorKind;
use joint_drivers::JointError;
use joint_drivers::can::{CanError, Component, Silent};
use joint_drivers::mit::damiao::{PMAX, VMAX};

use super::SCALES;
use crate::say::Line;
use crate::scene::{Arm, EFFECTS, N, home};

const WIRES: &str = "no drive answers: supply, cable, 1 Mbit/s in board and drives, 120 Ω at both \
                     ends, CAN_H and CAN_L swapped";
const BEHIND: &str = "its drive and all behind it do not answer: the cable or the plug in front of \
                      it, its supply, the terminator behind the last drive";
const LOSSY: &str = "some answers are lost and others come: 120 Ω at both ends and nowhere else, \
                     ground, a plug, two drives of one number";

/// Says which joints have no position; the loop's last error of a drive, too, if it is of the bus.
pub fn silent(
    silent: &Silent<N>,
    unread: &[Result<(), CanError>; N],
    sent: Option<(usize, CanError)>,
    mut say: impl FnMut(Line),
) {
    // Without room none of the joints behind it is heard.
    if let Some((joint, error @ (CanError::Full | CanError::Bus(_)))) = sent
        && unread.iter().skip(joint).all(Result::is_err)
    {
        say(line(JointError { joint, error }));
    }
    match silent.behind {
        Some(0) => say(Line::of_all(WIRES)),
        Some(joint) => say(Line::of(joint, BEHIND)),
        None if silent.lossy => return say(Line::of_all(LOSSY)),
        None => {}
    }
    for (joint, unread) in unread.iter().enumerate().filter(|(joint, _)| silent.joints[*joint]) {
        if let Err(error) = *unread {
            say(line(JointError { joint, error }));
        }
    }
}

/// An error of a drive, or of the bus.
pub fn line(JointError { joint, error }: JointError<CanError>) -> Line {
    use CanError as E;
    let text = match error {
        E::NoReply => {
            "its drive does not answer: its number (ESC_ID), a second drive of its number, its \
             plug and supply, another maker's drive"
        }
        E::Identifier => {
            "frames came, none of them from its drive: ESC_ID has to be the number of the joint, \
             MST_ID 0x10 + this; set them with the other drives unplugged"
        }
        E::Full => {
            "the bus has no room for its command: no drive takes a frame (supply, cable, bit \
             rate), or the board's queue has fewer places than there are joints"
        }
        E::Bus(ErrorKind::Acknowledge) => {
            "no drive acknowledges a frame: supply, cable, 1 Mbit/s in board and drives"
        }
        E::Bus(ErrorKind::Overrun) => {
            "more frames came than a tick can take: another board or program sends on this bus"
        }
        E::Bus(ErrorKind::Other) => {
            "the board is off the bus after too many errors: 1 Mbit/s, 120 Ω at both ends, ground"
        }
        E::Bus(_) => {
            "frames are destroyed: 1 Mbit/s in board and drives, 120 Ω at both ends, two drives \
             of one number, ground"
        }
        E::Scale(PMAX) => "its register PMAX is not that of SCALES in board.rs: write it there",
        E::Scale(VMAX) => {
            "its register VMAX is not that of SCALES in board.rs: write it there (48 V motors)"
        }
        E::Scale(_) => {
            "its register TMAX is not that of SCALES in board.rs: is it the motor of this joint?"
        }
        E::Mode(_) => {
            "its drive is in another control mode: write 1 (MIT) into register 10, CTRL_MODE, and \
             store it"
        }
        E::Missing(_) => "its drive does not say this register: another maker, or old firmware?",
        E::NotReady => {
            "its drive is not enabled: hold the button; its supply came back, or another program \
             disables it"
        }
        E::OverTemperature(Component::Motor) => {
            "its motor is too hot: let it cool, load it less; then the button clears this"
        }
        E::OverTemperature(Component::Drive) => {
            "its drive is too hot: let it cool, load it less; then the button clears this"
        }
        E::OverVoltage => {
            "its supply has too much voltage: a braking arm feeds it, take a brake resistor or a \
             battery; the button clears this"
        }
        E::UnderVoltage => {
            "its supply has too little voltage: its limit of current, thin wires; the button \
             clears this"
        }
        E::OverCurrent => "a phase had too much current: is it blocked? The button clears this",
        E::Overload => "it was overloaded: is it blocked? The button clears this",
        E::LostCommunication => {
            "its drive has missed its commands for its TIMEOUT: this board stood still, or \
             register 9 is below some 10 ms; the button clears this"
        }
        E::LostTurn => {
            "its drive lost its supply, and may have lost its turns: stand it at its home and \
             restart the board, or place_near of the drives"
        }
        E::Range => "its position is at the end of the drive's scale: turn it back, set its zero",
        E::Encoder => "its encoder failed or is not calibrated: by the maker's tool",
        E::Fault(_) => "its drive reports a fault of this number: the button clears this",
        E::Remote | E::Length(_) | E::Short => {
            "a frame in place of its answer is none of this protocol: who else sends its MST_ID?"
        }
        E::Node | E::Torque => "impossible: number or SCALES in board.rs, torque in scene.rs",
        _ => "a frame has what the protocol does not have: another board sends on this bus?",
    };
    let number = match error {
        E::Scale(number) | E::Mode(number) => Some(number.into()),
        E::Missing(number) | E::Fault(number) => Some(number),
        _ => None,
    };
    let joint = Some(joint).filter(|_| !matches!(error, E::Bus(_)));
    Line { joint, text, number }
}

/// What the description lacks, or has more of than the motors: these are its limits of torque.
pub fn advice(torques: &[f32; N], mut say: impl FnMut(Line)) {
    for (joint, (scale, most)) in SCALES.iter().zip(torques).enumerate() {
        if *most > scale.torque {
            say(Line::of(
                joint,
                "its limit of torque is above its motor's greatest, which is what it gets: is it \
                 the motor of this joint (SCALES in board.rs)? Else lower the limit in scene.rs",
            ));
        }
    }
    if terms(&EFFECTS) != [true; 2] {
        say(Line::of_all(
            "the description has no rotors (armature) or no friction: a geared joint may not \
             break away, and counts as frozen; state them, import it again, add them to EFFECTS",
        ));
    }
}

/// Whether effects have rotors and friction.
pub fn terms<E: Effect<f32, N, N>>(effects: &E) -> [bool; 2] {
    let q = home();
    let (own, links) = (Core::<Arm>::crba(&q, effects), Core::<Arm>::crba(&q, &Inertia));
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
