//! Prints the inputs of the hard cases, by their bits, for `host-tests/oracle/hard.py`.

use hard_cases::setup::list::exported;

fn main() -> serde_json::Result<()> {
    println!("{}", serde_json::to_string(&exported())?);
    Ok(())
}
