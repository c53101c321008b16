//! One table, as Markdown for the docs and as text for a terminal.

use console::Term;

/// Rows of cells; the first column is left-aligned, the others are right-aligned.
pub struct Table {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(head: &[&str]) -> Self {
        Self { head: head.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// A row for each of some things, by what their columns are called and say of one.
    pub fn of<'a, T: 'a>(rows: impl IntoIterator<Item = &'a T>, columns: &[Column<'_, T>]) -> Self {
        let head: Vec<&str> = columns.iter().map(|(head, _)| *head).collect();
        let mut table = Self::new(&head);
        for row in rows {
            table.row(columns.iter().map(|(_, cell)| cell(row)));
        }
        table
    }

    pub fn text(&self) -> String {
        plain(&self.markdown())
    }

    pub fn markdown(&self) -> String {
        let all = || std::iter::once(&self.head).chain(&self.rows);
        let width = |column: usize| {
            let cells = all().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).fold(3, usize::max)
        };
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let line = |row: &Vec<String>| {
            let cells = row.iter().zip(&widths).enumerate();
            let padded = cells.map(|(column, (cell, &width))| match column {
                0 => format!("{cell:width$}"),
                _ => format!("{cell:>width$}"),
            });
            format!("| {} |\n", padded.collect::<Vec<_>>().join(" | "))
        };
        let rule = widths.iter().enumerate().map(|(column, width)| {
            let end = if column == 0 { "-" } else { ":" };
            "-".repeat(width - 1) + end
        });
        let rule = line(&rule.collect());
        line(&self.head) + &rule + &self.rows.iter().map(line).collect::<String>()
    }
}

/// The heading of a column, and its cell in a row.
pub type Column<'a, T> = (&'a str, &'a dyn Fn(&T) -> String);

/// Markdown for a terminal: tables without bars and no wider than it is, and neither comments nor
/// pictures.
pub fn plain(markdown: &str) -> String {
    let (stdout, mut text) = (Term::stdout(), String::new());
    let room = match stdout.size_checked() {
        Some((_, columns)) if stdout.is_term() => columns.into(),
        _ => usize::MAX,
    };
    let mut table: Vec<Vec<&str>> = Vec::new();
    for line in markdown.lines() {
        if let Some(cells) = line.strip_prefix("| ").and_then(|l| l.strip_suffix(" |")) {
            table.push(cells.split(" | ").collect());
            continue;
        }
        text += &folded(&std::mem::take(&mut table), room);
        if line.starts_with("<!--") || line.starts_with("![") {
            continue;
        }
        if !(line.is_empty() && text.ends_with("\n\n")) {
            text += line.trim_start_matches('#').trim_start();
            text.push('\n');
        }
    }
    text + &folded(&table, room)
}

/// The rows of a table, all of equal widths: columns beyond the room follow below, behind the first
/// one again.
fn folded(rows: &[Vec<&str>], room: usize) -> String {
    let widths = rows.first().map_or_else(Vec::new, |head| {
        head.iter().map(|cell| cell.chars().count() + 2).collect::<Vec<_>>()
    });
    let (mut text, mut from) = (String::new(), 1);
    while from < widths.len() || text.is_empty() && !rows.is_empty() {
        let mut width = widths[0];
        let fits = widths[from.min(widths.len())..].iter().take_while(|more| {
            width += **more;
            width <= room
        });
        let to = from + fits.count().max(1);
        for row in rows {
            let cells = row[..1].iter().chain(row.get(from..to.min(row.len())).unwrap_or_default());
            let line: Vec<&str> = cells.copied().collect();
            let line = line.join("  ");
            let is_rule = line.starts_with("---");
            let line = if is_rule { line.replace(['-', ':'], "─") } else { line };
            text += &format!("  {}\n", line.trim_end());
        }
        from = to;
        if from < widths.len() {
            text.push('\n');
        }
    }
    text
}

/// `1234567` as `1,234,567`.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{Table, folded, thousands};

    #[test]
    fn a_wide_table_continues_below() {
        let rows =
            [vec!["mrad", "one", "two"], vec!["----", "--:", "--:"], vec!["RMS ", "  1", "  2"]];
        let whole = "  mrad  one  two\n  ────  ───  ───\n  RMS     1    2\n";
        assert_eq!(folded(&rows, 16), whole);
        let parts =
            "  mrad  one\n  ────  ───\n  RMS     1\n\n  mrad  two\n  ────  ───\n  RMS     2\n";
        assert_eq!(folded(&rows, 15), parts);
        assert_eq!(folded(&rows, 1), parts);
        assert_eq!(folded(&[vec!["a"]], 1), "  a\n");
        assert_eq!(folded(&[], 9), "");
    }

    #[test]
    fn a_table_lines_up() {
        let mut table = Table::new(&["phase", "µs"]);
        table.row(["read".into(), thousands(1234)]);
        assert_eq!(table.text(), "  phase     µs\n  ─────  ─────\n  read   1,234\n");
        assert_eq!(table.markdown(), "| phase |    µs |\n| ----- | ----: |\n| read  | 1,234 |\n");
    }
}
