//! What an error that hardly matters has to save.

use super::front;
use super::point::Point;
use super::words::{digits, name};
use crate::error::{Error, Result};

/// The error, as a share of full scale.
const ERROR: f64 = 1e-3;

/// What a point of the front may cost of the default at that error: its worst tick, its mean.
const MOST: [f64; 2] = [0.85, 0.6];

/// The cheapest within [`ERROR`], by the worst tick and by the mean, each with its share of the default's cost.
fn cheapest<'a>(points: &[&'a Point]) -> Option<[(&'a Point, f64); 2]> {
    let default = points.iter().find(|point| point.is_default())?;
    let of = |cost: usize| {
        let within = |point: &&Point| point.relative_max.is_some_and(|share| share <= ERROR);
        let point = front::front(points, cost).into_iter().find(within)?;
        Some((point, point.costs()[cost] / default.costs()[cost]))
    };
    Some([of(0)?, of(1)?])
}

/// In a sentence.
pub fn told(points: &[&Point]) -> String {
    let Some([worst, mean]) = cheapest(points) else {
        return String::new();
    };
    let share = |share: f64| format!("{:.0} %", 100.0 * share);
    format!(
        "Within {} of full scale, the cheapest worst tick is {} of the default's (*{}*) and the cheapest mean {} \
         (*{}*).\n\n",
        digits(ERROR),
        share(worst.1),
        name(worst.0),
        share(mean.1),
        name(mean.0)
    )
}

/// Fails unless so much is saved; else says how much.
pub fn check(points: &[&Point]) -> Result<String> {
    let cheapest = cheapest(points);
    let seen =
        cheapest.ok_or_else(|| Error::check("nothing on the front is within the bar's error"))?;
    let [worst, mean] = seen.map(|(_, share)| share);
    if worst > MOST[0] || mean > MOST[1] {
        return Err(Error::check(format!(
            "bar: within {ERROR} of full scale, the cheapest worst tick is {worst:.3} of the default's, its mean \
             {mean:.3}; at most {} and {}",
            MOST[0], MOST[1]
        )));
    }
    Ok(format!(
        "{worst:.3} of the worst tick, {mean:.3} of the mean"
    ))
}

#[cfg(test)]
mod tests {
    use super::super::front::mark;
    use super::super::front::tests::point;
    use super::super::point::Point;
    use super::check;

    #[test]
    fn the_bars_are_of_the_default() {
        let mut points = [
            point("default", 1e-6, 1000, 1000.0),
            point("trig=table", 1e-4, 800, 800.0),
            point("rate=10", 5e-4, 1200, 500.0),
            point("model=gravity", 1.0, 100, 100.0),
        ];
        for point in &mut points {
            point.relative_max = point.error_max;
        }
        mark(&mut points);
        let all: Vec<&Point> = points.iter().collect();
        assert_eq!(
            check(&all).expect("met"),
            "0.800 of the worst tick, 0.500 of the mean"
        );
        assert!(check(&all[..2]).is_err());
    }
}
