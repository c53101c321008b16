//! The choice: the cheapest way within an error, the most accurate one within a time.

use std::str::FromStr;

use super::measure::Robot;
use super::point::{Kind, Point, of_group};
use super::words::{cycles, digits, name, sentence, stated};
use super::{code, front};
use crate::error::{Error, Result};
use crate::table::thousands;

/// What an error may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowed {
    /// In the unit of [`Allowed::kind`]: N·m or rad.
    pub error: f64,
    /// What is off by it.
    pub kind: Kind,
}

/// What the choice goes by.
#[derive(Clone, Copy, Debug)]
pub enum Budget {
    /// The cheapest within this error.
    Error(Allowed),
    /// The most accurate within this worst tick.
    Cycles(u64),
}

/// Units by their names.
const UNITS: [(&str, f64, Kind); 6] = [
    ("mN·m", 1e-3, Kind::Inverse),
    ("mNm", 1e-3, Kind::Inverse),
    ("N·m", 1.0, Kind::Inverse),
    ("Nm", 1.0, Kind::Inverse),
    ("mrad", 1e-3, Kind::Simulation),
    ("rad", 1.0, Kind::Simulation),
];

impl FromStr for Allowed {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let text = text.trim();
        let units = "an error is a torque in Nm or mNm (0.05Nm), for a simulation an angle in rad or mrad (2mrad)";
        let known = UNITS.iter().find_map(|&(unit, scale, kind)| {
            Some((text.strip_suffix(unit)?.trim().parse::<f64>(), scale, kind))
        });
        match known {
            Some((Ok(number), scale, kind)) if number > 0.0 && number.is_finite() => Ok(Self {
                error: number * scale,
                kind,
            }),
            Some((Ok(_), ..)) => Err(format!("{text}: an error is more than nothing")),
            Some((Err(_), ..)) => Err(format!("{text} does not begin with a number: {units}")),
            None if text.parse::<f64>().is_ok() => Err(format!("{text} has no unit: {units}")),
            None => Err(units.into()),
        }
    }
}

impl Budget {
    /// What is computed by what is chosen.
    pub fn kind(self, robot: Robot) -> Kind {
        match self {
            Self::Error(allowed) => allowed.kind,
            Self::Cycles(_) if robot == Robot::DoublePendulum => Kind::Simulation,
            Self::Cycles(_) => Kind::Inverse,
        }
    }

    /// What is chosen from.
    pub fn group(self, robot: Robot, quick: bool) -> Result<(&'static str, Kind, &'static str)> {
        let (kind, name) = (self.kind(robot), robot.name());
        let (among, circumstances) = match kind {
            Kind::Simulation => (&Robot::SIMULATED[..], "free"),
            _ => (&Robot::COMPUTED[..], "rigid"),
        };
        if among.contains(&robot) && !(quick && kind == Kind::Simulation) {
            return Ok((name, kind, circumstances));
        }
        let [torques, angles] = [&Robot::COMPUTED[..], &Robot::SIMULATED[..]].map(|robots| {
            robots
                .iter()
                .map(|robot| robot.name())
                .collect::<Vec<_>>()
                .join(", ")
        });
        Err(Error::check(format!(
            "not for {name}: there are torques, in Nm, of {torques}, and simulations, in rad, without --quick, of {angles}"
        )))
    }

