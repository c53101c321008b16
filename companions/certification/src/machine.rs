//! The state of a processor of which only a part is known: integers and addresses are followed,
//! other data is not.

use std::collections::HashMap;

use cycle_meter::{Class, Insn, Pipe};

use crate::decode::{
    Access, Condition, Instruction, Integer, LR, NOWHERE, Operand, PC, SP, Several,
};
use crate::flags;
use crate::image::Image;
use crate::words::{Names, STACK, Word, number};

/// The word that is known to lie at an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Kept {
    word: Word,
    bytes: u32,
    /// Whether it is a register that a prologue saves: no pointer reaches it.
    is_saved: bool,
}

/// The knowledge of the processor's state, and the cycles so far for each state of the pipeline.
#[derive(Clone, Debug)]
pub struct Machine {
    core: [Word; 15],
    real: [Word; 32],
    /// The flags negative, zero, carry and overflow, each if it is known.
    flags: [Option<bool>; 4],
    memory: HashMap<Word, Kept>,
    /// Whether an address of the stack was stored, so that a word from memory that is not known can
    /// be one.
    is_exposed: bool,
    pipes: Vec<(Pipe, u64)>,
}

impl Machine {
    pub fn new(names: &mut Names, pipes: Vec<(Pipe, u64)>) -> Self {
        let mut core = [STACK; 15];
        core[..13].fill_with(|| names.fresh());
        core[usize::from(LR)] = names.fresh();
        Self {
            core,
            real: [STACK; 32].map(|_| names.fresh()),
            flags: [None; 4],
            memory: HashMap::new(),
            is_exposed: false,
            pipes,
        }
    }

    /// The largest sum of cycles.
    pub fn cycles(&self) -> u64 {
        self.pipes.iter().map(|pipe| pipe.1).max().unwrap_or(0)
    }

    pub fn charge(&mut self, insn: &Insn) {
        self.advance(|pipe| pipe.step(insn));
    }

    pub fn refill(&mut self) {
        self.advance(Pipe::refill);
    }

    fn advance(&mut self, by: impl Fn(&mut Pipe) -> u32) {
        let before = std::mem::take(&mut self.pipes);
        for (mut pipe, cycles) in before {
            let cycles = cycles + u64::from(by(&mut pipe));
            self.keep(pipe, cycles);
        }
    }

    fn keep(&mut self, pipe: Pipe, cycles: u64) {
        match self.pipes.iter_mut().find(|(other, _)| *other == pipe) {
            Some((_, most)) => *most = cycles.max(*most),
            None => self.pipes.push((pipe, cycles)),
        }
    }

    /// Whatever is true of both.
    pub fn join(&mut self, names: &mut Names, other: &Self) {
        let registers = self.core.iter_mut().chain(&mut self.real);
        for (mine, theirs) in registers.zip(other.core.iter().chain(&other.real)) {
            if mine != theirs {
                *mine = names.of(&[*mine, *theirs]);
            }
        }
        for (mine, theirs) in self.flags.iter_mut().zip(other.flags) {
            *mine = mine.filter(|_| *mine == theirs);
        }
        let is_same = |at: &Word, kept: &mut Kept| other.memory.get(at) == Some(kept);
        self.memory.retain(is_same);
        self.is_exposed |= other.is_exposed;
        for (pipe, cycles) in &other.pipes {
            self.keep(*pipe, *cycles);
        }
    }

    pub fn holds(&self, condition: Condition) -> Option<bool> {
        flags::holds(condition, self.flags)
    }

    pub fn core(&self, register: u8) -> Word {
        self.core.get(usize::from(register)).copied().unwrap_or(number(0))
    }

    /// Whether a register is zero.
    pub fn is_zero(&self, register: u8) -> Option<bool> {
        let word = self.core(register);
        if word.is_on_stack() {
            return Some(false);
        }
        word.number().map(|number| number == 0)
    }

    /// Sets a register of the core, the program counter apart.
    fn set(&mut self, register: u8, word: Word) {
        if let Some(place) = self.core.get_mut(usize::from(register)) {
            *place = word;
        }
    }

