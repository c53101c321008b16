//! Instructions of two halfwords: A5.3.

use super::real::{real_data, real_memory};
use super::{ALWAYS, Access, Instruction, Integer, NOWHERE, Operand, PC, SP, signed};

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
        0xe8d0 if second & 0xffe0 == 0xf000 => Instruction::TableBranch {
            n,
            m,
            shift: (second >> 4 & 1) as u8,
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
    if first & 0xfff0 == 0xfab0 && second & 0xf0f0 == 0xf080 {
        let (d, m) = ((second >> 8 & 15) as u8, (second & 15) as u8);
        return Some(Instruction::LeadingZeros { d, m });
    }
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
