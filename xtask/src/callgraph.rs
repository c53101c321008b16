//! Which functions a function can reach, read from the machine code: what the sources say is
//! one thing, what the linker kept is another.

use std::collections::{BTreeMap, VecDeque};

use crate::elf::{Function, Image};
use crate::error::{Error, Result};

/// An instruction, by its one or two halfwords.
#[derive(Clone, Copy, Debug)]
pub struct Instruction {
    /// Where it lies.
    pub address: u64,
    /// Its first halfword.
    pub first: u32,
    /// Its second one.
    pub second: Option<u32>,
}

impl Instruction {
    /// Where a direct call or jump goes.
    pub fn target(self) -> Option<u64> {
        let offset = match self.second {
            None if self.first >> 11 == 0b11100 => extend(u64::from(self.first & 0x7ff) << 1, 12),
            None if self.first >> 12 == 0b1101 && (self.first >> 9) & 7 != 7 => {
                extend(u64::from(self.first & 0xff) << 1, 9)
            }
            Some(second) if self.first >> 11 == 0b11110 && second >> 15 == 1 => {
                wide_offset(self.first, second)?
            }
            _ => return None,
        };
        // The program counter reads as four bytes ahead.
        Some((self.address + 4).wrapping_add_signed(offset))
    }

    /// Whether it calls or jumps to an address in a register, other than to return.
    fn is_indirect(self) -> bool {
        let to_register = self.second.is_none() && self.first >> 8 == 0b0100_0111;
        let calls = self.first & 0x80 != 0;
        let link_register = (self.first >> 3) & 0xf == 14;
        to_register && (calls || !link_register)
    }

    /// Whether it is `DBG`, which marks the regions that are measured.
    pub fn is_marker(self) -> bool {
        self.first == 0xf3af && self.second.is_some_and(|second| second & 0xfff0 == 0x80f0)
    }

    /// Whether a Cortex-M4F lacks it: FPv5 (VSEL, VRINT, VMINNM …), f64 arithmetic, and what
    /// ARMv8-M and v8.1-M added (CSEL …, low-overhead loops, load-acquire and store-release).
    pub fn is_beyond_m4f(self) -> bool {
        let Some(second) = self.second else {
            return false;
        };
        let coprocessor = (second >> 8) & 0xf;
        let fpv5 = self.first >> 8 == 0xfe && matches!(coprocessor, 10 | 11);
        let f64_arithmetic = self.first >> 8 == 0xee && coprocessor == 11 && second & 0x10 == 0;
        let conditional_select = self.first >> 4 == 0xea5 && second >> 15 == 1;
        let low_overhead_loop = self.first >> 11 == 0b11110 && second & 0xd000 == 0xc000;
        let ordered = matches!(self.first >> 4, 0xe8c | 0xe8d)
            && matches!((second >> 4) & 0xf, 0x8 | 0x9 | 0xa | 0xc | 0xd | 0xe);
        fpv5 || f64_arithmetic || conditional_select || low_overhead_loop || ordered
    }
}

/// BL, B.W and the conditional B.W (ARMv7-M manual, A7.7.12 and A7.7.18).
fn wide_offset(first: u32, second: u32) -> Option<i64> {
    let bit = |word: u32, n: u32| u64::from((word >> n) & 1);
    let low = u64::from(second & 0x7ff) << 1;
    if second & (1 << 12) != 0 {
        let sign = bit(first, 10);
        let i1 = 1 ^ bit(second, 13) ^ sign;
        let i2 = 1 ^ bit(second, 11) ^ sign;
        let high = u64::from(first & 0x3ff) << 12;
        return Some(extend(sign << 24 | i1 << 23 | i2 << 22 | high | low, 25));
    }
    let is_branch = second & (1 << 14) == 0 && (first >> 7) & 7 != 7;
    let high = u64::from(first & 0x3f) << 12;
    let offset = bit(first, 10) << 20 | bit(second, 11) << 19 | bit(second, 13) << 18 | high | low;
    is_branch.then(|| extend(offset, 21))
}

fn extend(value: u64, bits: u32) -> i64 {
    (value << (64 - bits)).cast_signed() >> (64 - bits)
}

impl Function {
    /// Its instructions, without the literal pools.
    pub fn instructions(&self) -> Vec<Instruction> {
        let halfword = |at: usize| {
            let pair = self.bytes.get(at..at + 2)?;
            Some(u32::from(u16::from_le_bytes([pair[0], pair[1]])))
        };
        let mut instructions = Vec::new();
        let mut at = 0;
        while let Some(first) = halfword(at) {
            let address = self.address + at as u64;
            let mark = self.data.iter().rev().find(|(from, _)| *from <= address);
            if mark.is_some_and(|(_, is_data)| *is_data) {
                at += 2;
                continue;
            }
            let wide = first >> 11 >= 0b11101;
            let second = if wide { halfword(at + 2) } else { None };
            instructions.push(Instruction {
                address,
                first,
                second,
            });
            at += if wide { 4 } else { 2 };
        }
        instructions
    }

    /// Whether one of its names is as asked.
    pub fn is_named(&self, asked: impl Fn(&str) -> bool) -> bool {
        self.names.iter().any(|name| asked(name))
    }

    fn name(&self) -> &str {
        &self.names[0]
    }
}

/// The functions that one can reach.
pub struct Reach<'a> {
    /// Each function, and the one that it was first reached from.
    from: BTreeMap<usize, Option<usize>>,
    image: &'a Image,
}

