//! The effect of single instructions of Thumb on the stack pointer.

/// By how many bytes an instruction of Thumb lowers the stack pointer (ARMv7-M manual, A7.7);
/// nothing if the code does not say by how many.
pub fn thumb([first, second]: [u16; 2]) -> Option<u64> {
    let low = u64::from(second & 0xff);
    Some(match first {
        // PUSH, SUB SP
        _ if first & 0xfe00 == 0xb400 => 4 * u64::from((first & 0x1ff).count_ones()),
        _ if first & 0xff80 == 0xb080 => 4 * u64::from(first & 0x7f),
        // STMDB SP!; STR and STRD with [SP, #-n]!; VPUSH
        0xe92d => 4 * u64::from(second.count_ones()),
        0xf84d if second & 0xf00 == 0xd00 => low,
        0xe96d => 4 * low,
        _ if first & 0xffbf == 0xed2d => 4 * low,
        // SUB SP, SP, #n in both encodings
        _ if first & 0xfbef == 0xf1ad && second & 0xf00 == 0xd00 => expanded(first, second)?,
        _ if first & 0xfbff == 0xf2ad && second & 0xf00 == 0xd00 => immediate(first, second),
        // SUB SP, SP, Rm; ADD SP, Rm; MOV SP, Rm but from the frame pointer
        _ if first & 0xffef == 0xebad && second & 0xf00 == 0xd00 => return None,
        _ if first & 0xff87 == 0x4485 => return None,
        _ if first & 0xff87 == 0x4685 && first != 0x46bd => return None,
        // MSR to one of the stack pointers
        _ if first & 0xffe0 == 0xf380 && second & 0xfffe == 0x8808 => return None,
        _ => 0,
    })
}

/// The twelve bits of a constant.
fn immediate(first: u16, second: u16) -> u64 {
    let (first, second) = (u64::from(first), u64::from(second));
    (first >> 10 & 1) << 11 | (second >> 12 & 7) << 8 | second & 0xff
}

/// A constant of eight bits that is rotated (A5.3.2); nothing for the forms that repeat a byte.
fn expanded(first: u16, second: u16) -> Option<u64> {
    let bits = immediate(first, second);
    match bits >> 8 {
        0 => Some(bits),
        1..=3 => None,
        _ => Some(u64::from((0x80 | bits as u32 & 0x7f).rotate_right(bits as u32 >> 7))),
    }
}

#[cfg(test)]
mod tests {
    use super::thumb;

    #[test]
    fn frames_of_thumb() {
        for (code, bytes) in [
            ([0xb5f0, 0], Some(20)),        // push {r4-r7, lr}
            ([0xb082, 0], Some(8)),         // sub sp, #8
            ([0xb002, 0], Some(0)),         // add sp, #8
            ([0xe92d, 0x4ff0], Some(36)),   // push.w {r4-r11, lr}
            ([0xf84d, 0xbd04], Some(4)),    // str r11, [sp, #-4]!
            ([0xed2d, 0x8b10], Some(64)),   // vpush {d8-d15}
            ([0xed6d, 0x8a01], Some(4)),    // vpush {s17}
            ([0xf5ad, 0x7d0a], Some(552)),  // sub.w sp, sp, #552
            ([0xf2ad, 0x4d04], Some(1028)), // subw sp, sp, #1028
            ([0xe8bd, 0x8ff0], Some(0)),    // pop.w {r4-r11, pc}
            ([0x46bd, 0], Some(0)),         // mov sp, r7
            ([0xf1a7, 0x0d18], Some(0)),    // sub.w sp, r7, #24
            ([0xebad, 0x0d00], None),       // sub.w sp, sp, r0
            ([0x4485, 0], None),            // add sp, r0
            ([0x46a5, 0], None),            // mov sp, r4
        ] {
            assert_eq!(thumb(code), bytes, "{code:x?}");
        }
    }
}
