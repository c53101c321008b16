//! Instructions of the floating-point unit: A6.

use super::{Arithmetic, Instruction, SP};

/// The number of a single-precision register of four bits and one: A6.3.
fn real(four: u16, one: u16) -> u8 {
    ((four & 15) << 1 | one & 1) as u8
}

/// Loads and stores: A6.5.
pub fn real_memory(first: u16, second: u16) -> Option<Instruction> {
    let n = (first & 15) as u8;
    let (up, load, writes_back) = (first & 0x80 != 0, first & 0x10 != 0, first & 0x20 != 0);
    let before = first & 0x100 != 0;
    let words = (second & 0xff) as u8;
    let is_double = match second >> 8 & 15 {
        10 => false,
        11 => true,
        _ => return None,
    };
    let d = first >> 6;
    let first = if is_double {
        ((d & 1) << 4 | second >> 12) as u8 * 2
    } else {
        real(second >> 12, d)
    };
    if before && !writes_back {
        let offset = 4 * i32::from(words) * if up { 1 } else { -1 };
        let count = 1 + u8::from(is_double);
        return Some(Instruction::Reals {
            first,
            count,
            n,
            offset,
            load,
        });
    }
    // Upwards after, or downwards before.
    (before != up && words > 0 && words % 2 <= u8::from(!is_double)).then_some(
        Instruction::RealsMoving {
            first,
            count: words,
            n,
            load,
            down: before,
            writes_back,
        },
    )
}

/// Data processing and moves: A6.4, A6.6.
pub fn real_data(first: u16, second: u16) -> Option<Instruction> {
    use Instruction::{Absolute, Compare, Copy, Negate, Real, Root, TakeFlags, Transfer};
    if second >> 8 & 15 != 10 {
        return None;
    }
    let d = real(second >> 12, first >> 6);
    let (n, m) = (real(first, second >> 7), real(second, second >> 5));
    if (first, second) == (0xeef1, 0xfa10) {
        return Some(TakeFlags);
    }
    if second & 0x10 != 0 {
        let core = (second >> 12) as u8;
        let is_move = first & 0xe0 == 0 && second & 0x7f == 0x10 && core < SP;
        return is_move.then_some(Transfer {
            core,
            real: n,
            to_core: first & 0x10 != 0,
        });
    }
    let op = |op| Some(Instruction::Arithmetic { op, d, n, m });
    match (first & 0xb0, second & 0x40 != 0) {
        (0x20, false) => op(Arithmetic::Mul),
        (0x20, true) => op(Arithmetic::NegatedMul),
        (0x30, false) => op(Arithmetic::Add),
        (0x30, true) => op(Arithmetic::Sub),
        (0x80, false) => op(Arithmetic::Div),
        (0xb0, false) if second & 0xa0 == 0 => {
            let byte = u32::from((first & 15) << 4 | second & 15);
            let exponent = if byte & 0x40 != 0 { 0x7c } else { 0x80 } | byte >> 4 & 3;
            Some(Real {
                d,
                value: f32::from_bits((byte & 0x80) << 24 | exponent << 23 | (byte & 15) << 19),
            })
        }
        (0xb0, true) => match (first & 15, second >> 7 & 1) {
            (0, 0) => Some(Copy { d, m }),
            (0, 1) => Some(Absolute { d, m }),
            (1, 0) => Some(Negate { d, m }),
            (1, 1) => Some(Root { d, m }),
            // Of numbers the form that signals NaNs is the same.
            (4, _) => Some(Compare { d, m: Some(m) }),
            (5, _) if second & 0x2f == 0 => Some(Compare { d, m: None }),
            _ => None,
        },
        _ => None,
    }
}
