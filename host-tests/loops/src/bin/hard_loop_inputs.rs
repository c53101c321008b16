//! Prints the inputs of the hard cases with loops as JSON for `host-tests/oracle/loops_precise.py`.

use loop_tests::hard::exported;

fn main() -> serde_json::Result<()> {
    println!("{}", serde_json::to_string(&exported())?);
    Ok(())
}
