//! Modelled cycles by the most and the least favourable reading of the manual, where it leaves
//! room.

use crate::kit::error::{Result, refuse_if};

/// The readings by the names that the cycle meter has for them, beside the chosen one of every
/// other figure.
pub const READINGS: [&str; 2] = ["least", "most"];

/// The fewest and the most cycles, from those by the most favourable, the chosen and the least
/// favourable reading.
///
/// # Errors
/// They are not in this order.
pub fn bracket([least, chosen, most]: [u64; 3]) -> Result<[u64; 2]> {
    refuse_if!(
        least > chosen || chosen > most,
        "the readings of the manual are not in their order: {least}, {chosen}, {most} cycles"
    );
    Ok([least, most])
}

#[cfg(test)]
mod tests {
    use super::bracket;

    #[test]
    fn readings_out_of_order_are_refused() {
        assert!(bracket([7, 8, 9]).is_ok() && bracket([8, 8, 8]).is_ok());
        assert!(bracket([9, 8, 9]).is_err() && bracket([7, 8, 7]).is_err());
    }
}
