//! Memory that C owns: the only code that has to be trusted with pointers.

use core::marker::PhantomData;
use core::mem::MaybeUninit;
use core::ptr::NonNull;

use crate::control::Control;
use crate::{Exports, Library, Named, numbers, status};

/// The mark of an object of this size: a word that zeros, random bytes and the objects of other
/// libraries and versions do not have.
const fn magic<L: Named>(size: usize) -> u64 {
    (L::HASH ^ size as u64) | 1
}

/// An argument as C passes it: a number, or a pointer, which may be null.
pub trait Argument {
    /// C's type, of the same bits.
    type Raw: Copy;

    /// Whether it may be read. An unaligned access is a fault of some processors, and undefined in
    /// Rust on all.
    #[inline(always)]
    fn is_aligned(_: Self::Raw) -> bool {
        true
    }
}

impl<T> Argument for Option<&T> {
    type Raw = *const T;

    #[inline(always)]
    fn is_aligned(raw: *const T) -> bool {
        raw.is_aligned()
    }
}

impl<T> Argument for Option<&mut T> {
    type Raw = *mut T;

    #[inline(always)]
    fn is_aligned(raw: *mut T) -> bool {
        raw.is_aligned()
    }
}

/// It looks at its pointer itself: a command is written without it.
impl Argument for Option<Handle> {
    type Raw = Self;
}

macro_rules! numbers {
    ($($number:ty)*) => {$( impl Argument for $number { type Raw = Self; } )*};
}
numbers!(i32 u32 usize f32);

/// An object in memory of C's: the first word says whether there is one.
#[repr(C)]
#[derive(Debug)]
pub struct Kept<T: Copy, L> {
    magic: u64,
    value: MaybeUninit<T>,
    library: PhantomData<L>,
}

impl<T: Copy, L> Clone for Kept<T, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Copy, L> Copy for Kept<T, L> {}

impl<T: Copy, L: Named> Kept<T, L> {
    const MAGIC: u64 = magic::<L>(size_of::<Self>());

    pub(crate) const fn of(value: T) -> Self {
        const { assert!(align_of::<Self>() <= align_of::<u64>(), "the header aligns to 8 bytes") };
        Self { magic: Self::MAGIC, value: MaybeUninit::new(value), library: PhantomData }
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
struct Slot<L, const N: usize, const TOOL: usize, const POINTS: usize> {
    magic: u64,
    control: Control<L, N, TOOL, POINTS>,
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The bytes that the header reserves for a controller.
    pub const CONTROLLER_BYTES: usize = numbers::CONTROLLER_BYTES(N, POINTS);
    /// Fails to compile if the header reserves too few bytes for it.
    pub(crate) const CONTROLLER_FITS: () = {
        assert!(size_of::<Slot<L, N, TOOL, POINTS>>() <= Self::CONTROLLER_BYTES);
        assert!(align_of::<Slot<L, N, TOOL, POINTS>>() <= align_of::<u64>());
    };
}

/// A pointer to the memory of a controller. Null is `None` of an `Option`; what else C has to
/// guarantee is in the header: it points to a whole object of the header's type.
#[repr(transparent)]
#[derive(Clone, Copy, Debug)]
pub struct Handle(NonNull<u8>);

impl Handle {
    /// The pointer that C passes.
    ///
    /// # Safety
    /// It points to memory as the header describes it, which has [`Exports::CONTROLLER_BYTES`].
    pub const unsafe fn new(memory: NonNull<u8>) -> Self {
        Self(memory)
    }

    fn slot<T>(self) -> Option<NonNull<T>> {
        let slot = self.0.cast::<T>();
        slot.as_ptr().is_aligned().then_some(slot)
    }

    /// Puts a controller into the memory, of which C says that it has `bytes`; false if it does not
    /// fit.
    pub(crate) fn place<L: Named, const N: usize, const TOOL: usize, const POINTS: usize>(
        self,
        bytes: usize,
        control: Control<L, N, TOOL, POINTS>,
    ) -> bool {
        let size = size_of::<Slot<L, N, TOOL, POINTS>>();
        let Some(slot) = self.slot().filter(|_| bytes >= size) else {
            return false;
        };
        let magic = const { magic::<L>(size_of::<Slot<L, N, TOOL, POINTS>>()) };
        // SAFETY: the pointer is not null, it is aligned, and the memory behind it has the size of
        // a slot.
        unsafe { slot.write(Slot { magic, control }) };
        true
    }

    /// The controller in the memory; none if no controller of this library was placed there.
    pub(crate) fn control<'a, L: Named, const N: usize, const TOOL: usize, const POINTS: usize>(
        self,
    ) -> Option<&'a mut Control<L, N, TOOL, POINTS>> {
        let mut slot = self.slot::<Slot<L, N, TOOL, POINTS>>()?;
        // SAFETY: the pointer is not null and aligned, and an object of the header's type is at
        // least as large as a slot. The read is volatile, since C may have left the word without a
        // value: it is then any number.
        let found = unsafe { (&raw const (*slot.as_ptr()).magic).read_volatile() };
        if found != const { magic::<L>(size_of::<Slot<L, N, TOOL, POINTS>>()) } {
            return None;
        }
        // SAFETY: only `place` writes the word, together with a controller. The header forbids
        // calls with the same memory at the same time, so that no other reference exists during
        // this call.
        Some(&mut unsafe { slot.as_mut() }.control)
    }
}
