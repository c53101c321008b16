//! Which functions a function can reach, read from the machine code: what the sources say is
//! one thing, what the linker kept is another.

use std::collections::VecDeque;
use std::collections::btree_map::{BTreeMap, Entry};
use std::path::Path;

use cycle_meter::{Class, Insn, Relative};

use crate::kit::elf::{Function, Image, is_f64, is_panic};
use crate::kit::error::{Result, bail, check, refuse_if};

/// The most instructions between the one that forms a table's address and the jump into it.
const TABLE_START_BEFORE: usize = 8;

/// Less than as many bytes are between the jump and the table.
const MOST_PADDING: u64 = 8;

#[derive(Clone, Copy, Debug)]
pub struct Instruction {
    pub address: u64,
    /// Its halfwords; the second is zero if it has one.
    pub code: [u16; 2],
    pub insn: Insn,
}

impl Instruction {
    /// The target of a relative branch or load.
    pub fn relative(self) -> Option<Relative> {
        cycle_meter::relative(self.address as u32, self.code[0], self.code[1])
    }

    /// The target of a direct call or jump.
    pub fn target(self) -> Option<u64> {
        let branch = self.relative().filter(|reached| reached.words == 0)?;
        Some(branch.target.into())
    }

    /// Whether it is `mov pc, Rm`: a jump, and no call.
    fn is_move_to_pc(self) -> bool {
        self.code[0] & 0xFF87 == 0x4687
    }

    /// The address that `addw Rd, pc, #imm12` forms (ARMv7-M manual, A7.7.7).
    fn address_formed(self) -> Option<u64> {
        let [first, second] = self.code.map(u64::from);
        let imm12 = (first >> 10 & 1) << 11 | (second >> 12 & 7) << 8 | second & 0xFF;
        (first & 0xFBFF == 0xF20F).then_some(((self.address + 4) & !3) + imm12)
    }

    pub fn is_beyond_m4f(self) -> bool {
        self.insn.class == Class::Unknown
    }
}

impl Image {
    /// The instructions of all its functions.
    pub fn instructions(&self) -> impl Iterator<Item = (&Function, Instruction)> {
        self.functions.iter().flat_map(|function| {
            let instructions = function.instructions().into_iter();
            instructions.map(move |one| (function, one))
        })
    }

    /// The number of instructions; an error if a Cortex-M4F lacks one of them.
    pub fn m4f_instructions(&self) -> Result<usize> {
        if let Some((function, one)) = self.instructions().find(|(_, one)| one.is_beyond_m4f()) {
            let (name, code, at) = (&function.names[0], one.code, one.address);
            bail!("`{name}` has {code:x?} at {at:#x}");
        }
        Ok(self.instructions().count())
    }
}

impl Function {
    /// Whether an address lies in it.
    pub fn contains(&self, address: u64) -> bool {
        let end = self.address + self.bytes.len() as u64;
        (self.address..end).contains(&address)
    }

    /// Its instructions, without the literal pools.
    pub fn instructions(&self) -> Vec<Instruction> {
        let halfword = |at: usize| {
            let pair = self.bytes.get(at..at + 2)?;
            Some(u16::from_le_bytes([pair[0], pair[1]]))
        };
        let mut instructions = Vec::new();
        let mut at = 0;
        while let Some(first) = halfword(at) {
            let address = self.address + at as u64;
            let mark = self.data.iter().rev().find(|(from, _)| *from <= address);
            if mark.is_some_and(|(_, is_data)| *is_data) {
                at += 2;
                continue;
            }
            let size = usize::from(cycle_meter::size(first));
            let second = halfword(at + 2).filter(|_| size == 4).unwrap_or_default();
            instructions.push(Instruction {
                address,
                code: [first, second],
                insn: cycle_meter::decode(first, second),
            });
            at += size;
        }
        instructions
    }

    /// Where a veneer of the linker leads, which reaches what is too far for a branch: `movw ip, …;
    /// movt ip, …; bx ip` (ARMv7-M manual, A7.7.76 and A7.7.79).
    pub fn veneer(&self) -> Option<u64> {
        let (halves, rest) = self.bytes.as_chunks();
        let halves: Vec<u64> = halves.iter().map(|half| u16::from_le_bytes(*half).into()).collect();
        let &[low, low_imm, high, high_imm, 0x4760] = halves.as_slice() else {
            return None;
        };
        let imm16 = |first: u64, second: u64| {
            (first & 15) << 12 | (first >> 10 & 1) << 11 | (second >> 12 & 7) << 8 | second & 0xFF
        };
        let into_ip = [low_imm, high_imm].iter().all(|second| second & 0x8F00 == 0x0C00);
        let is_veneer = low & 0xFBF0 == 0xF240 && high & 0xFBF0 == 0xF2C0 && into_ip;
        let target = imm16(high, high_imm) << 16 | imm16(low, low_imm) & !1;
        (is_veneer && rest.is_empty()).then_some(target)
    }

