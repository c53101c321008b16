//! The most stack that a call takes: of each function where its stack pointer is lowest, and of the
//! calls from there.
//!
//! Every instruction is followed with what is known of registers relative to the stack pointer at
//! the start, whatever the data. So loops need no count, but where two ways meet the pointer must
//! be the same.

use std::collections::HashMap;

use crate::cycles::{Declined, is_within};
use crate::decode::{Instruction, Integer as Op, LR, NOWHERE, Operand, SP};
use crate::flow::{Fetched, Flow, Way};
use crate::image::Image;

/// The bytes that a Cortex-M4F pushes when an interrupt comes: 26 words with the registers of the
/// FPU, whose room is taken at once although they are stored lazily, and a word if the stack
/// pointer is no multiple of eight (ARM DDI 0403E, B1.5.6 and B1.5.7).
pub const INTERRUPT_FRAME: u64 = 4 * 26 + 4;

/// The known values of the core registers, relative to the stack pointer at the start.
type Known = [Option<i32>; 15];

/// The most bytes below the stack pointer that a call of the function at an address takes, with all
/// that it calls and the frame of one interrupt; the stack of the interrupt's handler is its own.
///
/// # Errors
/// [`Declined`].
pub fn stack(image: &Image, at: u32) -> Result<u64, Declined> {
    let mut walk = Walk { image, known: HashMap::new(), open: Vec::new() };
    Ok(walk.depth(at & !1)? + INTERRUPT_FRAME)
}

struct Walk<'a> {
    image: &'a Image,
    known: HashMap<u32, u64>,
    /// The functions that are followed, each called by the one before.
    open: Vec<u32>,
}

impl Walk<'_> {
    fn depth(&mut self, start: u32) -> Result<u64, Declined> {
        if let Some(depth) = self.known.get(&start) {
            return Ok(*depth);
        }
        if self.open.contains(&start) {
            return Err(Declined::Recursion { at: start });
        }
        self.open.push(start);
        let range = self.image.function(start).unwrap_or((start, u32::MAX));
        let flow = Flow::of(self.image, start, |to| is_within(range, to), false);
        let mut entry: Known = [None; 15];
        entry[usize::from(SP)] = Some(0);
        let mut states: HashMap<u32, Known> = HashMap::new();
        let mut open = vec![(start, entry)];
        let mut deepest = 0;
        while let Some((at, came)) = open.pop() {
            let state = match states.get(&at) {
                Some(old) if *old == came => continue,
                Some(old) => both(old, &came),
                None => came,
            };
            if states.insert(at, state) == Some(state) {
                continue;
            }
            let one = flow.code.get(&at).ok_or(Declined::IndirectJump { at })?;
            let after = step(one, state);
            let pointer = after[usize::from(SP)].ok_or(Declined::StackPointer { at })?;
            let here = u64::from(pointer.min(0).unsigned_abs());
            deepest = deepest.max(here);
            for way in self.ways(one)? {
                match way {
                    // If its condition fails, the instruction is skipped and changes nothing.
                    Way::Next if one.condition.is_some() && one.insn.may_branch => {
                        open.push((one.next(), state));
                    }
                    Way::Next => open.push((one.next(), after)),
                    Way::To(to) if is_within(range, to) => open.push((to, after)),
                    Way::To(to) => deepest = deepest.max(here + self.depth(to)?),
                    Way::Call(to) => {
                        deepest = deepest.max(here + self.depth(to)?);
                        let mut kept = after;
                        for register in [0, 1, 2, 3, 12, LR] {
                            kept[usize::from(register)] = None;
                        }
                        open.push((one.next(), kept));
                    }
                    Way::Out => {}
                }
            }
        }
        self.open.pop();
        self.known.insert(start, deepest);
        Ok(deepest)
    }

    fn ways(&self, one: &Fetched) -> Result<Vec<Way>, Declined> {
        let ways = one.ways(self.image);
        match one.through() {
            Some((_, true)) => Err(Declined::IndirectCall { at: one.at }),
            // An instruction that traps has no way on.
            _ if ways.is_empty() && one.insn.indirect => Err(Declined::IndirectJump { at: one.at }),
            _ => Ok(ways),
        }
    }
}

/// The knowledge that holds on both ways.
fn both(a: &Known, b: &Known) -> Known {
    std::array::from_fn(|register| a[register].filter(|_| a[register] == b[register]))
}

fn step(one: &Fetched, before: Known) -> Known {
    use Instruction::{Access, Integer, Move, Several};
    let mut after = before;
    let of = |register: u8| before.get(usize::from(register)).copied().flatten();
    let writes = u32::from(one.insn.core_writes);
    let written = (0..15).filter(|register| writes >> register & 1 != 0);
    written.for_each(|register| after[register] = None);
    let (register, value) = match one.decoded {
        Some(Integer { op, d, n, by, .. }) => {
            let by = match (op, by) {
                (Op::Add, Operand::Constant(by)) => Some(by as i32),
                (Op::Sub, Operand::Constant(by)) => Some((by as i32).wrapping_neg()),
                _ => None,
            };
            (d, of(n).and_then(|at| Some(at.wrapping_add(by?))))
        }
        Some(Move { d, m }) => (d, of(m)),
        Some(Several(one)) if one.moves != 0 => (one.n, of(one.n).map(|at| at + one.moves)),
        Some(Access(access)) if access.writes_back => match access.offset {
            Operand::Constant(by) => (access.n, of(access.n).map(|at| at.wrapping_add(by as i32))),
            _ => (access.n, None),
        },
        // A base that moves is not among the results.
        None if one.insn.address >> SP & 1 != 0 && one.insn.size == 4 => (SP, None),
        _ => (NOWHERE, None),
    };
    if let Some(place) = after.get_mut(usize::from(register)) {
        *place = value;
    }
    if one.condition.is_some() && !one.insn.may_branch {
        return both(&before, &after);
    }
    after
}
