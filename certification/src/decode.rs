//! Instructions of ARMv7E-M with FPv4-SP that straight-line arithmetic uses: ARM DDI 0403E, chapters A5 to A7.
//!
//! What is not here is declined by the walk, with its address: no instruction is guessed at.

/// A condition of a branch: the four bits of the instruction set.
pub type Condition = u8;

/// The second operand of an addition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// A constant, negative for a subtraction.
    Constant(u32),
    /// A register, shifted left.
    Register(u8, u8),
    /// A register, shifted right.
    Right(u8, u8),
}

/// The arithmetic of the floating-point unit in single precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// n + m
    Add,
    /// n − m
    Sub,
    /// n m
    Mul,
    /// −(n m)
    NegatedMul,
}

/// The other operations on integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integer {
    /// n − m
    Sub,
    /// m − n
    ReverseSub,
    /// n ∧ m
    And,
    /// n ∨ m
    Or,
    /// n xor m
    Xor,
    /// n ∧ ¬m
    Clear,
    /// n m
    Multiply,
    /// n, shifted left by the low byte of m
    Left,
    /// n, shifted right by the low byte of m
    Right,
}

/// One decoded instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Instruction {
    /// Nothing.
    Nop,
    /// d = n + operand, and whether flags are set.
    Add {
        d: u8,
        n: u8,
        by: Operand,
        flags: bool,
    },
    /// d = n − m, and the flags; d is 16 of a comparison.
    Sub { d: u8, n: u8, by: Operand },
    /// d = a constant
    Constant { d: u8, value: u32 },
    /// The upper half of d.
    Upper { d: u8, value: u32 },
    /// d = m
    Move { d: u8, m: u8 },
    /// One word between t and n + offset; n may be the program counter.
    Word {
        t: u8,
        n: u8,
        offset: i32,
        load: bool,
    },
    /// Words between registers, a bit each, and n upward; `before` n of a store that decrements. Whether n moves.
    Words {
        n: u8,
        registers: u16,
        load: bool,
        down: bool,
        writes_back: bool,
    },
    /// Words of the floating-point registers from `first` on.
    Reals {
        first: u8,
        count: u8,
        n: u8,
        offset: i32,
        load: bool,
    },
    /// The same at n, which moves.
    RealsMoving {
        first: u8,
        count: u8,
        n: u8,
        load: bool,
        down: bool,
        writes_back: bool,
    },
    /// d = n op m
    Arithmetic { op: Arithmetic, d: u8, n: u8, m: u8 },
    /// d = −m
    Negate { d: u8, m: u8 },
    /// d = m
    Copy { d: u8, m: u8 },
    /// d = a constant
    Real { d: u8, value: f32 },
    /// Bits between a core register and a floating-point one.
    Transfer { core: u8, real: u8, to_core: bool },
    /// Goes on elsewhere, relative to the address plus four; `link` of a call.
    Branch {
        offset: i32,
        condition: Condition,
        link: bool,
    },
    /// Goes on elsewhere if a register is zero, or not.
    BranchIfZero { n: u8, offset: i32, if_not: bool },
    /// Goes on at a register's address.
    BranchTo { m: u8 },
    /// d = the word's address of the instruction plus an offset
    Address { d: u8, offset: i32 },
    /// d = n op operand, and whether flags are set.
    Integer {
        op: Integer,
        d: u8,
        n: u8,
        by: Operand,
        flags: bool,
    },
    /// d = ¬m
    Not { d: u8, m: u8, flags: bool },
    /// Makes the next instructions conditional.
    IfThen,
    /// d = n m + a
    MultiplyAdd { d: u8, n: u8, m: u8, a: u8 },
    /// Memory of any size at n + offset.
    Access(Access),
}

