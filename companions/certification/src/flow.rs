//! The successors of the instructions of a function, and the places where the ways of a branch meet
//! again.

use std::collections::{BTreeMap, HashMap};

use cycle_meter::{Class, Insn, Marker};

use crate::decode::{ALWAYS, Condition, Instruction, LR, PC, SP, decode};
use crate::image::Image;

/// The mark that closes the measured region.
const CLOSES: Class = Class::Marker(Marker { region: 0, opens: false });

/// An instruction: what it costs, and what it does if that is known.
#[derive(Clone, Debug)]
pub struct Fetched {
    pub at: u32,
    pub code: [u16; 2],
    pub insn: Insn,
    pub decoded: Option<Instruction>,
    /// Its condition in an IT block.
    pub condition: Option<Condition>,
}

/// A way in which execution may go on after an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    Next,
    To(u32),
    Call(u32),
    /// Back to the caller, or out of the region.
    Out,
}

impl Fetched {
    pub fn of(image: &Image, at: u32) -> Option<Self> {
        let first = image.half(at)?;
        let second = match cycle_meter::size(first) {
            4 => image.half(at + 2)?,
            _ => 0,
        };
        Some(Self {
            at,
            code: [first, second],
            insn: cycle_meter::decode(first, second),
            decoded: decode(first, second),
            condition: None,
        })
    }

    pub fn next(&self) -> u32 {
        self.at + u32::from(self.insn.size)
    }

    /// The register that it calls or jumps through, and whether it calls.
    pub fn through(&self) -> Option<(u8, bool)> {
        let register = (self.code[0] >> 3 & 15) as u8;
        match self.code[0] & 0xff87 {
            0x4780 => Some((register, true)),
            0x4700 | 0x4687 if register != LR => Some((register, false)),
            _ => None,
        }
    }

    pub fn is_return(&self) -> bool {
        match self.decoded {
            Some(Instruction::BranchTo { m }) => m == LR,
            Some(Instruction::Several(one)) => {
                one.load && one.n == SP && one.registers >> PC & 1 != 0
            }
            _ => false,
        }
    }

    pub fn closes(&self) -> bool {
        self.insn.class == CLOSES
    }

    /// The target of a direct branch.
    fn target(&self) -> Option<u32> {
        let branch = cycle_meter::relative(self.at, self.code[0], self.code[1]);
        branch.filter(|to| to.words == 0).map(|to| to.target)
    }

    /// The targets of a table that the compiler wrote behind a jump: offsets, of which none leads
    /// into the table, or branches.
    pub fn table(&self, image: &Image) -> Vec<u32> {
        if self.insn.class == Class::TableBranch && self.code[0] & 15 == 15 {
            let (mut targets, mut end) =
                (Vec::new(), image.code_after(self.next()).unwrap_or(u32::MAX));
            let bytes = if self.code[1] & 0x10 == 0 { 1 } else { 2 };
            let function = image.function(self.at);
            for at in (self.next()..).step_by(bytes) {
                let Some(entry) = image.half(at).filter(|_| at < end) else {
                    break;
                };
                let entry = if bytes == 1 { entry & 0xff } else { entry };
                let target = self.next() + 2 * u32::from(entry);
                // An entry that leads out of the function is padding.
                if function.is_some_and(|(start, size)| target.wrapping_sub(start) >= size) {
                    break;
                }
                if target >= at {
                    end = end.min(target);
                    targets.push(target);
                }
            }
            return targets;
        }
        let padding = u32::from(image.half(self.next()) == Some(0xbf00));
        let start = self.next() + 2 * padding;
        let mut before = (1..17).filter_map(|k| Self::of(image, self.at - 2 * k));
        let is_formed = |one: Self| match one.decoded {
            Some(Instruction::Address { offset, .. }) => {
                ((one.at + 4) & !3).wrapping_add_signed(offset) == start
            }
            _ => false,
        };
        let is_table = self.code[0] & 0xff87 == 0x4687 && before.any(is_formed);
        let entries = (start..).step_by(4).take_while(|at| {
            let one = Self::of(image, *at);
            is_table && one.is_some_and(|one| one.is_entry())
        });
        entries.collect()
    }

    fn is_entry(&self) -> bool {
        let is_jump = matches!(
            self.decoded,
            Some(Instruction::Branch { condition: ALWAYS, link: false, .. })
        );
        is_jump && self.insn.size == 4
    }

    /// The ways that its code alone leaves open; none if they are not known.
    pub fn ways(&self, image: &Image) -> Vec<Way> {
        use Instruction::{Branch, BranchIfZero};
        let target = self.target().map_or(Way::Out, Way::To);
        let mut ways = match self.decoded {
            _ if !self.insn.may_branch => vec![Way::Next],
            Some(Branch { link: true, .. }) => self.target().map(Way::Call).into_iter().collect(),
            Some(Branch { condition: ALWAYS, .. }) => vec![target],
            Some(Branch { .. } | BranchIfZero { .. }) => vec![target, Way::Next],
            _ if self.is_return() => vec![Way::Out],
            _ => self.table(image).into_iter().map(Way::To).collect(),
        };
        if self.condition.is_some() && self.insn.may_branch && !ways.contains(&Way::Next) {
            ways.push(Way::Next);
        }
        ways
    }
}

