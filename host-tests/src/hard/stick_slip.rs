//! A block on a belt: stick-slip.

use super::friction::sledge;
use super::{Case, Row};
use dynamics_core::effects::{Coulomb, Inertia, Spring, Stribeck, Width};
use dynamics_core::scalar::Real;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;

pub const CASES: &[Case] = &[Case {
    number: 34,
    name: "stick-slip period on a belt",
    parameters: "2 kg on a spring of 300 N/m, a belt with 0.1 m/s, static friction of 7 N and sliding friction of 4 \
            N, Stribeck velocity 1e-4 m/s, width 2e-6 m/s, steps of 50 µs",
    source: "stick-slip as in the textbook; Armstrong-Hélouvry (1991), chapter 2",
    oracle: "closed form for friction that drops at once: 2A/V + (2/ω)(π − atan(A ω/V)), A = (F_s − F_c)/k; the \
            largest extension F_c/k + √(A² + V²/ω²)",
    reason: "friction does not drop at once, but within the Stribeck velocity, 1e-3 of the belt's speed, and a \
            step is 1e-4 of the period: measured",
    run: belt,
}];

/// Peaks of the stretch that a run has after 5 s: their mean height and distance in time.
#[derive(Default)]
pub struct Cycle {
    last: [f64; 2],
    /// Times and heights of the peaks.
    pub peaks: Vec<[f64; 2]>,
}

impl Cycle {
    pub fn see(&mut self, t: f64, stretch: f64) {
        let [before, now] = self.last;
        if t > 5.0 && now > before && now >= stretch {
            self.peaks.push([t, now]);
        }
        self.last = [now, stretch];
    }

    /// Mean distance in time and mean height of the peaks.
    pub fn period_and_height(&self) -> [f64; 2] {
        let (first, last) = (self.peaks[0], self.peaks[self.peaks.len() - 1]);
        let count = self.peaks.len() as f64;
        let height = self.peaks.iter().map(|p| p[1]).sum::<f64>() / count;
        [(last[0] - first[0]) / (count - 1.0), height]
    }
}

/// A block of 2 kg on a spring of 300 N/m, on a belt of 0.1 m/s.
#[derive(Clone, Copy, Debug)]
pub struct Belt {
    /// Friction when sliding, and what stiction has above it, N.
    pub sliding: f64,
    pub excess: f64,
    /// Stribeck's speed, m/s.
    pub speed: f64,
    /// Width of the sign, m/s.
    pub width: f64,
}

impl Belt {
    /// Mass, stiffness, speed of the belt.
    pub const MASS: f64 = 2.0;
    /// N/m.
    pub const STIFFNESS: f64 = 300.0;
    /// m/s.
    pub const SPEED: f64 = 0.1;

    /// The limit cycle of 15 s in steps of 50 µs, in the frame of the belt: the spring's end moves away.
    pub fn run<R: Real>(&self) -> Cycle {
        let (of, h) = (R::from_f64, 5e-5);
        let spring = Spring {
            stiffness: [of(Self::STIFFNESS)],
            rest: [R::ZERO],
        };
        let dry = Coulomb {
            torque: [of(self.sliding)],
            width: Width::new(of(self.width)),
        };
        let stribeck = Stribeck {
            excess: [of(self.excess)],
            stribeck_speed: Width::new(of(self.speed)),
            width: Width::new(of(self.width)),
        };
        let (model, mut scene) = (sledge::<R>(Self::MASS), (Inertia, dry, stribeck, spring));
        let (mut state, mut cycle) = (State::at([R::ZERO]), Cycle::default());
        for i in 1..=300_000 {
            let t = h * f64::from(i);
            scene.3.rest = [of(-Self::SPEED * t)];
            linearly_implicit(&model, &mut state, &[R::ZERO], &mut scene, of(h))
                .expect("M is positive definite");
            cycle.see(t, state.q[0].to_f64() + Self::SPEED * t);
        }
        cycle
    }
}

fn belt() -> Vec<Row> {
    let belt = Belt {
        sliding: 4.0,
        excess: 3.0,
        speed: 1e-4,
        width: 2e-6,
    };
    let omega = (Belt::STIFFNESS / Belt::MASS).sqrt();
    let (a, v) = (belt.excess / Belt::STIFFNESS, Belt::SPEED);
    let period = 2.0 * a / v + 2.0 / omega * (std::f64::consts::PI - (a * omega / v).atan());
    let height = belt.sliding / Belt::STIFFNESS + a.hypot(v / omega);
    let mut rows = Vec::new();
    for (scalar, cycle) in [("f32", belt.run::<f32>()), ("f64", belt.run::<f64>())] {
        let [time, stretch] = cycle.period_and_height();
        rows.push(Row::measured(
            "period",
            scalar,
            (time / period - 1.0).abs(),
            1e-2,
        ));
        rows.push(Row::measured(
            "greatest stretch",
            scalar,
            (stretch / height - 1.0).abs(),
            1e-2,
        ));
    }
    rows
}
