//! Modelled cycles by the most and the least favourable reading of the manual, where it leaves
//! room.

use crate::kit::error::{Result, check, refuse_if};

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

/// The smallest and the largest share of the chosen cycles, of several brackets.
///
/// # Errors
/// A bracket is not in its order, or there is none.
pub fn shares(of: impl IntoIterator<Item = [u64; 3]>) -> Result<[f64; 2]> {
    let mut shares: Option<[f64; 2]> = None;
    for readings in of {
        let [low, high] = bracket(readings)?.map(|cycles| cycles as f64 / readings[1] as f64);
        let [lowest, highest] = shares.unwrap_or([low, high]);
        shares = Some([lowest.min(low), highest.max(high)]);
    }
    shares.ok_or_else(|| check!("no cycles were measured by other readings"))
}

#[cfg(test)]
mod tests {
    use super::{bracket, shares};

    #[test]
    fn readings_out_of_order_are_refused() {
        assert!(bracket([7, 8, 9]).is_ok() && bracket([8, 8, 8]).is_ok());
        assert!(bracket([9, 8, 9]).is_err() && bracket([7, 8, 7]).is_err());
    }

    #[test]
    fn the_shares_are_the_widest_of_all() {
        let of = shares([[90, 100, 105], [190, 200, 230]]).expect("two");
        assert_eq!(of, [0.9, 1.15]);
        assert!(shares([]).is_err() && shares([[9, 8, 9]]).is_err());
    }
}
