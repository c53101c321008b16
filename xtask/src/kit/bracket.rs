//! Modelled cycles by the most and the least favourable reading of the manual, where it leaves
//! room.

use crate::kit::error::{Result, refuse_if};
use crate::kit::table::thousands;

/// The readings by the names that the cycle meter has for them, beside the chosen one of every
/// other figure.
pub const READINGS: [&str; 2] = ["least", "most"];

/// The fewest and the most cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bracket {
    least: u64,
    most: u64,
}

impl Bracket {
    /// From the cycles by the most favourable, the chosen and the least favourable reading.
    ///
    /// # Errors
    /// They are not in this order.
    pub fn of(least: u64, chosen: u64, most: u64) -> Result<Self> {
        refuse_if!(
            least > chosen || chosen > most,
            "the readings of the manual are not in their order: {least}, {chosen}, {most} cycles"
        );
        Ok(Self { least, most })
    }

    pub fn words(self) -> String {
        format!("{} to {}", thousands(self.least), thousands(self.most))
    }
}

/// The smallest and the largest share of the chosen cycles, of several brackets.
///
/// # Errors
/// A bracket is not in its order, or there is none.
pub fn shares(of: impl IntoIterator<Item = [u64; 3]>) -> Result<[f64; 2]> {
    let mut shares: Option<[f64; 2]> = None;
    for [least, chosen, most] in of {
        let bracket = Bracket::of(least, chosen, most)?;
        let share = |cycles: u64| cycles as f64 / chosen as f64;
        let (low, high) = (share(bracket.least), share(bracket.most));
        let [lowest, highest] = shares.unwrap_or([low, high]);
        shares = Some([lowest.min(low), highest.max(high)]);
    }
    shares.ok_or_else(|| crate::kit::error::check!("no cycles were measured by other readings"))
}

#[cfg(test)]
mod tests {
    use super::{Bracket, shares};

    #[test]
    fn readings_out_of_order_are_refused() {
        let bracket = |least, chosen, most| Bracket::of(least, chosen, most);
        assert!(bracket(7, 8, 9).is_ok() && bracket(8, 8, 8).is_ok());
        assert!(bracket(9, 8, 9).is_err() && bracket(7, 8, 7).is_err());
        let words = bracket(1500, 2000, 2500).expect("in order").words();
        assert_eq!(words, "1,500 to 2,500");
    }

    #[test]
    fn the_shares_are_the_widest_of_all() {
        let of = shares([[90, 100, 105], [190, 200, 230]]).expect("two");
        assert_eq!(of, [0.9, 1.15]);
        assert!(shares([]).is_err() && shares([[9, 8, 9]]).is_err());
    }
}
