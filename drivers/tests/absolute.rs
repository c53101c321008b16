//! The promises of the absolute encoders.

use core::f32::consts::{FRAC_PI_2, TAU};
use embedded_hal::i2c::ErrorKind as I2cError;
use embedded_hal::spi::{ErrorKind as SpiError, ErrorType, Operation, SpiDevice};
use embedded_hal_mock::eh1::{i2c, spi};
use joint_drivers::as5047p::{self, As5047p, FrameError, READ_ANGLE, READ_ERRORS};
use joint_drivers::as5600::{As5600, As5600Error};
use joint_drivers::{Direction, JointMapping, JointRange};

use super::{identity, near_zero};

/// The transactions of one AS5047P frame.
fn frame(command: u16, answer: u16) -> [spi::Transaction<u8>; 3] {
    let bytes = |frame: u16| frame.to_be_bytes().to_vec();
    [
        spi::Transaction::transaction_start(),
        spi::Transaction::transfer_in_place(bytes(command), bytes(answer)),
        spi::Transaction::transaction_end(),
    ]
}

fn restart() -> Vec<spi::Transaction<u8>> {
    [frame(READ_ERRORS, 0xffff), frame(READ_ANGLE, 0xffff)].concat()
}

#[test]
fn the_as5047p_is_commanded_as_its_data_sheet_says() {
    // Read ANGLECOM: bits 15 (parity of 15 ones) and 14 (read) and the address 0x3FFF. Read ERRFL:
    // 0x4001 is even.
    assert_eq!((READ_ANGLE, READ_ERRORS), (0xffff, 0x4001));
    let mut encoder = As5047p::new(spi::Mock::new(&restart()), identity());
    encoder.start();
    encoder.release().done();
}

#[test]
fn the_as5047p_counts_turns_and_maps_them_to_the_joint() {
    let raws = [16_000, 16_383, 0, 4096, 8192, 12_288, 0];
    let frames: Vec<_> =
        raws.iter().flat_map(|raw| frame(READ_ANGLE, as5047p::encode(*raw))).collect();
    let mapping = JointMapping::new(FRAC_PI_2, Direction::Reverse, 2.0).unwrap();
    let mut encoder = As5047p::new(spi::Mock::new(&frames), near_zero(mapping));
    for counts in [-384, -1, 0, 4096, 8192, 12_288, 16_384] {
        let shaft = counts as f32 * as5047p::RESOLUTION;
        let angle = encoder.read().unwrap();
        let off = angle - (FRAC_PI_2 - shaft) / 2.0;
        assert!(off.abs() < 1e-6, "{counts}: {angle}");
    }
    encoder.release().done();
}

#[test]
fn each_as5047p_error_costs_one_angle_and_a_restart() {
    let ok = || frame(READ_ANGLE, as5047p::encode(100)).to_vec();
    let transactions = [
        ok(),
        frame(READ_ANGLE, as5047p::encode(200) ^ 1).to_vec(),
        restart(),
        frame(READ_ANGLE, as5047p::with_parity(as5047p::ERROR)).to_vec(),
        restart(),
        ok(),
    ]
    .concat();
    let mut encoder = As5047p::new(spi::Mock::new(&transactions), identity());
    let angle = 100.0 * as5047p::RESOLUTION;
    assert_eq!(encoder.read(), Ok(angle));
    for error in [FrameError::Parity, FrameError::Flag] {
        assert_eq!(encoder.read(), Err(error));
        assert_eq!(encoder.angle(), angle);
    }
    assert_eq!(encoder.read(), Ok(angle));
    encoder.release().done();
}

/// A bus that fails, which the mock cannot.
struct FailedBus;

impl ErrorType for FailedBus {
    type Error = SpiError;
}

