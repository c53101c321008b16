//! The most cycles that a function or a measured region can take, by the cycle meter's model: its
//! longest path, with what the pipeline carries from instruction to instruction.
//!
//! The code is executed with numbers where they are known and names where they are not. So loops
//! whose counts do not depend on data are followed turn by turn, as the processor does. At a branch
//! that depends on data both ways are followed to where they meet again, and what they leave behind
//! is joined. Code without a bound is declined, with its address.

use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

use cycle_meter::{Class, Pipe};
use serde::{Deserialize, Serialize};

use crate::decode::Instruction;
use crate::flow::{Fetched, Flow, Way};
use crate::image::Image;
use crate::machine::Machine;
use crate::words::Names;

/// The instructions before the mark whose pipeline the region finds.
const LEAD: usize = 24;
/// The turns of a loop on data after which nothing bounds it, and the branches on data that can be
/// open at once.
const MOST_TURNS: usize = 64;
const MOST_OPEN: usize = 300;
/// More instructions than are followed in one region.
const MOST: u64 = 2_000_000;

/// Why there is no bound, and the address of what has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[serde(tag = "reason", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Declined {
    /// The number of its turns depends on data.
    #[error("the loop at {at:#x} has no bound in the code")]
    Loop {
        /// The address of the branch.
        at: u32,
    },
    /// A jump through a register whose targets are not known.
    #[error("the jump at {at:#x} goes where a register says")]
    IndirectJump {
        /// The address of the jump.
        at: u32,
    },
    /// A call through a register whose value is not known.
    #[error("the call at {at:#x} goes where a register says")]
    IndirectCall {
        /// The address of the call.
        at: u32,
    },
    /// The model has no such instruction, or it traps.
    #[error("the instruction at {at:#x} is not in the model")]
    UnknownInstruction {
        /// The address of the instruction.
        at: u32,
    },
    /// A function that calls itself.
    #[error("the function at {at:#x} calls itself")]
    Recursion {
        /// The address of the function.
        at: u32,
    },
    /// The code does not determine the stack pointer at an instruction.
    #[error("the stack pointer at {at:#x} is not known")]
    StackPointer {
        /// The address of the instruction.
        at: u32,
    },
    /// More instructions than are followed.
    #[error("the path is still not at its end at {at:#x}")]
    TooLong {
        /// The address at which the analysis was given up.
        at: u32,
    },
}

type Result<T> = std::result::Result<T, Declined>;

/// The most cycles of a measured region, and the branches on data in it, of which both ways were
/// followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// Its cycles, or why they have no bound.
    pub cycles: Result<u64>,
    /// The addresses of the branches.
    pub branches: Vec<u32>,
}

/// The bound of the region that opens with the mark at an address; what it calls itself through a
/// register is the function at another. Nothing if no function holds the mark.
pub fn region(image: &Image, at: u32, callee: Option<u32>) -> Option<Bound> {
    let function = image.function(at)?;
    let whole = Flow::of(image, function.0, |to| is_within(function, to), false);
    let (row, pipes) = before(image, &whole, at)?;
    let inside = Rc::new(Flow::of(image, at, |to| is_within(function, to), true));
    let mut run = Run::new(image, function);
    run.callee = callee;
    run.flows.insert(at, inside);
    run.calls.push(at);
    let mut start = Machine::new(&mut run.names, pipes);
    row.iter().for_each(|one| run.execute(&mut start, one, one.condition.map(|_| None)));
    let cycles = run.run(start, at, at, None).map(|end| end.cycles());
    Some(Bound { cycles, branches: run.branches.into_iter().collect() })
}

/// The same of a call of the function at an address, from its first instruction to its return, with
/// nothing pending in the pipeline.
pub fn function(image: &Image, at: u32) -> Bound {
    let at = at & !1;
    let range = image.function(at).unwrap_or((at, u32::MAX));
    let mut run = Run::new(image, range);
    let pipes = vec![(Pipe::default(), 0)];
    let start = Machine::new(&mut run.names, pipes);
    let cycles = run.call(start, at).map(|end| end.cycles());
    Bound { cycles, branches: run.branches.into_iter().collect() }
}

pub(crate) fn is_within((start, size): (u32, u32), at: u32) -> bool {
    (start..start.saturating_add(size)).contains(&at)
}

/// Instructions, and states of the pipeline with the cycles until there.
type Before<'a> = (Vec<&'a Fetched>, Vec<(Pipe, u64)>);

