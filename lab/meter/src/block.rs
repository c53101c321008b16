//! A translation block: straight-line code that QEMU runs from its start, with
//! its costs summed once, when it is translated.

use crate::insn::{Class, Insn, Marker};
use crate::model::Pipe;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Exact.
    pub instructions: u64,
    /// Modelled.
    pub cycles: u64,
    /// Exact.
    pub flops: u64,
}

impl Tally {
    pub fn plus(self, other: Self) -> Self {
        Self {
            instructions: self.instructions + other.instructions,
            cycles: self.cycles + other.cycles,
            flops: self.flops + other.flops,
        }
    }

    /// The count that has been added since it was `then`.
    pub fn since(self, then: Self) -> Self {
        Self {
            instructions: self.instructions - then.instructions,
            cycles: self.cycles - then.cycles,
            flops: self.flops - then.flops,
        }
    }

    fn charge(&mut self, insn: &Insn, pipe: &mut Pipe) {
        self.instructions += u64::from(!insn.is_marker());
        self.cycles += u64::from(pipe.step(insn));
        self.flops += insn.flops();
    }
}

/// A marker and where in its block it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Number of instructions of the block before it.
    pub index: usize,
    pub marker: Marker,
}

#[derive(Debug)]
pub struct Block {
    start: u32,
    end: u32,
    insns: Box<[Insn]>,
    /// Entry k is what the first k instructions cost when the block is entered with a clear pipe,
    /// and the pipe after them.
    from_clear: Box<[(Tally, Pipe)]>,
    marks: Box<[Mark]>,
    checkpoints: Box<[usize]>,
}

impl Block {
    /// The block of these instructions, the first of which is at address `start`.
    pub fn new(start: u32, insns: Vec<Insn>) -> Self {
        let (mut sum, mut pipe) = (Tally::default(), Pipe::default());
        let mut from_clear = vec![(sum, pipe)];
        for insn in &insns {
            sum.charge(insn, &mut pipe);
            from_clear.push((sum, pipe));
        }
        let mark = |(index, insn): (usize, &Insn)| match insn.class {
            Class::Marker(marker) => Some(Mark { index, marker }),
            _ => None,
        };
        let end = |pc: u32, insn: &Insn| pc.wrapping_add(u32::from(insn.size));
        Self {
            start,
            end: insns.iter().fold(start, end),
            from_clear: from_clear.into(),
            marks: insns.iter().enumerate().filter_map(mark).collect(),
            checkpoints: checkpoints(&insns),
            insns: insns.into(),
        }
    }

    pub fn start(&self) -> u32 {
        self.start
    }

    /// Address after the last instruction.
    pub fn end(&self) -> u32 {
        self.end
    }

    /// The address of the instruction of this index.
    pub fn address(&self, index: usize) -> u32 {
        let sizes = self.insns[..index].iter().map(|insn| u32::from(insn.size));
        self.start.wrapping_add(sizes.sum())
    }

    pub fn insns(&self) -> &[Insn] {
        &self.insns
    }

    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// Indices of the instructions whose start must be reported while the block
    /// runs, so that it is known how far it came if QEMU leaves it early. Under
    /// `-icount` QEMU does so at every access to a device, and executes the access
    /// again in a block of its own which plugins do not see. Empty if that cannot happen.
    pub fn checkpoints(&self) -> &[usize] {
        &self.checkpoints
    }

    /// The number of instructions that were executed once `passed` checkpoints have been reported.
    pub fn executed(&self, passed: usize) -> usize {
        match passed {
            _ if passed >= self.checkpoints.len() => self.insns.len(),
            0 => 0,
            _ => self.checkpoints[passed - 1] + 1,
        }
    }