    fn load(&mut self, (names, image): (&mut Names, &Image), at: Word) -> Word {
        if let Some(kept) = self.memory.get(&at).filter(|kept| kept.bytes == 4) {
            return kept.word;
        }
        if let Some(word) = at.number().and_then(|at| image.word(at)) {
            return number(word);
        }
        let word = self.unknown(names);
        self.keep_word(at, word, 4, false);
        word
    }

    fn keep_word(&mut self, at: Word, word: Word, bytes: u32, is_saved: bool) {
        let kept = Kept { word, bytes, is_saved };
        self.memory.insert(at, kept);
    }

    /// A name for a word of memory that is not known.
    fn unknown(&self, names: &mut Names) -> Word {
        if self.is_exposed { names.any() } else { names.fresh() }
    }

    /// A function gets multiples of four in these registers.
    pub fn align(&mut self, names: &mut Names, registers: &[usize]) {
        for register in registers {
            self.core[*register] = names.aligned(self.core[*register]);
        }
    }

    /// A call writes the address after it.
    pub fn link(&mut self, names: &mut Names) {
        self.core[usize::from(LR)] = names.fresh();
    }

    /// Forgets what a store of unknown bytes can change.
    fn spoil(&mut self, at: Word, bytes: u32) {
        self.memory.retain(|place, kept| {
            let distance = place.offset.wrapping_sub(at.offset);
            let is_apart = distance >= bytes && distance.wrapping_neg() >= kept.bytes;
            match place.has_name_of(at) {
                true => is_apart,
                false => kept.is_saved || !place.may_meet(at),
            }
        });
    }

    fn store(&mut self, at: Word, word: Word, is_saved: bool) {
        self.spoil(at, 4);
        self.is_exposed |= !is_saved && word.may_be_on_stack();
        self.keep_word(at, word, 4, is_saved);
    }

    /// A store that may be left out.
    fn may_store(&mut self, at: Word, word: Word) {
        self.spoil(at, 4);
        self.is_exposed |= word.may_be_on_stack();
    }

    fn operand(&self, names: &mut Names, by: Operand) -> Word {
        match by {
            Operand::Constant(value) => number(value),
            Operand::Register(m, 0) => self.core(m),
            Operand::Register(m, shift) | Operand::Right(m, shift) => {
                let is_right = matches!(by, Operand::Right(..));
                match self.core(m).number() {
                    Some(value) => number(if is_right { value >> shift } else { value << shift }),
                    None => names.of(&[self.core(m)]),
                }
            }
        }
    }

    /// Executes what an instruction does apart from branching. `under` is nothing outside an IT
    /// block, else whether its condition is known to hold; if it is not, what the instruction
    /// writes is unknown.
    pub fn execute(
        &mut self,
        (names, image): (&mut Names, &Image),
        here: u32,
        (insn, decoded): (&Insn, Option<Instruction>),
        under: Option<bool>,
    ) {
        let is_sure = under != Some(false);
        let (core, real, flags) = (self.core, self.real, self.flags);
        let known =
            decoded.is_some_and(|one| self.follow((&mut *names, image), here, one, is_sure));
        if !known {
            self.havoc(names, insn);
        }
        use Instruction::{Constant, Integer};
        // Short instructions set no flags in an IT block, comparisons apart; of one that is not
        // followed nothing is known.
        let is_comparison = matches!(decoded, None | Some(Integer { d: NOWHERE, .. }));
        if insn.size == 2 && under.is_some() && !is_comparison {
            self.flags = flags;
        } else if let Some(Constant { value, .. }) = decoded.filter(|_| insn.size == 2) {
            [self.flags[0], self.flags[1]] = [value >> 31 != 0, value == 0].map(Some);
        }
        if !is_sure {
            let registers = self.core.iter_mut().chain(&mut self.real);
            for (now, before) in registers.zip(core.iter().chain(&real)) {
                if now != before {
                    *now = names.of(&[*now, *before]);
                }
            }
            self.flags = if self.flags == flags { flags } else { [None; 4] };
        }
    }

