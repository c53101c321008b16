//! The addresses that an instruction states relative to itself: targets of branches and literals.

/// A distance from an instruction, and where its encoding holds it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Relative {
    pub target: u32,
    /// The number of words that are loaded from there; 0 for a branch.
    pub words: u32,
    /// The bits of the two halfwords that say how far it is.
    pub bits: [u16; 2],
}

/// The target of the instruction of these halfwords at an address, if it is a direct branch or
/// loads literals (ARMv7-M manual, A7.7.12, A7.7.18, A7.7.21, A7.7.44 and A7.7.233).
pub fn relative(address: u32, first: u16, second: u16) -> Option<Relative> {
    let (one, two) = (u32::from(first), u32::from(second));
    let reached = |words: u32, bits: [u16; 2], offset: i32| {
        // The program counter reads as four bytes ahead; literals count from a whole word.
        let base = address.wrapping_add(4) & if words == 0 { !0 } else { !3 };
        let target = base.wrapping_add_signed(offset);
        Some(Relative { target, words, bits })
    };
    let sign = if first & 0x80 == 0 { -1 } else { 1 };
    match first >> 11 {
        0b11100 => reached(0, [0x7FF, 0], extend(one << 1, 12)),
        0b11010 | 0b11011 if first >> 9 & 7 != 7 => reached(0, [0xFF, 0], extend(one << 1, 9)),
        // CBZ, CBNZ.
        0b10110 | 0b10111 if first & 0x500 == 0x100 => {
            reached(0, [0x2F8, 0], (one >> 3 & 0x40 | one >> 2 & 0x3E) as i32)
        }
        0b01001 => reached(1, [0xFF, 0], (one & 0xFF) as i32 * 4),
        0b11110 if second & 0x9000 == 0x9000 => {
            let (i1, i2) = (!(two >> 13 ^ one >> 10) & 1, !(two >> 11 ^ one >> 10) & 1);
            let high = (one >> 10 & 1) << 24 | i1 << 23 | i2 << 22;
            let offset = high | (one & 0x3FF) << 12 | (two & 0x7FF) << 1;
            reached(0, [0x7FF, 0x2FFF], extend(offset, 25))
        }
        0b11110 if second & 0xD000 == 0x8000 && first >> 7 & 7 != 7 => {
            let high = (one >> 10 & 1) << 20 | (two >> 11 & 1) << 19 | (two >> 13 & 1) << 18;
            let offset = high | (one & 0x3F) << 12 | (two & 0x7FF) << 1;
            reached(0, [0x43F, 0x2FFF], extend(offset, 21))
        }
        _ if first & 0xFF7F == 0xF85F => reached(1, [0x80, 0xFFF], sign * (two & 0xFFF) as i32),
        _ if first & 0xFF3F == 0xED1F && second & 0xE00 == 0xA00 => {
            reached(1 + (two >> 8 & 1), [0x80, 0xFF], sign * 4 * (two & 0xFF) as i32)
        }
        _ => None,
    }
}

/// Sign-extends a number of this many bits.
const fn extend(value: u32, bits: u32) -> i32 {
    (value << (32 - bits)) as i32 >> (32 - bits)
}

#[cfg(test)]
mod tests {
    use super::relative;

    #[test]
    fn branches_go_where_the_manual_says() {
        // Assembled and disassembled by LLVM at 0x1000.
        let cases = [
            (0xF000, 0xF87E, Some(0x1100)), // bl
            (0xF7FF, 0xFF7E, Some(0x0F00)), // bl, backwards
            (0xF000, 0xB87E, Some(0x1100)), // b.w
            (0xF43F, 0xAF7E, Some(0x0F00)), // beq.w, backwards
            (0xE07E, 0, Some(0x1100)),      // b
            (0xD07E, 0, Some(0x1100)),      // beq
            (0xB918, 0, Some(0x100A)),      // cbnz r0, 6 bytes on
            (0xF3BF, 0x8F5F, None),         // dmb
            (0xDF00, 0, None),              // svc
            (0x4770, 0, None),              // bx lr
        ];
        for (first, second, target) in cases {
            let found = relative(0x1000, first, second).map(|r| (r.target, r.words));
            assert_eq!(found, target.map(|to| (to, 0)), "{first:#06x} {second:#06x}");
        }
    }

    #[test]
    fn distance_bits_are_those_that_change_the_target() {
        for code in [
            [0xF000, 0xF87E], // bl
            [0xF000, 0xB87E], // b.w
            [0xF43F, 0xAF7E], // beq.w
            [0xE07E, 0],      // b
            [0xD07E, 0],      // beq
            [0xB918, 0],      // cbnz r0
            [0x4802, 0],      // ldr r0, [pc, #8]
            [0xF8DF, 0x0008], // ldr.w r0, [pc, #8]
            [0xED9F, 0x0A02], // vldr s0, [pc, #8]
        ] {
            let found = relative(0x1000, code[0], code[1]).expect("a distance");
            for half in 0..2 {
                for bit in 0..16 {
                    let mut other = code;
                    other[half] ^= 1 << bit;
                    // Another bit may make another instruction of it, or change what is not the
                    // distance.
                    let other = relative(0x1000, other[0], other[1]);
                    let other = other.filter(|other| other.bits == found.bits);
                    let is_farther = other.is_some_and(|other| other.target != found.target);
                    let is_of_distance = found.bits[half] >> bit & 1 == 1;
                    assert_eq!(is_farther, is_of_distance, "{code:04x?}: {half}, {bit}");
                }
            }
        }
    }

    #[test]
    fn literals_lie_where_the_manual_says() {
        let cases = [
            (0x4802, 0, 0x100C, 1),      // ldr r0, [pc, #8]
            (0xF8DF, 0x0008, 0x100C, 1), // ldr.w r0, [pc, #8]
            (0xF85F, 0x0008, 0x0FFC, 1), // ldr.w r0, [pc, #-8]
            (0xED9F, 0x0A02, 0x100C, 1), // vldr s0, [pc, #8]
            (0xED1F, 0x0B02, 0x0FFC, 2), // vldr d0, [pc, #-8]
        ];
        for (first, second, target, words) in cases {
            for address in [0x1000, 0x1002] {
                let found = relative(address, first, second).map(|r| (r.target, r.words));
                assert_eq!(found, Some((target, words)), "{first:#06x} {second:#06x}");
            }
        }
    }
}
