//! Frames of an encoder: what passes its checks is an angle, and no bit that falls over passes
//! them.

use super::bytes::Bytes;
use joint_drivers::as5047p::{COUNTS, decode, encode};
use joint_drivers::{JointMapping, JointRange, MultiTurnEncoder};

/// Frames of two bytes each.
///
/// # Panics
/// If one is taken for another angle than its own, a wrong bit passes, or a count goes further than
/// half a turn.
pub fn frames(bytes: &[u8]) {
    let near = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 3e-3);
    let mut counter = MultiTurnEncoder::<14>::new(near.expect("slower than its encoder"));
    let from = &mut Bytes(bytes);
    while from.any() {
        let frame = u16::from_le_bytes([from.byte(), from.byte()]);
        let before = counter.counts();
        match decode(frame) {
            Ok(raw) => {
                assert!(raw < COUNTS && encode(raw) == frame, "{frame:#x}");
                assert!(counter.update(raw).is_ok(), "{raw}");
            }
            Err(_) => {
                let even = frame.count_ones() % 2 == 0;
                assert!(!even || frame & 0x4000 != 0, "{frame:#x}");
            }
        }
        let whole = encode(frame & 0x3fff);
        assert_eq!(decode(whole), Ok(frame & 0x3fff));
        (0..16).for_each(|bit| assert!(decode(whole ^ (1 << bit)).is_err()));
        let step = counter.counts().wrapping_sub(before);
        assert!(step.unsigned_abs() <= u32::from(COUNTS / 2), "{step}");
        assert!(counter.angle::<f32>().is_finite());
    }
}