    /// After an instruction of which only the registers are known.
    fn havoc(&mut self, names: &mut Names, insn: &Insn) {
        let all = self.core;
        for register in 0..15 {
            if insn.core_writes >> register & 1 != 0 || insn.address >> register & 1 != 0 {
                self.core[register] = names.of(&all);
            }
        }
        for register in 0..32 {
            if insn.float_writes >> register & 1 != 0 {
                self.real[register] = names.fresh();
            }
        }
        let is_memory = matches!(insn.class, Class::Load | Class::Store | Class::Words(_));
        if is_memory {
            let bases = all.iter().zip(0..).filter(|(_, n)| insn.address >> n & 1 != 0);
            let bases: Vec<Word> = bases.map(|(word, _)| *word).collect();
            let at = names.of(&bases);
            self.spoil(at, 4);
            self.is_exposed |= insn.class != Class::Load;
        } else if !insn.float || insn.class == Class::FloatMove {
            self.flags = [None; 4];
        }
    }

    fn compare(&mut self, sets: bool, a: Word, b: Word, carry: bool) {
        if !sets {
            return;
        }
        self.flags = match (a.number(), b.number()) {
            (Some(a), Some(b)) => flags::of_sum(a, b, carry).map(Some),
            _ => [None; 4],
        };
    }

    fn subtract(&mut self, names: &mut Names, a: Word, b: Word, sets: bool) -> Word {
        if let Some(value) = b.number() {
            self.compare(sets, a, number(!value), true);
            if sets && a.is_on_stack() {
                self.flags[1] = Some(false).filter(|_| value == 0);
            }
            return a.plus(value.wrapping_neg());
        }
        if a.has_name_of(b) {
            let (x, y) = (a.offset, b.offset);
            if sets {
                // No object in memory wraps around the end of the address space.
                let carry = a.aligned(3).map(|_| x as i32 >= y as i32);
                self.flags = [None, Some(x == y), carry, None];
            }
            return number(x.wrapping_sub(y));
        }
        self.compare(sets, a, b, true);
        match a.number() {
            Some(value) => names.difference(value, b),
            None => names.of(&[a, b]),
        }
    }

    fn add(&mut self, names: &mut Names, a: Word, b: Word, sets: bool) -> Word {
        self.compare(sets, a, b, false);
        match (a.number(), b.number()) {
            (_, Some(b)) => a.plus(b),
            (Some(a), _) => b.plus(a),
            _ => names.of(&[a, b]),
        }
    }

    fn integer(
        &mut self,
        names: &mut Names,
        op: Integer,
        (a, b): (Word, Word),
        sets: bool,
    ) -> Word {
        let result = match op {
            Integer::Add => return self.add(names, a, b, sets),
            Integer::Sub => return self.subtract(names, a, b, sets),
            Integer::ReverseSub => return self.subtract(names, b, a, sets),
            _ => match (a.number(), b.number()) {
                (Some(a), Some(b)) => number(op.of(a, b)),
                (None, Some(1)) if op == Integer::Multiply => a,
                (None, Some(mask)) if op == Integer::And => match a.aligned(mask) {
                    Some(bits) => number(bits),
                    None => names.of(&[a, b]),
                },
                _ => names.of(&[a, b]),
            },
        };
        if sets {
            let value = result.number();
            self.flags = [value.map(|n| n >> 31 != 0), value.map(|n| n == 0), None, None];
        }
        result
    }

