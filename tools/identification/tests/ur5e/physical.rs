//! Sets of parameters that bodies can have.

use identification::PhysicalSet;
use motion_control::estimate::PhysicalParameters;
use nalgebra::{DMatrix, DVector};

use crate::coverage::identified;
use crate::setup::*;

/// By the projection that firmware has, in f32 and without offsets.
pub fn assert_possible(set: &PhysicalSet<6, 6>) {
    type Stored = PhysicalParameters<f32, 6, 78>;
    fn all<const N: usize>(bodies: &[[f64; 10]; 6], joints: &[[f64; N]; 6]) -> [f32; 78] {
        let own = joints.iter().flat_map(|joint| &joint[..3]);
        let all: Vec<f32> = bodies.as_flattened().iter().chain(own).map(|x| *x as f32).collect();
        all.try_into().expect("78")
    }
    let Parameters { bodies, joints } = Parameters::nominal();
    let mut stored = Stored::try_new(all(&bodies, &joints)).expect("possible");
    assert_eq!(stored.follow(&all(&set.bodies, &set.joints)), 1.0);
}

/// With hardly any knowledge of nominal numbers the nearest set that is not possible has the
/// estimate itself. By optimality that of a convex problem agrees with the estimate at least as
/// well as the true parameters, which are possible.
// No possible arm has the estimate, and yet the set is possible.
#[test]
fn the_physical_set_agrees_as_well_as_the_truth() {
    let nominal = Parameters::nominal();
    let mut impossible = 0;
    for seed in 0..few_or_many(2, 10) {
        let truth = Parameters::off(seed);
        let found = identified(&ARM, &truth, seed);
        let set = found.physical(&*ARM, &nominal.bodies, &nominal.joints, 10.0);
        let set = set.expect("a good model");
        assert_possible(&set);
        let n = ARM.len();
        let covariance = DMatrix::from_row_slice(n, n, &found.covariance().concat());
        let whitened = covariance.cholesky().expect("positive definite");
        let misfit = |base: Vec<f64>| {
            let off = DVector::from_vec(base) - DVector::from_column_slice(&found.base);
            (off.dot(&whitened.solve(&off)) / n as f64).sqrt()
        };
        let stated = misfit(ARM.of_all(&set.bodies, &set.joints));
        assert!((stated - set.misfit).abs() < 1e-6, "{stated} {}", set.misfit);
        assert!(set.misfit < 1.001 * misfit(truth.base()), "{seed}");
        impossible += u64::from(set.misfit > 0.05);
    }
    assert!(impossible > few_or_many(0, 3), "{impossible}");
}