    /// The place of a jump or call through a register whose target is not known.
    ///
    /// A jump into a table of branches is known: LLVM writes the table behind the jump, where its
    /// entries are instructions of the function like any other.
    pub fn unknown_jump(&self) -> Option<u64> {
        if self.veneer().is_some() {
            return None;
        }
        let all = self.instructions();
        let place = all.iter().enumerate().position(|(i, one)| {
            let before = &all[i.saturating_sub(TABLE_START_BEFORE)..i];
            let is_table = |start: &Instruction| {
                let table = start.address_formed();
                let behind = one.address + 2..one.address + 2 + MOST_PADDING;
                let entry = |to: &&Instruction| Some(to.address) == table && to.target().is_some();
                table.is_some_and(|table| behind.contains(&table))
                    && all.iter().find(entry).is_some()
            };
            one.insn.indirect && !(one.is_move_to_pc() && before.iter().any(is_table))
        });
        place.map(|i| all[i].address)
    }

    /// Whether one of its names matches.
    pub fn is_named(&self, matches: impl Fn(&str) -> bool) -> bool {
        self.names.iter().any(|name| matches(name))
    }

    fn name(&self) -> &str {
        &self.names[0]
    }
}

/// The functions that one can reach.
pub struct Reach<'a> {
    /// Each function, and the one that it was first reached from.
    from: BTreeMap<usize, Option<usize>>,
    image: &'a Image,
}

impl<'a> Reach<'a> {
    /// Follows the direct calls and jumps from every function that is a root.
    ///
    /// # Errors
    /// There is no root, or something reached calls through a register or leaves the known
    /// functions, so that what else is reached is not known.
    pub fn of(image: &'a Image, is_root: impl Fn(&Function) -> bool) -> Result<Self> {
        let is_root = |index: &usize| is_root(&image.functions[*index]);
        let roots: Vec<usize> = (0..image.functions.len()).filter(is_root).collect();
        if roots.is_empty() {
            bail!("the firmware has no function to start from");
        }
        let from = roots.iter().map(|root| (*root, None)).collect();
        let mut reach = Self { from, image };
        let mut queue = VecDeque::from(roots);
        while let Some(index) = queue.pop_front() {
            let function = &image.functions[index];
            if let Some(at) = function.unknown_jump() {
                let path = reach.path(index);
                bail!("{path} calls through a register at {at:#x}: what it reaches is not known");
            }
            let jumps = function.instructions().into_iter().filter_map(Instruction::target);
            for target in jumps.chain(function.veneer()).filter(|to| !function.contains(*to)) {
                let callee = image.functions.iter().position(|f| f.contains(target));
                let callee = callee.ok_or_else(|| {
                    let jumps = format!("{} jumps to {target:#x}", reach.path(index));
                    check!("{jumps}, which is in no function")
                })?;
                if let Entry::Vacant(new) = reach.from.entry(callee) {
                    new.insert(Some(index));
                    queue.push_back(callee);
                }
            }
        }
        Ok(reach)
    }