/// The instructions that are executed in a row right before a mark whatever was executed before
/// them, and what the pipeline can hold at the mark: a branch to it leaves nothing pending.
fn before<'a>(image: &Image, whole: &'a Flow, mark: u32) -> Option<Before<'a>> {
    whole.code.get(&mark)?;
    let ways = whole.code.values().flat_map(|one| one.ways(image));
    let targets: BTreeSet<u32> = ways
        .filter_map(|way| match way {
            Way::To(to) => Some(to),
            _ => None,
        })
        .collect();
    let (mut row, mut expected) = (Vec::new(), mark);
    let earlier = whole.code.range(..mark).rev().map(|(_, one)| one);
    for one in earlier.take(LEAD) {
        if one.next() != expected || one.ways(image) != [Way::Next] {
            break;
        }
        expected = one.at;
        row.push(one);
    }
    row.reverse();
    let mut pipe = Pipe::default();
    row.iter().for_each(|one| {
        pipe.step(&one.insn);
    });
    let mut pipes = vec![(pipe, 0)];
    if targets.contains(&mark) && !pipe.is_clear() {
        pipes.push((Pipe::default(), 0));
    }
    // A branch skips what stands before its target.
    let last = targets.range(..=mark).next_back().copied().unwrap_or(0);
    row.retain(|one| one.at >= last);
    Some((row, pipes))
}

/// The destination of a way: an address at which it goes on, or the outside.
enum Led {
    On(Machine, u32),
    Out(Machine),
}

struct Run<'a> {
    image: &'a Image,
    names: Names,
    flows: HashMap<u32, Rc<Flow>>,
    /// The function that the region is in.
    around: (u32, u32),
    /// The functions that are executed, each called by the one before.
    calls: Vec<u32>,
    /// The number of times that both ways of a branch are being followed, by its address and the
    /// depth of calls.
    turns: HashMap<(u32, usize), usize>,
    /// The branches whose ways are being followed.
    open: usize,
    executed: u64,
    branches: BTreeSet<u32>,
    /// The function that the region calls through a register.
    callee: Option<u32>,
}

impl<'a> Run<'a> {
    fn new(image: &'a Image, around: (u32, u32)) -> Self {
        Self {
            image,
            names: Names::new(),
            flows: HashMap::new(),
            around,
            calls: Vec::new(),
            turns: HashMap::new(),
            open: 0,
            executed: 0,
            branches: BTreeSet::new(),
            callee: None,
        }
    }

    /// Calls the function at an address.
    fn call(&mut self, mut machine: Machine, at: u32) -> Result<Machine> {
        if self.calls.contains(&at) {
            return Err(Declined::Recursion { at });
        }
        let is_of = |parts: &[&str]| {
            self.image.names(at).any(|name| parts.iter().any(|part| name.contains(part)))
        };
        if is_of(&["memcpy", "memmove"]) {
            machine.align(&mut self.names, &[0, 1]);
        } else if is_of(&["memset", "memclr"]) {
            machine.align(&mut self.names, &[0]);
        }
        let range = self.range(at);
        let flow = || Rc::new(Flow::of(self.image, at, |to| is_within(range, to), false));
        self.flows.entry(at).or_insert_with(flow);
        self.calls.push(at);
        let end = self.run(machine, at, at, None);
        self.calls.pop();
        end
    }

    fn range(&self, at: u32) -> (u32, u32) {
        self.image.function(at).unwrap_or(self.around)
    }

    /// From an address of a flow to where it stops, or ends.
    fn run(
        &mut self,
        mut machine: Machine,
        flow: u32,
        mut at: u32,
        stop: Option<u32>,
    ) -> Result<Machine> {
        let code = self.flows[&flow].clone();
        while Some(at) != stop {
            let one = code.code.get(&at).ok_or(Declined::IndirectJump { at })?;
            self.executed += 1;
            if self.executed > MOST {
                return Err(Declined::TooLong { at });
            }
            if one.closes() && self.calls.len() == 1 {
                break;
            }
            if one.insn.class == Class::Unknown {
                return Err(Declined::UnknownInstruction { at });
            }
            machine.charge(&one.insn);
            let under = one.condition.map(|condition| machine.holds(condition));
            if !one.insn.may_branch {
                self.execute(&mut machine, one, under);
                at = one.next();
                continue;
            }
            let ways = self.ways(&machine, one, under)?;
            if let [way] = ways[..] {
                match self.take(machine, one, way)? {
                    Led::Out(end) => return Ok(end),
                    Led::On(on, to) => (machine, at) = (on, to),
                }
                continue;
            }
            let meeting = code.meeting(at);
            machine = self.fork(&machine, (flow, one), &ways, meeting)?;
            match meeting {
                Some(meeting) => at = meeting,
                None => break,
            }
        }
        Ok(machine)
    }

