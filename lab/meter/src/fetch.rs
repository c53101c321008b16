//! Instruction fetch from flash that waits: the cycles that a sequence takes beyond those of memory
//! that never waits. Its sources and its limits stand in the crate's documentation.

use std::num::NonZeroUsize;

use lru::LruCache;

use crate::insn::Insn;

/// A chip's flash, as its reference manual describes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flash {
    /// Bytes that one read of the flash gives.
    line: u32,
    /// Cycles that a read takes beyond the first.
    waits: u64,
    /// The lines that the caches of code and of data hold.
    lines: [NonZeroUsize; 2],
}

impl Flash {
    const fn new(line: u32, waits: u64, lines: [usize; 2]) -> Self {
        let [code, data] = lines;
        let some = "a cache holds a line";
        let lines = [NonZeroUsize::new(code).expect(some), NonZeroUsize::new(data).expect(some)];
        Self { line, waits, lines }
    }
}

/// STM32G474 at 170 MHz with two banks (RM0440, 3.3.3 to 3.3.5); the STM32L413 at 80 MHz is alike.
pub const G474: Flash = Flash::new(8, 4, [128, 32]);

/// STM32F405 at 168 MHz and 2.7 V or more (RM0090, 3.5).
pub const F405: Flash = Flash::new(16, 5, [64, 8]);

/// The flashes of [`Sample::waits`](crate::Sample::waits), in its order.
pub const FLASHES: [Flash; 2] = [G474, F405];

/// From here on the model fetches code without waits. The machine of QEMU has no memory where these
/// chips have one that is coupled to the core (0x1000_0000), so that code which a board runs there
/// is linked to this address, the upper half of the machine's RAM, when it is measured.
pub const COUPLED: u32 = 0x2001_0000;

/// RAM on the system bus, from which a core fetches a word in two cycles at least.
const RAM: u32 = 0x2000_0000;

/// An address at which no instruction stands.
const NOWHERE: u32 = u32::MAX;

/// Whether this is flash: coupled memory comes next.
pub fn in_flash(address: u32) -> bool {
    address < 0x1000_0000
}

fn waits(address: u32) -> bool {
    in_flash(address) || (RAM..COUPLED).contains(&address)
}

/// Words that the core fetches ahead of the instruction that it decodes.
const AHEAD: u32 = 3;

/// The core's queue of words, the caches and the flash. All times are cycles, waits included.
#[derive(Debug)]
pub struct Fetch {
    flash: Flash,
    /// What has been waited for so far.
    waits: u64,
    /// When the next instruction executes if its words have come.
    now: u64,
    /// When the last one began to execute.
    before: u64,
    /// The address at which the next instruction is expected; another one empties the queue.
    next: u32,
    /// The word that is fetched next, and when the one before it came.
    word: u32,
    came: u64,
    /// For word n at n modulo 4: when there is room for it, and when it came.
    queue: [(u64, u64); 4],
    /// The line of the last word, and when it came.
    line: (u32, u64),
    /// Lines that were read, and when each of them had come.
    code: LruCache<u32, u64>,
    data: LruCache<u32, u64>,
    /// When the flash can be read again.
    free: u64,
}

impl Fetch {
    pub fn new(flash: Flash) -> Self {
        Self {
            flash,
            waits: 0,
            // Room for what is fetched before the first instruction.
            now: 8,
            before: 8,
            next: NOWHERE,
            word: 0,
            came: 0,
            queue: [(0, 0); 4],
            line: (NOWHERE, 0),
            code: LruCache::new(flash.lines[0]),
            data: LruCache::new(flash.lines[1]),
            free: 0,
        }
    }

    /// The cycles that have been waited for.
    pub fn waits(&self) -> u64 {
        self.waits
    }

