use super::*;
use Reaction::{ControlledStop, RideThrough, TorqueOff};

/// Every fault, its reaction, and its text after the joint, if it has one.
#[rustfmt::skip]
const FAULTS: [(Fault, Reaction, &str); 24] = [
    (Fault::Encoder { joint: 3 }, RideThrough, "joint 3: its encoder reports an error"),
    (Fault::Stale, RideThrough, "no measurement of this tick"),
    (Fault::Unfinished, RideThrough, "the tick before got no torque"),
    (Fault::NotFinite { joint: 3 }, RideThrough, "joint 3: its measured position is not finite"),
    (Fault::Position { joint: 3 }, RideThrough, "joint 3: its position is outside its bounds"),
    (Fault::Jump { joint: 3 }, RideThrough, "joint 3: its position jumped"),
    (Fault::Speed { joint: 3 }, RideThrough, "joint 3: it exceeds its speed limit"),
    (Fault::Torque { joint: 3 }, RideThrough, "joint 3: the torque of its law is not finite"),
    (Fault::Frozen { joint: 3 }, RideThrough, "joint 3: its encoder is frozen, or it never broke away"),
    (Fault::NotReady { joint: 3 }, RideThrough, "joint 3: its drive is not ready"),
    (Fault::Missed, RideThrough, "too many ticks were missed"),
    (Fault::Overrun, RideThrough, "a tick ended after its period"),
    (Fault::Reference { joint: 3 }, ControlledStop, "joint 3: its reference jumped"),
    (Fault::External, ControlledStop, "a stop from outside"),
    (Fault::Hot { joint: 3 }, ControlledStop, "joint 3: its motor is too hot"),
    (Fault::LostTurn { joint: 3 }, ControlledStop, "joint 3: its encoder can have lost a turn"),
    (Fault::Saturated { joint: 3 }, TorqueOff, "joint 3: its torque is at its limit for too long"),
    (Fault::LimitCycle { joint: 3 }, TorqueOff, "joint 3: its torque swings from limit to limit"),
    (Fault::Drive { joint: 3 }, TorqueOff, "joint 3: its drive rejected the torque command"),
    (Fault::Limits { joint: 3 }, TorqueOff, "joint 3: one of its limits is invalid"),
    (Fault::Model, TorqueOff, "the model is invalid"),
    (Fault::Overflow, TorqueOff, "a queue or a stack has overflowed"),
    (Fault::Restarted, TorqueOff, "the processor restarted"),
    (Fault::Brake, TorqueOff, "the brake did not respond"),
];

#[test]
fn every_fault_has_its_reaction_and_its_text() {
    for (fault, reaction, text) in FAULTS {
        assert_eq!(fault.reaction(), reaction, "{fault}");
        assert_eq!(std::format!("{fault}"), text);
    }
}