    /// Cost of the first `count` instructions entered with the pipe in state `entry`, and its state
    /// after them.
    pub fn cost(&self, entry: Pipe, count: usize) -> (Tally, Pipe) {
        let (mut sum, mut pipe) = (Tally::default(), entry);
        for (insn, (before, clear)) in self.insns[..count].iter().zip(&self.from_clear) {
            // As if it had been entered with a clear pipe, mostly after an instruction: so is the
            // rest.
            if pipe == *clear {
                let (all, after) = self.from_clear[count];
                return (sum.plus(all.since(*before)), after);
            }
            sum.charge(insn, &mut pipe);
        }
        (sum, pipe)
    }

    /// Whether its last instruction may go elsewhere than to the next address.
    pub fn may_branch(&self) -> bool {
        self.insns.last().is_some_and(|insn| insn.may_branch)
    }
}

/// Every access to a device but one that comes last, and the last instruction to
/// tell that the others came through.
fn checkpoints(insns: &[Insn]) -> Box<[usize]> {
    let last = insns.len().saturating_sub(1);
    let devices = (0..last).filter(|&index| insns[index].may_access_device());
    let mut found: Vec<usize> = devices.collect();
    if !found.is_empty() {
        found.push(last);
    }
    found.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decode::decode;

    const NOP: u16 = 0xBF00;
    const LDR_R0_R1: u16 = 0x6808;

    fn block(codes: &[u16]) -> Block {
        Block::new(0x100, codes.iter().map(|&code| decode(code, 0)).collect())
    }

    #[test]
    fn block_sums_agree_with_single_steps() {
        const VDIV: [u16; 2] = [0xEE80, 0x0A81];
        const VADD: [u16; 2] = [0xEE30, 0x0A81];
        let insns = |codes: &[[u16; 2]]| -> Vec<Insn> {
            codes.iter().map(|code| decode(code[0], code[1])).collect()
        };
        let [load, nop] = [[LDR_R0_R1, 0], [NOP, 0]];
        let code = insns(&[load, load, nop, VADD, VDIV, nop, VADD, load, VADD]);
        let block = Block::new(0x100, code.clone());
        for entry in [&[][..], &[load], &[nop], &[VADD], &[VDIV], &[VDIV, nop]] {
            let mut pipe = Pipe::default();
            for insn in insns(entry) {
                pipe.step(&insn);
            }
            let (start, mut sum) = (pipe, Tally::default());
            for (count, insn) in (0..).zip(&code) {
                assert_eq!(block.cost(start, count), (sum, pipe), "{entry:?} {count}");
                sum.charge(insn, &mut pipe);
            }
            assert_eq!(block.cost(start, code.len()), (sum, pipe), "{entry:?}");
        }
        assert_eq!(block.end(), 0x11A);
    }

    #[test]
    fn a_pending_load_shortens_the_first_load() {
        let mut pipe = Pipe::default();
        pipe.step(&decode(LDR_R0_R1, 0));
        assert_eq!(block(&[LDR_R0_R1, NOP]).cost(pipe, 2).0.cycles, 2);
        assert_eq!(block(&[NOP, LDR_R0_R1]).cost(pipe, 2).0.cycles, 3);
    }

    #[test]
    fn checkpoints_tell_how_many_instructions_ran() {
        let block = block(&[NOP, LDR_R0_R1, NOP, LDR_R0_R1, NOP]);
        assert_eq!(block.checkpoints(), [1, 3, 4]);
        assert_eq!([0, 1, 2, 3].map(|passed| block.executed(passed)), [0, 2, 4, 5]);
    }

    #[test]
    fn code_without_device_access_needs_no_checkpoints() {
        const LDR_R0_SP: u16 = 0x9801;
        const LDR_R0_LITERAL: u16 = 0x4801;
        for codes in [&[][..], &[NOP], &[LDR_R0_SP, LDR_R0_LITERAL, NOP], &[NOP, LDR_R0_R1]] {
            let block = block(codes);
            assert!(block.checkpoints().is_empty());
            assert_eq!(block.executed(0), codes.len());
        }
    }
}
