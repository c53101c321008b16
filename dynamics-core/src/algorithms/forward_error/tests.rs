use super::*;
use crate::algorithms::forward_dynamics;
use crate::effects::RIGID_BODY;
use crate::glam::{DMat3, DQuat, Mat3};
use crate::model::{ArmModel, BASE, Body, Joint, Link, Model, Robot};
use crate::robots::*;
use crate::state::State;
use crate::state::manifold::normalise;

/// Numbers within ±1, always the same.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn within<const N: usize>(&mut self, bound: f64) -> [f32; N] {
        core::array::from_fn(|_| (bound * self.next()) as f32)
    }
}

/// The numbers of an f32 model in f64.
fn widened<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
) -> Model<f64, B, Q, V> {
    let rotation = |r: &Mat3| DMat3::from_quat(DQuat::from_mat3(&r.as_dmat3()).normalize());
    let (single, mut wide) = (model.to_f32(), *model);
    let widen = |(link, single): (&mut Link<f64>, &Link<f32>)| {
        link.placement.rot = rotation(&single.placement.rot);
        link.placement.pos = single.placement.pos.as_dvec3();
        link.inertia.mass = single.inertia.mass.into();
        link.inertia.first_moment = single.inertia.first_moment.as_dvec3();
        link.inertia.rotational = single.inertia.rotational.as_dmat3();
    };
    wide.links.iter_mut().zip(&single.links).for_each(widen);
    wide
}

/// The error of f32 forward dynamics, and what it is estimated to be, both relative to the largest
/// acceleration, in twenty states.
fn measured<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    q_within: f64,
) -> [[f64; 2]; 20] {
    let (single, double) = (model.to_f32(), widened(model));
    let mut numbers = Numbers(7);
    core::array::from_fn(|_| {
        let mut q = numbers.within(q_within);
        normalise(&single, &mut q).expect("no quaternion is zero");
        let (qd, qdd) = (numbers.within(3.0), numbers.within::<V>(10.0));
        let wide = State { q: q.map(f64::from), qd: qd.map(f64::from), qdd: qdd.map(f64::from) };
        let tau = rnea(&double, &wide, &RIGID_BODY).map(|tau| tau as f32);
        let truth =
            forward_dynamics(&double, &wide, &tau.map(f64::from), &RIGID_BODY).expect("regular");
        let state = State { q, qd, qdd };
        let Ok(found) = forward_dynamics_with_error(&single, &state, &tau, &RIGID_BODY) else {
            // No digit is left of a pivot: an error in place of a result.
            return [0.0, f64::INFINITY];
        };
        assert_eq!(Ok(found.qdd), forward_dynamics(&single, &state, &tau, &RIGID_BODY));
        let size = truth.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        let off = found.qdd.iter().zip(truth);
        let off = off.fold(0.0, |off: f64, (x, truth)| off.max((f64::from(*x) - truth).abs()));
        [off / size, found.relative().into()]
    })
}

/// K rods of 1 kg and 0.25 m: about parallel axes, or across and upright by turns.
fn rods<const K: usize>(in_space: bool) -> ArmModel<f64, K> {
    Model::new(
        "rods",
        core::array::from_fn(|i| {
            let axis = if in_space && i % 2 == 1 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
            let (parent, at) = if i == 0 { (BASE, 0.0) } else { (i - 1, 0.25) };
            let across = 0.25 * 0.25 / 12.0;
            Body::new("rod", parent, Joint::revolute(axis))
                .xyz([at, 0.0, 0.0])
                .mass(1.0)
                .com([0.125, 0.0, 0.0])
                .inertia([0.02 * across, 0.0, 0.0, across, 0.0, across])
        }),
    )
}

/// The estimate bounds the error in each state, and is not far above the largest of them.
fn hold<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    q_within: f64,
) -> f64 {
    let all = measured(model, q_within);
    let name = model.name;
    for [error, estimate] in all {
        assert!(error <= estimate, "{name}: {error:e} of {estimate:e}");
    }
    let largest = |k: usize| all.iter().fold(0.0, |largest: f64, of| largest.max(of[k]));
    let [error, estimate] = [0, 1].map(largest);
    assert!(100.0 * error >= estimate, "{name}: {error:e} of {estimate:e}");
    estimate
}

#[test]
fn the_error_of_f32_is_at_most_its_estimate() {
    let arms = [
        hold(&Ur5e::MODEL, 3.0),
        hold(&Panda::MODEL, 3.0),
        hold(&Iiwa14::MODEL, 3.0),
        hold(&Gen3::MODEL, 3.0),
        hold(&XArm7::MODEL, 3.0),
        hold(&Z1::MODEL, 3.0),
        hold(&So101::MODEL, 2.0),
        hold(&Puma560::MODEL, 3.0),
        hold(&OpenArm::MODEL, 3.0),
        hold(&Yam::MODEL, 3.0),
        hold(&A1Leg::MODEL, 3.0),
        hold(&A1::MODEL, 3.0),
        hold(&A1Free::MODEL, 3.0),
    ];
    assert!(arms.iter().all(|estimate| *estimate < 5e-4), "{arms:?}");
    hold(&G1::MODEL, 2.0);
    let humanoid = hold(&G1Free::MODEL, 2.0);
    assert!(humanoid > 1e-3, "a humanoid loses digits, {humanoid:e}");
}

// An estimate above 1 says that no digit is left.
#[test]
fn for_long_chains_the_error_estimate_exceeds_one() {
    hold(&rods::<16>(false), 0.0);
    hold(&rods::<16>(false), 0.1);
    hold(&rods::<16>(true), 3.0);
    hold(&rods::<64>(true), 3.0);
    assert!(hold(&rods::<64>(false), 0.0) > 1.0);
    assert!(hold(&rods::<64>(false), 0.1) > 1.0);
}
