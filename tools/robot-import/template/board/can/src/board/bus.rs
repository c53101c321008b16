//! What the drives and their bus say, in words.

use dynamics_core::effects::{Effect, Inertia};
use dynamics_core::{Core, Engine, state::State};
use joint_drivers::JointError;
use joint_drivers::can::{CanError, Silent};

use super::SCALES;
use crate::say::Line;
use crate::scene::{Arm, EFFECTS, N, home};

const NONE: &str = "no drive answers: supply, cable, CAN_H and CAN_L, 1 Mbit/s, 120 Ω at both ends";
const BEHIND: &str = "its drive and all behind it do not answer: the cable or plug in front of it";
const LOSSY: &str = "answers are lost on and off: 120 Ω at both ends alone, ground, a loose plug";

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
        Some(0) => say(Line::of_all(NONE)),
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
    let number = match error {
        CanError::Scale(number) | CanError::Mode(number) => Some(number.into()),
        CanError::Missing(number) | CanError::Fault(number) => Some(number),
        _ => None,
    };
    let joint = Some(joint).filter(|_| !matches!(error, CanError::Bus(_)));
    Line { joint, text: error.words(), number }
}

/// What the description lacks, or has more of than the motors: these are its limits of torque.
pub fn advice(torques: &[f32; N], mut say: impl FnMut(Line)) {
    for (joint, (scale, most)) in SCALES.iter().zip(torques).enumerate() {
        if *most > scale.torque {
            say(Line::of(joint, "its limit of torque is above its motor's greatest: SCALES"));
        }
    }
    if terms(&EFFECTS) != [true; 2] {
        const LACKS: &str = "no rotors (armature) or no friction described: it may not break away";
        say(Line::of_all(LACKS));
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
