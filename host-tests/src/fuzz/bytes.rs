//! Numbers out of bytes: ordinary ones, and those that nobody expects.

/// The bytes that are left.
#[derive(Clone, Copy, Debug)]
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// The next byte; 0 when there is none left.
    pub fn byte(&mut self) -> u8 {
        let (first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        *first
    }

    /// Whether there are bytes left.
    pub fn any(&self) -> bool {
        !self.0.is_empty()
    }

    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    fn bits<const N: usize>(&mut self) -> [u8; N] {
        core::array::from_fn(|_| self.byte())
    }

    /// Any number of f32, widened: one of two is of ordinary size.
    pub fn number(&mut self) -> f64 {
        match self.byte() % 16 {
            0 => f32::from_bits(u32::from_le_bytes(self.bits())).into(),
            1 => [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, 1e-40]
                [self.below(6)]
            .into(),
            2 => 0.0,
            3 => -0.0,
            4 => 1.0,
            5 => f64::from(i8::from_le_bytes(self.bits())),
            6 => core::f64::consts::FRAC_PI_2 * f64::from(self.byte()),
            7 => 1e6 * self.ordinary(),
            _ => self.ordinary(),
        }
    }

    /// Any number of f64.
    pub fn wide(&mut self) -> f64 {
        match self.byte() % 8 {
            0 => f64::from_bits(u64::from_le_bytes(self.bits())),
            1 => [f64::MAX, f64::MIN_POSITIVE, 1e-310, 1e154][self.below(4)],
            _ => self.number(),
        }
    }

    /// A number within ±4.
    pub fn ordinary(&mut self) -> f64 {
        f64::from(i16::from_le_bytes(self.bits())) / 8192.0
    }

    pub fn numbers<const N: usize>(&mut self) -> [f64; N] {
        core::array::from_fn(|_| self.number())
    }
}
