//! The flags of sums of integers, and the conditions that they decide: ARM DDI 0403E, A2.2.1 and
//! A7.3.

use crate::decode::Condition;

/// Negative, zero, carry and overflow of a + b + carry.
pub fn of_sum(a: u32, b: u32, carry: bool) -> [bool; 4] {
    let wide = u64::from(a) + u64::from(b) + u64::from(carry);
    let sum = wide as u32;
    let overflow = (a ^ sum) & (b ^ sum) & 0x8000_0000 != 0;
    [sum >> 31 != 0, sum == 0, wide >> 32 != 0, overflow]
}

/// Whether a condition holds, if the flags that are known decide it.
pub fn holds(condition: Condition, [n, z, c, v]: [Option<bool>; 4]) -> Option<bool> {
    let holds = match condition >> 1 {
        0 => z?,
        1 => c?,
        2 => n?,
        3 => v?,
        // Equality alone decides these, too.
        4 => z != Some(true) && c? && !z?,
        5 => n? == v?,
        6 => z != Some(true) && n? == v? && !z?,
        _ => return Some(true),
    };
    Some(holds != (condition & 1 != 0))
}