/// A load or store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Access {
    /// The register.
    pub t: u8,
    /// The one of the next word, [`NOWHERE`] if there is none.
    pub second: u8,
    /// The base.
    pub n: u8,
    /// What is added to it.
    pub offset: Operand,
    /// 1, 2 or 4.
    pub bytes: u8,
    /// Whether a narrow number has a sign.
    pub is_signed: bool,
    /// From memory.
    pub load: bool,
    /// Whether the offset counts for the address.
    pub before: bool,
    /// Whether n moves.
    pub writes_back: bool,
}

/// A branch that is always taken.
pub const ALWAYS: Condition = 14;
/// The stack pointer, link register and program counter.
pub const SP: u8 = 13;
/// See [`SP`].
pub const LR: u8 = 14;
/// See [`SP`].
pub const PC: u8 = 15;
/// No register: where a comparison writes.
pub const NOWHERE: u8 = 16;

/// Whether an instruction has a second halfword: A5.1.
pub fn is_long(first: u16) -> bool {
    first >> 11 >= 0b11101
}

/// The value of the low `bits` bits as a signed number.
fn signed(value: u32, bits: u32) -> i32 {
    ((value << (32 - bits)) as i32) >> (32 - bits)
}

/// An instruction of one halfword: A5.2.
pub fn short(code: u16) -> Option<Instruction> {
    use Instruction::{Add, Branch, BranchIfZero, BranchTo, Constant, Move, Nop, Sub, Word, Words};
    let field = |low: u32, bits: u32| (u32::from(code) >> low) & ((1 << bits) - 1);
    let low = |at: u32| field(at, 3) as u8;
    let by = Operand::Constant;
    let (third, byte) = (field(8, 3) as u8, field(0, 8));
    let high = (field(7, 1) << 3 | field(0, 3)) as u8;
    let m = field(3, 4) as u8;
    let word = |t, n, words: u32, load| Word {
        t,
        n,
        offset: 4 * words as i32,
        load,
    };
    let integer = |op, by| Instruction::Integer {
        op,
        d: low(0),
        n: low(3),
        by,
        flags: true,
    };
    let access = |bytes, offset, load| {
        Instruction::Access(Access {
            t: low(0),
            second: NOWHERE,
            n: low(3),
            offset,
            bytes,
            is_signed: false,
            load,
            before: true,
            writes_back: false,
        })
    };
    Some(match code >> 8 {
        0x00..=0x07 => Instruction::Integer {
            op: Integer::Multiply,
            d: low(0),
            n: low(3),
            by: by(1 << field(6, 5)),
            flags: true,
        },
        0x08..=0x0f if field(6, 5) > 0 => integer(Integer::Right, by(field(6, 5))),
        0x43 if field(6, 4) == 15 => Instruction::Not {
            d: low(0),
            m: low(3),
            flags: true,
        },
        0x40 | 0x42 | 0x43 if [0, 1, 2, 3, 8, 12, 13, 14].contains(&field(6, 4)) => {
            let op = match field(6, 4) {
                0 | 8 => Integer::And,
                1 => Integer::Xor,
                2 => Integer::Left,
                3 => Integer::Right,
                12 => Integer::Or,
                13 => Integer::Multiply,
                _ => Integer::Clear,
            };
            Instruction::Integer {
                op,
                d: if field(6, 4) == 8 { NOWHERE } else { low(0) },
                n: low(0),
                by: Operand::Register(low(3), 0),
                flags: true,
            }
        }
        0x42 if field(6, 2) == 1 => integer(Integer::ReverseSub, by(0)),
        0xb2 if code & 0x80 != 0 => Instruction::Integer {
            op: Integer::And,
            d: low(0),
            n: low(3),
            by: by(if code & 0x40 == 0 { 0xffff } else { 0xff }),
            flags: false,
        },
        0x50..=0x5f => {
            let (bytes, load) = match field(9, 3) {
                0 => (4, false),
                1 => (2, false),
                2 => (1, false),
                4 => (4, true),
                5 => (2, true),
                6 => (1, true),
                // LDRSB, LDRSH
                _ => return None,
            };
            access(bytes, Operand::Register(low(6), 0), load)
        }
        0x70..=0x7f => access(1, by(field(6, 5)), code & 0x800 != 0),
        0x80..=0x8f => access(2, by(2 * field(6, 5)), code & 0x800 != 0),
        0xa0..=0xa7 => Instruction::Address {
            d: third,
            offset: 4 * byte as i32,
        },
        0x18 | 0x19 => Add {
            d: low(0),
            n: low(3),
            by: Operand::Register(low(6), 0),
            flags: true,
        },
        0x1a | 0x1b => Sub {
            d: low(0),
            n: low(3),
            by: Operand::Register(low(6), 0),
        },
        0x1c | 0x1d => Add {
            d: low(0),
            n: low(3),
            by: by(field(6, 3)),
            flags: true,
        },
        0x1e | 0x1f => Sub {
            d: low(0),
            n: low(3),
            by: by(field(6, 3)),
        },
        0x20..=0x27 => Constant {
            d: third,
            value: byte,
        },
        0x28..=0x2f => Sub {
            d: NOWHERE,
            n: third,
            by: by(byte),
        },
        0x30..=0x37 => Add {
            d: third,
            n: third,
            by: by(byte),
            flags: true,
        },
        0x38..=0x3f => Sub {
            d: third,
            n: third,
            by: by(byte),
        },
        0x42 if field(6, 2) == 2 => Sub {
            d: NOWHERE,
            n: low(0),
            by: Operand::Register(low(3), 0),
        },
        0x44 if high != PC && m != PC => Add {
            d: high,
            n: high,
            by: Operand::Register(m, 0),
            flags: false,
        },
        0x45 => Sub {
            d: NOWHERE,
            n: high,
            by: Operand::Register(m, 0),
        },
        0x46 if high != PC && m != PC => Move { d: high, m },
        0x47 if code & 0x87 == 0 => BranchTo { m },
        0x48..=0x4f => word(third, PC, byte, true),
        0x60..=0x6f => word(low(0), low(3), field(6, 5), code & 0x800 != 0),
        0x90..=0x9f => word(third, SP, byte, code & 0x800 != 0),
        0xa8..=0xaf => Add {
            d: third,
            n: SP,
            by: by(4 * byte),
            flags: false,
        },
        0xb0 => {
            let bytes = 4 * field(0, 7);
            let by = by(if code & 0x80 == 0 {
                bytes
            } else {
                bytes.wrapping_neg()
            });
            Add {
                d: SP,
                n: SP,
                by,
                flags: false,
            }
        }
        0xb1 | 0xb3 | 0xb9 | 0xbb => BranchIfZero {
            n: low(0),
            offset: (field(9, 1) << 6 | field(3, 5) << 1) as i32,
            if_not: code & 0x800 != 0,
        },
        0xb4 | 0xb5 => Words {
            n: SP,
            registers: (byte | field(8, 1) << LR) as u16,
            load: false,
            down: true,
            writes_back: true,
        },
        0xbc | 0xbd => Words {
            n: SP,
            registers: (byte | field(8, 1) << PC) as u16,
            load: true,
            down: false,
            writes_back: true,
        },
        0xbf if code == 0xbf00 => Nop,
        0xbf if code & 15 != 0 => Instruction::IfThen,
        0xc0..=0xcf => Words {
            n: third,
            registers: byte as u16,
            load: code & 0x800 != 0,
            down: false,
            writes_back: code & 0x800 == 0 || byte & 1 << third == 0,
        },
        0xd0..=0xdd => Branch {
            offset: signed(byte << 1, 9),
            condition: field(8, 4) as u8,
            link: false,
        },
        0xe0..=0xe7 => Branch {
            offset: signed(field(0, 11) << 1, 12),
            condition: ALWAYS,
            link: false,
        },
        _ => return None,
    })
}

