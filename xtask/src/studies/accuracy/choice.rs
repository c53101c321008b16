//! The choice: the cheapest way within an error, the most accurate one within a time.

use std::str::FromStr;

use super::names::{cycles, digits, lines, name, stated};
use super::page::percent;
use super::point::{Kind, Point, of_group};
use super::robot::Robot;
use super::{code, front};
use crate::kit::error::{Result, bail, check};
use crate::kit::table::thousands;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowed {
    /// In the unit of [`Allowed::kind`]: N·m or rad.
    pub error: f64,
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug)]
pub enum Budget {
    /// The cheapest within this error.
    Error(Allowed),
    /// The most accurate within this worst tick.
    Cycles(u64),
}

/// Cycles of a microsecond on a processor at 168 MHz.
const PER_MICROSECOND: f64 = 168.0;

/// Units by their names, each of which `m` makes a thousandth of.
const UNITS: [(&str, Kind); 3] =
    [("N·m", Kind::Inverse), ("Nm", Kind::Inverse), ("rad", Kind::Simulation)];

impl FromStr for Allowed {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let text = text.trim();
        let units = "an error is a torque in Nm or mNm (0.05Nm), for a simulation an angle in rad or mrad (2mrad)";
        let known = UNITS.iter().find_map(|(unit, kind)| Some((text.strip_suffix(unit)?, *kind)));
        let (number, kind) = known.ok_or_else(|| format!("{text} has no unit: {units}"))?;
        let (number, scale) = match number.strip_suffix('m') {
            Some(number) => (number, 1e-3),
            None => (number, 1.0),
        };
        match number.trim().parse::<f64>() {
            Ok(number) if number > 0.0 && number.is_finite() => {
                let error = number * scale;
                Ok(Self { error, kind })
            }
            Ok(_) => Err(format!("{text}: an error is more than nothing")),
            Err(_) => Err(format!("{text} does not begin with a number: {units}")),
        }
    }
}

impl Budget {
    pub fn group(self, robot: Robot) -> (&'static str, Kind, &'static str) {
        let kind = match self {
            Self::Error(allowed) => allowed.kind,
            Self::Cycles(_) => Kind::Inverse,
        };
        let circumstances = match kind {
            Kind::Simulation => "free",
            _ => "",
        };
        (robot.name(), kind, circumstances)
    }

    /// The point of the front that this allows.
    pub fn choose<'a>(self, points: &[&'a Point]) -> Result<&'a Point> {
        let front = front::front(points, 0);
        let (&[cheapest, ..], &[.., best]) = (&front[..], &front[..]) else {
            bail!("nothing was measured of this robot");
        };
        let unit = &best.unit;
        let mut within = front.iter().copied().filter(|point| match self {
            Self::Cycles(most) => point.cycles <= most,
            Self::Error(allowed) => point.error() <= allowed.error,
        });
        let (chosen, what, end) = match self {
            Self::Cycles(most) => {
                let what = format!("below {} cycles; the cheapest", thousands(most));
                (within.next_back(), what, cheapest)
            }
            Self::Error(allowed) => {
                let error = digits(allowed.error);
                let what = format!("off by less than {error} {unit}; the most accurate");
                (within.next(), what, best)
            }
        };
        chosen.ok_or_else(|| {
            let (cycles, error) = (thousands(end.cycles), digits(end.error()));
            let (name, front) = (name(end), "nothing on the front is");
            check!(
                "{front} {what} takes {cycles} cycles ({name}) and is off by up to {error} {unit}"
            )
        })
    }

    /// The cheapest in the mean that is no less accurate, if that is another one.
    fn in_the_mean<'a>(self, points: &[&'a Point], chosen: &Point) -> Option<&'a Point> {
        let allowed = match self {
            Self::Error(allowed) => allowed.error,
            Self::Cycles(_) => chosen.error(),
        };
        let front = front::front(points, 1);
        let point = front.into_iter().find(|point| point.error() <= allowed)?;
        (point.cycles_mean < 0.95 * chosen.cycles_mean).then_some(point)
    }

    /// The choice in words, with the Rust to paste.
    pub fn answer(self, points: &[&Point]) -> Result<String> {
        let chosen = self.choose(points)?;
        let default = points.iter().copied().find(|point| point.is_default());
        let mut text = described(chosen, default)?;
        if let Some(other) = self.in_the_mean(points, chosen) {
            text += "\nIf the mean over ticks matters rather than the worst tick:\n\n";
            text += &described(other, default)?;
        }
        let mut dearer = front::front(points, 0).into_iter();
        if let (Self::Cycles(_), Some(next)) = (self, dearer.find(|p| p.cycles > chosen.cycles)) {
            let (name, cycles, error) = (name(next), thousands(next.cycles), digits(next.error()));
            let unit = &next.unit;
            text += &format!(
                "\nThe next one, {name}, takes {cycles} cycles and is off by up to {error} {unit}.\n"
            );
        }
        Ok(text)
    }
}

