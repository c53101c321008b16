//! The sum at the end of what a command writes: a digit that is changed by hand is seen without
//! measuring anew, whichever part of the figures a step measures.

use sha2::{Digest, Sha256};

const BEFORE: &str = "<!-- sum of the above: ";

/// A text with its sum as its last line.
pub fn sealed(text: &str) -> String {
    let text = text.trim();
    format!("{text}\n{BEFORE}{} -->\n", sum(text))
}

/// A text without its sum.
pub fn unsealed(text: &str) -> &str {
    let text = text.trim();
    text.rsplit_once(BEFORE).map_or(text, |(text, _)| text).trim()
}

/// Whether a text ends with its sum.
#[cfg(test)]
pub fn is_sealed(text: &str) -> bool {
    text.trim() == sealed(unsealed(text)).trim()
}

/// The first half of a SHA-256.
fn sum(text: &str) -> String {
    let digest = Sha256::digest(text);
    digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}
