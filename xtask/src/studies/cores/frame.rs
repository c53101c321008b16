//! The effect of single instructions on the stack pointer, and the targets of those of RISC-V.
//!
//! Every instruction that lowers the stack pointer is added up, wherever in a function it stands:
//! the sum is a bound of the frame, since compilers lower it in the prologue and nowhere in a loop.
//! What restores it is left out.

use crate::kit::error::{Result, bail};

#[derive(Debug, Default)]
pub struct Flow {
    /// The bytes of its frame, at most.
    pub frame: u64,
    /// The targets of its calls and jumps.
    pub targets: Vec<u64>,
}

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
        _ => Some(u64::from(
            (0x80 | bits as u32 & 0x7f).rotate_right(bits as u32 >> 7),
        )),
    }
}

/// The flow of a function of RISC-V (unprivileged manual, chapters 2 and 26).
///
/// # Errors
/// It calls through a register, or the code does not say how large its frame is.
pub fn risc_v(start: u64, bytes: &[u8]) -> Result<Flow> {
    let mut flow = Flow::default();
    let mut at = 0;
    // The register and the address that `auipc` has computed.
    let mut upper: Option<(u32, u64)> = None;
    while let Some(&[a, b]) = bytes.get(at..at + 2) {
        let address = start + at as u64;
        let is_long = a & 3 == 3;
        let rest = bytes.get(at + 2..at + 4).filter(|_| is_long);
        let code = u32::from_le_bytes([a, b, rest.map_or(0, |r| r[0]), rest.map_or(0, |r| r[1])]);
        at += if is_long { 4 } else { 2 };
        let goes = |offset: i64| address.wrapping_add_signed(offset);
        let before = upper.take();
        if !is_long {
            short(code as u16, address, &mut flow)?;
            continue;
        }
        let (rd, rs1) = (code >> 7 & 31, code >> 15 & 31);
        let low = i64::from(code as i32 >> 20);
        match code & 0x7f {
            0x17 => {
                let high = i64::from((code & 0xffff_f000) as i32);
                upper = Some((rd, goes(high)));
            }
            0x6f => flow.targets.push(goes(jump(code))),
            0x63 => flow.targets.push(goes(branch(code))),
            0x67 => match before {
                _ if is_return(rd, rs1, low) => {}
                Some((register, base)) if register == rs1 => {
                    flow.targets.push(base.wrapping_add_signed(low));
                }
                _ => bail!("it calls through a register at {address:#x}"),
            },
            // ADDI SP
            0x13 if rd == SP && code >> 12 & 7 == 0 && rs1 == SP => flow.lower(low),
            0x13 if rd == SP && code >> 12 & 7 == 0 && rs1 == FRAME => {}
            // Whatever else computes SP: arithmetic, loads, LUI and AUIPC.
            0x03 | 0x13 | 0x33 | 0x37 if rd == SP => {
                bail!("its frame at {address:#x} is of an unknown size")
            }
            _ => {}
        }
    }
    Ok(flow)
}

const SP: u32 = 2;
/// The frame pointer.
const FRAME: u32 = 8;

impl Flow {
    /// The stack pointer moves so far.
    fn lower(&mut self, by: i64) {
        self.frame += u64::try_from(-by).unwrap_or(0);
    }
}

/// `jalr x0, 0(ra)`, or through t0 as the routines return that save registers.
fn is_return(rd: u32, rs1: u32, low: i64) -> bool {
    rd == 0 && low == 0 && matches!(rs1, 1 | 5)
}

