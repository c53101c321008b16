//! The text for FPBench is read and evaluated by itself.

use std::collections::HashMap;

use certification::fpcore::fpcore;
use certification::graph::Node;
use certification::search::Evaluation;

use super::recorded::{GRAVITY, RNEA, graph, robot};

/// The words of a text, each parenthesis one of them.
fn words(text: &str) -> Vec<String> {
    let spaced = text.replace('(', " ( ").replace(')', " ) ");
    let spaced = spaced.replace('[', " [ ").replace(']', " ] ");
    spaced.split_whitespace().map(str::to_owned).collect()
}

/// Evaluates the bindings of a text in f64 and returns its result.
fn evaluate(text: &str, variables: &HashMap<String, f64>) -> f64 {
    let words = words(text);
    let mut values = variables.clone();
    let start = words
        .iter()
        .position(|word| word == "let*")
        .expect("bindings");
    let mut at = start + 2;
    while words[at] == "[" {
        let end = at
            + words[at..]
                .iter()
                .position(|word| word == "]")
                .expect("an end");
        let number = |word: &String| {
            values
                .get(word)
                .copied()
                .unwrap_or_else(|| word.parse().expect("a number"))
        };
        let value = match &words[at + 2..end] {
            [one] => number(one),
            [_, operation, a, _] => match operation.as_str() {
                "sin" => number(a).sin(),
                "cos" => number(a).cos(),
                "-" => -number(a),
                other => panic!("{other}"),
            },
            [_, operation, a, b, _] => match operation.as_str() {
                "+" => number(a) + number(b),
                "-" => number(a) - number(b),
                "*" => number(a) * number(b),
                other => panic!("{other}"),
            },
            other => panic!("{other:?}"),
        };
        values.insert(words[at + 1].clone(), value);
        at = end + 1;
    }
    values[&words[at + 1]]
}

#[test]
fn the_text_computes_what_the_code_does() {
    for (hex, output) in [(RNEA, 1), (GRAVITY, 2)] {
        let (mut graph, robot) = (graph(hex), robot(6));
        let text = fpcore(&graph, output, &robot, "ur5e").expect("its inputs are the robot's");
        let opening = text.matches(['(', '[']).count();
        assert_eq!(opening, text.matches([')', ']']).count());
        assert!(text.starts_with("(FPCore (") && text.contains(":precision binary32"));
        let state: Vec<f64> = (0..18).map(|i| 0.1 + 0.125 * f64::from(i)).collect();
        let letters = ["q", "dq", "ddq"];
        let name = |i: usize| format!("{}{}", letters[i / 6], i % 6 + 1);
        let variables = state
            .iter()
            .enumerate()
            .map(|(i, x)| (name(i), *x))
            .collect();
        let (_, double) = Evaluation::new(&graph, &robot)
            .at(&state)
            .nth(output)
            .expect("a result");
        let value = evaluate(&text, &variables);
        assert!(
            (value - double).abs() < 1e-9 * double.abs(),
            "{value} {double}"
        );
        // An input that is not the robot's has no name.
        graph.nodes.push(Node::Neg(0));
        graph.outputs.push((24, graph.nodes.len() - 1));
        assert!(fpcore(&graph, output, &super::recorded::robot(1), "ur5e").is_none());
    }
}
