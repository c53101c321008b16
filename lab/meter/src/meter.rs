//! Follows the execution from block to block and cuts it into samples.

use crate::block::{Block, Mark, Tally};
use crate::fetch::{FLASHES, Fetch, in_flash};
use crate::insn::Marker;
use crate::model::Pipe;
use crate::samples::Sample;

/// The running count and the regions that are open.
///
/// A block is charged when the next one starts: only then is it known whether its
/// last instruction branched.
#[derive(Debug)]
pub struct Meter<'b> {
    /// Everything up to the start of the current block.
    total: Tally,
    /// The pipe as the current block found it.
    entry: Pipe,
    current: Option<&'b Block>,
    /// The count and the waits at the marks that opened them, and their addresses.
    open: [Option<(Tally, [u64; 2], u32)>; 8],
    /// The memories that wait. They stand still while no region is open, so that their caches are
    /// as warm as those of a firmware that does nothing else.
    fetches: [Fetch; 2],
    /// The instructions of the current block that they have seen, or were to leave out.
    fetched: usize,
    /// What it loaded from flash, by the instruction.
    loads: Vec<(usize, u32)>,
    samples: Vec<Sample>,
    unmatched: u64,
}

impl<'b> Meter<'b> {
    pub fn new() -> Self {
        Self {
            total: Tally::default(),
            entry: Pipe::default(),
            current: None,
            open: [None; 8],
            fetches: FLASHES.map(Fetch::new),
            fetched: 0,
            loads: Vec::new(),
            samples: Vec::new(),
            unmatched: 0,
        }
    }

    /// A block starts; the one before it passed this many of its checkpoints.
    pub fn enter(&mut self, block: &'b Block, passed: usize) {
        if let Some(last) = self.current.replace(block) {
            self.settle(last, passed, block.start());
        }
    }

    /// An instruction of the current block loads from an address.
    pub fn load(&mut self, index: usize, address: u32) {
        if in_flash(address) && self.open.iter().any(Option::is_some) {
            self.loads.push((index, address));
        }
    }

    /// A marker of the current block is executed.
    pub fn mark(&mut self, mark: &Mark) {
        let Some(block) = self.current else { return };
        let now = self.total.plus(block.cost(self.entry, mark.index).0);
        self.fetch(block, mark.index);
        let waits = [0, 1].map(|which| self.fetches[which].waits());
        let Marker { region, opens } = mark.marker;
        let slot = &mut self.open[usize::from(region)];
        if opens {
            self.unmatched +=
                u64::from(slot.replace((now, waits, block.address(mark.index))).is_some());
        } else if let Some((then, waited, at)) = slot.take() {
            let cost = now.since(then);
            let sample = Sample::of(region, [cost.instructions, cost.cycles, cost.flops]);
            let waits = [0, 1].map(|which| waits[which] - waited[which]);
            self.samples.push(Sample { waits, at, ..sample });
        } else {
            self.unmatched += 1;
        }
    }

    /// Closed regions, in the order of their closing.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Markers that opened an open region or closed a closed one.
    pub fn unmatched(&self) -> u64 {
        self.unmatched
    }

    /// Lets the memories that wait see the block's instructions up to this one.
    fn fetch(&mut self, block: &Block, end: usize) {
        let begin = std::mem::replace(&mut self.fetched, end);
        if self.open.iter().all(Option::is_none) {
            self.fetches.iter_mut().for_each(Fetch::interrupt);
            return;
        }
        let mut pipe = block.cost(self.entry, begin).1;
        let mut address = block.address(begin);
        for (index, insn) in (begin..).zip(block.insns().get(begin..end).unwrap_or_default()) {
            let first = self.loads.partition_point(|(by, _)| *by < index);
            let loads = self.loads[first..].iter().take_while(|(by, _)| *by == index);
            let loads = loads.map(|(_, from)| *from);
            // A mark costs nothing, but a region shall not wait for its mark's word.
            let cycles = u64::from(pipe.step(insn)) + u64::from(insn.is_marker());
            for fetch in &mut self.fetches {
                fetch.step(address, insn, loads.clone(), cycles);
            }
            address = address.wrapping_add(u32::from(insn.size));
        }
    }

