//! The largest stack of a function and of all that it calls, read from the machine code of a
//! Cortex-M.

use std::collections::BTreeMap;

use super::frame;
use xtask::kit::elf::{Function, Image, is_f64, is_panic};
use xtask::kit::error::{Result, bail, check, refuse_if};

/// A function while it is walked, and its stack afterwards.
enum State {
    Open,
    Known(u64),
}

/// The largest sum of frames along a chain of calls from the function at an address: no call of it
/// takes more stack.
///
/// # Errors
/// Something in reach calls through a register, calls itself, takes a frame whose size the code
/// does not say, leaves the known functions, computes in f64, or panics.
pub fn stack(image: &Image, address: u64) -> Result<u64> {
    let unwanted = |name: &str| is_f64(name) || is_panic(name);
    // The lowest bit says Thumb and is no part of the address.
    stack_of(image, unwanted, address & !1, &mut BTreeMap::new())
}

/// As [`stack`], of a function that may compute in f64 and panic.
///
/// # Errors
/// As [`stack`], without those two.
pub fn stack_of_start(image: &Image, address: u64) -> Result<u64> {
    stack_of(image, |_| false, address & !1, &mut BTreeMap::new())
}

/// The stack of the function that an address lies in, and of all that it calls.
fn stack_of(
    image: &Image,
    unwanted: fn(&str) -> bool,
    address: u64,
    known: &mut BTreeMap<usize, State>,
) -> Result<u64> {
    let index = image.functions.iter().position(|function| function.contains(address));
    let index = index.ok_or_else(|| check!("{address:#x} is in no function"))?;
    let function = &image.functions[index];
    let name = &function.names[0];
    match known.get(&index) {
        Some(State::Known(stack)) => return Ok(*stack),
        Some(State::Open) => bail!("`{name}` calls itself: its stack has no bound"),
        None => {}
    }
    if let Some(name) = function.names.iter().find(|name| unwanted(name)) {
        bail!("the tick reaches `{name}`");
    }
    known.insert(index, State::Open);
    let (frame, targets) = flow(function).map_err(|e| check!("`{name}`: {e}"))?;
    let mut deepest = 0;
    for target in targets.into_iter().filter(|target| !function.contains(*target)) {
        let callee = stack_of(image, unwanted, target, known);
        deepest = deepest.max(callee.map_err(|e| check!("`{name}` → {e}"))?);
    }
    let stack = frame + deepest;
    known.insert(index, State::Known(stack));
    Ok(stack)
}

/// The bytes of a function's frame, at most, and the targets of its calls and jumps.
///
/// Every instruction that lowers the stack pointer is added up, wherever in the function it stands:
/// the sum is a bound of the frame, since compilers lower it in the prologue and nowhere in a loop.
/// Instructions that restore it are left out.
fn flow(function: &Function) -> Result<(u64, Vec<u64>)> {
    refuse_if!(function.bytes.is_empty(), "it has no code");
    if let Some(at) = function.unknown_jump() {
        bail!("it calls through a register at {at:#x}");
    }
    let (mut frame, mut targets) = (0, Vec::from_iter(function.veneer()));
    for one in function.instructions() {
        frame += frame::thumb(one.code)
            .ok_or_else(|| check!("its frame at {:#x} is of an unknown size", one.address))?;
        targets.extend(one.target());
    }
    Ok((frame, targets))
}

#[cfg(test)]
mod tests {
    use super::{stack, stack_of_start};
    use xtask::kit::elf::{Function, Image};

    fn image(functions: &[(&str, u64, &[u16])]) -> Image {
        let function =
            |&(name, address, code): &(&str, u64, &[u16])| Function::of(name, address, code);
        Image::of(functions.iter().map(function).collect())
    }

    /// push {r4, lr}; sub sp, #8; bl 0x1020; bl 0x1040; pop {r4, pc}
    const CALLER: &[u16] = &[0xb510, 0xb082, 0xf000, 0xf80c, 0xf000, 0xf81a, 0xbd10];
    /// push {r4, r5, r6, lr}; bx lr
    const SHALLOW: &[u16] = &[0xb570, 0x4770];
    /// sub sp, #64; bx lr
    const DEEP: &[u16] = &[0xb090, 0x4770];

    #[test]
    fn the_stack_of_the_deepest_chain_counts() {
        let image = image(&[
            ("tick", 0x1000, CALLER),
            ("shallow", 0x1020, SHALLOW),
            ("deep", 0x1040, DEEP),
        ]);
        assert_eq!(stack(&image, 0x1001).expect("a bound"), 16 + 64);
    }

    #[test]
    fn what_has_no_bound_or_is_unwanted_is_named() {
        // bl 0x1000, at 0x1040.
        let recursive: &[u16] = &[0xf7ff, 0xffde, 0x4770];
        let indirect: &[u16] = &[0x4798, 0x4770]; // blx r3
        let dynamic: &[u16] = &[0xebad, 0x0d00, 0x4770]; // sub.w sp, sp, r0
        let of = |name, code| {
            image(&[("tick", 0x1000, CALLER), ("shallow", 0x1020, SHALLOW), (name, 0x1040, code)])
        };
        for (name, code, what) in [
            ("deep", recursive, "calls itself"),
            ("deep", indirect, "through a register"),
            ("deep", dynamic, "unknown size"),
            ("__aeabi_dadd", DEEP, "reaches `__aeabi_dadd`"),
            ("_ZN4core9panicking5panicE", DEEP, "panicking"),
        ] {
            let error = stack(&of(name, code), 0x1000).expect_err(what).to_string();
            assert!(error.contains(what), "{error}");
        }
        for name in ["__aeabi_d2f", "_ZN4core9panicking5panicE"] {
            let image = of(name, DEEP);
            assert!(stack_of_start(&image, 0x1000).is_ok());
            assert!(stack(&image, 0x1000).is_err(), "{name}");
        }
        let error = stack(&image(&[("tick", 0x1000, CALLER)]), 0x1000);
        assert!(error.expect_err("a gap").to_string().contains("0x1020 is in no function"));
    }
}
