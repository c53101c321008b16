//! Instructions of ARMv7E-M with FPv4-SP that straight-line arithmetic uses: ARM DDI 0403E,
//! chapters A5 to A7.
//!
//! What is not here is declined by the walk, with its address: no instruction is guessed at.

mod long;
mod real;
mod short;

pub use long::long;
pub use short::short;

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
    /// n / m
    Div,
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

impl Integer {
    /// Of two words.
    pub fn of(self, n: u32, m: u32) -> u32 {
        match self {
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
    /// Words between registers, a bit each, and n upward; `before` n of a store that decrements.
    /// Whether n moves.
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
    /// d = |m|
    Absolute { d: u8, m: u8 },
    /// d = √m
    Root { d: u8, m: u8 },
    /// Compares d with m, or with zero if there is none.
    Compare { d: u8, m: Option<u8> },
    /// The flags of that comparison become those of the processor.
    TakeFlags,
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
    /// Makes the next instructions conditional: ITSTATE, A7.3.3.
    IfThen { state: u8 },
    /// d = n m + a
    MultiplyAdd { d: u8, n: u8, m: u8, a: u8 },
    /// d = the number of zeros before the first one of m
    LeadingZeros { d: u8, m: u8 },
    /// TBB, TBH: branches forward by twice entry m of the table at n, whose entries are bytes or
    /// halfwords.
    TableBranch { n: u8, m: u8, shift: u8 },
    /// Memory of any size at n + offset.
    Access(Access),
}

/// A load or store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Access {
    /// The register.
    pub t: u8,
    /// The register of the next word, or [`NOWHERE`] if only one word is moved.
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