    fn execute(&mut self, machine: &mut Machine, one: &Fetched, under: Option<Option<bool>>) {
        if under != Some(Some(false)) {
            let world = (&mut self.names, self.image);
            let under = under.map(|holds| holds.is_some());
            machine.execute(world, one.at, (&one.insn, one.decoded), under);
        }
    }

    /// Follows all ways of a branch to where they meet, and joins what they leave.
    fn fork(
        &mut self,
        machine: &Machine,
        (flow, one): (u32, &Fetched),
        ways: &[Way],
        meeting: Option<u32>,
    ) -> Result<Machine> {
        self.branches.insert(one.at);
        let place = (one.at, self.calls.len());
        let turns = self.turns.entry(place).or_default();
        *turns += 1;
        self.open += 1;
        if *turns > MOST_TURNS || self.open > MOST_OPEN {
            return Err(Declined::Loop { at: one.at });
        }
        let mut joined: Option<Machine> = None;
        for way in ways {
            let end = match self.take(machine.clone(), one, *way)? {
                Led::Out(end) => end,
                Led::On(on, to) => self.run(on, flow, to, meeting)?,
            };
            match &mut joined {
                Some(joined) => joined.join(&mut self.names, &end),
                None => joined = Some(end),
            }
        }
        self.turns.entry(place).and_modify(|turns| *turns -= 1);
        self.open -= 1;
        joined.ok_or(Declined::IndirectJump { at: one.at })
    }

    /// The ways that are open to a branch with what is known.
    fn ways(
        &self,
        machine: &Machine,
        one: &Fetched,
        under: Option<Option<bool>>,
    ) -> Result<Vec<Way>> {
        if under == Some(Some(false)) {
            return Ok(vec![Way::Next]);
        }
        let mut ways = one.ways(self.image);
        let known = match one.decoded {
            Some(Instruction::Branch { condition, link: false, .. }) => machine.holds(condition),
            Some(Instruction::BranchIfZero { n, if_not, .. }) => {
                machine.is_zero(n).map(|is_zero| is_zero != if_not)
            }
            _ => None,
        };
        if let (Some(taken), None) = (known, under) {
            ways.retain(|way| (*way != Way::Next) == taken);
        }
        if let Some((register, calls)) = one.through() {
            let given = self.callee.filter(|_| self.calls.len() == 1);
            let to = machine.core(register).number().or(given).map(|to| to & !1);
            let way = match (to, calls) {
                (Some(to), true) => Some(Way::Call(to)),
                (Some(to), false) => Some(Way::To(to)),
                (None, true) => return Err(Declined::IndirectCall { at: one.at }),
                (None, false) => None,
            };
            if let Some(way) = way {
                ways.retain(|way| *way == Way::Next);
                ways.push(way);
            }
        } else if one.insn.class == Class::TableBranch {
            let index = machine.core((one.code[1] & 15) as u8).number();
            let known = index.and_then(|index| ways.get(index as usize).copied());
            ways = known.map_or(ways, |way| vec![way]);
        }
        match (under, ways.is_empty()) {
            (_, true) if one.insn.indirect => Err(Declined::IndirectJump { at: one.at }),
            (_, true) => Err(Declined::UnknownInstruction { at: one.at }),
            (Some(Some(true)), _) => Ok(ways.into_iter().filter(|way| *way != Way::Next).collect()),
            _ => Ok(ways),
        }
    }

    /// Whether what is followed is a function, and not a region of one, which ends at its mark.
    fn returns(&self) -> bool {
        self.calls.len() > 1 || self.around.0 == self.calls[0]
    }

    fn take(&mut self, mut machine: Machine, one: &Fetched, way: Way) -> Result<Led> {
        match way {
            Way::Next => Ok(Led::On(machine, one.next())),
            Way::To(to) => {
                // The meter takes a branch to the next address for one that is not taken.
                if to != one.next() {
                    machine.refill();
                }
                match is_within(self.range(one.at), to) {
                    true => Ok(Led::On(machine, to)),
                    false if self.returns() => Ok(Led::Out(self.call(machine, to)?)),
                    false => Err(Declined::IndirectJump { at: one.at }),
                }
            }
            Way::Call(to) => {
                machine.refill();
                machine.link(&mut self.names);
                Ok(Led::On(self.call(machine, to)?, one.next()))
            }
            Way::Out if self.returns() => {
                self.execute(&mut machine, one, None);
                machine.refill();
                Ok(Led::Out(machine))
            }
            Way::Out => Err(Declined::IndirectJump { at: one.at }),
        }
    }
}