    /// The point of the front that this allows.
    pub fn choose<'a>(self, points: &[&'a Point]) -> Result<&'a Point> {
        let front = front::front(points, 0);
        let (&[cheapest, ..], &[.., best]) = (&front[..], &front[..]) else {
            return Err(Error::check("nothing was measured of this robot"));
        };
        let unit = &best.unit;
        let mut front = front.into_iter();
        let (within, what, end) = match self {
            Self::Cycles(most) => (
                front.rfind(|point| point.cycles <= most),
                format!("below {} cycles; the cheapest", thousands(most)),
                cheapest,
            ),
            Self::Error(allowed) => {
                let error = digits(allowed.error);
                let what = format!("off by less than {error} {unit}; the most accurate");
                (
                    front.find(|point| point.error() <= allowed.error),
                    what,
                    best,
                )
            }
        };
        within.ok_or_else(|| {
            let (cycles, error) = (thousands(end.cycles), digits(end.error()));
            let (name, front) = (name(end), "nothing on the front is");
            Error::check(format!(
                "{front} {what} takes {cycles} cycles ({name}) and is off by up to {error} {unit}"
            ))
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
        let mut text = format!("{}\n\n{}", described(chosen), code::rust(chosen)?);
        if let Some(other) = self.in_the_mean(points, chosen) {
            text += &format!(
                "\nIf the mean over ticks matters rather than the worst tick:\n\n{}\n\n{}",
                described(other),
                code::rust(other)?
            );
        }
        Ok(text)
    }
}

/// What may be chosen from a group: what the library ships, and the fronts of that.
pub fn shipped(points: &[Point], group: (&str, Kind, &str)) -> Vec<Point> {
    let own = of_group(points, group).into_iter();
    let mut own: Vec<Point> = own
        .filter(|point| code::rust(point).is_ok())
        .cloned()
        .collect();
    front::mark(&mut own);
    own
}

/// A point's figures in words.
fn described(point: &Point) -> String {
    let of = match point.kind {
        Kind::Simulation => "cycles for a simulated second",
        _ => "cycles in the worst tick",
    };
    format!(
        "{} {}: {} modelled {of}, {} in the mean; off by up to {} {} ({} of full scale)\n{}",
        point.robot,
        name(point),
        thousands(point.cycles),
        cycles(point.cycles_mean),
        digits(point.error()),
        point.unit,
        stated(point.relative_max),
        sentence(point)
    )
}

#[cfg(test)]
mod tests {
    use super::super::front::{mark, tests::point};
    use super::super::point::{Kind, Point};
    use super::{Allowed, Budget};

    #[test]
    fn an_error_needs_a_number_and_a_unit() {
        let torque = |error| {
            Ok(Allowed {
                error,
                kind: Kind::Inverse,
            })
        };
        assert_eq!("0.05Nm".parse(), torque(0.05));
        assert_eq!("50 mN·m".parse(), torque(0.05));
        assert_eq!(
            "2mrad".parse(),
            Ok(Allowed {
                error: 2e-3,
                kind: Kind::Simulation
            })
        );
        for bad in ["0.05", "Nm", "-1Nm", "0Nm", "nanNm", "5kg", "infNm"] {
            assert!(bad.parse::<Allowed>().is_err(), "{bad}");
        }
        let refused = "0.05".parse::<Allowed>().expect_err("no unit");
        assert!(refused.contains("no unit"), "{refused}");
    }

    #[test]
    fn a_budget_picks_from_the_front_or_says_what_would_do() {
        let mut points = [
            point("default", 1e-5, 1000, 1000.0),
            point("trig=table", 1e-3, 900, 900.0),
            point("model=gravity", 10.0, 300, 300.0),
        ];
        mark(&mut points);
        let all: Vec<&Point> = points.iter().collect();
        let chosen = |budget: Budget| budget.choose(&all).map(|point| &*point.key);
        let error = |error| {
            Budget::Error(Allowed {
                error,
                kind: Kind::Inverse,
            })
        };
        assert!(chosen(error(0.05)).is_ok_and(|key| key == "trig=table"));
        assert!(chosen(Budget::Cycles(1500)).is_ok_and(|key| key == "default"));
        let refused = chosen(Budget::Cycles(10))
            .expect_err("too little")
            .to_string();
        assert!(
            refused.starts_with("nothing on the front is below 10 cycles; the cheapest takes 300"),
            "{refused}"
        );
        assert!(chosen(error(1e-9)).is_err());
    }
}
