//! The same f32 numbers have the same bits on every machine: digests to compare them by.

/// A digest of many results' bits (FNV-1a, 64 bits).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(pub u64);

impl Digest {
    /// The digest of no result.
    pub const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    /// Adds the bits of some results, in their order.
    ///
    /// ```
    /// use firmware_demo::digest::Digest;
    /// let [mut plus, mut minus] = [Digest::EMPTY; 2];
    /// plus.add([0.0]);
    /// minus.add([-0.0]);
    /// assert_ne!(plus, minus);
    /// ```
    pub fn add<const N: usize>(&mut self, values: [f32; N]) {
        for byte in values.iter().flat_map(|x| x.to_bits().to_le_bytes()) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}
