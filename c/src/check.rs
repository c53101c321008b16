//! Every function checks these: inputs before it computes, results before it writes them.
//!
//! The usual case costs three integer operations a position and one addition for every other
//! number: a sum is finite only if all of its terms are. If it is not, a function of its own looks
//! at each number, so that finite numbers with an infinite sum are still accepted.

use dynamics_core::model::{ArmModel, Robot};

use crate::status::{ANGLE, NOT_FINITE, OVERFLOW};
use crate::{Exports, Library};

/// Accepts finite inputs.
///
/// # Errors
/// `NOT_FINITE`.
#[inline(always)]
pub fn inputs<const L: usize>(lists: [&[f32]; L]) -> Result<(), i32> {
    if are_finite(lists) { Ok(()) } else { Err(NOT_FINITE) }
}

/// Accepts finite results.
///
/// # Errors
/// `OVERFLOW`.
#[inline(always)]
pub fn results<const L: usize>(lists: [&[f32]; L]) -> Result<(), i32> {
    if are_finite(lists) { Ok(()) } else { Err(OVERFLOW) }
}

#[inline(always)]
fn are_finite<const L: usize>(lists: [&[f32]; L]) -> bool {
    let sum = lists.map(|list| list.iter().fold(-0.0_f32, |sum, value| sum + value));
    let sum = sum.iter().fold(-0.0_f32, |sum, value| sum + value);
    // Zero times a number that is not finite is not zero.
    sum * 0.0 == 0.0 || lists.into_iter().all(each_is_finite)
}

#[cold]
#[inline(never)]
fn each_is_finite(list: &[f32]) -> bool {
    list.iter().all(|value| value.is_finite())
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The largest distance of each position from zero: the range of angles within which the
    /// library's sines are accurate, and any finite number for prismatic joints.
    pub const RANGE: [f32; N] = {
        let model: ArmModel<f64, N> = <L::Arm as Robot<N, N, N>>::MODEL;
        let (mut range, mut body) = ([f32::MAX; N], 0);
        while body < N {
            let link = &model.links[body];
            if let Some(angle) = link.angle_range() {
                range[link.idx_v] = angle as f32;
            }
            body += 1;
        }
        range
    };

    /// Whether all positions are within their ranges. The bits of positive numbers are in the order of
    /// the numbers, and those of infinity and NaN come after them.
    #[inline(always)]
    fn within(q: &[f32; N]) -> bool {
        let mut beyond = 0;
        for (q, range) in q.iter().zip(const { &Self::RANGE }) {
            beyond |= range.to_bits().wrapping_sub(q.to_bits() & 0x7fff_ffff);
        }
        beyond >> 31 == 0
    }

    /// Accepts finite positions within their ranges.
    ///
    /// # Errors
    /// `NOT_FINITE` or `ANGLE`.
    #[inline(always)]
    pub(crate) fn positions(q: &[f32; N]) -> Result<(), i32> {
        if Self::within(q) { Ok(()) } else { Err(Self::wrong(q)) }
    }

    #[cold]
    #[inline(never)]
    fn wrong(q: &[f32; N]) -> i32 {
        match q.iter().all(|q| q.is_finite()) {
            true => ANGLE,
            false => NOT_FINITE,
        }
    }

    /// The joint whose position is not finite or beyond its range.
    pub(crate) fn beyond(q: &[f32; N]) -> Option<usize> {
        let within = |(q, range): (&f32, &f32)| q.abs() <= *range;
        q.iter().zip(const { &Self::RANGE }).position(|joint| !within(joint))
    }
}