/// An instruction of two halfwords: A5.3 and A6.
pub fn long(first: u16, second: u16) -> Option<Instruction> {
    match first >> 8 {
        0xec | 0xed => real_memory(first, second),
        0xee => real_data(first, second),
        0xe8..=0xeb => multiple_or_shifted(first, second),
        0xf8 => single(first, second),
        0xf9 => access(first, second),
        0xfa => shifted_by_register(first, second),
        0xfb => multiply(first, second),
        0xf0..=0xf7 => immediate_or_branch(first, second),
        _ => None,
    }
}

fn multiple_or_shifted(first: u16, second: u16) -> Option<Instruction> {
    let n = (first & 15) as u8;
    let shift = ((second >> 12 & 7) << 2 | second >> 6 & 3) as u8;
    let (d, m) = ((second >> 8 & 15) as u8, (second & 15) as u8);
    Some(match first & 0xfff0 {
        // LDM, STM and their forms that count down, which only stores have here.
        0xe880 | 0xe8a0 | 0xe890 | 0xe8b0 | 0xe900 | 0xe920 => Instruction::Words {
            n,
            registers: second,
            load: first & 0x10 != 0,
            down: first & 0x100 != 0,
            writes_back: first & 0x20 != 0,
        },
        0xeb00 | 0xeb10 if second & 0x8020 == 0 && n != PC => Instruction::Add {
            d: if d == PC { NOWHERE } else { d },
            n,
            by: shifted_by(m, shift, second)?,
            flags: first & 0x10 != 0,
        },
        0xe840..=0xe9ff if first & 0x40 != 0 && first & 0x120 != 0 => {
            let bytes = 4 * u32::from(second & 0xff);
            Instruction::Access(Access {
                t: (second >> 12) as u8,
                second: d,
                n,
                offset: Operand::Constant(if first & 0x80 == 0 {
                    bytes.wrapping_neg()
                } else {
                    bytes
                }),
                bytes: 4,
                is_signed: false,
                load: first & 0x10 != 0,
                before: first & 0x100 != 0,
                writes_back: first & 0x20 != 0,
            })
        }
        _ if first >> 9 == 0x75 && second & 0x8000 == 0 => return shifted(first, second),
        _ => return None,
    })
}

