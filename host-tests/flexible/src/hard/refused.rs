//! Modes, shapers and numbers that are refused.

use dynamics_core::effects::{Elasticity, RIGID_BODY};
use dynamics_core::flexible::{FlexibleLink, ModeProblem, Modes, Shape, step};
use dynamics_core::model::{ArmModel, BASE};
use dynamics_core::state::State;
use host_tests::hard::Row;
use motion_control::reference::{Shaper, ShaperProblem, Vibration};

use super::{body, one};
use crate::UPPER;

pub(super) fn refused() -> Vec<Row> {
    let mut rows = Vec::new();
    let model: ArmModel<f64, 1> = ArmModel::new("one", [body("link", BASE, &UPPER)]);
    let good = UPPER.link(0, &[Shape::BendZ(1), Shape::BendZ(2)]).expect("a beam");
    let mut claim =
        |what: &str, mode: usize, problem: ModeProblem, spoil: &dyn Fn(&mut FlexibleLink)| {
            let mut link = good;
            spoil(&mut link);
            let error = Modes::<f64, 2>::try_new(&model, &[link]).err();
            let named =
                error.is_some_and(|e| (e.link, e.mode, e.problem) == ("link", mode, problem));
            rows.push(Row::claim(what, "f64", named));
        };
    claim("no mass: named", 1, ModeProblem::NoMass, &|link| {
        link.products[1][1] = [[0.0; 3]; 3];
    });
    claim("negative stiffness: named", 0, ModeProblem::Stiffness, &|link| {
        link.stiffness[0][0] *= -1.0
    });
    claim("stiffness not positive definite: named", 1, ModeProblem::Stiffness, &|link| {
        let off = 2.0 * (link.stiffness[0][0] * link.stiffness[1][1]).sqrt();
        (link.stiffness[0][1], link.stiffness[1][0]) = (off, off);
    });
    claim("another's multiple: named", 1, ModeProblem::Inertia, &|link| {
        link.modes[1] = link.modes[0];
        let same = link.products[0][0];
        (link.products[0][1], link.products[1][0], link.products[1][1]) = (same, same, same);
    });
    claim("a rigid rotation: named", 0, ModeProblem::RigidMotion, &|link| {
        // φ = x along z.
        let mode = &mut link.modes[0];
        mode.momentum = [0.0, 0.0, UPPER.mass() * UPPER.com()[0]];
        let [.., yy, _, _] = UPPER.inertia();
        let second = yy + UPPER.mass() * UPPER.com()[0].powi(2);
        mode.moments = [[0.0; 3], [0.0; 3], [second, 0.0, 0.0]];
        link.products[0][0] = [[0.0; 3], [0.0; 3], [0.0, 0.0, second]];
        (link.products[0][1], link.products[1][0]) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    });
    claim("NaN: named", 1, ModeProblem::NotFinite, &|link| link.modes[1].moments[2][0] = f64::NAN);
    claim("products that are no transposes: named", 1, ModeProblem::Inertia, &|link| {
        link.products[1][0][2][2] += 1e-3
    });
    claim("more modes than a link may have: named", 6, ModeProblem::Count, &|link| {
        link.count = 7;
    });
    claim("negative damping: named", 0, ModeProblem::Damping, &|link| link.damping[0][0] = -1.0);
    let still = Vibration { link: "link", mode: 1, omega: 0.0, damping_ratio: 0.0 };
    let error = Shaper::<f64, 3>::zv(&[still], 1e-3).err();
    let named =
        error.is_some_and(|e| (e.link, e.mode, e.problem) == ("link", 1, ShaperProblem::Frequency));
    rows.push(Row::claim("a shaper of frequency zero: named", "f64", named));

    let (robot, modes) = one::<f32, 2>(&UPPER);
    let scene = (RIGID_BODY, Elasticity);
    let mut all = true;
    for bad in [f32::NAN, f32::INFINITY] {
        for place in 0..4 {
            let (mut joint, mut bent) = (State::at([0.1_f32]), State::at([0.01_f32, 0.0]));
            [&mut joint.q[0], &mut joint.qd[0], &mut bent.q[1], &mut bent.qd[0]][place]
                .clone_from(&bad);
            let before = bent.q[0];
            let refused =
                step(&robot, &modes, &mut joint, &mut bent, &[1.0], &scene, 1e-3).is_err();
            all &= refused && bent.q[0].to_bits() == before.to_bits();
        }
    }
    rows.push(Row::claim("NaN and infinity: an error, and the state unchanged", "f32", all));
    rows
}
