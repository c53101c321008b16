//! Instructions of one halfword: A5.2.

use super::{ALWAYS, Access, Instruction, Integer, LR, NOWHERE, Operand, PC, SP, signed};

/// A halfword, by its fields.
#[derive(Clone, Copy)]
struct Code(u16);

impl Code {
    fn field(self, low: u32, bits: u32) -> u32 {
        (u32::from(self.0) >> low) & ((1 << bits) - 1)
    }

    /// A register of three bits.
    fn low(self, at: u32) -> u8 {
        self.field(at, 3) as u8
    }

    /// The one in bits 8 to 10.
    fn third(self) -> u8 {
        self.low(8)
    }

    fn byte(self) -> u32 {
        self.field(0, 8)
    }

    /// Registers of four bits: the one that is written, and the other.
    fn high(self) -> (u8, u8) {
        let d = (self.field(7, 1) << 3 | self.field(0, 3)) as u8;
        (d, self.field(3, 4) as u8)
    }

    fn is_load(self) -> bool {
        self.0 & 0x800 != 0
    }
}

/// An instruction of one halfword: A5.2.
pub fn short(code: u16) -> Option<Instruction> {
    let one = Code(code);
    match code >> 8 {
        0x00..=0x3f => shift_or_sum(one),
        0x40..=0x43 => of_low_registers(one),
        0x44..=0x47 => of_high_registers(one),
        0x48..=0x9f | 0xb4 | 0xb5 | 0xbc | 0xbd | 0xc0..=0xcf => memory(one),
        _ => other(one),
    }
}

/// Shifts, sums, comparisons and constants: A5.2.1.
fn shift_or_sum(one: Code) -> Option<Instruction> {
    use Instruction::{Add, Constant, Sub};
    let (d, n, third) = (one.low(0), one.low(3), one.third());
    let by = Operand::Constant;
    let (register, three, byte) = (
        Operand::Register(one.low(6), 0),
        by(one.field(6, 3)),
        by(one.byte()),
    );
    let add = |d, n, by| Add {
        d,
        n,
        by,
        flags: true,
    };
    let integer = |op, by| Instruction::Integer {
        op,
        d,
        n,
        by,
        flags: true,
    };
    let shift = one.field(6, 5);
    Some(match one.field(8, 8) {
        0x00..=0x07 => integer(Integer::Multiply, by(1 << shift)),
        0x08..=0x0f if shift > 0 => integer(Integer::Right, by(shift)),
        0x18 | 0x19 => add(d, n, register),
        0x1a | 0x1b => Sub { d, n, by: register },
        0x1c | 0x1d => add(d, n, three),
        0x1e | 0x1f => Sub { d, n, by: three },
        0x20..=0x27 => Constant {
            d: third,
            value: one.byte(),
        },
        0x28..=0x2f => Sub {
            d: NOWHERE,
            n: third,
            by: byte,
        },
        0x30..=0x37 => add(third, third, byte),
        0x38..=0x3f => Sub {
            d: third,
            n: third,
            by: byte,
        },
        _ => return None,
    })
}

/// Data processing: A5.2.2.
fn of_low_registers(one: Code) -> Option<Instruction> {
    let (d, m) = (one.low(0), one.low(3));
    let by = Operand::Register(m, 0);
    let integer = |op, d, n, by| Instruction::Integer {
        op,
        d,
        n,
        by,
        flags: true,
    };
    let op = match one.field(6, 4) {
        0 => Integer::And,
        1 => Integer::Xor,
        2 => Integer::Left,
        3 => Integer::Right,
        8 => return Some(integer(Integer::And, NOWHERE, d, by)),
        9 => return Some(integer(Integer::ReverseSub, d, m, Operand::Constant(0))),
        10 => {
            return Some(Instruction::Sub {
                d: NOWHERE,
                n: d,
                by,
            });
        }
        12 => Integer::Or,
        13 => Integer::Multiply,
        14 => Integer::Clear,
        15 => return Some(Instruction::Not { d, m, flags: true }),
        _ => return None,
    };
    Some(integer(op, d, d, by))
}