    /// Executes the instruction at an address that loads from these places in flash, and takes this
    /// many cycles without waits.
    pub fn step(
        &mut self,
        address: u32,
        insn: &Insn,
        loads: impl Iterator<Item = u32>,
        cycles: u64,
    ) {
        let end = address.wrapping_add(u32::from(insn.size));
        if waits(address) {
            self.take(address, end);
        }
        for load in loads {
            let line = load / self.flash.line;
            let comes = match self.data.get(&line) {
                Some(&comes) => comes,
                None => self.read(line, self.now, |fetch| &mut fetch.data),
            };
            self.wait_until(comes);
        }
        self.before = self.now;
        self.now += cycles;
        self.next = if waits(address) { end } else { NOWHERE };
    }

    /// The last instruction branched, and refilling the pipeline takes this many cycles.
    pub fn branch(&mut self, refill: u64) {
        // Until the branch was executed, the words behind it were fetched.
        if self.next != NOWHERE {
            self.fetch_before(self.now, self.next / 4 + AHEAD);
        }
        self.now += refill;
        self.interrupt();
    }

    /// Something else was executed, so that the queue holds nothing of use.
    pub fn interrupt(&mut self) {
        self.next = NOWHERE;
    }

    /// Takes the words of an instruction out of the queue, and waits for them.
    fn take(&mut self, address: u32, end: u32) {
        let (first, last) = (address / 4, (end - 1) / 4);
        if address != self.next {
            // The refill leaves time for the first instruction's words, whatever its alignment.
            self.word = first;
            self.came = self.now - 2 - u64::from(last - first);
            self.queue = [(self.came, 0); 4];
        }
        self.fetch_before(u64::MAX, last + 1);
        let decoded = self.queue[last as usize % 4].1;
        self.wait_until(decoded + 1);
        for word in first..end / 4 {
            let freed = (word + AHEAD) as usize % 4;
            self.queue[freed].0 = decoded.max(self.before);
        }
        self.fetch_before(self.now, end / 4 + AHEAD);
    }

    fn wait_until(&mut self, time: u64) {
        let waits = time.saturating_sub(self.now);
        self.waits += waits;
        self.now += waits;
    }

    /// Fetches words as long as they start before a time, up to the word `end`.
    fn fetch_before(&mut self, time: u64, end: u32) {
        while self.word < end {
            let slot = self.word as usize % 4;
            let start = self.came.max(self.queue[slot].0);
            if start >= time {
                break;
            }
            let comes = match in_flash(self.word * 4) {
                true => self.fetch(self.word * 4 / self.flash.line, start),
                false => start + 1,
            };
            self.came = comes + 1;
            self.queue[slot].1 = self.came;
            self.word += 1;
        }
    }

    /// When a word of a line can be had that is asked for at a time. The first word of each line
    /// makes the flash read the next one too; whatever is read enters the cache.
    fn fetch(&mut self, line: u32, time: u64) -> u64 {
        if line != self.line.0 {
            let comes = match self.code.get(&line) {
                Some(&comes) => comes.max(time),
                None => self.read(line, time, |fetch| &mut fetch.code),
            };
            self.line = (line, comes);
            if self.code.get(&(line + 1)).is_none() {
                self.read(line + 1, comes, |fetch| &mut fetch.code);
            }
        }
        self.line.1.max(time)
    }

