//! The estimate against normal equations that are solved by elimination, and what is refused.

use super::*;
use crate::estimate::tests::solved;
use dynamics_core::glam::DVec3;

const CONFIG: TipWrenchConfig<f64, 4> =
    TipWrenchConfig { noise: [0.5, 0.25, 1.0, 2.0], force: 10.0, couple: 3.0 };

fn motion(x: [f64; 6]) -> Motion<f64> {
    Motion { ang: DVec3::new(x[0], x[1], x[2]), lin: DVec3::new(x[3], x[4], x[5]) }
}

const JACOBIAN: [[f64; 6]; 4] = [
    [0.1, -0.2, 1.0, 0.3, -0.4, 0.05],
    [1.0, 0.3, -0.1, 0.2, 0.15, 0.6],
    [-0.5, 0.9, 0.2, 0.1, -0.7, 0.3],
    [0.2, 0.8, -0.3, 0.9, 0.25, -0.35],
];

/// The equations of the module, as they are written.
fn expected(jacobian: &[[f64; 6]; 4], external: &[f64; 4]) -> [f64; 6] {
    let TipWrenchConfig { noise, force, couple } = CONFIG;
    let size = [couple, couple, couple, force, force, force];
    let (mut a, mut b) = ([[0.0; 6]; 6], [0.0; 6]);
    for (joint, column) in jacobian.iter().enumerate() {
        let c: [f64; 6] = core::array::from_fn(|i| size[i] * column[i] / noise[joint]);
        for i in 0..6 {
            b[i] += c[i] * external[joint] / noise[joint];
            for j in 0..6 {
                a[i][j] += c[i] * c[j];
            }
        }
    }
    (0..6).for_each(|i| a[i][i] += 1.0);
    let x = solved(a, b);
    core::array::from_fn(|i| size[i] * x[i])
}

fn estimated(jacobian: &[[f64; 6]; 4], external: &[f64; 4]) -> Result<[f64; 6], Fault> {
    let tip = TipWrench::try_new(CONFIG).expect("a good configuration");
    let force = tip.estimate(&jacobian.map(motion), external)?;
    let [n, f] = [force.ang, force.lin].map(|axis| axis.to_array());
    Ok([n[0], n[1], n[2], f[0], f[1], f[2]])
}

#[test]
fn the_wrench_is_that_of_the_normal_equations() {
    for external in [[1.0, 0.0, 0.0, 0.0], [0.5, -2.0, 3.0, 1.0]] {
        let wrench = estimated(&JACOBIAN, &external).expect("finite");
        for (got, expected) in wrench.iter().zip(expected(&JACOBIAN, &external)) {
            assert!((got - expected).abs() < 1e-11, "{got} {expected}");
        }
    }
}

/// The column of a joint along one axis.
fn along(axis: usize, size: f64) -> [f64; 6] {
    let mut column = [0.0; 6];
    column[axis] = size;
    column
}

// A joint of 10⁸ leaves 4 of a shift of 1 in the direction of another.
#[test]
fn the_shift_grows_with_the_roundings_of_the_largest() {
    let tip = TipWrench::try_new(TipWrenchConfig { noise: [1.0; 2], force: 1.0, couple: 1.0 });
    let tip = tip.expect("a good configuration");
    let jacobian = [along(0, 1e8), along(4, 2.0)].map(motion);
    let force = tip.estimate(&jacobian, &[0.0, 3.0]).expect("finite");
    let shift = 1.0 + (1e16 + 4.0) * f64::EPSILON * 2.0;
    let expected = 2.0 * 3.0 / (4.0 + shift);
    assert!((force.lin.y - expected).abs() < 1e-12, "{force:?}");
}

#[test]
fn the_first_joint_that_is_not_finite_is_named() {
    for bad in [f64::NAN, f64::INFINITY] {
        for joint in 0..4 {
            let fault = Err(Fault::NotFinite { joint });
            let mut external = [1.0; 4];
            external[joint] = bad;
            assert_eq!(estimated(&JACOBIAN, &external), fault);
            for axis in 0..6 {
                let mut jacobian = JACOBIAN;
                jacobian[joint][axis] = bad;
                assert_eq!(estimated(&jacobian, &[1.0; 4]), fault, "{axis}");
            }
        }
    }
    // Numbers that are too large are of no joint.
    let fault = Err(Fault::NotFinite { joint: 0 });
    assert_eq!(estimated(&JACOBIAN, &[0.0, 0.0, 0.0, f64::MAX]), fault);
    let mut jacobian = JACOBIAN;
    jacobian[3] = along(3, 1e200);
    assert_eq!(estimated(&jacobian, &[0.0; 4]), fault);
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let of = |change: fn(&mut TipWrenchConfig<f64, 4>)| {
        let mut config = CONFIG;
        change(&mut config);
        TipWrench::try_new(config).map(|_| ())
    };
    let refused = |parameter| Err(ConfigError::OutOfRange { parameter });
    let noise = refused(ConfigParameter::TorqueNoise);
    assert_eq!(of(|c| c.noise[3] = 1e-6), Ok(()));
    assert_eq!(of(|c| c.noise[3] = 1e6), Ok(()));
    assert_eq!(of(|c| c.noise[3] = 0.9e-6), noise);
    assert_eq!(of(|c| c.noise[3] = 1.05e6), noise);
    assert_eq!(of(|c| c.noise[3] = f64::NAN), noise);
    let size = refused(ConfigParameter::WrenchSize);
    assert_eq!(of(|c| c.force = 0.0), size);
    assert_eq!(of(|c| c.force = f64::INFINITY), size);
    // Without couples, a force alone is estimated.
    assert_eq!(of(|c| c.couple = 0.0), Ok(()));
    assert_eq!(of(|c| c.couple = -1.0), size);
    assert_eq!(of(|c| c.couple = f64::INFINITY), size);
}