/// Sums, comparisons, moves and branches of any registers: A5.2.3.
fn of_high_registers(one: Code) -> Option<Instruction> {
    let (d, m) = one.high();
    let by = Operand::Register(m, 0);
    let has_pc = d == PC || m == PC;
    Some(match one.field(8, 8) {
        0x44 if !has_pc => Instruction::Add {
            d,
            n: d,
            by,
            flags: false,
        },
        0x45 => Instruction::Sub {
            d: NOWHERE,
            n: d,
            by,
        },
        0x46 if !has_pc => Instruction::Move { d, m },
        0x47 if one.0 & 0x87 == 0 => Instruction::BranchTo { m },
        _ => return None,
    })
}

/// Loads and stores: A5.2.4 and A5.2.5.
fn memory(one: Code) -> Option<Instruction> {
    use Instruction::{Word, Words};
    let (third, load) = (one.third(), one.is_load());
    let word = |t, n, words: u32, load| Word {
        t,
        n,
        offset: 4 * words as i32,
        load,
    };
    let access = |bytes, offset, load| {
        Instruction::Access(Access {
            t: one.low(0),
            second: NOWHERE,
            n: one.low(3),
            offset,
            bytes,
            is_signed: false,
            load,
            before: true,
            writes_back: false,
        })
    };
    let (five, register) = (one.field(6, 5), Operand::Register(one.low(6), 0));
    let (base, registers) = (one.low(3), one.byte());
    Some(match (one.field(12, 4), one.field(9, 3)) {
        (4, _) => word(third, PC, one.byte(), true),
        (5, 0) => access(4, register, false),
        (5, 1) => access(2, register, false),
        (5, 2) => access(1, register, false),
        (5, 4) => access(4, register, true),
        (5, 5) => access(2, register, true),
        (5, 6) => access(1, register, true),
        (6, _) => word(one.low(0), base, five, load),
        (7, _) => access(1, Operand::Constant(five), load),
        (8, _) => access(2, Operand::Constant(2 * five), load),
        (9, _) => word(third, SP, one.byte(), load),
        // PUSH and POP
        (11, _) => Words {
            n: SP,
            registers: (registers | one.field(8, 1) << if load { PC } else { LR }) as u16,
            load,
            down: !load,
            writes_back: true,
        },
        (12, _) => Words {
            n: third,
            registers: registers as u16,
            load,
            down: false,
            writes_back: !load || registers & 1 << third == 0,
        },
        // LDRSB, LDRSH
        _ => return None,
    })
}

/// Addresses, the stack pointer, branches and hints: A5.2.5 and A5.2.6.
fn other(one: Code) -> Option<Instruction> {
    use Instruction::{Add, Address, Branch, BranchIfZero, IfThen, Nop};
    let byte = one.byte();
    let add = |d, by| Add {
        d,
        n: SP,
        by: Operand::Constant(by),
        flags: false,
    };
    let stack = 4 * one.field(0, 7);
    Some(match one.field(8, 8) {
        0xa0..=0xa7 => Address {
            d: one.third(),
            offset: 4 * byte as i32,
        },
        0xa8..=0xaf => add(one.third(), 4 * byte),
        0xb0 if byte < 0x80 => add(SP, stack),
        0xb0 => add(SP, stack.wrapping_neg()),
        // UXTH and UXTB
        0xb2 if byte >= 0x80 => Instruction::Integer {
            op: Integer::And,
            d: one.low(0),
            n: one.low(3),
            by: Operand::Constant(if byte < 0xc0 { 0xffff } else { 0xff }),
            flags: false,
        },
        0xb1 | 0xb3 | 0xb9 | 0xbb => BranchIfZero {
            n: one.low(0),
            offset: (one.field(9, 1) << 6 | one.field(3, 5) << 1) as i32,
            if_not: one.is_load(),
        },
        0xbf if byte == 0 => Nop,
        0xbf if byte & 15 != 0 => IfThen { state: byte as u8 },
        0xd0..=0xdd => Branch {
            offset: signed(byte << 1, 9),
            condition: one.field(8, 4) as u8,
            link: false,
        },
        0xe0..=0xe7 => Branch {
            offset: signed(one.field(0, 11) << 1, 12),
            condition: ALWAYS,
            link: false,
        },
        _ => return None,
    })
}