/// Data processing with a shifted register: A5.3.11.
fn shifted(first: u16, second: u16) -> Option<Instruction> {
    let (n, d, m) = (first & 15, (second >> 8 & 15) as u8, (second & 15) as u8);
    let shift = ((second >> 12 & 7) << 2 | second >> 6 & 3) as u8;
    let flags = first & 0x10 != 0;
    let integer = |op, n, by| Instruction::Integer {
        op,
        d: if d == PC { NOWHERE } else { d },
        n,
        by,
        flags,
    };
    let by = shifted_by(m, shift, second)?;
    let n = n as u8;
    Some(match (first >> 5 & 15, by) {
        (2, Operand::Right(..)) if n == PC => {
            integer(Integer::Right, m, Operand::Constant(shift.into()))
        }
        (2, _) if n == PC => integer(Integer::Multiply, m, Operand::Constant(1 << shift)),
        (3, Operand::Register(m, 0)) if n == PC => Instruction::Not { d, m, flags },
        (3, _) if n == PC => return None,
        (0, _) => integer(Integer::And, n, by),
        (1, _) => integer(Integer::Clear, n, by),
        (2, _) => integer(Integer::Or, n, by),
        (4, _) => integer(Integer::Xor, n, by),
        (13, _) => integer(Integer::Sub, n, by),
        (14, _) => integer(Integer::ReverseSub, n, by),
        _ => return None,
    })
}

/// LSL and LSR by a register: A7.7.69, A7.7.71.
fn shifted_by_register(first: u16, second: u16) -> Option<Instruction> {
    let op = match first & 0xffe0 {
        0xfa00 => Integer::Left,
        0xfa20 => Integer::Right,
        _ => return None,
    };
    (second & 0xf0f0 == 0xf000).then_some(Instruction::Integer {
        op,
        d: (second >> 8 & 15) as u8,
        n: (first & 15) as u8,
        by: Operand::Register((second & 15) as u8, 0),
        flags: first & 0x10 != 0,
    })
}