    /// The functions, each with the chain of calls that reaches it.
    pub fn functions(&self) -> impl Iterator<Item = (&'a Function, String)> + '_ {
        let found = self.from.keys();
        found.map(|index| (&self.image.functions[*index], self.path(*index)))
    }

    fn path(&self, index: usize) -> String {
        let mut names = vec![self.image.functions[index].name()];
        let mut at = index;
        while let Some(Some(caller)) = self.from.get(&at) {
            names.push(self.image.functions[*caller].name());
            at = *caller;
        }
        names.reverse();
        names.join(" → ")
    }
}

/// The number of functions that the ticks of an image reach; fails if one of them is f64
/// arithmetic, a sine of libm or a panic.
pub fn f32_only(elf: &Path, is_tick: fn(&str) -> bool) -> Result<usize> {
    let image = Image::read(elf)?;
    let reach = Reach::of(&image, |function| function.is_named(is_tick))?;
    let mut count = 0;
    for (function, path) in reach.functions() {
        count += 1;
        let unwanted = |name: &&String| is_f64(name) || is_panic(name);
        if let Some(name) = function.names.iter().find(unwanted) {
            bail!("the tick reaches `{name}`: {path}");
        }
    }
    Ok(count)
}

/// Fails unless a function and all that it reaches lie in memory that never waits.
pub fn placed(image: &Image, root: &str) -> Result<()> {
    let reach = Reach::of(image, |function| function.is_named(|name| name == root))?;
    for (function, path) in reach.functions() {
        refuse_if!(!image.fast.contains(&function.address), "{path} waits for flash");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Reach, placed};
    use crate::kit::elf::{Function, Image};

    #[test]
    fn an_image_with_a_double_of_the_fpu_is_refused() {
        let image = |code: [u16; 4]| Image::of(vec![Function::of("tick", 0x1000, &code)]);
        let counted = image([0xBF00, 0xEE30, 0x0A81, 0x4770]).m4f_instructions(); // vadd.f32 s0, s1, s2
        assert_eq!(counted.expect("all are known"), 3);
        let refused = image([0xBF00, 0xEE30, 0x0B01, 0x4770]).m4f_instructions(); // vadd.f64 d0, d0, d1
        let error = refused.expect_err("a double").to_string();
        assert!(error.contains("`tick` has [ee30, b01] at 0x1002"), "{error}");
    }

    #[test]
    fn a_jump_through_a_register_is_refused_with_its_path() {
        // bl 0x1010; bx lr
        let caller = Function::of("tick", 0x1000, &[0xf000, 0xf806, 0x4770]);
        let image =
            |code: [u16; 3]| Image::of(vec![caller.clone(), Function::of("callee", 0x1010, &code)]);
        let returns = image([0xbf00, 0xbf00, 0x4770]);
        let reach = Reach::of(&returns, |f| f.is_named(|name| name == "tick")).expect("no jump");
        let paths: Vec<String> = reach.functions().map(|(_, path)| path).collect();
        assert_eq!(paths, ["tick", "tick → callee"]);
        let jumps = image([0xbf00, 0x469f, 0x4770]); // mov pc, r3
        let error = Reach::of(&jumps, |f| f.is_named(|name| name == "tick")).err();
        let error = error.expect("refused").to_string();
        assert!(error.contains("tick → callee calls through a register at 0x1012"), "{error}");
        assert!(Reach::of(&jumps, |_| false).is_err());
    }

    #[test]
    fn a_function_that_is_left_in_flash_is_named_with_its_path() {
        let caller = Function::of("tick", 0x1000, &[0xf000, 0xf806, 0x4770]); // bl 0x1010; bx lr
        let mut image = Image::of(vec![caller, Function::of("callee", 0x1010, &[0x4770])]);
        for (end, path) in [(0x1010, "tick → callee waits"), (0x1000, "tick waits")] {
            image.fast = 0x1000..end;
            let error = placed(&image, "tick").expect_err(path).to_string();
            assert!(error.contains(path), "{error}");
        }
        image.fast = 0x1000..0x1012;
        placed(&image, "tick").expect("both are placed");
        // movw ip, #0x2001; movt ip, #0x0800; bx ip
        let veneer = [0xf242, 0x0c01, 0xf6c0, 0x0c00, 0x4760];
        image.functions[1] = Function::of("veneer", 0x1010, &veneer);
        image.functions.push(Function::of("far", 0x0800_2000, &[0x4770]));
        let error = placed(&image, "tick").expect_err("a veneer into flash").to_string();
        assert!(error.contains("tick → veneer → far waits"), "{error}");
    }

    #[test]
    fn a_jump_into_a_table_of_branches_is_followed() {
        // addw r1, pc, #4; add.w r2, r1, r9, lsl #2; mov pc, r2; nop; b.w 0x2000; then with a table
        // elsewhere, and without one
        let code = [0xF20F, 0x0108, 0xEB01, 0x0289, 0x4697, 0xBF00, 0xF000, 0xBFF8];
        let with = |at: usize, halfword: u16| {
            let mut changed = code;
            changed[at] = halfword;
            let table = Function::of("tick", 0x1000, &changed);
            Image::of(vec![table, Function::of("callee", 0x2000, &[0x4770])])
        };
        let paths = |image: &Image| {
            let reach = Reach::of(image, |f| f.is_named(|name| name == "tick"))?;
            crate::kit::error::Result::Ok(reach.functions().count())
        };
        assert_eq!(paths(&with(5, 0xBF00)).expect("a table"), 2);
        for (at, wrong) in [(0, 0xF20E), (1, 0x010C), (4, 0x4710), (6, 0xBF00)] {
            assert!(paths(&with(at, wrong)).is_err(), "halfword {at}");
        }
    }
}
