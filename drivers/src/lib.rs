//! One control loop for encoders and drives of any kind, and drivers of common parts, on the traits
//! of [`embedded_hal`], [`embedded_can`] and [`embedded_io`]: no heap, no panic and no `unsafe`.
//!
//! | what | is |
//! |---|---|
//! | [`JointEncoder`], [`JointEncoders`] | reads rad, of one joint or of all; an array of the first is the second |
//! | [`JointDrive`], [`JointDrives`] | sets N·m, and says whether it failed or is not ready |
//! | [`ControlLoop`] | owns both and a brake; read, reference, law, limits, write in each tick |
//! | [`Law`] | the model's torque |
//! | [`PdOnDrives`] | the law's feedback on the drives as well, at their rate |
//! | [`Probe`] | sees the phases of a tick |
//!
//! Each driver has the zero, the direction and the resolution of its joint as parameters
//! ([`JointMapping`], [`Resolution`]): it measures rad at the joint and commands N·m, V or a share
//! of the full scale there. An encoder also has the range of its joint ([`JointRange`]), since
//! its count gives the angle within one turn only.
//!
//! The encoders and the H-bridges implement the traits of a joint, the servos that of all encoders.
//! The controllers on CAN are both at once, on a bus that they share ([`CanJoints`]); those of
//! several makers on one bus are [`mit::AnyDrive`], and an [`Outbox`] stands between joints and a
//! bus controller of fewer places. The servos take a duty: they are no drives of torque.
//!
//! | part | bus | measures or commands | module |
//! |---|---|---|---|
//! | AS5047P | SPI | absolute angle, 14 bits | [`as5047p`] |
//! | AS5600 | I²C | absolute angle, 12 bits, and whether its magnet is well placed | [`as5600`] |
//! | incremental encoder with index | A, B and Z, or a timer | angle from the index, once it was passed | [`incremental`] |
//! | H-bridge | PWM, GPIO | torque, as sign and magnitude or in locked antiphase | [`h_bridge`] |
//! | moteus | CAN FD | torque; position, velocity, torque, mode and fault | [`moteus`] |
//! | ODrive | CAN | torque; position, velocity, torque, state and errors | [`odrive`] |
//! | Damiao DM-J | CAN, CAN FD | torque, spring and damper; position, velocity, torque, temperatures, faults, scales | [`mit::damiao`] |
//! | RobStride 00 to 06 | CAN | the same without scales, by its own protocol and in MIT mode | [`mit::robstride`] |
//! | CubeMars AK | CAN | the same without scales | [`mit::cubemars`] |
//! | STS3215, six in the SO-101 | half-duplex UART | position or duty; position, 4096 counts per turn | [`feetech`] |
//!
//! All of them have this in common: a torque that is not a number becomes zero torque; errors are
//! typed; no reading is NaN or infinite; input that is wrong leads to an error, never to a panic.
//!
//! ```
//! use joint_drivers::{Direction, JointMapping, JointRange, as5600::As5600};
//! use embedded_hal_mock::eh1::i2c::{Mock, Transaction};
//! // The encoder reads 1.5 rad where the joint is at zero, and turns the other way round.
//! let mapping = JointMapping::new(1.5, Direction::Reverse, 1.0)?;
//! // The joint is between its stops at ±3 rad, and moves by 5 rad/s at most in ticks of 1 ms.
//! let mapping = mapping.with_range(JointRange::Within { lower: -3.0, upper: 3.0 }, 5.0 * 1e-3)?;
//! let bus = Mock::new(&[
//!     Transaction::write_read(0x36, vec![0x0b], vec![0x20]),       // a magnet was detected
//!     Transaction::write_read(0x36, vec![0x0c], vec![0x04, 0x00]), // 1024 of 4096 counts: 90°
//! ]);
//! let mut encoder = As5600::new(bus, mapping);
//! assert!((encoder.read()? - (1.5 - core::f32::consts::FRAC_PI_2)).abs() < 1e-6);
//! encoder.release().done();
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Cargo features
//!
//! - `async`, off by default: the encoders on a bus over [`embedded_hal_async`] and the servo bus
//!   over `embedded-io-async`, for Embassy: traits of the same names in `asynch`,
//!   `ControlLoop::tick_async`, and `start_async`, `read_async`, `positions_async` and others. They
//!   share the state and the decoding with the blocking form.
#![cfg_attr(
    not(feature = "async"),
    doc = "",
    doc = "[`embedded_hal_async`]: https://docs.rs/embedded-hal-async"
)]
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

#[cfg(test)]
extern crate std;

#[cfg(feature = "async")]
pub mod asynch;
pub mod can;
mod control_loop;
mod drives;
mod encoder_mapping;
mod encoders;
mod joint;
mod mapping;
mod servos;

pub use can::joint::{CanJoint, PdCanJoint, Report};
pub use can::joints::{CanJoints, JointBus, Outbox};
#[doc(inline)]
pub use can::{mit, moteus, odrive};
pub use control_loop::{ControlLoop, Law, Phase, Probe, Telemetry};
pub use drives::h_bridge;
pub use drives::pd::{PdDrives, PdOnDrives};
pub use encoder_mapping::{EncoderMapping, JointRange, LostTurn};
pub use encoders::multi_turn::MultiTurnEncoder;
pub use encoders::{as5047p, as5600, incremental};
pub use joint::{
    DriveFault, DriveFaultKind, EncoderType, JointDrive, JointDrives, JointEncoder, JointEncoders,
    JointError, NoBrake,
};
pub use mapping::{Direction, JointMapping, MappingError, Resolution};
pub use servos::feetech;
