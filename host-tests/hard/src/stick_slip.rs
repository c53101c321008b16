//! A block on a belt: stick-slip.

use host_tests::friction::Belt;
use host_tests::hard::{Case, Row};

pub const CASES: &[Case] = &[Case {
    number: 34,
    name: "stick-slip period on a belt",
    parameters: "2 kg on a spring of 300 N/m, a belt with 0.1 m/s, static friction of 7 N and \
        sliding friction of 4 N, Stribeck velocity 1e-4 m/s, width 2e-6 m/s, steps of 50 µs",
    source: "textbook stick-slip; Armstrong-Hélouvry (1991), chapter 2",
    oracle: "closed form for friction that drops at once: 2A/V + (2/ω)(π − atan(A ω/V)), A = (F_s \
        − F_c)/k; the largest extension F_c/k + √(A² + V²/ω²)",
    reason: "friction drops within the Stribeck velocity, 1e-3 of the belt's speed, and a step is \
        1e-4 of the period: measured",
    run: belt,
}];

fn belt() -> Vec<Row> {
    let belt = Belt { sliding: 4.0, excess: 3.0, speed: 1e-4, width: 2e-6 };
    let omega = (Belt::STIFFNESS / Belt::MASS).sqrt();
    let (a, v) = (belt.excess / Belt::STIFFNESS, Belt::SPEED);
    let period = 2.0 * a / v + 2.0 / omega * (std::f64::consts::PI - (a * omega / v).atan());
    let height = belt.sliding / Belt::STIFFNESS + a.hypot(v / omega);
    let mut rows = Vec::new();
    for (scalar, cycle) in [("f32", belt.run::<f32>()), ("f64", belt.run::<f64>())] {
        let [time, stretch] = cycle.period_and_height();
        rows.push(Row::measured("period", scalar, (time / period - 1.0).abs(), 1e-2));
        rows.push(Row::measured("greatest stretch", scalar, (stretch / height - 1.0).abs(), 1e-2));
    }
    rows
}
