//! Sledges and blocks with dry friction.

use dynamics_core::effects::{Coulomb, Inertia, Lugre, Spring, Stribeck, Width};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;

/// A body of this mass on a prismatic joint along x.
pub fn sledge<R: Real>(mass: f64) -> ArmModel<R, 1> {
    let body = Body::new("sledge", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(mass);
    let model: ArmModel<f64, 1> = Model::new("sledge", [body]);
    R::cast(&model)
}

/// LuGre's friction with the numbers of Canudas de Wit et al. (1995), table 1.
pub fn lugre<R: Real>() -> Lugre<R, 1> {
    Lugre {
        stiffness: [R::from_f64(STIFFNESS)],
        damping: [R::from_f64(316.0)],
        viscous: [R::from_f64(0.4)],
        sliding: [R::ONE],
        excess: [R::from_f64(STICTION - 1.0)],
        stribeck_speed: Width::new(R::from_f64(1e-3)),
        bristle: [R::ZERO],
    }
}

/// Stiction of [`lugre`], N.
pub const STICTION: f64 = 1.5;
/// Stiffness of its bristles, N/m.
pub const STIFFNESS: f64 = 1e5;

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

    /// The limit cycle of 15 s in steps of 50 µs, in the frame of the belt: the spring's end moves
    /// away.
    pub fn run<R: Real>(&self) -> Cycle {
        let (of, h) = (R::from_f64, 5e-5);
        let spring = Spring { stiffness: [of(Self::STIFFNESS)], rest: [R::ZERO] };
        let dry = Coulomb { torque: [of(self.sliding)], width: Width::new(of(self.width)) };
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