    fn settle(&mut self, last: &Block, passed: usize, next: u32) {
        let executed = last.executed(passed);
        self.fetch(last, executed);
        self.fetched = 0;
        self.loads.clear();
        let (cost, pipe) = last.cost(self.entry, executed);
        self.total = self.total.plus(cost);
        self.entry = pipe;
        // A block that was left early goes on elsewhere; an interrupt is no branch.
        if executed == last.insns().len() && next != last.end() {
            if last.may_branch() {
                let refill = u64::from(self.entry.refill());
                self.total.cycles += refill;
                self.fetches.iter_mut().for_each(|fetch| fetch.branch(refill));
            } else {
                self.entry = Pipe::default();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decode::{decode, size};

    const NOP: u16 = 0xBF00;
    const BACK: u16 = 0xD1FC; // bne
    const LDR_R0_R1: u16 = 0x6808;

    fn dbg(option: u16) -> [u16; 2] {
        [0xF3AF, 0x80F0 | option]
    }

    fn block(start: u32, codes: &[u16]) -> Block {
        let mut insns = Vec::new();
        let mut rest = codes;
        while let [first, tail @ ..] = rest {
            insns.push(decode(*first, tail.first().copied().unwrap_or(0)));
            rest = &rest[usize::from(size(*first) / 2)..];
        }
        Block::new(start, insns)
    }

    /// Runs blocks to their ends, markers included; closes region 0 at the end.
    fn run(blocks: &[&Block]) -> Vec<Sample> {
        let open = block(0, &dbg(0));
        let close = block(blocks.last().map_or(4, |last| last.end()), &dbg(1));
        let mut meter = Meter::new();
        for block in [&[&open][..], blocks, &[&close]].concat() {
            meter.enter(block, usize::MAX);
            block.marks().iter().for_each(|mark| meter.mark(mark));
        }
        assert_eq!(meter.unmatched(), 0);
        meter.samples().iter().map(|one| one.anywhere()).collect()
    }

    fn sample(region: u8, instructions: u64, cycles: u64) -> Sample {
        Sample::of(region, [instructions, cycles, 0])
    }

    #[test]
    fn an_executed_branch_is_recognised_by_its_successor() {
        let body = block(4, &[NOP, BACK]);
        let tail = block(8, &[NOP]);
        assert_eq!(run(&[&body, &tail]), [sample(0, 3, 3)]);
        assert_eq!(run(&[&body, &body, &body, &tail]), [sample(0, 7, 11)]);
    }

    #[test]
    fn flops_are_counted_as_often_as_they_are_executed() {
        let body = block(4, &[0xEE30, 0x0A81, 0xEEA0, 0x0A81, BACK]); // vadd, vfma
        let tail = block(14, &[NOP]);
        assert_eq!(run(&[&body, &body, &tail])[0].flops, 6);
    }

    #[test]
    fn an_interrupt_is_no_branch() {
        assert_eq!(run(&[&block(4, &[NOP]), &block(0x40, &[NOP])]), [sample(0, 2, 2)]);
    }

    #[test]
    fn an_interrupt_empties_the_pipe() {
        // A load that follows a load overlaps with it, unless something else came between.
        let [loads, after, elsewhere] = [4, 6, 0x40].map(|start| block(start, &[LDR_R0_R1]));
        let straight = run(&[&loads, &after]);
        let interrupted = run(&[&loads, &elsewhere]);
        assert_eq!(straight, [sample(0, 2, 3)]);
        assert_eq!(interrupted, [sample(0, 2, 4)]);
    }

    #[test]
    fn where_a_block_is_cut_does_not_matter() {
        let codes = [LDR_R0_R1, LDR_R0_R1, 0x6801, LDR_R0_R1, NOP];
        let whole = run(&[&block(4, &codes)]);
        for cut in 1..codes.len() {
            let (head, tail) = codes.split_at(cut);
            let tail = block(4 + 2 * cut as u32, tail);
            assert_eq!(run(&[&block(4, head), &tail]), whole, "{cut}");
        }
    }

    #[test]
    fn inner_regions_leave_the_outer_one_alone() {
        let marked = [&[LDR_R0_R1][..], &dbg(2), &[LDR_R0_R1], &dbg(3), &[NOP]].concat();
        let plain = run(&[&block(4, &[LDR_R0_R1, LDR_R0_R1, NOP])]);
        assert_eq!(run(&[&block(4, &marked)]), [sample(1, 1, 1), plain[0]]);
    }

    #[test]
    fn a_block_left_at_a_device_is_charged_once() {
        let open = block(0, &dbg(0));
        let whole = block(4, &[NOP, LDR_R0_R1, NOP, NOP]);
        let rest = block(8, &[NOP, NOP]);
        let close = block(12, &dbg(1));
        let mut meter = Meter::new();
        for (block, passed) in [(&open, 0), (&whole, 0), (&rest, 1), (&close, 0)] {
            meter.enter(block, passed);
            block.marks().iter().for_each(|mark| meter.mark(mark));
        }
        assert_eq!(meter.samples()[0].anywhere(), sample(0, 4, 5));
    }

    #[test]
    fn memory_that_waits_is_charged_in_regions_only_and_stays_warm() {
        let mark = |start, option| block(start, &dbg(option));
        let (open, body, close) = (mark(0, 0), block(4, &[NOP; 40]), mark(84, 1));
        let elsewhere = block(0x1000, &[NOP; 4000]);
        let mut meter = Meter::new();
        for _ in 0..2 {
            for block in [&elsewhere, &open, &body, &close] {
                meter.enter(block, usize::MAX);
                meter.load(39, 0x2000);
                block.marks().iter().for_each(|mark| meter.mark(mark));
            }
        }
        // By hand: lines of eight bytes take four cycles for the first, with the mark and two
        // instructions, two for the next, and one for each of nine with four instructions. Lines of
        // sixteen take five for the first; the others are read while eight instructions execute.
        // The last instruction loads. The queue has asked for a word of the line behind, so that the
        // first flash reads that one and the next, eight cycles more, before what is loaded.
        let cycles: Vec<_> = meter.samples().iter().map(Sample::all_cycles).collect();
        assert_eq!(cycles, [[40, 40 + 4 + 2 + 9 + 8 + 4, 40 + 5 + 5], [40; 3]]);
    }

    #[test]
    fn unmatched_markers_are_counted() {
        let block = block(0, &[dbg(0), dbg(0), dbg(1), dbg(1)].concat());
        let mut meter = Meter::new();
        meter.enter(&block, 0);
        block.marks().iter().for_each(|mark| meter.mark(mark));
        assert_eq!((meter.samples().len(), meter.unmatched()), (1, 2));
    }
}
