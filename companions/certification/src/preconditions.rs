//! What every bound of cycles and stack holds for.

use serde::Serialize;

/// What bounds hold for; it is part of the JSON.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Preconditions {
    core: &'static str,
    wait_states: u32,
    memory: &'static str,
    interrupts: &'static str,
    divider: &'static str,
    pointers: &'static str,
    copies: &'static str,
}

impl Preconditions {
    /// Each with its name.
    pub fn named(&self) -> [(&'static str, &'static str); 6] {
        [
            ("core", self.core),
            ("memory", self.memory),
            ("interrupts", self.interrupts),
            ("divider", self.divider),
            ("pointers", self.pointers),
            ("copies", self.copies),
        ]
    }
}

/// What every bound of cycles and stack holds for.
pub const PRECONDITIONS: Preconditions = Preconditions {
    core: "Cortex-M4F without wait states, by the model of the cycle meter",
    wait_states: 0,
    memory: "code and constants in flash at 0x08000000, stack and variables in RAM at 0x20000000",
    interrupts: "none within the cycles; one, with the state of the FPU, within the stack",
    divider: "no division is pending at the call",
    pointers: "a pointer that the caller gives reaches no word of the stack that the compiler keeps for itself",
    copies: "what is copied and cleared at once, by `memcpy` and its kin, lies at multiples of four",
};
