//! Words of which only a part is known: numbers, and names of what is not, with what can lie at
//! them as addresses.

/// A number plus what a name stands for: nothing if the name is 0, else a word of which nothing is
/// known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Word {
    name: u32,
    pub offset: u32,
}

/// The bits of a name that say where it can point: to the stack from the start on, or elsewhere.
const ON_STACK: u32 = 1 << 31;
const ELSEWHERE: u32 = 1 << 30;
/// The bit of a name of a multiple of four.
const ALIGNED: u32 = 1 << 29;
/// The stack pointer at the start, which is a multiple of eight, and its negative.
pub const STACK: Word = Word { name: 1 | ON_STACK, offset: 0 };
const NEGATED: u32 = 2 | ON_STACK;

pub fn number(offset: u32) -> Word {
    Word { name: 0, offset }
}

impl Word {
    pub fn number(self) -> Option<u32> {
        (self.name == 0).then_some(self.offset)
    }

    pub fn plus(self, offset: u32) -> Self {
        let offset = self.offset.wrapping_add(offset);
        Self { offset, ..self }
    }

    pub fn has_name_of(self, other: Self) -> bool {
        self.name == other.name
    }

    pub fn is_on_stack(self) -> bool {
        self.name == STACK.name
    }

    /// Whether it may be an address on the stack.
    pub fn may_be_on_stack(self) -> bool {
        self.name & ON_STACK != 0
    }

    /// The low bits of a mask, if alignment says them.
    pub fn aligned(self, mask: u32) -> Option<u32> {
        let multiple = match self.name {
            name if name == STACK.name || name == NEGATED => 8,
            name if name & ALIGNED != 0 => 4,
            _ => return None,
        };
        (mask < multiple).then_some(self.offset & mask)
    }

    /// The regions of memory that it can point to.
    fn places(self) -> u32 {
        match self.name {
            0 => ELSEWHERE,
            name => name & (ON_STACK | ELSEWHERE),
        }
    }

    /// Whether addresses of different names can be of one word.
    pub fn may_meet(self, other: Self) -> bool {
        self.places() & other.places() != 0
    }
}

/// The source of names for words whose values are not known.
#[derive(Debug)]
pub struct Names {
    last: u32,
}

impl Names {
    pub fn new() -> Self {
        Self { last: 2 }
    }

    fn named(&mut self, places: u32) -> Word {
        self.last += 1;
        let name = self.last | places;
        Word { name, offset: 0 }
    }

    /// A word that is no address of the stack.
    pub fn fresh(&mut self) -> Word {
        self.named(ELSEWHERE)
    }

    /// A word that can be any address.
    pub fn any(&mut self) -> Word {
        self.named(ELSEWHERE | ON_STACK)
    }

    /// A word for one that is a multiple of four.
    pub fn aligned(&mut self, word: Word) -> Word {
        if word.number().is_some() || word.aligned(3).is_some() {
            return word;
        }
        self.named(word.places() | ALIGNED)
    }

    /// A number minus a word.
    pub fn difference(&mut self, value: u32, word: Word) -> Word {
        let offset = value.wrapping_sub(word.offset);
        let name = match word.aligned(3) {
            _ if word.is_on_stack() => NEGATED,
            Some(_) => self.named(word.places() | ALIGNED).name,
            None => self.of(&[word]).name,
        };
        Word { name, offset }
    }

    /// A word that was computed from these.
    pub fn of(&mut self, words: &[Word]) -> Word {
        let places = words.iter().fold(0, |all, word| all | word.places());
        self.named(places)
    }
}
