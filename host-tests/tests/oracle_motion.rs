//! Kinematics, energies, momenta and mobilities against Pinocchio, in f64 and f32.

use std::collections::BTreeMap;

use crate::common::of_recorded_robots;
use crate::common::{Verdict, Worst, flat, six, unit};
use dynamics_core::Core;
use dynamics_core::algorithms::{
    center_of_mass, centroidal_matrix, centroidal_momentum, frame, momentum, rnea_derivatives,
};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Robot, Static};
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use host_tests::measured::largest;
use host_tests::recordings::{Recording, columns, full_scale, load, row, symmetric};

/// Largest error of a quantity, and the full scale of what was recorded.
fn worst(rows: &[Vec<f64>]) -> Worst {
    Worst { error: 0.0, full_scale: full_scale(rows) }
}

/// The largest error of each quantity in each scalar, over all robots and relative to the robot's
/// full scale.
#[derive(Default)]
struct Most(BTreeMap<(&'static str, &'static str), f64>);

impl Most {
    fn see<R>(&mut self, quantity: &'static str, worst: &Worst) {
        let most = self.0.entry((quantity, core::any::type_name::<R>())).or_default();
        *most = largest([*most, worst.error / worst.full_scale]);
    }
}

fn motions<R: Real, T, const B: usize, const Q: usize, const V: usize>(
    r: &Recording,
    most: &mut Most,
) where
    T: Robot<B, Q, V>,
{
    let quantities = [
        ("tip pose", &r.tip_pose),
        ("tip velocity", &r.tip_velocity),
        ("tip acceleration", &r.tip_acceleration),
        ("jacobian in the body", &r.jacobian_local),
        ("jacobian in the world", &r.jacobian_world),
        ("jacobian, mixed", &r.jacobian_mixed),
        ("drift in the body", &r.drift_local),
        ("drift in the world", &r.drift_world),
        ("drift, mixed", &r.drift_mixed),
        ("kinetic energy", &r.kinetic_energy),
        ("potential energy", &r.potential_energy),
        ("centre of mass", &r.centre_of_mass),
        ("momentum", &r.momentum),
        ("centroidal momentum", &r.centroidal_momentum),
        ("centroidal matrix", &r.centroidal_matrix),
        ("M qd", &r.generalised_momentum),
        ("Cᵀ qd", &r.coriolis_transposed),
        ("∂ID/∂q", &r.rnea_by_q),
        ("∂ID/∂qd", &r.rnea_by_qd),
    ];
    let mut errors = quantities.map(|(_, rows)| worst(rows));
    let mut forward = <[Worst; 2]>::default();
    let tip = B - 1;
    for i in 0..r.first_states() {
        let velocity = |rows| row::<V>(rows, i).map(R::from_f64);
        let state = State {
            q: row::<Q>(&r.q, i).map(R::from_f64),
            qd: velocity(&r.qd),
            qdd: velocity(&r.qdd),
        };
        let k = Core::<T>::kinematics(&state, &());
        let pose = k.poses[tip];
        let rows = pose.rot.transpose().cols(); // rows of the rotation
        let flat_rot = |k: usize| rows[k / 3].array()[k % 3].to_f64();
        let place = pose.pos.array().map(R::to_f64);
        let got: [f64; 12] =
            core::array::from_fn(|k| if k < 9 { flat_rot(k) } else { place[k - 9] });
        errors[0].compare(got, row(&r.tip_pose, i));
        errors[1].compare(six(k.velocity(tip, frame::Local)), row(&r.tip_velocity, i));
        errors[2].compare(six(k.acceleration(tip, frame::Local)), row(&r.tip_acceleration, i));
        let jacobians = [
            Core::<T>::jacobian(&state.q, tip, frame::Local),
            Core::<T>::jacobian(&state.q, tip, frame::World),
            Core::<T>::jacobian(&state.q, tip, frame::LocalWorldAligned),
        ];
        for (k, jacobian) in jacobians.into_iter().enumerate() {
            let want = columns::<V>(quantities[3 + k].1, i);
            for (got, want) in jacobian.into_iter().zip(want) {
                errors[3 + k].compare(six(got), want);
            }
        }
        errors[6].compare(
            six(Core::<T>::bias_acceleration(&state, tip, frame::Local)),
            row(&r.drift_local, i),
        );
        errors[7].compare(
            six(Core::<T>::bias_acceleration(&state, tip, frame::World)),
            row(&r.drift_world, i),
        );
        errors[8].compare(
            six(Core::<T>::bias_acceleration(&state, tip, frame::LocalWorldAligned)),
            row(&r.drift_mixed, i),
        );
        let [kinetic, potential] = [
            Core::<T>::kinetic_energy(&state, &()),
            Core::<T>::potential_energy(&state.q, &RIGID_BODY),
        ];
        errors[9].compare([kinetic.to_f64()], row(&r.kinetic_energy, i));
        errors[10].compare([potential.to_f64()], row(&r.potential_energy, i));
        let centre = center_of_mass(&Static::<T>::NEW, &state, &()).position;
        errors[11].compare(centre.array().map(R::to_f64), row(&r.centre_of_mass, i));
        let all = |f: Force<R>| flat::<R>(f.ang, f.lin);
        errors[12].compare(all(momentum(&Static::<T>::NEW, &state, &())), row(&r.momentum, i));
        let h = centroidal_momentum(&Static::<T>::NEW, &state, &());
        errors[13].compare(all(h), row(&r.centroidal_momentum, i));
        let matrix = centroidal_matrix(&Static::<T>::NEW, &state.q, &());
        for (got, want) in matrix.into_iter().zip(columns::<V>(&r.centroidal_matrix, i)) {
            errors[14].compare(all(got), want);
        }
        let rate = Core::<T>::momentum_and_coriolis(&state, &());
        errors[15].compare(rate.p.map(R::to_f64), row(&r.generalised_momentum, i));
        errors[16].compare(rate.ct_qd.map(R::to_f64), row(&r.coriolis_transposed, i));
        if i < r.rnea_by_q.len() {
            let by = rnea_derivatives(&Static::<T>::NEW, &state, &RIGID_BODY);
            for (k, rows) in [by.dq, by.dqd].iter().enumerate() {
                let (want, _) = quantities[17 + k].1[i].as_chunks::<V>();
                for (got, want) in rows.iter().zip(want) {
                    errors[17 + k].compare(got.map(R::to_f64), *want);
                }
            }
            let tau = row::<V>(&r.rnea, i).map(R::from_f64);
            let by = Core::<T>::forward_dynamics_derivatives(&state, &tau, &RIGID_BODY);
            let by = by.expect("M is positive");
            for (k, want) in r.forward_derivatives::<V>(i).iter().enumerate() {
                for (got, want) in [&by.dq, &by.dqd][k].iter().zip(want) {
                    forward[k].see(got.map(R::to_f64), *want);
                }
            }
        }
    }
    for ((name, _), worst) in quantities.iter().zip(&errors) {
        most.see::<R>(name, worst);
    }
    for (name, worst) in ["∂FD/∂q", "∂FD/∂qd"].into_iter().zip(&forward) {
        most.see::<R>(name, worst);
    }
}

