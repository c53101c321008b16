//! The timing model: cycles of a sequence of instructions on a Cortex-M4F whose
//! memory never waits. Its sources and its limits stand in the crate's documentation.

use crate::insn::{Class, Insn};

/// Cycles to refill the pipeline after an executed branch (the manual says 1 to 3).
pub const REFILL: u32 = 2;

/// Cycles that `VDIV` and `VSQRT` go on for after their first one.
pub const DIVIDER_BUSY: u32 = 13;

/// Cycles of `SDIV` and `UDIV` (the manual says 2 to 12): a figure does not depend on the operands
/// that a test happened to use.
const INTEGER_DIVIDE: u32 = 12;

/// The state that an instruction leaves behind and that can delay later ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pipe {
    /// Core registers written by the previous instruction.
    core_results: u16,
    /// Registers written by the previous instruction, if it was floating-point arithmetic.
    float_results: u32,
    /// Whether the previous instruction was a single load.
    after_load: bool,
    /// Cycles until the floating-point divider is done.
    divider: u32,
}

impl Pipe {
    /// Whether nothing is pending: the next instructions cost what they cost alone.
    pub fn is_clear(&self) -> bool {
        *self == Self::default()
    }

    /// Executes one instruction and returns its cycles, stalls included. A branch
    /// is charged as not taken, a predicated instruction as executed.
    pub fn step(&mut self, insn: &Insn) -> u32 {
        if insn.is_marker() {
            return 0;
        }
        let interlock = insn.address & self.core_results != 0;
        let mut stall = u32::from(interlock);
        if insn.float {
            stall += self.divider + u32::from(insn.float_reads & self.float_results != 0);
            self.divider = 0;
        }
        let cycles = stall + self.issue(insn, interlock);
        use Class::{FloatArithmetic, FloatConversion, FloatDivide, FloatMultiplyAdd};
        let is_arithmetic = match insn.class {
            FloatArithmetic | FloatConversion | FloatMultiplyAdd | FloatDivide => u32::MAX,
            _ => 0,
        };
        *self = Self {
            core_results: insn.core_writes,
            float_results: insn.float_writes & is_arithmetic,
            after_load: insn.class == Class::Load,
            divider: match insn.class {
                Class::FloatDivide => DIVIDER_BUSY,
                _ => self.divider.saturating_sub(cycles),
            },
        };
        cycles
    }

    /// Refills the pipeline after an executed branch and returns the cycles it takes.
    pub fn refill(&mut self) -> u32 {
        *self = Self { divider: self.divider.saturating_sub(REFILL), ..Self::default() };
        REFILL
    }

