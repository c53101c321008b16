//! The front: what nothing beats in error and cost at once.

use std::cmp::Ordering;

use super::point::Point;

/// Marks in each group those that no other one is as accurate as for less, in the worst tick and in
/// the mean.
pub fn mark(points: &mut [Point]) {
    let marks: Vec<[bool; 2]> = points
        .iter()
        .map(|point| [0, 1].map(|cost| point.error().is_finite() && !beaten(point, points, cost)))
        .collect();
    for (point, fronts) in points.iter_mut().zip(marks) {
        point.fronts = fronts;
        point.front = fronts.contains(&true);
    }
}

/// A cost or an error that is larger by no more is the same: not worth another change.
const SAME: f64 = 1.01;

/// Whether another one costs no more and errs no more, or hardly more with fewer things changed.
fn beaten(point: &Point, all: &[Point], cost: usize) -> bool {
    let no_worse = |one: &Point, than: &Point, slack: f64| {
        one.costs()[cost] <= slack * than.costs()[cost] && one.error() <= slack * than.error()
    };
    all.iter().filter(|other| other.group() == point.group() && other.key != point.key).any(
        |other| match other.changes().count().cmp(&point.changes().count()) {
            Ordering::Less => no_worse(other, point, SAME),
            Ordering::Equal => {
                let alike = no_worse(point, other, 1.0);
                no_worse(other, point, 1.0) && (!alike || other.key < point.key)
            }
            Ordering::Greater => no_worse(other, point, 1.0) && !no_worse(point, other, SAME),
        },
    )
}

/// The front of a group by a cost, from the cheapest on.
pub fn front<'a>(points: &[&'a Point], cost: usize) -> Vec<&'a Point> {
    let on = points.iter().copied().filter(|point| point.fronts[cost]);
    let mut front: Vec<&Point> = on.collect();
    front.sort_by(|a, b| a.costs()[cost].total_cmp(&b.costs()[cost]));
    front
}

#[cfg(test)]
pub mod tests {
    use super::super::point::Point;
    use super::{front, mark};

    /// A way of the robot `arm` with this key, error, and cost in the worst tick and in the mean.
    pub fn point(key: &str, error: f64, cycles: u64, mean: f64) -> Point {
        let mut point = Point {
            robot: "arm".into(),
            cycles,
            cycles_mean: mean,
            error_max: error.is_finite().then_some(error),
            unit: "N·m".into(),
            key: key.into(),
            ..Point::default()
        };
        let changes = point.changes();
        point.configuration =
            changes.map(|(axis, value)| (axis.to_owned(), value.to_owned())).collect();
        point
    }

    #[test]
    fn only_what_nothing_beats_is_on_the_front() {
        let mut points = [
            point("default", 1e-5, 1000, 1000.0),
            point("trig=a", 1e-3, 900, 900.0),
            point("trig=b", 2e-3, 900, 900.0),
            point("rate=10", 5e-2, 2000, 200.0),
            point("model=gravity", 10.0, 300, 300.0),
            point("arith=lost", f64::INFINITY, 1, 1.0),
            point("form=twin,trig=c", 1e-5, 1000, 1000.0),
        ];
        mark(&mut points);
        let all: Vec<_> = points.iter().collect();
        let keys = |cost| -> Vec<_> { front(&all, cost).iter().map(|p| &*p.key).collect() };
        assert_eq!(keys(0), ["model=gravity", "trig=a", "default"]);
        assert_eq!(keys(1), ["rate=10", "trig=a", "default"]);
        assert!(points[3].front && !points[2].front && !points[5].front && !points[6].front);
    }

    #[test]
    fn a_cycle_in_a_hundred_is_not_worth_a_change() {
        let mut points = [
            point("default", 1e-5, 1000, 1000.0),
            point("form=b", 1e-5, 995, 995.0),
            point("trig=a", 1e-3, 900, 900.0),
            point("trig=a,form=b", 1e-3, 880, 880.0),
        ];
        mark(&mut points);
        assert_eq!(points.map(|point| point.front), [true, false, false, true]);
    }

    #[test]
    fn robots_are_not_compared_with_each_other() {
        let mut points = [point("default", 1.0, 10, 10.0), point("default", 2.0, 20, 20.0)];
        points[1].robot = "leg".into();
        mark(&mut points);
        assert!(points[0].front && points[1].front);
    }
}