impl SpiDevice for FailedBus {
    fn transaction(&mut self, _: &mut [Operation<'_, u8>]) -> Result<(), SpiError> {
        Err(SpiError::Overrun)
    }
}

#[test]
fn an_as5047p_bus_failure_is_an_error() {
    let mut encoder = As5047p::new(FailedBus, identity());
    assert_eq!(encoder.read(), Err(FrameError::Bus(SpiError::Overrun)));
    assert!(encoder.angle().abs() < as5047p::RESOLUTION);
}

#[test]
fn every_as5047p_frame_is_an_angle_or_an_error() {
    let mut angles = 0;
    for frame in 0..=u16::MAX {
        match as5047p::decode(frame) {
            Ok(raw) => {
                angles += 1;
                assert!(raw < as5047p::COUNTS && as5047p::encode(raw) == frame);
            }
            Err(FrameError::Parity) => assert_eq!(frame.count_ones() % 2, 1),
            Err(error) => {
                assert_eq!((error, frame & as5047p::ERROR != 0), (FrameError::Flag, true))
            }
        }
    }
    assert_eq!(angles, 16_384);
}

// This holds on either side of zero.
#[test]
fn angles_round_to_the_nearest_count() {
    for count in [-8000_i16, -3, -1, 0, 1, 3, 8000] {
        for off in [-0.4, 0.0, 0.4] {
            let angle = (f32::from(count) + off) * as5047p::RESOLUTION;
            let wanted = count.rem_euclid(as5047p::COUNTS as i16) as u16;
            assert_eq!(as5047p::quantise(angle), wanted, "{count} {off}");
        }
    }
}

#[test]
fn a_geared_encoder_starts_near_the_known_turn() {
    let mapping = JointMapping::new(0.0, Direction::Forward, 10.0).unwrap();
    let mapping = mapping.with_range(JointRange::Near(3.0), 1e-3).unwrap();
    let bus = spi::Mock::new(&frame(READ_ANGLE, as5047p::encode(16_383)));
    let mut encoder = As5047p::new(bus, mapping);
    let expected = (5.0 * TAU - as5047p::RESOLUTION) / 10.0;
    assert!((encoder.read().unwrap() - expected).abs() < 1e-6);
    encoder.release().done();
}

/// The transactions of one reading of an AS5600.
pub(crate) fn registers(status: u8, angle: u16) -> [i2c::Transaction; 2] {
    [
        i2c::Transaction::write_read(0x36, vec![0x0b], vec![status]),
        i2c::Transaction::write_read(0x36, vec![0x0c], angle.to_be_bytes().to_vec()),
    ]
}

// A turn has 4096 counts, and the upper four bits are ignored.
#[test]
fn the_as5600_counts_turns_and_ignores_upper_bits() {
    let raws = [0x0fff, 0x0000, 0xf400, 0x0800, 0x0c00, 0x0000];
    let all: Vec<_> = raws.iter().flat_map(|raw| registers(0x20, *raw)).collect();
    let mapping = JointMapping::new(-0.5, Direction::Forward, 1.0).unwrap();
    let mut encoder = As5600::new(i2c::Mock::new(&all), near_zero(mapping));
    for counts in [-1, 0, 1024, 2048, 3072, 4096] {
        let expected = counts as f32 * (TAU / 4096.0) + 0.5;
        assert!((encoder.read().unwrap() - expected).abs() < 1e-6);
    }
    encoder.release().done();
}

/// Four joints whose ranges are shorter than a turn of their encoders, and lie across its seam.
#[test]
fn a_first_reading_lies_in_the_joints_range() {
    let joints = [
        (2.4, Direction::Forward, 1.0, 1.2),
        // The example is that of the guide's page on a board.
        (1.5, Direction::Reverse, 1.0, 3.0),
        (2.4, Direction::Reverse, 3.0, 0.5),
        (-2.9, Direction::Forward, 1.0, 0.6),
    ];
    for (zero, direction, ratio, half) in joints {
        let mapping = JointMapping::new(zero, direction, ratio).unwrap();
        let range = JointRange::Within { lower: -half, upper: half };
        let mapping = mapping.with_range(range, 5e-3).unwrap();
        for part in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            let truth = part * half;
            let shaft = (zero + direction.sign() * truth * ratio).rem_euclid(TAU);
            let count = (shaft / TAU * 4096.0).round() as u16 & 4095;
            let bus = i2c::Mock::new(&registers(0x20, count));
            let mut encoder = As5600::new(bus, mapping);
            let read = encoder.read().unwrap();
            let off = (read - truth).abs() * ratio * 4096.0 / TAU;
            assert!(off < 0.51, "{zero} {truth} {read}");
            encoder.release().done();
        }
    }
}

#[test]
fn an_absent_weak_or_strong_magnet_is_an_error() {
    let cases = [
        (0x00, As5600Error::MagnetAbsent),
        (0x10, As5600Error::MagnetAbsent),
        (0x30, As5600Error::MagnetTooWeak),
        (0x28, As5600Error::MagnetTooStrong),
        (0x38, As5600Error::Status(0x38)),
        (0xff, As5600Error::Status(0xff)),
    ];
    for (status, error) in cases {
        let bus = i2c::Mock::new(&registers(status, 0)[..1]);
        let mut encoder = As5600::new(bus, identity());
        assert_eq!(encoder.read(), Err(error));
        encoder.release().done();
    }
}

#[test]
fn an_as5600_bus_failure_keeps_the_last_angle() {
    let [_, angle] = registers(0x20, 1024);
    let lost =
        i2c::Transaction::write_read(0x36, vec![0x0c], vec![0, 0]).with_error(I2cError::Other);
    let mut encoder = As5600::new(i2c::Mock::new(&[angle, lost]), identity());
    assert_eq!(encoder.read_angle(), Ok(FRAC_PI_2));
    assert_eq!(encoder.read_angle(), Err(As5600Error::Bus(I2cError::Other)));
    assert_eq!(encoder.angle(), FRAC_PI_2);
    encoder.release().done();
}
