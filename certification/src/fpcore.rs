//! A result of machine code as an FPCore, the form of the benchmarks of FPBench, which other tools
//! that bound rounding errors read.
//!
//! FPCore 2.0 (<https://fpbench.org/spec/fpcore-2.0.html>). An operation of the code is a binding
//! of `let*`, rounded to binary32; a product and a sum stay two operations, as the code has them. A
//! reciprocal root, in the code a guess from bits and Newton's steps, is one that is rounded once:
//! FPCore knows no bits.

use std::fmt::Write as _;

use crate::graph::{Graph, Node};
use crate::state_box::{Kind, Leaf, Robot};

/// A coordinate's name: q1, dq1, ddq1.
fn variable(robot: &Robot, axis: usize) -> String {
    let (kind, joint) = robot.axis(axis);
    let letters = match kind {
        Kind::Position => "q",
        Kind::Velocity => "dq",
        Kind::Acceleration => "ddq",
    };
    format!("{letters}{}", joint + 1)
}

/// An output of a graph; None if one of its inputs is not the robot's. `name` is that of the
/// benchmark.
pub fn fpcore(graph: &Graph, output: usize, robot: &Robot, name: &str) -> Option<String> {
    let graph = graph.of_output(output);
    let (mut used, mut bindings) = (vec![false; 3 * robot.joints.len()], String::new());
    for (k, node) in graph.nodes.iter().enumerate() {
        let value = match *node {
            Node::Input(input) => {
                let (of, axis) = match robot.leaf(input)? {
                    Leaf::Sine(joint) => ("sin", joint),
                    Leaf::Cosine(joint) => ("cos", joint),
                    Leaf::Axis(axis) => ("", axis),
                };
                used[axis] = true;
                let coordinate = variable(robot, axis);
                if of.is_empty() {
                    coordinate
                } else {
                    format!("({of} {coordinate})")
                }
            }
            // All digits, so that a reader of real numbers has the same one.
            Node::Literal(x) => format!("{:?}", f64::from(x)),
            Node::Add(a, b) => format!("(+ v{a} v{b})"),
            Node::Sub(a, b) => format!("(- v{a} v{b})"),
            Node::Mul(a, b) => format!("(* v{a} v{b})"),
            Node::Div(a, b) => format!("(/ v{a} v{b})"),
            Node::Sqrt(a) => format!("(sqrt v{a})"),
            // Which the code rounds otherwise: see the top.
            Node::InverseRoot(a, _) => format!("(cast (! :precision real (/ 1 (sqrt v{a}))))"),
            Node::Neg(a) => format!("(- v{a})"),
            Node::Abs(a) => format!("(fabs v{a})"),
        };
        let _ = writeln!(bindings, "   [v{k} {value}]");
    }
    let axes: Vec<usize> = (0..used.len()).filter(|axis| used[*axis]).collect();
    let variables: Vec<String> = axes.iter().map(|axis| variable(robot, *axis)).collect();
    let whole = robot.whole();
    let ranges = axes.iter().zip(&variables).map(|(axis, variable)| {
        let range = whole[*axis];
        format!("(<= {:?} {variable} {:?})", range.low, range.high)
    });
    let last = graph.nodes.len() - 1;
    Some(format!(
        "(FPCore ({})\n :name \"{name}, joint {}\"\n :precision binary32\n :pre (and {})\n (let* (\n{bindings}  )\n  v{last}))\n",
        variables.join(" "),
        graph.outputs[0].0 / 4 + 1,
        ranges.collect::<Vec<_>>().join("\n           "),
    ))
}
