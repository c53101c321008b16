//! The lines of places in a text, found once for all of them.

/// The lines of offsets, from 1.
pub struct Lines(Vec<u32>);

impl Lines {
    /// Finds the lines of a text.
    pub fn of(text: &str) -> Self {
        let ends = text.bytes().enumerate();
        Self(ends.filter(|(_, byte)| *byte == b'\n').map(|(i, _)| i as u32).collect())
    }

    /// The line of an offset.
    pub fn line(&self, offset: u32) -> u32 {
        self.0.partition_point(|end| *end < offset) as u32 + 1
    }
}