impl<'a> Reach<'a> {
    /// Follows the direct calls and jumps from every function that is a root.
    ///
    /// # Errors
    /// There is no root, or something reached calls through a register or leaves the known
    /// functions, so that it cannot be told what else is reached.
    pub fn of(image: &'a Image, is_root: impl Fn(&Function) -> bool) -> Result<Self> {
        let roots: Vec<usize> = (0..image.functions.len())
            .filter(|index| is_root(&image.functions[*index]))
            .collect();
        if roots.is_empty() {
            return Err(Error::check("the firmware has no function to start from"));
        }
        let mut reach = Self {
            from: roots.iter().map(|root| (*root, None)).collect(),
            image,
        };
        let mut queue = VecDeque::from(roots);
        while let Some(index) = queue.pop_front() {
            let function = &image.functions[index];
            let own = function.address..function.address + function.bytes.len() as u64;
            for instruction in function.instructions() {
                if instruction.is_indirect() {
                    return Err(Error::check(format!(
                        "{} calls through a register at {:#x}: what it reaches cannot be told",
                        reach.path(index),
                        instruction.address
                    )));
                }
                let Some(target) = instruction.target().filter(|to| !own.contains(to)) else {
                    continue;
                };
                let Some(callee) = image
                    .functions
                    .iter()
                    .position(|f| (f.address..f.address + f.bytes.len() as u64).contains(&target))
                else {
                    return Err(Error::check(format!(
                        "{} jumps to {target:#x}, which is in no function",
                        reach.path(index)
                    )));
                };
                if let std::collections::btree_map::Entry::Vacant(new) = reach.from.entry(callee) {
                    new.insert(Some(index));
                    queue.push_back(callee);
                }
            }
        }
        Ok(reach)
    }

    /// The functions, with the way to each of them in words.
    pub fn functions(&self) -> impl Iterator<Item = (&'a Function, String)> + '_ {
        self.from
            .keys()
            .map(|index| (&self.image.functions[*index], self.path(*index)))
    }

    fn path(&self, index: usize) -> String {
        let mut names = vec![self.image.functions[index].name()];
        let mut at = index;
        while let Some(Some(caller)) = self.from.get(&at) {
            names.push(self.image.functions[*caller].name());
            at = *caller;
        }
        names.reverse();
        names.join(" → ")
    }
}

#[cfg(test)]
mod tests {
    use super::Instruction;

    fn target(first: u32, second: Option<u32>) -> Option<u64> {
        Instruction {
            address: 0x1000,
            first,
            second,
        }
        .target()
    }

    #[test]
    fn branches_go_where_the_manual_says() {
        // Assembled and disassembled by LLVM at 0x1000.
        assert_eq!(target(0xf000, Some(0xf87e)), Some(0x1100)); // bl
        assert_eq!(target(0xf7ff, Some(0xff7e)), Some(0x0f00)); // bl, backwards
        assert_eq!(target(0xf000, Some(0xb87e)), Some(0x1100)); // b.w
        assert_eq!(target(0xf43f, Some(0xaf7e)), Some(0x0f00)); // beq.w, backwards
        assert_eq!(target(0xe07e, None), Some(0x1100)); // b
        assert_eq!(target(0xd07e, None), Some(0x1100)); // beq
        assert_eq!(target(0xf3bf, Some(0x8f5f)), None); // dmb
        assert_eq!(target(0xdf00, None), None); // svc
    }

    #[test]
    fn a_call_through_any_register_is_indirect_and_a_return_is_not() {
        let indirect = |first| {
            let instruction = Instruction {
                address: 0,
                first,
                second: None,
            };
            instruction.is_indirect()
        };
        assert!(indirect(0x4798)); // blx r3
        assert!(indirect(0x47f0)); // blx lr
        assert!(indirect(0x4718)); // bx r3
        assert!(!indirect(0x4770)); // bx lr
        assert!(!indirect(0x4618)); // mov r0, r3
    }

    #[test]
    fn opcodes_beyond_an_m4f_are_told_from_its_own() {
        let beyond = |first, second| {
            Instruction {
                address: 0,
                first,
                second: Some(second),
            }
            .is_beyond_m4f()
        };
        assert!(beyond(0xfe00, 0x0a00)); // vseleq.f32 s0, s0, s0
        assert!(beyond(0xfe00, 0x0b00)); // vseleq.f64 d0, d0, d0
        assert!(beyond(0xfe80, 0x0b00)); // vmaxnm.f64 d0, d0, d0
        assert!(beyond(0xfeb8, 0x0a40)); // vrinta.f32 s0, s0
        assert!(beyond(0xee30, 0x0b00)); // vadd.f64 d0, d0, d0
        assert!(beyond(0xea51, 0x8002)); // csel r0, r1, r2, eq
        assert!(beyond(0xf040, 0xe001)); // dls lr, r0
        assert!(beyond(0xe8d0, 0x1faf)); // lda r1, [r0]
        assert!(!beyond(0xea51, 0x0002)); // orrs.w r0, r1, r2
        assert!(!beyond(0xf7ff, 0xff7e)); // bl
        assert!(!beyond(0xe8d0, 0x1f4f)); // ldrexb r1, [r0]
        assert!(!beyond(0xee30, 0x0a00)); // vadd.f32 s0, s0, s0
        assert!(!beyond(0xed2d, 0x8b02)); // vpush {d8}
        assert!(!beyond(0xee00, 0x0b10)); // vmov.32 d0[0], r0
    }
}