/// The instructions that a function, or a part of it, executes.
#[derive(Debug)]
pub struct Flow {
    pub code: BTreeMap<u32, Fetched>,
    /// The place where all ways of an instruction meet again, if that is inside.
    meets: HashMap<u32, u32>,
}

impl Flow {
    /// From an address on, within a range.
    pub fn of(image: &Image, start: u32, is_inside: impl Fn(u32) -> bool, is_region: bool) -> Self {
        let mut code: BTreeMap<u32, Fetched> = BTreeMap::new();
        let mut conditions: HashMap<u32, Condition> = HashMap::new();
        let mut follows: HashMap<u32, Vec<Option<u32>>> = HashMap::new();
        let mut open = vec![start];
        while let Some(at) = open.pop() {
            if code.contains_key(&at) {
                continue;
            }
            let Some(mut one) = Fetched::of(image, at) else {
                continue;
            };
            one.condition = conditions.get(&at).copied();
            if one.insn.class == Class::IfThen {
                conditions.extend(block(image, &one));
            }
            let next = |way| match way {
                Way::Next | Way::Call(_) => Some(one.next()),
                Way::To(at) => Some(at).filter(|at| is_inside(*at)),
                Way::Out => None,
            };
            let mut ways: Vec<Option<u32>> = one.ways(image).into_iter().map(next).collect();
            match one.through() {
                Some((_, true)) => ways = vec![Some(one.next())],
                _ if is_region && one.closes() => ways = vec![None],
                _ => {}
            }
            open.extend(ways.iter().flatten());
            follows.insert(at, ways);
            code.insert(at, one);
        }
        let meets = meets(&follows);
        Self { code, meets }
    }

    pub fn meeting(&self, at: u32) -> Option<u32> {
        self.meets.get(&at).copied()
    }
}

/// The conditions of the instructions of an IT block: A7.3.2.
fn block(image: &Image, it: &Fetched) -> Vec<(u32, Condition)> {
    let (first, mask) = (it.code[0] >> 4 & 15, it.code[0] & 15);
    let mut at = it.next();
    let conditions = (0..4 - mask.trailing_zeros()).map(|k| {
        let last = if k == 0 { first & 1 } else { mask >> (4 - k) & 1 };
        let here = at;
        at += Fetched::of(image, at).map_or(2, |one| u32::from(one.insn.size));
        (here, (first & !1 | last) as Condition)
    });
    conditions.collect()
}

/// The immediate postdominators, by the algorithm of Cooper, Harvey and Kennedy (2001); those that
/// are the exit are left out.
fn meets(follows: &HashMap<u32, Vec<Option<u32>>>) -> HashMap<u32, u32> {
    let mut before: HashMap<Option<u32>, Vec<u32>> = HashMap::new();
    for (at, ways) in follows {
        ways.iter().for_each(|way| before.entry(*way).or_default().push(*at));
    }
    let none = Vec::new();
    let sources = |at: &Option<u32>| before.get(at).unwrap_or(&none);
    // In postorder from the exit.
    let (mut order, mut number) = (Vec::new(), HashMap::new());
    let mut open = vec![(None, 0)];
    let mut seen = std::collections::HashSet::from([None]);
    while let Some((at, k)) = open.pop() {
        match sources(&at).get(k) {
            Some(source) => {
                open.push((at, k + 1));
                if seen.insert(Some(*source)) {
                    open.push((Some(*source), 0));
                }
            }
            None => {
                number.insert(at, order.len());
                order.push(at);
            }
        }
    }
    let exit = order.len() - 1;
    let mut meets: Vec<Option<usize>> = vec![None; order.len()];
    meets[exit] = Some(exit);
    let common = |meets: &[Option<usize>], mut a: usize, mut b: usize| {
        while a != b {
            let lower = if a < b { &mut a } else { &mut b };
            *lower = meets[*lower].unwrap_or(exit);
        }
        a
    };
    let mut changes = true;
    while changes {
        changes = false;
        for k in (0..exit).rev() {
            let ways = order[k].and_then(|at| follows.get(&at)).into_iter().flatten();
            let known = ways.filter_map(|way| number.get(way)).filter(|n| meets[**n].is_some());
            let met = known.copied().reduce(|a, b| common(&meets, a, b));
            changes |= met != meets[k];
            meets[k] = met;
        }
    }
    let inside = |(k, meet): (usize, &Option<usize>)| Some((order[k]?, order[(*meet)?]?));
    meets.iter().enumerate().filter_map(inside).collect()
}
