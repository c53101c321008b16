//! The rows in print.

use crate::kit::bars::{self, ADDED, Bars, Compared, IMAGE, TICK, is_ratio};
use crate::kit::meter::{CHIPS, CLOCK_MHZ, IN_FLASH, MODEL};
use crate::kit::rows::Row;
use crate::kit::table::{Table, thousands};

const FLOOR_JOINTS: usize = 6;
/// The least arithmetic published for a general arm of so many joints, flops, sines and cosines
/// aside.
const LEAST_PUBLISHED: [(&str, u64); 3] = [("rnea", 836), ("crba", 855), ("aba", 2067)];

/// Between the names of two rows in a bar on the difference of their figures.
const OVER: &str = " over ";
/// The same in a bar on their ratio; names of other reports' rows have a comma.
const PER: &str = " / ";
const OTHERS: &str = ", ";

pub struct Report {
    pub rows: Vec<Row>,
    /// The engine's rows of the UR5e at opt-level s.
    pub small: Vec<Row>,
    pub bars: Bars,
    /// The compiler of the firmware.
    pub rustc: String,
}

impl Report {
    pub fn markdown(&self) -> String {
        let robots = self.rows.chunk_by(|a, b| a.robot == b.robot);
        let robots =
            robots.map(|rows| format!("\n## {}\n\n{}", rows[0].robot, table(rows).markdown()));
        format!(
            include_str!("page.md"),
            model = MODEL,
            clock = CLOCK_MHZ,
            in_flash = IN_FLASH,
            least = LEAST_PUBLISHED
                .map(|(name, flops)| format!("{} {}", name.to_uppercase(), thousands(flops)))
                .join(", "),
            robots = robots.collect::<String>(),
            ways = self.ways().markdown(),
            small = self.small_table().markdown(),
            bars = bars::table(&self.compared()).markdown(),
            rustc = self.rustc
        )
    }

    /// Every bar that there is a figure for: of the rows, then of the engine at opt-level s against
    /// itself at 3.
    fn compared(&self) -> Vec<Compared> {
        let mut all = Vec::new();
        for (key, figures) in self.bars.keys().filter_map(|key| Some((key, self.figures(key)?))) {
            let figures = figures.into_iter();
            let compared = |(figure, value)| Compared::of(&self.bars, key, figure, value);
            all.extend(figures.filter_map(compared));
        }
        for (small, row) in self.pairs() {
            let key = format!("opt-level s / 3, {}", row.key());
            for ((figure, value), (_, of)) in small.figures().into_iter().zip(row.figures()) {
                all.extend(Compared::of(&self.bars, &key, figure, value as f64 / of as f64));
            }
        }
        all
    }

    /// The bars that are not as `budgets.toml` has them, or whose row is not there, in words.
    pub fn missed(&self) -> Vec<String> {
        let compared = self.compared();
        let unmet = compared.iter().filter_map(Compared::complaint);
        let bars = self.bars.keys();
        let bars = bars.filter(|key| !key.contains(OTHERS));
        let unknown = bars
            .filter(|key| ![TICK, ADDED, IMAGE].iter().any(|end| key.ends_with(end)))
            .filter(|key| self.figures(key).is_none())
            .map(|key| format!("{key}: there is no such row"));
        unmet.chain(unknown).collect()
    }

    fn row(&self, key: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.key() == key)
    }

    /// The figures of a row, those by which one exceeds another, or their ratios.
    fn figures(&self, key: &str) -> Option<[(&'static str, f64); 4]> {
        let of = |key| {
            let figures = self.row(key)?.figures();
            Some(figures.map(|(name, value)| (name, value as f64)))
        };
        let two: fn(f64, f64) -> f64 = if is_ratio(key) { |a, b| a / b } else { |a, b| a - b };
        let Some((key, base)) = key.split_once(OVER).or_else(|| key.split_once(PER)) else {
            return of(key);
        };
        let (mut figures, base) = (of(key)?, of(base)?);
        for ((_, figure), (_, base)) in figures.iter_mut().zip(base) {
            *figure = two(*figure, base).max(0.0);
        }
        Some(figures)
    }

    /// The rows at opt-level s, and beside them those at 3.
    fn pairs(&self) -> Vec<(&Row, &Row)> {
        let small = self.small.iter();
        small.filter_map(|small| Some((small, self.row(&small.key())?))).collect()
    }

    /// By M and its factors, and by articulated bodies.
    fn ways(&self) -> Table {
        let pairs = self.rows.iter().filter_map(|row| {
            let of = |other: &&Row| {
                (&other.robot, &other.form, other.trig, &*other.algorithm)
                    == (&row.robot, &row.form, false, "aba")
            };
            let aba = self.rows.iter().find(of)?;
            (row.algorithm == "forward_dynamics" && !row.trig).then_some((
                row,
                row.cycles.max,
                aba.cycles.max,
            ))
        });
        Table::of(
            &pairs.collect::<Vec<_>>(),
            &[
                ("robot, form", &|(row, ..)| format!("{} {}", row.robot, row.form)),
                ("joints", &|(row, ..)| row.joints.to_string()),
                ("forward: cycles", &|(_, forward, _)| thousands(*forward)),
                ("aba: cycles", &|(.., aba)| thousands(*aba)),
                ("aba / forward", &|(_, forward, aba)| {
                    format!("{:.2}", *aba as f64 / *forward as f64)
                }),
                ("shorter", &|(_, forward, aba)| {
                    if aba < forward { "aba" } else { "forward_dynamics" }.into()
                }),
            ],
        )
    }

    /// opt-level s beside 3.
    fn small_table(&self) -> Table {
        let ratio = |small: u64, row: u64| format!("{:.3}", small as f64 / row as f64);
        Table::of(
            &self.pairs(),
            &[
                ("algorithm, form, inputs", &|(row, _)| called(row)),
                ("sin/cos", &|(row, _)| trig(row)),
                ("cycles at s", &|(small, _)| thousands(small.cycles.max)),
                ("at 3", &|(_, row)| thousands(row.cycles.max)),
                ("s / 3", &|(small, row)| ratio(small.cycles.max, row.cycles.max)),
                ("code at s", &|(small, _)| thousands(small.code_bytes)),
                ("at 3", &|(_, row)| thousands(row.code_bytes)),
                ("s / 3", &|(small, row)| ratio(small.code_bytes, row.code_bytes)),
            ],
        )
    }
}

