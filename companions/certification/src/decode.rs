//! Instructions of ARMv7E-M with FPv4-SP that straight-line arithmetic uses, by the table of the
//! cycle meter: ARM DDI 0403E, chapters A5 to A7.
//!
//! The walk declines every other instruction, with its address, and never guesses.

use cycle_meter::Operation;

/// A condition of a branch: the four bits of the instruction set.
pub type Condition = u8;

/// The second operand of an addition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// A constant, negative for a subtraction.
    Constant(u32),
    /// A register whose value is shifted left.
    Register(u8, u8),
    /// A register whose value is shifted right.
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
    /// n / m
    Div,
}

/// The operations on integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integer {
    /// n + m
    Add,
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

impl Integer {
    /// The result of the operation on two words.
    pub fn of(self, n: u32, m: u32) -> u32 {
        match self {
            Self::Add => n.wrapping_add(m),
            Self::Sub => n.wrapping_sub(m),
            Self::ReverseSub => m.wrapping_sub(n),
            Self::And => n & m,
            Self::Or => n | m,
            Self::Xor => n ^ m,
            Self::Clear => n & !m,
            Self::Multiply => n.wrapping_mul(m),
            Self::Left => n.checked_shl(m & 0xff).unwrap_or(0),
            Self::Right => n.checked_shr(m & 0xff).unwrap_or(0),
        }
    }
}

/// One decoded instruction and its operands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Instruction {
    /// An instruction without effect.
    Nop,
    /// d = a constant, in a core register
    Constant { d: u8, value: u32 },
    /// The upper half of d.
    Upper { d: u8, value: u32 },
    /// d = m, core registers
    Move { d: u8, m: u8 },
    /// d = n op m
    Arithmetic { op: Arithmetic, d: u8, n: u8, m: u8 },
    /// d = −m
    Negate { d: u8, m: u8 },
    /// d = √m
    Root { d: u8, m: u8 },
    /// Compares d with m, or with zero if there is none.
    Compare { d: u8, m: Option<u8> },
    /// The flags of that comparison become those of the processor.
    TakeFlags,
    /// d = m, floating-point registers
    Copy { d: u8, m: u8 },
    /// d = a constant, in a floating-point register
    Real { d: u8, value: f32 },
    /// Bits between a core register and a floating-point one.
    Transfer { core: u8, real: u8, to_core: bool },
    /// Goes on elsewhere, relative to the address plus four; `link` of a call.
    Branch { offset: i32, condition: Condition, link: bool },
    /// Goes on elsewhere if a register is zero, or not.
    BranchIfZero { n: u8, offset: i32, if_not: bool },
    /// Goes on at a register's address.
    BranchTo { m: u8 },
    /// d = the word's address of the instruction plus an offset
    Address { d: u8, offset: i32 },
    /// d = n op operand, and whether flags are set; d is 16 of a comparison.
    Integer { op: Integer, d: u8, n: u8, by: Operand, flags: bool },
    /// Makes the next instructions conditional: ITSTATE, A7.3.3.
    IfThen { state: u8 },
    /// d = n m + a
    MultiplyAdd { d: u8, n: u8, m: u8, a: u8 },
    /// Memory of any size at n + offset; n may be the program counter.
    Access(Access),
    /// Several registers are loaded from or stored to consecutive words.
    Several(Several),
}

/// Loads or stores of words that follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Several {
    /// A bit for each, in their order: those of the core, then those of the floating-point unit.
    pub registers: u64,
    /// The register that holds the base address.
    pub n: u8,
    /// The lowest address, from the base on.
    pub offset: i32,
    /// The number that is added to the base register afterwards.
    pub moves: i32,
    /// Whether it loads from memory.
    pub load: bool,
}

impl Several {
    /// The registers, those of the floating-point unit from 16 on.
    pub fn named(self) -> impl Iterator<Item = usize> {
        (0..64).filter(move |register| self.registers >> register & 1 != 0)
    }
}

/// A load or store of one register or two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Access {
    /// The register that is loaded or stored.
    pub t: u8,
    /// The register of the following word, or [`NOWHERE`] if the instruction moves one word.
    pub second: u8,
    /// The register that holds the base address.
    pub n: u8,
    /// The offset that is added to the base.
    pub offset: Operand,
    /// The size in memory: 1, 2 or 4 bytes.
    pub bytes: u8,
    /// Whether a narrow number has a sign.
    pub is_signed: bool,
    /// Whether it loads from memory.
    pub load: bool,
    /// Whether the offset counts for the address.
    pub before: bool,
    /// Whether the base register is updated.
    pub writes_back: bool,
}

