//! From machine code to the expression that it evaluates.
//!
//! The walk executes the code with real numbers as nodes of a graph and everything else, addresses
//! and counters, as it is. So it follows calls and loops with constant bounds. At a branch by a
//! comparison of real numbers it goes on as the state zero does, and notes the comparison, of which
//! [`crate::paths`] proves that all states of the box decide it so. Calls of the function that the
//! program names `CERTIFIED_SINES` are not followed: they are inputs, the sine and the cosine of a
//! coordinate.

use std::cmp::Ordering;
use std::collections::{BTreeSet, HashMap};

use crate::decode::{
    self, ALWAYS, Arithmetic, Condition, Instruction, Integer, LR, NOWHERE, Operand, PC, SP,
};
use crate::error::{Error, Result};
use crate::flags;
use crate::graph::{Graph, Guess, Input, Node};
use crate::image::Image;
use crate::roots;

mod memory;
mod sines;

use sines::Sines;

/// Addresses at which nothing lies: of what the arguments point to, a range for each; of the stack;
/// and of the caller.
const ARGUMENTS: u32 = 0x9000_0000;
const RANGE: u32 = 0x0100_0000;
const STACK: u32 = 0x2001_0000;
const CALLER: u32 = 0xffff_fff0;
/// More instructions than any function that is proven executes.
const MOST: usize = 200_000;

/// A word in a register or in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Word {
    /// Bits that do not depend on inputs.
    Bits(u32),
    /// The real number of a node.
    Real(usize),
    /// A guess of the reciprocal root of a real number: a magic number less half of its bits.
    Guess(usize, u32),
}

/// A comparison of two real numbers that a branch depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// The address of the instruction that takes its flags.
    pub address: u32,
    /// The nodes that are compared.
    pub nodes: [usize; 2],
    /// The order that they have at the state zero, and must have at every state of the box.
    pub ordering: Ordering,
}

/// A function's expression, and where its code lies.
#[derive(Clone, Debug)]
pub struct Walked {
    /// The expression; outputs are what was written through r0, by offset.
    pub graph: Graph,
    /// The addresses of the instructions that were executed, sorted.
    pub visited: Vec<u32>,
    /// The number of instructions that were executed.
    pub executed: usize,
    /// The comparisons on which the way depends.
    pub comparisons: Vec<Comparison>,
}

struct Walk<'a> {
    image: &'a Image,
    graph: Graph,
    inputs: HashMap<Input, usize>,
    literals: HashMap<u32, usize>,
    core: [Option<Word>; 16],
    real: [Option<Word>; 32],
    memory: HashMap<u32, Word>,
    /// Negative, zero, carry, overflow, as far as they are known.
    flags: [Option<bool>; 4],
    /// The conditions of the next instructions: ITSTATE.
    conditions: u8,
    sines: Option<Sines>,
    /// The real numbers that were compared last.
    compared: Option<[usize; 2]>,
    comparisons: Vec<Comparison>,
    /// The first address of the instruction, and the next one's.
    here: u32,
    next: u32,
    code: u32,
}

/// Walks the function at an address. An argument is a pointer to inputs, or to what lies at an
/// address of the program; the first one is where results go.
///
/// # Errors
/// [`Error::Declined`].
pub fn walk(image: &Image, function: u32, arguments: [Option<u32>; 4]) -> Result<Walked> {
    let mut walk = Walk {
        image,
        graph: Graph::default(),
        inputs: HashMap::new(),
        literals: HashMap::new(),
        core: [None; 16],
        real: [None; 32],
        memory: HashMap::new(),
        flags: [None; 4],
        conditions: 0,
        sines: Sines::of(image),
        compared: None,
        comparisons: Vec::new(),
        here: function & !1,
        next: function & !1,
        code: 0,
    };
    for ((i, given), register) in (0..).zip(arguments).zip(&mut walk.core) {
        *register = Some(Word::Bits(given.unwrap_or(ARGUMENTS + i * RANGE)));
    }
    // Registers that a function must keep hold what its caller left there, of which nothing is
    // known but that it is kept.
    for (i, kept) in (4..13).enumerate() {
        walk.core[kept] = Some(Word::Bits(CALLER + i as u32));
    }
    walk.real[16..].fill(Some(Word::Bits(CALLER)));
    walk.core[usize::from(SP)] = Some(Word::Bits(STACK));
    walk.core[usize::from(LR)] = Some(Word::Bits(CALLER));
    let mut visited = BTreeSet::new();
    let mut executed = 0;
    while walk.next != CALLER {
        visited.insert(walk.next);
        executed += 1;
        walk.step()?;
        if executed > MOST {
            return Err(walk.declined("more instructions than are followed"));
        }
    }
    let mut outputs: Vec<(u32, Word)> = walk
        .memory
        .iter()
        .filter_map(|(at, word)| Some((at.checked_sub(ARGUMENTS)?, *word)))
        .filter(|(offset, _)| *offset < RANGE)
        .collect();
    outputs.sort_by_key(|output| output.0);
    for (offset, word) in outputs {
        let node = walk.node(word);
        walk.graph.outputs.push((offset, node));
    }
    roots::join_steps(&mut walk.graph);
    Ok(Walked {
        comparisons: walk.comparisons,
        graph: walk.graph,
        visited: visited.into_iter().collect(),
        executed,
    })
}

