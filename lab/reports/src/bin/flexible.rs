//! Prints as JSON what few modes leave out of links that bend, and how far inverse dynamics is from the referee's: `cargo
//! xtask flexible` puts them into docs/flexible.md.

fn main() {
    println!("{}", flexible_tests::report::measured());
}