/// A register as its shift leaves it: by a number to the left, or by at least one to the right.
fn shifted_by(m: u8, shift: u8, second: u16) -> Option<Operand> {
    match second >> 4 & 3 {
        0 => Some(Operand::Register(m, shift)),
        1 if shift > 0 => Some(Operand::Right(m, shift)),
        _ => None,
    }
}

/// Multiplications whose result is a word: A5.3.16.
fn multiply(first: u16, second: u16) -> Option<Instruction> {
    let (n, d, m) = (
        (first & 15) as u8,
        (second >> 8 & 15) as u8,
        (second & 15) as u8,
    );
    let a = (second >> 12) as u8;
    (first & 0xfff0 == 0xfb00 && second & 0xf0 == 0).then_some(Instruction::MultiplyAdd {
        d,
        n,
        m,
        a: if a == PC { NOWHERE } else { a },
    })
}

/// Loads and stores of one register: A5.3.7 to A5.3.10.
fn access(first: u16, second: u16) -> Option<Instruction> {
    let size = first >> 5 & 3;
    let (n, t, load) = ((first & 15) as u8, (second >> 12) as u8, first & 0x10 != 0);
    if size == 3 || n == PC || t == PC {
        return None;
    }
    let constant = |bytes: u16, up| {
        let bytes = u32::from(bytes);
        Operand::Constant(if up { bytes } else { bytes.wrapping_neg() })
    };
    let (offset, before, writes_back) = if first & 0x80 != 0 {
        (constant(second & 0xfff, true), true, false)
    } else if second & 0x800 != 0 {
        let offset = constant(second & 0xff, second & 0x200 != 0);
        (offset, second & 0x400 != 0, second & 0x100 != 0)
    } else {
        let register = Operand::Register((second & 15) as u8, (second >> 4 & 3) as u8);
        (register, true, false)
    };
    Some(Instruction::Access(Access {
        t,
        second: NOWHERE,
        n,
        offset,
        bytes: 1 << size,
        is_signed: first & 0x100 != 0,
        load,
        before,
        writes_back,
    }))
}

fn single(first: u16, second: u16) -> Option<Instruction> {
    let (n, t) = ((first & 15) as u8, (second >> 12) as u8);
    let offset = i32::from(second & 0xfff);
    let word = |offset, load| Instruction::Word { t, n, offset, load };
    Some(match first & 0xfff0 {
        0xf8d0 => word(offset, true),
        0xf8c0 => word(offset, false),
        0xf850 if n == PC => word(-offset, true),
        // Offsets downwards, without a change of the base.
        0xf850 | 0xf840 if second & 0xf00 == 0xc00 => word(-(offset & 0xff), first & 0x10 != 0),
        // PUSH and POP of one register: A7.7.99, A7.7.101.
        0xf840 | 0xf850
            if n == SP && [0xd04, 0xb04][usize::from(first >> 4 & 1)] == second & 0xfff =>
        {
            let load = first & 0x10 != 0;
            Instruction::Words {
                n,
                registers: 1 << t,
                load,
                down: !load,
                writes_back: true,
            }
        }
        _ => return access(first, second),
    })
}

/// The constant that twelve bits encode: A5.3.2.
fn expanded(code: u32) -> u32 {
    let byte = code & 0xff;
    match code >> 8 {
        0 => byte,
        1 => byte << 16 | byte,
        2 => byte << 24 | byte << 8,
        3 => byte * 0x0101_0101,
        _ => (0x80 | code & 0x7f).rotate_right(code >> 7),
    }
}

