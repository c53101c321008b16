//! One table, as text for a terminal and as Markdown for the docs.

/// Rows of cells; the first column is left-aligned, the others are right-aligned.
pub struct Table {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these headings.
    pub fn new(head: &[&str]) -> Self {
        Self {
            head: head.iter().map(ToString::to_string).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// For a terminal.
    pub fn text(&self) -> String {
        let rule: Vec<String> = self.widths().iter().map(|w| "─".repeat(*w)).collect();
        self.lines(&rule)
            .map(|cells| format!("  {}\n", cells.join("  ").trim_end()))
            .collect()
    }

    /// For GitHub.
    pub fn markdown(&self) -> String {
        let rule: Vec<String> = self
            .widths()
            .iter()
            .enumerate()
            .map(|(i, w)| {
                let dashes = "-".repeat(w.saturating_sub(1));
                if i == 0 {
                    format!("-{dashes}")
                } else {
                    format!("{dashes}:")
                }
            })
            .collect();
        self.lines(&rule)
            .map(|cells| format!("| {} |\n", cells.join(" | ")))
            .collect()
    }

    fn widths(&self) -> Vec<usize> {
        (0..self.head.len())
            .map(|i| {
                let cells = std::iter::once(&self.head).chain(&self.rows);
                cells
                    .filter_map(|row| row.get(i))
                    .map(|cell| cell.chars().count())
                    .max()
                    .unwrap_or(0)
                    .max(3)
            })
            .collect()
    }

    /// The padded cells of heading, rule and rows.
    fn lines<'a>(&'a self, rule: &'a Vec<String>) -> impl Iterator<Item = Vec<String>> + 'a {
        let widths = self.widths();
        [&self.head, rule]
            .into_iter()
            .chain(&self.rows)
            .map(move |row| {
                row.iter()
                    .zip(&widths)
                    .enumerate()
                    .map(|(i, (cell, width))| {
                        let space = " ".repeat(width.saturating_sub(cell.chars().count()));
                        if i == 0 {
                            format!("{cell}{space}")
                        } else {
                            format!("{space}{cell}")
                        }
                    })
                    .collect()
            })
    }
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
    use super::{Table, thousands};

    #[test]
    fn a_table_lines_up() {
        let mut table = Table::new(&["phase", "µs"]);
        table.row(["read".into(), thousands(1234)]);
        assert_eq!(
            table.text(),
            "  phase     µs\n  ─────  ─────\n  read   1,234\n"
        );
        assert_eq!(
            table.markdown(),
            "| phase |    µs |\n| ----- | ----: |\n| read  | 1,234 |\n"
        );
    }
}
