//! The form of a hard case, of which there are packages: `hard-cases`, `loop-tests` and
//! `flexible-tests`.

mod row;

pub use row::{Row, Verdict};

#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Case {
    pub number: u32,
    /// The difficulty, in a few words.
    pub name: &'static str,
    /// The numbers that make it hard.
    pub parameters: &'static str,
    /// The source of the case.
    pub source: &'static str,
    /// The source of the right answer.
    pub oracle: &'static str,
    /// Why the bounds are what they are.
    pub reason: &'static str,
    #[serde(skip)]
    pub run: fn() -> Vec<Row>,
}

impl Case {
    /// Measures everything; each row knows its case.
    pub fn rows(&self) -> Vec<Row> {
        let mut rows = (self.run)();
        for row in &mut rows {
            row.case = self.name.into();
            row.number = self.number;
        }
        rows
    }
}

/// Tests of these names, each of which demands a case by the function `demand` beside it, or the rows
/// of a part of it.
#[macro_export]
macro_rules! demanded {
    ($($name:ident = $number:literal $(, $part:path)?;)*) => {
        $(#[test]
        fn $name() {
            $crate::demanded!(@ $number $(, $part)?);
        })*
    };
    (@ $number:literal) => { demand($number) };
    (@ $number:literal, $part:path) => {
        $crate::hard::demand_rows($number, &$part()).unwrap_or_else(|wrong| panic!("{wrong}"))
    };
}

/// Runs the case of this number of these cases.
///
/// # Errors
/// There is none, or not every row is as demanded: says which.
pub fn demand_of(cases: &[&[Case]], number: u32) -> Result<(), String> {
    let mut cases = cases.iter().copied().flatten();
    let case = cases
        .find(|case| case.number == number)
        .ok_or_else(|| format!("there is no case {number}"))?;
    demand_rows(number, &case.rows())
}

/// Demands these rows, all of the case of this number or a part of them.
///
/// # Errors
/// There is none, or not every row is as demanded: says which.
pub fn demand_rows(number: u32, rows: &[Row]) -> Result<(), String> {
    let wrong: Vec<String> = rows.iter().filter_map(|row| row.demand().err()).collect();
    if rows.is_empty() {
        return Err(format!("case {number} measures nothing"));
    }
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(format!("case {number}:\n{}", wrong.join("\n"))),
    }
}