fn immediate_or_branch(first: u16, second: u16) -> Option<Instruction> {
    use Instruction::{Add, Constant, Sub, Upper};
    let (one, two) = (u32::from(first), u32::from(second));
    if second & 0x8000 != 0 {
        return branch(one, two);
    }
    let (n, d) = ((one & 15) as u8, (two >> 8 & 15) as u8);
    let code = (one >> 10 & 1) << 11 | (two >> 12 & 7) << 8 | two & 0xff;
    let half = (one & 15) << 12 | code;
    let by = Operand::Constant;
    let to = if d == PC { NOWHERE } else { d };
    let integer = |op| Instruction::Integer {
        op,
        d: to,
        n,
        by: by(expanded(code)),
        flags: one & 0x10 != 0,
    };
    Some(match first & 0xfbf0 {
        0xf050 if n == PC => return None,
        0xf040 if n == PC => Constant {
            d,
            value: expanded(code),
        },
        0xf100 => Add {
            d,
            n,
            by: by(expanded(code)),
            flags: false,
        },
        0xf110 => Add {
            d: to,
            n,
            by: by(expanded(code)),
            flags: true,
        },
        0xf1a0 => Add {
            d,
            n,
            by: by(expanded(code).wrapping_neg()),
            flags: false,
        },
        0xf1b0 => Sub {
            d: to,
            n,
            by: by(expanded(code)),
        },
        0xf200 if n != PC => Add {
            d,
            n,
            by: by(code),
            flags: false,
        },
        0xf2a0 if n != PC => Add {
            d,
            n,
            by: by(code.wrapping_neg()),
            flags: false,
        },
        0xf000 | 0xf010 => integer(Integer::And),
        0xf020 | 0xf030 => integer(Integer::Clear),
        0xf040 | 0xf050 => integer(Integer::Or),
        0xf060 if n == PC => Constant {
            d,
            value: !expanded(code),
        },
        0xf080 | 0xf090 => integer(Integer::Xor),
        0xf1c0 | 0xf1d0 => integer(Integer::ReverseSub),
        0xf200 => Instruction::Address {
            d,
            offset: code as i32,
        },
        0xf2a0 => Instruction::Address {
            d,
            offset: -(code as i32),
        },
        0xf240 => Constant { d, value: half },
        0xf2c0 => Upper { d, value: half },
        _ => return None,
    })
}

fn branch(one: u32, two: u32) -> Option<Instruction> {
    let s = one >> 10 & 1;
    let (j1, j2) = (two >> 13 & 1, two >> 11 & 1);
    let i = |j: u32| 1 ^ j ^ s;
    let far = s << 24 | i(j1) << 23 | i(j2) << 22 | (one & 0x3ff) << 12 | (two & 0x7ff) << 1;
    let near = s << 20 | j2 << 19 | j1 << 18 | (one & 0x3f) << 12 | (two & 0x7ff) << 1;
    let condition = (one >> 6 & 15) as u8;
    Some(match two >> 12 & 5 {
        0 if condition < ALWAYS => Instruction::Branch {
            offset: signed(near, 21),
            condition,
            link: false,
        },
        1 => Instruction::Branch {
            offset: signed(far, 25),
            condition: ALWAYS,
            link: false,
        },
        5 => Instruction::Branch {
            offset: signed(far, 25),
            condition: ALWAYS,
            link: true,
        },
        _ => return None,
    })
}

/// The number of a single-precision register of four bits and one: A6.3.
fn real(four: u16, one: u16) -> u8 {
    ((four & 15) << 1 | one & 1) as u8
}

fn real_memory(first: u16, second: u16) -> Option<Instruction> {
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

fn real_data(first: u16, second: u16) -> Option<Instruction> {
    use Instruction::{Copy, Negate, Real, Transfer};
    if second >> 8 & 15 != 10 {
        return None;
    }
    let d = real(second >> 12, first >> 6);
    let (n, m) = (real(first, second >> 7), real(second, second >> 5));
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
            (1, 0) => Some(Negate { d, m }),
            _ => None,
        },
        _ => None,
    }
}