/// The configurations of a group that the library ships, with their fronts.
pub fn shipped(points: &[Point], group: (&str, Kind, &str)) -> Vec<Point> {
    let own = of_group(points, group).into_iter();
    let mut own: Vec<Point> = own.filter(|point| code::rust(point).is_ok()).cloned().collect();
    front::mark(&mut own);
    own
}

/// A point's figures in words, and its code.
fn described(point: &Point, default: Option<&Point>) -> Result<String> {
    let of = match point.kind {
        Kind::Simulation => "cycles for a simulated second",
        _ => "cycles in the worst tick",
    };
    let (robot, name, unit) = (&point.robot, name(point), &point.unit);
    let [worst, mean] = point.costs().map(cycles);
    let time =
        |point: &Point| format!("{:.2} µs at 168 MHz", point.cycles as f64 / PER_MICROSECOND);
    let than = default.map_or(String::new(), |default| {
        let share = percent(point.costs()[0] / default.costs()[0]);
        let cycles = thousands(default.cycles);
        format!(" ({}), {share} of the default's {cycles} ({})", time(point), time(default))
    });
    let (error, share) = (digits(point.error()), stated(point.relative_max));
    let elsewhere = [
        (point.error_box, "in the worst of the box's states"),
        (point.proven, "in any state, proven"),
    ];
    let elsewhere = elsewhere.map(|(error, what)| {
        error.map_or(String::new(), |error| format!(", by up to {} {unit} {what}", digits(error)))
    });
    let (elsewhere, lines, code) = (elsewhere.concat(), lines(point), code::rust(point)?);
    Ok(format!(
        "{robot} {name}: {worst} modelled {of}{than}, {mean} in the mean; off by up to {error} {unit} \
         ({share} of full scale) along the way{elsewhere}\n{lines}\n{code}"
    ))
}

#[cfg(test)]
mod tests {
    use super::super::front::{mark, tests::point};
    use super::super::point::{Kind, Point};
    use super::{Allowed, Budget};

    #[test]
    fn an_error_needs_a_number_and_a_unit() {
        let allowed = |error, kind| Ok(Allowed { error, kind });
        assert_eq!("0.05Nm".parse(), allowed(0.05, Kind::Inverse));
        assert_eq!("50 mN·m".parse(), allowed(0.05, Kind::Inverse));
        assert_eq!("2mrad".parse(), allowed(2e-3, Kind::Simulation));
        for bad in ["0.05", "Nm", "-1Nm", "0Nm", "nanNm", "5kg", "infNm"] {
            assert!(bad.parse::<Allowed>().is_err(), "{bad}");
        }
        let refused = "0.05".parse::<Allowed>().expect_err("no unit");
        assert!(refused.contains("no unit"), "{refused}");
    }

    #[test]
    fn a_budget_picks_from_the_front_or_explains() {
        let mut points = [
            point("default", 1e-5, 1000, 1000.0),
            point("trig=table", 1e-3, 900, 900.0),
            point("model=gravity", 10.0, 300, 300.0),
        ];
        mark(&mut points);
        let all: Vec<&Point> = points.iter().collect();
        let chosen = |budget: Budget| budget.choose(&all).map(|point| &*point.key);
        let kind = Kind::Inverse;
        let error = |error| Budget::Error(Allowed { error, kind });
        assert!(chosen(error(0.05)).is_ok_and(|key| key == "trig=table"));
        assert!(chosen(Budget::Cycles(1500)).is_ok_and(|key| key == "default"));
        let refused = chosen(Budget::Cycles(10)).expect_err("too little");
        let begin = "nothing on the front is below 10 cycles; the cheapest takes 300";
        assert!(refused.to_string().starts_with(begin), "{refused}");
        assert!(chosen(error(1e-9)).is_err());
    }
}
