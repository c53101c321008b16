//! Prints random trees, each with a state, as JSON for `host-tests/oracle/trees.py`.

use host_tests::export::robot;
use host_tests::random::recorded_trees;
use serde_json::json;

fn main() {
    let trees = recorded_trees().map(|(tree, state)| {
        let rows = [&state.q[..], &state.qd, &state.qdd];
        json!({ "robot": robot(&tree), "q": rows[0], "qd": rows[1], "qdd": rows[2] })
    });
    println!("{}", json!(trees.collect::<Vec<_>>()));
}
