//! What `cargo xtask history` writes of published and counted operations: a line for each ancestor, its cells between
//! bars; an empty line; and the list of all differences.

use history::counts::{ANCESTORS, Both, Polynomial};

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
        let fraction = match rest {
            0 => "",
            1 => "1/12",
            2 => "1/6",
            3 => "1/4",
            4 => "1/3",
            5 => "5/12",
            6 => "1/2",
            7 => "7/12",
            8 => "2/3",
            9 => "3/4",
            10 => "5/6",
            _ => "11/12",
        };
        let number = match (whole, rest) {
            (1, 0) if !power.is_empty() => String::new(),
            (_, 0) => whole.to_string(),
            (0, _) => format!("{fraction} "),
            _ => format!("{whole} {fraction} "),
        };
        text += &format!("{sign}{number}{power}");
    }
    if text.is_empty() {
        "0".into()
    } else {
        text.trim_end().into()
    }
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
        println!(
            "\n**{}, {}.** Counted: {}.",
            counts.authors,
            counts.form,
            both(counts.counted)
        );
        let Some(published) = counts.published else {
            continue;
        };
        println!("Published: {}. Counted less published:\n", both(published));
        for term in counts.terms {
            println!("- {}: {}", both(term.1), term.0);
        }
    }
}
