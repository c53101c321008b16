//! Operational space: two ways to Λ⁻¹, what Λ and its inverse are for, no jump at singular poses,
//! and control of motion and force with them.

use crate::common::*;
use dynamics_core::algorithms::{
    Conditioning, Damping, OperationalSpace, frame, operational_space, osim_inverse,
};
use dynamics_core::effects::{Armature, Inertia, Payload, RIGID_BODY};
use dynamics_core::model::{ArmModel, BASE, Body, BodyInertia, Joint, Model, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::spatial::Force;
use glam::DMat3;
use motion_control::law::TaskFrame;

const DAMPING: f64 = 1e-3;

fn both_ways<F: frame::Frame>(frame: F, worst: &mut Worst) {
    let mut rng = Rng::new(7);
    let load = Payload::<_, { B - 1 }>::from_inertia(BodyInertia {
        mass: 1.5,
        com: [0.1, -0.2, 0.05],
        inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015],
    });
    let scene = (Inertia, Armature([0.3; V]), load);
    for _ in 0..50 {
        let tree = random_tree(&mut rng, false);
        let q = random_state(&tree, &mut rng).q;
        for body in 0..B {
            let damping = Damping::relative(DAMPING);
            let task =
                operational_space(&tree, &q, (body, frame), &unit(), &scene, damping).unwrap();
            let recursion = osim_inverse(&tree, &q, body, frame, &scene).unwrap().along(&unit());
            for (got, want) in recursion.into_iter().zip(task.mobility) {
                worst.see(got, want);
            }
        }
    }
}

#[test]
fn recursive_and_factored_mobilities_agree() {
    let mut worst = Worst::default();
    both_ways(frame::Local, &mut worst);
    both_ways(frame::World, &mut worst);
    both_ways(frame::LocalWorldAligned, &mut worst);
    let mut verdict = Verdict::default();
    verdict.see("mixed tree", "mobility both ways", "f64", &worst);
    verdict.speak();
    let tree = random_tree(&mut Rng::new(1), false);
    let nobody = osim_inverse(&tree, &[0.1; Q], B, frame::Local, &RIGID_BODY).unwrap();
    assert_eq!(nobody.along(&unit()), [[0.0; 6]; 6]);
}

#[test]
fn a_joint_that_moves_no_inertia_is_named() {
    let empty: ArmModel<f64, 2> = Model::new(
        "empty hand",
        [
            Body::new("arm", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(1.0).com([0.3, 0.0, 0.0]),
            Body::new("hand", 0, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.6, 0.0, 0.0]),
        ],
    );
    let error = osim_inverse(&empty, &[0.1, 0.2], 1, frame::Local, &RIGID_BODY).unwrap_err();
    assert_eq!(error.joint, 1);
    let damping = Damping::relative(DAMPING);
    let task =
        operational_space(&empty, &[0.1, 0.2], (1, frame::Local), &unit(), &RIGID_BODY, damping);
    assert_eq!(task.unwrap_err().joint, 1);
}

/// Tasks at random poses that are not near a singular one.
fn regular_tasks<T: Robot<N, N, N>, const N: usize, const M: usize>(
    directions: &[Force<f64>; M],
) -> Vec<OperationalSpace<f64, M, N>> {
    let mut rng = Rng::new(11);
    let poses = (0..200).map(|_| rng.vector(3.0)).collect::<Vec<[f64; N]>>();
    let damping = Damping::relative(DAMPING);
    let task = |q| {
        operational_space(
            &T::MODEL,
            q,
            (N - 1, frame::LocalWorldAligned),
            directions,
            &RIGID_BODY,
            damping,
        )
    };
    let tasks = poses.iter().map(|q| task(q).unwrap());
    tasks.filter(|task| task.conditioning == Conditioning::Regular).collect()
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn inverses<T: Robot<N, N, N>, const N: usize, const M: usize>(
    directions: &[Force<f64>; M],
    worst: &mut [Worst; 3],
) {
    let tasks = regular_tasks::<T, N, M>(directions);
    assert!(tasks.len() > 50, "{}", tasks.len());
    let mut rng = Rng::new(13);
    for task in tasks {
        let inverse = task.consistent_inverse();
        for i in 0..M {
            let one: [f64; M] = core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
            worst[0].see(task.inertia.map(|row| dot(&row, &task.mobility[i])), one);
            worst[1].see(inverse.map(|column| dot(&column, &task.jacobian[i])), one);
        }
        // Torques in the null space of the task: no acceleration, nor any effect of the free part
        // twice.
        let tau: [f64; N] = rng.vector(30.0);
        let felt = |tau: &[f64; N]| task.response.map(|response| dot(&response, tau));
        let all = felt(&tau).into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let unseen = felt(&task.null_space_torque(&tau)).map(|x| x / all);
        worst[2].full_scale = 1.0;
        worst[2].see(unseen, [0.0; M]);
    }
}

// Torques of the null space are not felt in the task.
#[test]
fn operational_inertia_and_jacobian_have_their_inverses() {
    let mut worst = [(); 3].map(|()| Worst::default());
    inverses::<Ur5e, 6, 3>(&TaskFrame::BASE.place(), &mut worst);
    inverses::<Panda, 7, 3>(&TaskFrame::BASE.place(), &mut worst);
    inverses::<Panda, 7, 6>(&TaskFrame::BASE.turn_and_place(0.3), &mut worst);
    let mut verdict = Verdict::default();
    for (law, worst) in ["Λ of Λ⁻¹", "J of its inverse", "free torque"].iter().zip(&worst) {
        verdict.see("arms", law, "f64", worst);
    }
    verdict.speak();
}

#[test]
fn a_task_frame_turns_the_inertia_with_it() {
    let q = [0.1, -1.2, 1.5, 0.3, 0.7, 0.0];
    let axes = DMat3::from_rotation_z(0.7) * DMat3::from_rotation_x(-0.4);
    let damping = Damping::relative(DAMPING);
    let of = |frame: TaskFrame<f64>| {
        let place = frame.place();
        let task = operational_space(
            &Ur5e::MODEL,
            &q,
            (5, frame::LocalWorldAligned),
            &place,
            &RIGID_BODY,
            damping,
        );
        let [x, y, z] = task.unwrap().inertia;
        DMat3::from_cols(x.into(), y.into(), z.into())
    };
    let (base, turned) = (of(TaskFrame::BASE), of(TaskFrame { axes }));
    let apart = turned - axes.transpose() * base * axes;
    assert!(apart.to_cols_array().iter().all(|x| x.abs() < 1e-12), "{apart}");
}
