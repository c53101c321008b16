//! Deflections and frequencies of a link.

use dynamics_core::effects::{Elasticity, Inertia, RIGID_BODY};
use dynamics_core::flexible::{Beam, FlexibleLink, ModalFeedforward, Mode, Modes, crba};
use dynamics_core::model::{ArmModel, BASE};
use host_tests::hard::Row;

use super::{Scalar, body, one};
use crate::UPPER;

pub(super) fn sag() -> Vec<Row> {
    fn tip<R: Scalar, const M: usize>() -> f64 {
        let (robot, modes) = one::<R, M>(&UPPER);
        let rest = ModalFeedforward::at_rest(&robot, &modes, &[R::ZERO], &(RIGID_BODY, Elasticity));
        rest.expect("stiffness").bent.q.iter().map(|eta| eta.to_f64()).sum()
    }
    fn run<R: Scalar>(rows: &mut Vec<Row>, bounds: [f64; 3]) {
        let (l, rho, ei, m, g) = (0.5_f64, 0.8, 4.0, 0.3, 9.81);
        let closed = -(rho * l.powi(4) / 8.0 + m * l.powi(3) / 3.0) * g / ei;
        let tips = [tip::<R, 1>(), tip::<R, 2>(), tip::<R, 3>()];
        for (k, tip) in tips.into_iter().enumerate() {
            let quantity = format!("deflection of the end, {} modes", k + 1);
            rows.push(Row::measured(quantity, R::NAME, (tip / closed - 1.0).abs(), bounds[k]));
        }
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, [2e-3, 6e-5, 4e-6]);
    run::<f64>(&mut rows, [2e-3, 6e-5, 4e-6]);
    rows
}

/// Powers of x from x² on as shapes: what a user gives who has no beam.
fn powers<const M: usize>() -> (ArmModel<f64, 1>, Modes<f64, M>) {
    let beam = Beam::new(1.0, 1.0);
    let model = ArmModel::new("ritz", [body("link", BASE, &beam)]);
    let mut modes = [Mode::ZERO; M];
    for (k, mode) in modes.iter_mut().enumerate() {
        let n = k as f64 + 2.0;
        mode.momentum[2] = 1.0 / (n + 1.0);
        mode.moments[2][0] = 1.0 / (n + 2.0);
        (mode.shift[2], mode.turn[1]) = (1.0, -n);
    }
    let mut link = FlexibleLink::new(0, [1.0, 0.0, 0.0], &modes);
    for k in 0..M {
        for l in 0..M {
            let (a, b) = (k as f64 + 2.0, l as f64 + 2.0);
            link.products[k][l][2][2] = 1.0 / (a + b + 1.0);
            link.stiffness[k][l] = a * (a - 1.0) * b * (b - 1.0) / (a + b - 3.0);
        }
    }
    let modes = Modes::new(&model, &[link]);
    (model, modes)
}

pub(super) fn frequencies() -> Vec<Row> {
    const ROOTS: [f64; 3] = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613];
    fn errors<R: Scalar, const M: usize>(robot: &ArmModel<R, 1>, modes: &Modes<R, M>) -> Vec<f64> {
        let m = crba(robot, modes, &[R::ZERO], &[R::ZERO; M], &Inertia);
        let omega = modes.frequencies(&m).expect("positive definite");
        let pairs = omega.iter().zip(ROOTS);
        pairs.map(|(omega, root)| omega.to_f64() / (root * root) - 1.0).collect()
    }
    fn run<R: Scalar, const M: usize>(rows: &mut Vec<Row>, bound: f64) {
        let plain = Beam::new(1.0, 1.0).bending([1.0, 1.0]);
        let (robot, modes) = one::<R, M>(&plain);
        let worst = errors(&robot, &modes).iter().fold(0.0, |worst, e| f64::max(worst, e.abs()));
        let quantity = format!("shapes of the beam, {M} modes, all frequencies");
        rows.push(Row::stated(quantity, R::NAME, worst, bound));
    }
    fn ritz<const M: usize>(rows: &mut Vec<Row>, bounds: [f64; M]) {
        let (robot, modes) = powers::<M>();
        for (k, error) in errors(&robot, &modes).into_iter().enumerate() {
            let quantity = format!("powers, {M} modes, frequency {}", k + 1);
            rows.push(Row::measured(quantity, "f64", error, bounds[k]));
            // From above, but for the rounding of a matrix of condition 10³.
            rows.push(Row::claim("from above", "f64", error > -1e-12));
        }
    }
    let mut rows = Vec::new();
    run::<f32, 1>(&mut rows, 1e-6);
    run::<f32, 2>(&mut rows, 1e-6);
    run::<f32, 3>(&mut rows, 1e-6);
    run::<f64, 1>(&mut rows, 2e-15);
    run::<f64, 2>(&mut rows, 1e-13);
    run::<f64, 3>(&mut rows, 1e-13);
    ritz::<1>(&mut rows, [0.3]);
    ritz::<2>(&mut rows, [0.006, 0.7]);
    ritz::<3>(&mut rows, [5e-4, 0.02, 1.2]);
    rows
}
