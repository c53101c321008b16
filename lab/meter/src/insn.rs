//! The properties of an instruction that the timing model needs.

/// One end of a measured region: `dbg #2k` opens region k, `dbg #2k+1` closes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Marker {
    /// 0 to 7.
    pub region: u8,
    /// Whether it opens the region (else it closes it).
    pub opens: bool,
}

/// Instructions of one class cost the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// One end of a region: neither counted nor charged.
    Marker(Marker),
    /// Data processing, multiplication, branches, hints, DMB, DSB.
    Integer,
    /// `IT`.
    IfThen,
    /// `SDIV`, `UDIV`.
    IntegerDivide,
    /// `MRS`, `MSR`, `CPS`.
    System,
    /// `ISB`.
    InstructionBarrier,
    /// One word or less from memory, into a core or a floating-point register.
    Load,
    /// One word or less to memory.
    Store,
    /// Several words (`LDM`, `STM`, `LDRD`, `VLDM`, `VLDR.64` …) in one instruction.
    Words(u8),
    /// `TBB`, `TBH`.
    TableBranch,
    /// Floating-point moves, `VABS`, `VNEG`, `VMRS`, `VMSR`: the result may be used at once.
    FloatMove,
    /// Two words between core and floating-point registers.
    FloatMovePair,
    /// Floating-point sum, difference, product.
    FloatArithmetic,
    /// Floating-point comparison, conversion: timed like arithmetic, but no flop.
    FloatConversion,
    /// Floating-point multiply-accumulate, fused or not.
    FloatMultiplyAdd,
    /// `VDIV`, `VSQRT`.
    FloatDivide,
    /// No instruction of a Cortex-M4F: FPv5 (VSEL, VRINT, VMINNM …), f64 arithmetic, what ARMv8-M
    /// and v8.1-M added (CSEL …, low-overhead loops, load-acquire and store-release), or none at
    /// all.
    Unknown,
}

/// A decoded instruction. Register sets are bit masks: bit n for `Rn` or `Sn`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Insn {
    pub class: Class,
    /// 2 or 4 bytes.
    pub size: u8,
    /// Core registers that form a memory address (never the PC).
    pub address: u16,
    /// Core registers that receive a result. A base register that is merely
    /// updated is not listed: the address unit made the value and keeps it.
    pub core_writes: u16,
    /// Floating-point registers read.
    pub float_reads: u32,
    /// Floating-point registers written.
    pub float_writes: u32,
    /// Whether it is executed by the floating-point unit (loads and stores of its registers too).
    pub float: bool,
    /// Whether the instruction after it may be elsewhere.
    pub may_branch: bool,
    /// Whether it calls or jumps to an address that it takes from a register or from memory, other
    /// than to return.
    pub indirect: bool,
}

const SP: u16 = 1 << 13;
const PC: u16 = 1 << 15;

impl Insn {
    /// An instruction of that class and size which touches no register.
    pub(crate) const fn new(class: Class, size: u8) -> Self {
        Self {
            class,
            size,
            address: 0,
            core_writes: 0,
            float_reads: 0,
            float_writes: 0,
            float: false,
            may_branch: false,
            indirect: false,
        }
    }

    /// Adds core results; one that goes to the PC makes it an indirect branch.
    pub(crate) const fn writing(mut self, registers: u16) -> Self {
        self.core_writes |= registers & !PC;
        self.may_branch |= registers & PC != 0;
        self.indirect |= registers & PC != 0;
        self
    }

    /// Makes it a return if `it_is`: an indirect branch that goes back to the caller.
    pub(crate) const fn returning_if(mut self, it_is: bool) -> Self {
        self.indirect &= !it_is;
        self
    }

    pub(crate) const fn addressed_by(mut self, registers: u16) -> Self {
        self.address |= registers & !PC;
        self
    }

    pub(crate) const fn branching(mut self) -> Self {
        self.may_branch = true;
        self
    }

    /// Makes it a floating-point instruction with these operands.
    pub(crate) const fn on_floats(mut self, reads: u32, writes: u32) -> Self {
        self.float = true;
        self.float_reads = reads;
        self.float_writes = writes;
        self
    }

    /// Whether it may access a device. Literals and the stack are memory.
    pub fn may_access_device(&self) -> bool {
        self.address & !SP != 0
    }

    /// Whether it may load from flash: the stack is elsewhere.
    pub fn may_load_flash(&self) -> bool {
        let loads = matches!(self.class, Class::Load | Class::Words(_) | Class::TableBranch);
        loads && self.address != SP
    }

    /// Floating-point operations that it does: a multiply-accumulate is two; moves, signs,
    /// comparisons and conversions are none.
    pub fn flops(&self) -> u64 {
        match self.class {
            Class::FloatArithmetic | Class::FloatDivide => 1,
            Class::FloatMultiplyAdd => 2,
            _ => 0,
        }
    }

    /// Whether it is a region's end rather than an instruction of the program.
    pub fn is_marker(&self) -> bool {
        matches!(self.class, Class::Marker(_))
    }
}
