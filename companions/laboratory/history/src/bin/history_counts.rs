//! The lines of the command `history` about published and counted operations: a line for each
//! ancestor, its cells between bars; an empty line; and the list of all differences.

use history::counts::{ANCESTORS, Both, Polynomial};

/// Fractions by their numbers of twelfths.
const TWELFTHS: [&str; 12] =
    ["", "1/12", "1/6", "1/4", "1/3", "5/12", "1/2", "7/12", "2/3", "3/4", "5/6", "11/12"];

/// As the sources write it, fractions as n/d; zero if all coefficients are.
fn text(polynomial: Polynomial) -> String {
    let mut text = String::new();
    for (coefficient, power) in polynomial.0.into_iter().zip(["n⁴", "n³", "n²", "n", ""]) {
        if coefficient == 0 {
            continue;
        }
        let sign = match (coefficient < 0, text.is_empty()) {
            (true, true) => "−",
            (true, false) => " − ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let (whole, rest) = (coefficient.abs() / 12, coefficient.abs() % 12);
        let fraction = TWELFTHS[rest as usize];
        let number = match (whole, rest) {
            (1, 0) if !power.is_empty() => String::new(),
            (_, 0) => whole.to_string(),
            (0, _) => format!("{fraction} "),
            _ => format!("{whole} {fraction} "),
        };
        text += &format!("{sign}{number}{power}");
    }
    if text.is_empty() { "0".into() } else { text.trim_end().into() }
}

fn both(both: Both) -> String {
    format!("{}, {}", text(both[0]), text(both[1]))
}

/// Products and sums at six joints.
fn at_6(both: Both) -> [i64; 2] {
    both.map(|polynomial| polynomial.twelvefold(6) / 12)
}

fn cell([products, sums]: [i64; 2]) -> String {
    format!("{products} + {sums}")
}

fn main() {
    for counts in &ANCESTORS {
        let published = counts.printed_at_6.or(counts.published.map(at_6));
        let published = published.map_or("–".into(), cell);
        let (year, authors, form) = (counts.year, counts.authors, counts.form);
        println!(
            "{}|{year}|{authors}|{form}|{published}|{}",
            counts.key,
            cell(at_6(counts.counted))
        );
    }
    for (key, form) in [
        ("rnea", "RNEA, core"),
        ("engine_rnea", "RNEA, engine"),
        ("crba", "CRBA, core"),
        ("engine_crba", "CRBA, engine"),
    ] {
        println!("{key}|today|this library|{form}|–|–");
    }
    for counts in &ANCESTORS {
        println!("\n**{}, {}.** Counted: {}.", counts.authors, counts.form, both(counts.counted));
        let Some(published) = counts.published else {
            continue;
        };
        println!("Published: {}. Counted less published:\n", both(published));
        for term in counts.terms {
            println!("- {}: {}", both(term.1), term.0);
        }
    }
}