    /// Whether what the instruction does is followed.
    fn follow(
        &mut self,
        (names, image): (&mut Names, &Image),
        here: u32,
        instruction: Instruction,
        is_sure: bool,
    ) -> bool {
        use Instruction as I;
        match instruction {
            I::Nop | I::IfThen { .. } => {}
            I::Integer { op, d, n, by, flags } => {
                let by = self.operand(names, by);
                let result = self.integer(names, op, (self.core(n), by), flags);
                self.set(d, result);
            }
            I::MultiplyAdd { d, n, m, a } => {
                let words = (self.core(n), self.core(m));
                let product = self.integer(names, Integer::Multiply, words, false);
                let sum = match a {
                    NOWHERE => product,
                    a => self.add(names, product, self.core(a), false),
                };
                self.set(d, sum);
            }
            I::Constant { d, value } => self.set(d, number(value)),
            I::Address { d, offset } => {
                self.set(d, number(((here + 4) & !3).wrapping_add_signed(offset)));
            }
            I::Upper { d, value } => match self.core(d).number() {
                Some(low) => self.set(d, number(value << 16 | low & 0xffff)),
                None => return false,
            },
            I::Move { d, m } => self.set(d, self.core(m)),
            I::Access(access) => self.access((names, image), here, access, is_sure),
            I::Several(one) => self.several((names, image), here, one, is_sure),
            I::Copy { d, m } => self.real[usize::from(d)] = self.real[usize::from(m)],
            I::Real { d, value } => self.real[usize::from(d)] = number(value.to_bits()),
            I::Transfer { core, real, to_core: true } => {
                self.set(core, self.real[usize::from(real)])
            }
            I::Transfer { core, real, .. } => self.real[usize::from(real)] = self.core(core),
            _ => return false,
        }
        true
    }

    fn base(&self, n: u8, here: u32) -> Word {
        match n {
            PC => number((here + 4) & !3),
            n => self.core(n),
        }
    }

    /// Loads and stores of several registers, and of those of the floating-point unit.
    fn several(
        &mut self,
        (names, image): (&mut Names, &Image),
        here: u32,
        one: Several,
        is_sure: bool,
    ) {
        let base = self.base(one.n, here);
        if one.moves != 0 {
            self.set(one.n, base.plus(one.moves as u32));
        }
        let is_saved = one.n == SP && !one.load && one.moves < 0;
        for (k, register) in (0..).zip(one.named()) {
            let at = base.plus(one.offset as u32).plus(4 * k);
            let real = register.wrapping_sub(16);
            let word = match self.real.get(real) {
                Some(word) => *word,
                None => self.core(register as u8),
            };
            match (one.load, is_sure) {
                (true, _) => {
                    let word = self.load((&mut *names, image), at);
                    match self.real.get_mut(real) {
                        Some(place) => *place = word,
                        None => self.set(register as u8, word),
                    }
                }
                (false, true) => self.store(at, word, is_saved),
                (false, false) => self.may_store(at, word),
            }
        }
    }

    /// Moves a word between a register and memory.
    fn word(
        &mut self,
        world: (&mut Names, &Image),
        (t, at): (u8, Word),
        load: bool,
        is_sure: bool,
    ) {
        match (load, is_sure) {
            (true, _) => {
                let word = self.load(world, at);
                self.set(t, word);
            }
            (false, true) => self.store(at, self.core(t), false),
            (false, false) => self.may_store(at, self.core(t)),
        }
    }

    fn access(
        &mut self,
        (names, image): (&mut Names, &Image),
        here: u32,
        one: Access,
        is_sure: bool,
    ) {
        let base = self.base(one.n, here);
        let offset = self.operand(names, one.offset);
        let moved = self.add(names, base, offset, false);
        let at = if one.before { moved } else { base };
        if one.writes_back {
            self.set(one.n, moved);
        }
        if one.bytes == 4 {
            self.word((&mut *names, image), (one.t, at), one.load, is_sure);
            if one.second != NOWHERE {
                self.word((names, image), (one.second, at.plus(4)), one.load, is_sure);
            }
            return;
        }
        let bytes = u32::from(one.bytes);
        let mask = (1 << (8 * bytes)) - 1;
        if one.load {
            let kept = self.memory.get(&at).filter(|kept| kept.bytes == bytes);
            let kept = kept.and_then(|kept| kept.word.number());
            let bits = kept.or_else(|| image.word(at.number()?));
            let word = match bits.filter(|_| !one.is_signed) {
                Some(bits) => number(bits & mask),
                None => self.unknown(names),
            };
            self.set(one.t, word);
        } else {
            self.spoil(at, bytes);
            let value = self.core(one.t).number().filter(|_| is_sure);
            if let Some(value) = value {
                self.keep_word(at, number(value & mask), bytes, false);
            }
        }
    }
}
