//! The set of parameters that bodies can have.

use dynamics_core::model::BodyInertia;
use dynamics_core::spatial::SpatialInertia;
use motion_control::estimate::PhysicalParameters;

use crate::common::Rng;
use crate::parameter_estimator::arm::*;
use crate::parameter_estimator::bad_input::noise;
use crate::parameter_estimator::learner::*;

pub fn stored_of(nominal: &[f64; N]) -> PhysicalParameters<f32, 6, N> {
    PhysicalParameters::try_new(nominal.map(|x| x as f32)).expect("the nominal arm is possible")
}

/// Whether the mass is positive and Σ about the centre of mass positive definite, by its leading
/// minors.
fn is_possible(body: &[f32; 10]) -> bool {
    let body = BodyInertia::about_com(&SpatialInertia::from_parameters(body.map(f64::from)));
    let [xx, xy, xz, yy, yz, zz] = body.inertia;
    let half = 0.5 * (xx + yy + zz);
    let (a, b, c) = (half - xx, half - yy, half - zz);
    let second = a * b - xy * xy;
    let third = a * (b * c - yz * yz) + xy * (-xy * c - yz * xz) - xz * (xy * yz + b * xz);
    body.mass > 0.0 && a > 0.0 && second > 0.0 && third > 0.0
}

#[test]
fn no_stored_set_is_impossible_in_many_noisy_ticks() {
    let ticks = if cfg!(feature = "full") { 1_000_000 } else { 100_000 };
    let mut learner = Learner::new(1, 0.05, 1000.0);
    let (mut stored, mut rng, mut outside) = (stored_of(&learner.nominal), Rng::new(7), 0);
    for (_, row) in minute(1).iter().cycle().take(ticks) {
        let mut row = *row;
        noise(&mut row, &mut [0.0; N], &mut rng);
        let _ = learner.add(&row);
        stored.update(&learner.base, &learner.estimator.estimate());
        let candidate = learner.found().map(|x| x as f32);
        let possible = |all: &[f32; N]| {
            all.as_chunks::<10>().0[..6].iter().all(is_possible)
                && all[60..].iter().all(|x| *x >= 0.0)
        };
        assert!(possible(stored.parameters()));
        outside += usize::from(!possible(&candidate));
    }
    assert!(outside > ticks / 100, "{outside}");
}