/// The rows of one robot, for a terminal.
pub fn of_robot(rows: &[Row]) -> String {
    let name = rows.first().map_or("", |row| &row.robot);
    format!("{name}; {MODEL}. {IN_FLASH}.\n\n{}", table(rows).markdown())
}

fn called(row: &Row) -> String {
    format!("{} {} {}", row.algorithm, row.form, row.inputs)
}

fn trig(row: &Row) -> String {
    if row.trig { "inside" } else { "outside" }.to_owned()
}

fn table(rows: &[Row]) -> Table {
    Table::of(
        rows,
        &[
            ("algorithm, form, inputs", &called),
            ("sin/cos", &trig),
            ("insn min", &|row| thousands(row.instructions.min)),
            ("median", &|row| thousands(row.instructions.median)),
            ("max", &|row| thousands(row.instructions.max)),
            ("cycles min", &|row| thousands(row.cycles.min)),
            ("median", &|row| thousands(row.cycles.median)),
            ("max", &|row| thousands(row.cycles.max)),
            (CHIPS[0], &|row| thousands(row.in_flash[0].max)),
            (CHIPS[1], &|row| thousands(row.in_flash[1].max)),
            ("µs", &|row| format!("{:.2}", row.cycles.max as f64 / CLOCK_MHZ)),
            ("flops", &|row| thousands(row.flops)),
            ("of floor", &|row| floor_share(row).unwrap_or_default()),
            ("code", &|row| thousands(row.code_bytes)),
            ("stack", &|row| thousands(row.stack_bytes)),
        ],
    )
}

/// Flops as a share of the least that is published, where there is such a count.
fn floor_share(row: &Row) -> Option<String> {
    let floor = LEAST_PUBLISHED.iter().find(|(name, _)| *name == row.algorithm)?.1;
    let comparable = row.joints == FLOOR_JOINTS && row.inputs == "full" && !row.trig;
    comparable.then(|| format!("{:.2}", row.flops as f64 / floor as f64))
}

#[cfg(test)]
mod tests {
    use super::{Report, Row};
    use crate::kit::bars::{Bar, Bars};

    /// The missed bars of rows `tree` and `loop` of these cycles, by a bar of this name.
    fn missed(rows: &[(&str, u64)], key: &str, most: f64) -> Vec<String> {
        let row =
            |(name, cycles): &(&str, u64)| Row::sample(["leg", name, "engine", "full"], *cycles);
        let report = Report {
            rows: rows.iter().map(row).collect(),
            small: Vec::new(),
            bars: Bars::from([
                (key.into(), Bar::of([("cycles", most)])),
                ("leg rnea, m4f, engine / casadi".into(), Bar::of([("cycles", 0.1)])),
            ]),
            rustc: String::new(),
        };
        report.missed()
    }

    #[test]
    fn differences_and_multiples_of_rows_have_bars() {
        let [over, multiple] = [" over ", " / "]
            .map(|of| format!("leg loop engine full trig{of}leg tree engine full trig"));
        for (key, most, cycles, more) in [
            (over, 180.0, 580, "cycles 181 > 180"),
            (multiple, 2.5, 1_000, "cycles 2.502× > 2.500×"),
        ] {
            let of = |cycles| missed(&[("tree", 400), ("loop", cycles)], &key, most);
            assert!(of(cycles).is_empty());
            assert!(of(cycles + 1)[0].ends_with(more), "{:?}", of(cycles + 1));
            let lonely = missed(&[("loop", 400)], &key, most);
            assert!(lonely[0].ends_with("there is no such row"), "{lonely:?}");
        }
    }

    #[test]
    fn a_bar_of_another_command_needs_no_row() {
        for key in ["ur5e tick", "ur5e added", "board control image"] {
            assert!(missed(&[], key, 1.0).is_empty(), "{key}");
        }
        assert_eq!(missed(&[], "board control", 1.0).len(), 1);
    }
}
