//! The memory of a controller, which C owns: the only code of this crate that has to be trusted
//! with pointers.

use core::mem::MaybeUninit;
use core::ptr::NonNull;

use crate::control::Control;
use crate::scene::{MOST_POINTS, N};
use crate::status;

/// The bytes that the header reserves: enough for every target.
pub const BYTES: usize = 256 + 32 * MOST_POINTS + N * (144 + 16 * MOST_POINTS);

/// The mark that distinguishes the memory of a controller from any other: a word that zeros, random
/// bytes and the controllers of other libraries and versions do not have.
const MAGIC: u64 = (library() ^ size_of::<Slot>() as u64) | 1;

/// A number of this library and its version: the hash of Fowler, Noll and Vo of their names.
pub(crate) const fn library() -> u64 {
    let name = concat!(env!("CARGO_CRATE_NAME"), env!("CARGO_PKG_VERSION")).as_bytes();
    let (mut hash, mut k) = (0xcbf2_9ce4_8422_2325_u64, 0);
    while k < name.len() {
        hash = (hash ^ name[k] as u64).wrapping_mul(0x0000_0100_0000_01b3);
        k += 1;
    }
    hash
}

/// An object in memory of C's: the first word says whether there is one.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Kept<T: Copy> {
    magic: u64,
    value: MaybeUninit<T>,
}

impl<T: Copy> Kept<T> {
    const MAGIC: u64 = (library() ^ size_of::<Self>() as u64) | 1;

    pub(crate) const fn of(value: T) -> Self {
        const { assert!(align_of::<Self>() <= align_of::<u64>(), "the header aligns to 8 bytes") };
        Self { magic: Self::MAGIC, value: MaybeUninit::new(value) }
    }

    /// The object that C passes, if there is one.
    pub(crate) fn get(this: Option<&Self>) -> Result<&T, i32> {
        let this = this.ok_or(status::NULL)?;
        if this.magic != Self::MAGIC {
            return Err(status::MEMORY);
        }
        // SAFETY: only `of` writes the word, together with a value.
        Ok(unsafe { this.value.assume_init_ref() })
    }

    /// The same, to be changed.
    pub(crate) fn get_mut(this: Option<&mut Self>) -> Result<&mut T, i32> {
        Self::get(this.as_deref())?;
        let this = this.ok_or(status::NULL)?;
        // SAFETY: as above.
        Ok(unsafe { this.value.assume_init_mut() })
    }
}

/// A controller in its memory.
#[repr(C)]
struct Slot {
    magic: u64,
    control: Control,
}

const _: () = assert!(size_of::<Slot>() <= BYTES, "the header reserves too few bytes");
const _: () = assert!(align_of::<Slot>() <= align_of::<u64>(), "the header aligns to 8 bytes");

/// A pointer to the memory of a controller. Null is `None` of an `Option`; what else C has to
/// guarantee is in the header: it points to a whole object of the header's type.
#[repr(transparent)]
#[derive(Clone, Copy, Debug)]
pub struct Handle(NonNull<u8>);

/// The memory of a controller, for tests in Rust.
#[repr(C, align(8))]
#[derive(Clone, Copy, Debug)]
pub struct Memory([MaybeUninit<u8>; BYTES]);

impl Memory {
    /// Memory without a controller.
    pub const fn new() -> Self {
        Self::filled(0)
    }

    /// Memory of equal bytes.
    pub const fn filled(byte: u8) -> Self {
        Self([MaybeUninit::new(byte); BYTES])
    }

    /// Overwrites its first byte.
    pub fn spoil(&mut self, byte: u8) {
        self.0[0] = MaybeUninit::new(byte);
    }

    /// The pointer that C passes for it.
    pub fn handle(&mut self) -> Option<Handle> {
        NonNull::new(self.0.as_mut_ptr().cast()).map(Handle)
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::new()
    }
}

impl Handle {
    fn slot(self) -> Option<NonNull<Slot>> {
        let slot = self.0.cast::<Slot>();
        slot.as_ptr().is_aligned().then_some(slot)
    }

    /// Puts a controller into the memory, of which C says that it has `bytes`; false if it does not
    /// fit.
    pub(crate) fn place(self, bytes: usize, control: Control) -> bool {
        let Some(slot) = self.slot().filter(|_| bytes >= size_of::<Slot>()) else {
            return false;
        };
        let magic = MAGIC;
        // SAFETY: the pointer is not null, it is aligned, and the memory behind it has the size of
        // a slot.
        unsafe { slot.write(Slot { magic, control }) };
        true
    }

    /// The controller in the memory; none if no controller of this library was placed there.
    pub(crate) fn control<'a>(self) -> Option<&'a mut Control> {
        let mut slot = self.slot()?;
        // SAFETY: the pointer is not null and aligned, and an object of the header's type is at
        // least as large as a slot. The read is volatile, since C may have left the word without a
        // value: it is then any number.
        let magic = unsafe { (&raw const (*slot.as_ptr()).magic).read_volatile() };
        if magic != MAGIC {
            return None;
        }
        // SAFETY: only `place` writes the word, together with a controller. The header forbids
        // calls with the same memory at the same time, so that no other reference exists during
        // this call.
        Some(&mut unsafe { slot.as_mut() }.control)
    }
}