/// A branch that is always taken.
pub const ALWAYS: Condition = 14;
/// The stack pointer, link register and program counter.
pub const SP: u8 = 13;
/// The link register.
pub const LR: u8 = 14;
/// The program counter.
pub const PC: u8 = 15;
/// No register: where a comparison writes.
pub const NOWHERE: u8 = 16;

/// The instruction that these halfwords encode; a short instruction uses only the first.
pub fn decode(first: u16, second: u16) -> Option<Instruction> {
    let of = cycle_meter::operation(first, second)?;
    match of.name() {
        name if name.starts_with('v') => of_reals(name, of),
        name if name.starts_with("branch") || name == "call" => branch(name, of),
        name => of_core(name, of),
    }
}

/// The number of a register, or [`NOWHERE`].
fn register(of: Operation, name: &str) -> u8 {
    of.field(name).map_or(NOWHERE, |number| number as u8)
}

/// The number of a single-precision register, or of the first half of a double one: A6.3.
fn real(of: Operation, name: &str) -> u8 {
    let [four, one] = [name, &name.to_uppercase()].map(|name| of.field(name).unwrap_or(0));
    match of.field("z") {
        Some(1) => (one << 4 | four) as u8 * 2,
        _ => (four << 1 | one) as u8,
    }
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

fn of_core(name: &str, of: Operation) -> Option<Instruction> {
    use Instruction::{Address, Constant};
    let (is, number) = (|name| of.field(name) == Some(1), |name| of.field(name).unwrap_or(0));
    let plain = of.field("x").map_or(number("i"), expanded) | number("h") << 12;
    let scaled = plain.wrapping_mul(of.field("k").unwrap_or(1));
    let constant = match of.field("u") {
        Some(0) => scaled.wrapping_neg(),
        _ => scaled,
    };
    let shift = number("s") as u8;
    let by = match of.field("m") {
        Some(m) if is("y") => Operand::Right(m as u8, shift),
        Some(m) => Operand::Register(m as u8, shift),
        None => Operand::Constant(constant),
    };
    let (mut d, n, m, t) =
        (register(of, "d"), register(of, "n"), register(of, "m"), register(of, "t"));
    let flags = is("f") || name.starts_with("compare");
    let load = name.starts_with('l');
    let mut first = n;
    // The result goes where an operand was.
    let name = match name.strip_suffix("_to") {
        Some(name) if d == NOWHERE => {
            d = n;
            name
        }
        Some(name) => {
            first = d;
            name
        }
        None => name,
    };
    if d == PC {
        if !flags {
            return None;
        }
        d = NOWHERE;
    }
    let integer = |op, by| Instruction::Integer { op, d, n: first, by, flags };
    Some(match name {
        "nothing" => Instruction::Nop,
        "if_then" => Instruction::IfThen { state: number("i") as u8 },
        "add" => integer(Integer::Add, by),
        "constant" => Constant { d, value: plain },
        "inverted" => Constant { d, value: !plain },
        "upper" => Instruction::Upper { d, value: plain },
        "move" => Instruction::Move { d, m },
        "address" => Address { d, offset: constant as i32 },
        "lsl" => integer(Integer::Multiply, Operand::Constant(1 << shift)),
        "lsr" => integer(Integer::Right, Operand::Constant(shift.into())),
        "subtract" | "compare" => integer(Integer::Sub, by),
        "reverse_subtract" => integer(Integer::ReverseSub, by),
        "and" => integer(Integer::And, by),
        "or" => integer(Integer::Or, by),
        "xor" => integer(Integer::Xor, by),
        "clear" => integer(Integer::Clear, by),
        "multiply" => integer(Integer::Multiply, by),
        "left" => integer(Integer::Left, by),
        "right" => integer(Integer::Right, by),
        "not" => {
            Instruction::Integer { op: Integer::Xor, d, n: m, by: Operand::Constant(!0), flags }
        }
        "multiply_add" => Instruction::MultiplyAdd { d, n, m, a: register(of, "a") },
        "ldm" | "stm" => {
            let mut registers = of.field("l").unwrap_or(1 << (t & 15)) as u16;
            // The ninth bit of PUSH and POP.
            if n == SP && of.field("w").is_none() {
                let last = if load { PC } else { LR };
                registers = registers & 0xff | registers >> 8 << last;
            }
            let is_listed = load && registers >> n & 1 != 0;
            let moves = of.field("w").map_or(!is_listed, |w| w == 1);
            return several(of, registers.into(), moves, load);
        }
        "load" | "store" if number("z") < 3 && (t != PC || number("z") == 2) => {
            Instruction::Access(Access {
                t,
                second: register(of, "e"),
                n,
                offset: by,
                bytes: 1 << number("z"),
                is_signed: is("g"),
                load,
                before: of.field("b") != Some(0),
                writes_back: is("w"),
            })
        }
        "take_flags" => Instruction::TakeFlags,
        "to_core" | "from_core" if t < SP => {
            Instruction::Transfer { core: t, real: real(of, "n"), to_core: name == "to_core" }
        }
        _ => return None,
    })
}

fn branch(name: &str, of: Operation) -> Option<Instruction> {
    let number = |name| of.field(name).unwrap_or(0);
    let (sign, offset) = (number("s"), number("i") << 1);
    let (j, k) = (number("J"), number("K"));
    let (offset, width) = match name {
        "branch_to" => {
            return Some(Instruction::BranchTo { m: register(of, "m") });
        }
        "branch_if_zero" => {
            return Some(Instruction::BranchIfZero {
                n: register(of, "n"),
                offset: offset as i32,
                if_not: number("z") == 1,
            });
        }
        "branch" => (offset, number("w")),
        "branch_near" => (k << 19 | j << 18 | offset, 20),
        _ => ((1 ^ j ^ sign) << 23 | (1 ^ k ^ sign) << 22 | offset, 24),
    };
    Some(Instruction::Branch {
        offset: offset as i32 - (sign << width) as i32,
        condition: of.field("c").map_or(ALWAYS, |c| c as u8),
        link: name == "call",
    })
}

fn of_reals(name: &str, of: Operation) -> Option<Instruction> {
    let (d, n, m) = (real(of, "d"), real(of, "n"), real(of, "m"));
    let number = of.field("i").unwrap_or(0);
    let load = name.starts_with("vld");
    let op = |op| Instruction::Arithmetic { op, d, n, m };
    Some(match name {
        "vadd" => op(Arithmetic::Add),
        "vsub" => op(Arithmetic::Sub),
        "vmul" => op(Arithmetic::Mul),
        "vnmul" => op(Arithmetic::NegatedMul),
        "vdiv" => op(Arithmetic::Div),
        "vneg" => Instruction::Negate { d, m },
        "vsqrt" => Instruction::Root { d, m },
        "vmov" => Instruction::Copy { d, m },
        // For numbers that are no NaN, the form that signals NaNs compares in the same way.
        "vcmp" => Instruction::Compare { d, m: of.field("m").map(|_| m) },
        "vconst" => {
            let exponent = if number & 0x40 != 0 { 0x7c } else { 0x80 } | number >> 4 & 3;
            let bits = (number & 0x80) << 24 | exponent << 23 | (number & 15) << 19;
            Instruction::Real { d, value: f32::from_bits(bits) }
        }
        "vldr" | "vstr" | "vldm" | "vstm" if number > 0 || name.ends_with('r') => {
            let double = of.field("z").unwrap_or(0);
            let count = match name.ends_with('r') {
                true => 1 + double,
                false => number << double,
            };
            // Those that are not there have no bits.
            let is_there = u32::from(d) + count <= 32;
            let registers = is_there.then(|| ((1 << count) - 1) << (16 + d))?;
            return several(of, registers, of.field("w") == Some(1), load);
        }
        _ => return None,
    })
}

/// These registers, upwards from the base or from the offset, or downwards to the base.
fn several(of: Operation, registers: u64, is_moved: bool, load: bool) -> Option<Instruction> {
    let bytes = 4 * registers.count_ones() as i32;
    let distance = 4 * of.field("i").unwrap_or(0) as i32;
    let (offset, moves) = match (of.field("b"), of.field("u")) {
        (Some(1), _) => (-bytes, -bytes),
        (_, Some(0)) => (-distance, 0),
        (_, Some(_)) => (distance, 0),
        _ => (0, bytes),
    };
    Some(Instruction::Several(Several {
        registers,
        n: register(of, "n"),
        offset,
        moves: if is_moved { moves } else { 0 },
        load,
    }))
}