/// Λ⁻¹ of the tip by the O(n) recursion.
fn mobilities<R: Real, T, const B: usize, const Q: usize, const V: usize>(
    r: &Recording,
    most: &mut Most,
) where
    T: Robot<B, Q, V>,
{
    let mut errors = worst(&r.operational_inverse);
    for i in 0..r.first_states() {
        let q = row::<Q>(&r.q, i).map(R::from_f64);
        let mobility =
            Core::<T>::osim_inverse(&q, B - 1, frame::Local, &()).expect("M is positive");
        let got = mobility.along(&unit()).map(|row| row.map(R::to_f64));
        for (got, want) in got.into_iter().zip(symmetric::<6>(&r.operational_inverse, i)) {
            errors.compare(got, want);
        }
    }
    most.see::<R>("mobility", &errors);
}

fn both<T, const B: usize, const Q: usize, const V: usize>(most: &mut Most)
where
    T: Robot<B, Q, V>,
{
    let recording = load(T::MODEL.name);
    motions::<f64, T, B, Q, V>(&recording, most);
    motions::<f32, T, B, Q, V>(&recording, most);
    mobilities::<f64, T, B, Q, V>(&recording, most);
    mobilities::<f32, T, B, Q, V>(&recording, most);
}

// Mobilities agree as well, all within the table of tolerances.
#[test]
fn motions_energies_and_momenta_agree_with_pinocchio() {
    let mut most = Most::default();
    of_recorded_robots!(both, &mut most);
    let mut verdict = Verdict::default();
    for ((quantity, scalar), &error) in &most.0 {
        let full_scale = 1.0;
        verdict.see("recorded robots", quantity, scalar, &Worst { error, full_scale });
    }
    verdict.speak();
}

#[test]
fn a_recorded_triangle_by_rows_becomes_its_symmetric_matrix() {
    let rows = [vec![0.0, 1.0, 2.0, 11.0, 12.0, 22.0]];
    let want = [[0.0, 1.0, 2.0], [1.0, 11.0, 12.0], [2.0, 12.0, 22.0]];
    assert_eq!(symmetric::<3>(&rows, 0), want);
}