impl Walk<'_> {
    fn declined(&self, reason: &'static str) -> Error {
        Error::Declined { address: self.here, instruction: self.code, reason }
    }

    fn push(&mut self, node: Node) -> usize {
        self.graph.nodes.push(node);
        self.graph.nodes.len() - 1
    }

    /// The node of a word that is used as a real number.
    fn node(&mut self, word: Word) -> usize {
        match word {
            Word::Real(node) => node,
            Word::Guess(a, magic) => self.push(Node::InverseRoot(a, Guess { magic, steps: 0 })),
            Word::Bits(bits) => match self.literals.get(&bits) {
                Some(node) => *node,
                None => {
                    let node = self.push(Node::Literal(f32::from_bits(bits)));
                    self.literals.insert(bits, node);
                    node
                }
            },
        }
    }

    fn core(&self, register: u8) -> Result<Word> {
        if register == PC {
            return Ok(Word::Bits(self.here + 4));
        }
        self.core[usize::from(register)]
            .ok_or_else(|| self.declined("a core register that nothing has set"))
    }

    fn bits(&self, register: u8) -> Result<u32> {
        match self.core(register)? {
            Word::Bits(bits) => Ok(bits),
            _ => Err(self.declined("an integer operation on a real number")),
        }
    }

    fn operand(&self, operand: Operand) -> Result<u32> {
        match operand {
            Operand::Constant(value) => Ok(value),
            Operand::Register(m, shift) => Ok(self.bits(m)? << shift),
            Operand::Right(m, shift) => Ok(self.bits(m)? >> shift),
        }
    }

    fn holds(&self, condition: Condition) -> Result<bool> {
        if condition == ALWAYS {
            return Ok(true);
        }
        let unknown = || self.declined("a branch by flags that are not followed");
        flags::holds(condition, self.flags).ok_or_else(unknown)
    }

    fn real(&self, register: u8) -> Result<Word> {
        let word = self.real.get(usize::from(register)).copied().flatten();
        word.ok_or_else(|| self.declined("a floating-point register that nothing has set"))
    }

    fn set(&mut self, register: u8, word: Word) -> Result<()> {
        match register {
            NOWHERE => {}
            PC => match word {
                Word::Bits(address) => self.next = address & !1,
                _ => return Err(self.declined("a branch to a real number")),
            },
            register => self.core[usize::from(register)] = Some(word),
        }
        Ok(())
    }

    fn step(&mut self) -> Result<()> {
        self.here = self.next;
        let half = |at| self.image.half(at).ok_or_else(|| self.declined("no code lies here"));
        let first = half(self.here)?;
        let size = cycle_meter::size(first);
        let second = if size == 4 { half(self.here + 2)? } else { 0 };
        self.code = u32::from(first) << 16 | u32::from(second);
        self.next = self.here + u32::from(size);
        let instruction = decode::decode(first, second)
            .ok_or_else(|| self.declined("an instruction of which nothing is proven"))?;
        if self.conditions & 15 == 0 {
            return self.execute(instruction);
        }
        let condition = self.conditions >> 4;
        self.conditions = match self.conditions & 7 {
            0 => 0,
            _ => self.conditions & 0xe0 | self.conditions << 1 & 0x1f,
        };
        if !self.holds(condition)? {
            return Ok(());
        }
        let flags = self.flags;
        self.execute(instruction)?;
        // Short instructions set no flags in an IT block, comparisons apart.
        use Instruction::{Integer, TakeFlags};
        let is_comparison = matches!(instruction, Integer { d: NOWHERE, .. } | TakeFlags);
        if size == 2 && !is_comparison {
            self.flags = flags;
        }
        Ok(())
    }

    fn execute(&mut self, instruction: Instruction) -> Result<()> {
        use Instruction as I;
        match instruction {
            I::Nop => Ok(()),
            I::IfThen { state } => {
                self.conditions = state;
                Ok(())
            }
            I::Constant { d, value } => {
                // An encoding of one halfword sets the flags.
                if self.next == self.here + 2 {
                    [self.flags[0], self.flags[1]] = [value >> 31 != 0, value == 0].map(Some);
                }
                self.set(d, Word::Bits(value))
            }
            I::Address { d, offset } => {
                let address = ((self.here + 4) & !3).wrapping_add_signed(offset);
                self.set(d, Word::Bits(address))
            }
            I::MultiplyAdd { d, n, m, a } => {
                let product = self.bits(n)?.wrapping_mul(self.bits(m)?);
                let more = if a == NOWHERE { 0 } else { self.bits(a)? };
                self.set(d, Word::Bits(product.wrapping_add(more)))
            }
            I::Upper { d, value } => {
                let low = self.bits(d)? & 0xffff;
                self.set(d, Word::Bits(value << 16 | low))
            }
            I::Move { d, m } => {
                let word = self.core(m)?;
                self.set(d, word)
            }
            I::Several(one) => self.several(one),
            I::Arithmetic { op, d, n, m } => self.arithmetic(op, d, n, m),
            I::Negate { d, m } => self.function(Node::Neg, d, m),
            I::Root { d, m } => self.function(Node::Sqrt, d, m),
            I::Compare { d, m } => {
                let a = self.real(d)?;
                let b = m.map_or(Ok(Word::Bits(0)), |m| self.real(m))?;
                self.compared = Some([self.node(a), self.node(b)]);
                Ok(())
            }
            I::TakeFlags => self.take_flags(),
            I::Integer { op: Integer::Sub, d, n, by: Operand::Right(m, 1), flags: false } => {
                let (magic, halved) = (self.bits(n)?, self.core(m)?);
                match halved {
                    Word::Real(a) => self.set(d, Word::Guess(a, magic)),
                    Word::Bits(bits) => self.set(d, Word::Bits(magic.wrapping_sub(bits >> 1))),
                    _ => Err(self.declined("a guess of a guess")),
                }
            }
            I::Integer { op, d, n, by, flags } => {
                let (a, b) = (self.bits(n)?, self.operand(by)?);
                let result = op.of(a, b);
                if flags {
                    self.flags = match op {
                        Integer::Add => flags::of_sum(a, b, false).map(Some),
                        Integer::Sub => flags::of_sum(a, !b, true).map(Some),
                        // Carry and overflow are those of no sum.
                        _ => [Some(result >> 31 != 0), Some(result == 0), None, None],
                    };
                }
                self.set(d, Word::Bits(result))
            }
            I::Copy { d, m } => {
                self.real[usize::from(d)] = Some(self.real(m)?);
                Ok(())
            }
            I::Real { d, value } => {
                self.real[usize::from(d)] = Some(Word::Bits(value.to_bits()));
                Ok(())
            }
            I::Transfer { core, real, to_core } => {
                if to_core {
                    let word = self.real(real)?;
                    return self.set(core, word);
                }
                let mut word = self.core(core)?;
                if let Word::Guess(..) = word {
                    word = Word::Real(self.node(word));
                }
                self.real[usize::from(real)] = Some(word);
                Ok(())
            }
            I::Branch { offset, condition, link } => {
                let to = (self.here + 4).wrapping_add_signed(offset);
                if link && self.sines.as_ref().is_some_and(|sines| sines.address == to) {
                    return self.sine_and_cosine();
                }
                if link {
                    self.core[usize::from(LR)] = Some(Word::Bits(self.next | 1));
                }
                if self.holds(condition)? {
                    self.next = to;
                }
                Ok(())
            }
            I::BranchIfZero { n, offset, if_not } => {
                if (self.bits(n)? == 0) != if_not {
                    self.next = (self.here + 4).wrapping_add_signed(offset);
                }
                Ok(())
            }
            I::BranchTo { m } => {
                self.next = self.bits(m)? & !1;
                Ok(())
            }
            I::Access(one) if one.bytes == 4 => self.access(one),
            I::Access(one) if one.load && one.second == NOWHERE && !one.is_signed => {
                self.access(one)
            }
            _ => Err(self.declined("an instruction of which nothing is proven")),
        }
    }

    fn function(&mut self, of: fn(usize) -> Node, d: u8, m: u8) -> Result<()> {
        let word = self.real(m)?;
        let a = self.node(word);
        let node = self.push(of(a));
        self.real[usize::from(d)] = Some(Word::Real(node));
        Ok(())
    }

    fn arithmetic(&mut self, op: Arithmetic, d: u8, n: u8, m: u8) -> Result<()> {
        let (n, m) = (self.real(n)?, self.real(m)?);
        let (a, b) = (self.node(n), self.node(m));
        let mut node = self.push(match op {
            Arithmetic::Add => Node::Add(a, b),
            Arithmetic::Sub => Node::Sub(a, b),
            Arithmetic::Div => Node::Div(a, b),
            Arithmetic::Mul | Arithmetic::NegatedMul => Node::Mul(a, b),
        });
        if op == Arithmetic::NegatedMul {
            node = self.push(Node::Neg(node));
        }
        self.real[usize::from(d)] = Some(Word::Real(node));
        Ok(())
    }
}