    fn issue(&self, insn: &Insn, interlock: bool) -> u32 {
        match insn.class {
            Class::Marker(_) => 0,
            Class::Load if self.after_load && !interlock => 1,
            Class::Load | Class::System | Class::TableBranch | Class::FloatMovePair => 2,
            Class::InstructionBarrier => 1 + REFILL,
            Class::FloatMultiplyAdd => 3,
            Class::IntegerDivide => INTEGER_DIVIDE,
            Class::Words(n) => 1 + u32::from(n),
            _ => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::insn::Marker;

    const INTEGER: Insn = Insn::new(Class::Integer, 2);

    fn float(class: Class, reads: u32, writes: u32) -> Insn {
        Insn::new(class, 4).on_floats(reads, writes)
    }

    fn load(address: u16, data: u16) -> Insn {
        Insn::new(Class::Load, 2).addressed_by(address).writing(data)
    }

    fn cycles(insns: &[Insn]) -> u32 {
        let mut pipe = Pipe::default();
        insns.iter().map(|insn| pipe.step(insn)).sum()
    }

    #[test]
    fn each_choice_where_the_manual_leaves_room_is_made() {
        assert_eq!(Pipe::default().refill(), 2);
        assert_eq!(cycles(&[Insn::new(Class::IfThen, 2)]), 1);
        assert_eq!(cycles(&[Insn::new(Class::IntegerDivide, 4)]), 12);
        assert_eq!(cycles(&[load(2, 1), load(1, 4)]), 5);
        assert_eq!(cycles(&[load(2, 1), load(2, 4)]), 3);
        // The addend of a multiply-accumulate is the register that it writes.
        let add = float(Class::FloatArithmetic, 0b110, 0b1);
        assert_eq!(cycles(&[add, float(Class::FloatMultiplyAdd, 0b11001, 0b1)]), 5);
        let (loads, stores) = (float(Class::Load, 0, 0b1), float(Class::Store, 0b1, 0));
        assert_eq!(cycles(&[loads, loads, stores]), 4);
    }

    #[test]
    fn a_result_of_arithmetic_may_not_be_used_at_once() {
        let add = float(Class::FloatArithmetic, 0b110, 0b1);
        let uses = float(Class::FloatArithmetic, 0b1, 0b1000);
        assert_eq!(cycles(&[add, add]), 2);
        assert_eq!(cycles(&[add, uses]), 3);
        assert_eq!(cycles(&[add, INTEGER, uses]), 3);
        assert_eq!(cycles(&[add, float(Class::Store, 0b1, 0)]), 3);
        assert_eq!(cycles(&[add, float(Class::FloatMove, 0b1, 0)]), 3);
        assert_eq!(cycles(&[float(Class::FloatMove, 0, 0b1), add, add]), 3);
    }

    #[test]
    fn barriers_and_multiply_add_cost_what_the_manual_says() {
        let barrier = Insn::new(Class::InstructionBarrier, 4);
        assert_eq!(cycles(&[barrier]), 1 + REFILL);
        let mac = float(Class::FloatMultiplyAdd, 0b111, 0b1);
        assert_eq!(cycles(&[mac]), 3);
        assert_eq!(cycles(&[mac, mac]), 7);
    }

    #[test]
    fn integer_code_hides_a_division() {
        let divide = float(Class::FloatDivide, 0b110, 0b1);
        let other = float(Class::FloatArithmetic, 0b110, 0b1000);
        assert_eq!(cycles(&[divide]), 1);
        assert_eq!(cycles(&[divide, other]), 15);
        for hidden in 1..=13 {
            let mut insns = vec![divide];
            insns.resize(1 + hidden, INTEGER);
            insns.push(other);
            assert_eq!(cycles(&insns), 15, "{hidden}");
        }
        assert_eq!(cycles(&[divide, divide, other]), 29);
    }

    #[test]
    fn a_refill_lets_the_divider_run() {
        let mut pipe = Pipe::default();
        pipe.step(&float(Class::FloatDivide, 0b110, 0b1));
        assert_eq!(pipe.refill(), REFILL);
        let waits = pipe.step(&float(Class::FloatMove, 0, 0));
        assert_eq!(waits, DIVIDER_BUSY - REFILL + 1);
    }

    #[test]
    fn loads_pipeline_unless_an_address_depends() {
        assert_eq!(cycles(&[load(2, 1)]), 2);
        assert_eq!(cycles(&[load(2, 1), load(2, 4), load(2, 8)]), 4);
        assert_eq!(cycles(&[load(2, 1), INTEGER, load(2, 4)]), 5);
        assert_eq!(cycles(&[load(2, 1), load(1, 4)]), 5);
    }

    #[test]
    fn an_address_just_computed_stalls_loads_and_stores() {
        let add = INTEGER.writing(1);
        let by = |class| Insn::new(class, 2).addressed_by(1);
        assert_eq!(cycles(&[add, load(1, 2)]), 4);
        assert_eq!(cycles(&[add, INTEGER, load(1, 2)]), 4);
        assert_eq!(cycles(&[add, by(Class::Store)]), 3);
        assert_eq!(cycles(&[add, by(Class::Words(4))]), 7);
    }

    #[test]
    fn a_marker_costs_no_cycles() {
        let (region, opens) = (0, true);
        let marker = Insn::new(Class::Marker(Marker { region, opens }), 4);
        let sequence = [INTEGER.writing(1), load(1, 2), load(4, 8), load(8, 1)];
        let marked = sequence.map(|insn| [marker, insn, marker]);
        assert_eq!(cycles(marked.as_flattened()), cycles(&sequence));
    }
}