    /// Reads a line once the flash has finished what it does.
    fn read(
        &mut self,
        line: u32,
        time: u64,
        cache: fn(&mut Self) -> &mut LruCache<u32, u64>,
    ) -> u64 {
        let comes = time.max(self.free) + self.flash.waits;
        self.free = comes + 1;
        cache(self).put(line, comes);
        comes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::insn::Class;

    const WIDE: Insn = Insn::new(Class::Integer, 4);

    /// The waits of instructions of four bytes, one after the other, which take these cycles.
    fn straight(fetch: &mut Fetch, start: u32, cycles: &[u64]) -> u64 {
        let before = fetch.waits();
        for (address, cycles) in (start..).step_by(4).zip(cycles) {
            fetch.step(address, &WIDE, std::iter::empty(), *cycles);
        }
        fetch.waits() - before
    }

    #[test]
    fn straight_code_takes_what_reading_its_lines_takes() {
        // The first line is waited for; then two instructions execute while five cycles read the
        // next line, or four while six do.
        assert_eq!(straight(&mut Fetch::new(G474), 0x100, &[1; 20]), 4 + 9 * (5 - 2));
        assert_eq!(straight(&mut Fetch::new(F405), 0x100, &[1; 20]), 5 + 4 * (6 - 4));
    }

    #[test]
    fn slow_instructions_hide_the_reading_of_the_next_line() {
        assert_eq!(straight(&mut Fetch::new(G474), 0x100, &[3; 20]), 4);
        // While one takes long, the next one is decoded, three words are queued, the last of them
        // word 4, and line 3 is read. Line 4 is asked for by word 6, early enough; line 5 is not.
        for (words, waits) in [(10, 4), (11, 4 + 3)] {
            let mut cycles = vec![1; words];
            cycles[0] = 20;
            assert_eq!(straight(&mut Fetch::new(G474), 0x100, &cycles), waits);
        }
    }

    #[test]
    fn a_loop_waits_once_if_the_cache_holds_it() {
        // Each of the caches holds 256 words.
        for flash in FLASHES {
            for (words, is_held) in [(248, true), (264, false)] {
                let mut fetch = Fetch::new(flash);
                let passes = [0; 3].map(|_| {
                    let waits = straight(&mut fetch, 0x100, &vec![1; words]);
                    fetch.branch(2);
                    waits
                });
                assert!(passes[0] > 100, "{flash:?}: {passes:?}");
                assert_eq!(passes[2] == 0, is_held, "{flash:?}, {words}: {passes:?}");
            }
        }
    }

    #[test]
    fn a_branch_waits_for_a_line_that_no_cache_holds() {
        let mut fetch = Fetch::new(G474);
        straight(&mut fetch, 0x100, &[1, 20]);
        fetch.branch(2);
        assert_eq!(straight(&mut fetch, 0x800, &[20]), 4);
        fetch.branch(2);
        assert_eq!(straight(&mut fetch, 0x100, &[20]), 0);
        // Reads are not broken off: a branch at once finds the flash busy with the next two lines,
        // since their first word was asked for, which leaves eight of ten cycles.
        fetch.branch(2);
        let waits = straight(&mut fetch, 0x2000, &[1]);
        fetch.branch(2);
        assert_eq!((waits, straight(&mut fetch, 0x3000, &[1])), (4, 4 + 8));
    }

    #[test]
    fn a_load_waits_for_the_flash_and_then_is_in_its_cache() {
        let mut fetch = Fetch::new(G474);
        straight(&mut fetch, 0x100, &[20]);
        for (address, waits) in [(0x800, 4), (0x804, 0), (0x800, 0), (0x808, 4), (0x806, 0)] {
            let before = fetch.waits();
            fetch.step(fetch.next, &WIDE, [address].into_iter(), 20);
            assert_eq!(fetch.waits() - before, waits, "{address:#x}");
        }
    }

    #[test]
    fn ram_on_the_system_bus_gives_a_word_in_two_cycles() {
        assert_eq!(straight(&mut Fetch::new(G474), RAM, &[1; 20]), 20);
        assert_eq!(straight(&mut Fetch::new(G474), RAM, &[2; 20]), 1);
    }

    #[test]
    fn coupled_memory_and_a_flash_without_wait_states_cost_nothing() {
        let none = Flash { waits: 0, ..G474 };
        for (flash, start) in [(G474, COUPLED), (F405, 0x1000_0000), (none, 0x102)] {
            let mut fetch = Fetch::new(flash);
            for target in [0, 6, 12, 0x1000, 2] {
                assert_eq!(straight(&mut fetch, start + target, &[1, 1, 3, 1, 1, 1, 1]), 0);
                fetch.branch(2);
            }
        }
    }
}
