//! The promises of joints on a CAN bus as encoders and drives.

use std::collections::VecDeque;

use embedded_can::nb::Can;
use embedded_can::{ErrorKind, ExtendedId, Frame, StandardId};
use joint_drivers::can::{CanError, FdFrame};
use joint_drivers::moteus::Moteus;
use joint_drivers::odrive::ODrive;
use joint_drivers::{CanJoints, DriveFault, DriveFaultKind};
use joint_drivers::{JointDrives, JointEncoders, JointError};

mod frames;
mod outbox;

use super::identity;

/// A bus that says in each call what is next.
#[derive(Default)]
pub(super) struct Bus {
    received: VecDeque<nb::Result<FdFrame, ErrorKind>>,
    pub(super) sent: Vec<FdFrame>,
    error: Option<nb::Error<ErrorKind>>,
    /// With three places, of which the highest identifier gives up its own for a lower one, as
    /// bxCAN does.
    is_small: bool,
}

impl Can for Bus {
    type Frame = FdFrame;
    type Error = ErrorKind;
    fn transmit(&mut self, frame: &FdFrame) -> nb::Result<Option<FdFrame>, ErrorKind> {
        if let Some(error) = self.error {
            return Err(error);
        }
        if let Some(places) = self.sent.get_mut(..3).filter(|_| self.is_small) {
            let last = places.iter_mut().max_by_key(|place| place.id()).unwrap();
            let is_lower = frame.id() < last.id();
            let displaced = is_lower.then(|| core::mem::replace(last, *frame));
            return displaced.map(Some).ok_or(nb::Error::WouldBlock);
        }
        self.sent.push(*frame);
        Ok(None)
    }
    fn receive(&mut self) -> nb::Result<FdFrame, ErrorKind> {
        if let Some(nb::Error::Other(error)) = self.error {
            return Err(nb::Error::Other(error));
        }
        self.received.pop_front().unwrap_or(Err(nb::Error::WouldBlock))
    }
}

/// A reply of a moteus: mode, position in f32 turns, no velocity, no torque, a fault.
fn reply(node: u32, mode: u8, turns: f32, fault: u8) -> FdFrame {
    let [q0, q1, q2, q3] = turns.to_le_bytes();
    let data = [0x21, 0, mode, 0x2f, 1, q0, q1, q2, q3, 0, 0, 0, 0, 0, 0, 0, 0, 0x21, 0x0f, fault];
    FdFrame::new(ExtendedId::new(node << 8).unwrap(), &data).unwrap()
}

fn joints<B: Can<Frame = FdFrame>>(bus: B) -> CanJoints<B, Moteus, 2> {
    CanJoints::new(bus, [moteus(1), moteus(2)])
}

fn moteus(node: u8) -> Moteus {
    Moteus::new(node, 0, 10.0, identity()).unwrap()
}

fn torque_frame(node: u8, torque: f32) -> FdFrame {
    moteus(node).set_torque(torque).unwrap()
}

/// A frame of the ODrive 3.
fn odrive_frame(command: u16, data: [u8; 8]) -> FdFrame {
    FdFrame::new(StandardId::new(3 << 5 | command).unwrap(), &data).unwrap()
}

const HALF_A_TURN: [u8; 8] = [0, 0, 0, 0x3f, 0, 0, 0, 0];

pub(super) fn heard(received: &[FdFrame]) -> Bus {
    // The last one first.
    let received = received.iter().rev().map(|frame| Ok(*frame)).collect();
    Bus { received, ..Bus::default() }
}

const fn at(joint: usize, error: CanError) -> JointError<CanError> {
    JointError { joint, error }
}

#[test]
fn each_joint_gets_its_torque() {
    let joints = joints(Bus::default());
    (&joints).set_torques(&[1.0, -2.0]).unwrap();
    let sent = joints.release().sent;
    assert_eq!(sent, [torque_frame(1, 1.0), torque_frame(2, -2.0)]);
}

#[test]
fn a_bus_that_fails_or_is_full_is_an_error() {
    let overrun = ErrorKind::Overrun;
    for (error, expected) in [
        (nb::Error::Other(overrun), CanError::Bus(overrun)),
        (nb::Error::WouldBlock, CanError::Full),
    ] {
        let joints = joints(Bus { error: Some(error), ..Bus::default() });
        assert_eq!((&joints).set_torques(&[0.0; 2]), Err(at(0, expected)));
    }
}

#[test]
fn an_odrive_measures_and_says_whether_it_is_ready() {
    let half = odrive_frame(0x09, HALF_A_TURN);
    for (heartbeat, expected) in [
        ([0, 0, 0, 0, 8, 0, 0, 0], Ok(())),
        ([0, 0, 0, 0, 1, 0, 0, 0], Err(at(0, CanError::NotReady))),
        ([1, 0, 0, 0, 1, 0, 0, 0], Err(at(0, CanError::Fault(1)))),
    ] {
        let axis = ODrive::new(3, 10.0, identity()).unwrap();
        let joints = CanJoints::new(heard(&[half, odrive_frame(0x01, heartbeat)]), [axis]);
        assert_eq!((&joints).read(), Ok([core::f32::consts::PI]));
        assert_eq!((&joints).set_torques(&[0.0]), expected);
    }
}