fn short(code: u16, address: u64, flow: &mut Flow) -> Result<()> {
    let bit = |from: u16, to: u32| i64::from(code >> from & 1) << to;
    let (rd, rs2) = (u32::from(code >> 7 & 31), code >> 2 & 31);
    match (code & 3, code >> 13) {
        // C.JAL, C.J
        (1, 1 | 5) => {
            let offset = bit(12, 11) | bit(11, 4) | bit(10, 9) | bit(9, 8) | bit(8, 10);
            let offset =
                offset | bit(7, 6) | bit(6, 7) | bit(2, 5) | bit(5, 3) | bit(4, 2) | bit(3, 1);
            flow.targets
                .push(address.wrapping_add_signed(signed(offset, 12)));
        }
        // C.BEQZ, C.BNEZ
        (1, 6 | 7) => {
            let offset = bit(12, 8) | bit(11, 4) | bit(10, 3) | bit(6, 7) | bit(5, 6);
            let offset = offset | bit(4, 2) | bit(3, 1) | bit(2, 5);
            flow.targets
                .push(address.wrapping_add_signed(signed(offset, 9)));
        }
        // C.ADDI SP, C.ADDI16SP
        (1, 0) if rd == SP => {
            flow.lower(signed(bit(12, 5) | i64::from(code >> 2 & 31), 6));
        }
        (1, 3) if rd == SP => {
            let offset = bit(12, 9) | bit(6, 4) | bit(5, 6) | bit(4, 8) | bit(3, 7) | bit(2, 5);
            flow.lower(signed(offset, 10));
        }
        // C.LI SP, C.SLLI SP, C.LWSP SP
        (1, 2) | (2, 0 | 2) if rd == SP => bail!("its frame at {address:#x} is of an unknown size"),
        // C.JR, C.JALR; C.MV and C.ADD to SP
        (2, 4) if rs2 == 0 && rd != 0 && !is_return(u32::from(code >> 12 & 1), rd, 0) => {
            bail!("it calls through a register at {address:#x}")
        }
        (2, 4) if rs2 != 0 && rd == SP => bail!("its frame at {address:#x} is of an unknown size"),
        _ => {}
    }
    Ok(())
}

/// The offset of JAL.
fn jump(code: u32) -> i64 {
    let part = |from: u32, bits: u32, to: u32| i64::from(code >> from & ((1 << bits) - 1)) << to;
    signed(
        part(31, 1, 20) | part(12, 8, 12) | part(20, 1, 11) | part(21, 10, 1),
        21,
    )
}

fn branch(code: u32) -> i64 {
    let part = |from: u32, bits: u32, to: u32| i64::from(code >> from & ((1 << bits) - 1)) << to;
    signed(
        part(31, 1, 12) | part(7, 1, 11) | part(25, 6, 5) | part(8, 4, 1),
        13,
    )
}

/// Sign-extends a number of this many bits.
fn signed(value: i64, bits: u32) -> i64 {
    value << (64 - bits) >> (64 - bits)
}

#[cfg(test)]
mod tests {
    use super::{risc_v, thumb};

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

    fn flow(codes: &[u32]) -> Result<(u64, Vec<u64>), String> {
        let bytes: Vec<u8> = codes
            .iter()
            .flat_map(|code| {
                let size = if code & 3 == 3 { 4 } else { 2 };
                code.to_le_bytes()[..size].to_vec()
            })
            .collect();
        let flow = risc_v(0x1000, &bytes).map_err(|e| e.to_string())?;
        Ok((flow.frame, flow.targets))
    }

    #[test]
    fn frames_and_calls_of_risc_v() {
        for (codes, expected) in [
            (&[0xfe01_0113][..], (32, vec![])),  // addi sp, sp, -32
            (&[0x0201_0113], (0, vec![])),       // addi sp, sp, 32
            (&[0x1101], (32, vec![])),           // c.addi sp, -32
            (&[0x7139], (64, vec![])),           // c.addi16sp -64
            (&[0x6121], (0, vec![])),            // c.addi16sp 64
            (&[0x0100_00ef], (0, vec![0x1010])), // jal ra, +16
            (&[0xff1f_f06f], (0, vec![0xff0])),  // j -16
            (&[0x0000_1097, 0x0100_80e7], (0, vec![0x2010])), // auipc ra, 1; jalr ra, 16(ra)
            (&[0x0000_1317, 0x0103_0067], (0, vec![0x2010])), // auipc t1, 1; jr 16(t1)
            (&[0x00b5_0863], (0, vec![0x1010])), // beq a0, a1, +16
            (&[0x2801], (0, vec![0x1010])),      // c.jal +16
            (&[0xbfc5], (0, vec![0xff0])),       // c.j -16
            (&[0xc901], (0, vec![0x1010])),      // c.beqz a0, +16
            (&[0x8082], (0, vec![])),            // ret
        ] {
            assert_eq!(flow(codes), Ok(expected), "{codes:x?}");
        }
        // c.jalr a0; jalr ra, 0(a0); sub sp, sp, a0; c.mv sp, a0; auipc ra, 1; nop; jalr ra, 0(ra)
        for codes in [
            &[0x9502][..],
            &[0x0005_00e7],
            &[0x40a1_0133],
            &[0x812a],
            &[0x0000_1097, 0x0001, 0x0000_80e7],
        ] {
            assert!(flow(codes).is_err(), "{codes:x?}");
        }
    }
}
