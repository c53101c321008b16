//! The cost of M, forward dynamics and Jacobians on the Panda, and of a pose of its tip.
#![no_std]
#![no_main]

mod costs;

use core::hint::black_box;

use costs::row::Row;
use costs::{Ask, STATES, asks};
use dynamics_core::Engine;
use dynamics_core::algorithms::frame::{LocalWorldAligned, Pose};
use dynamics_core::model::OnBody;
use dynamics_core::spatial::Motion;
use motion_control::motion::{PoseSolution, PoseSolver};
use robots::Panda;

const TIP: usize = 6;

fn tip(q: &[f32; 7]) -> (Pose<f32>, [Motion<f32>; 7]) {
    let trig = Engine::<Panda>::joint_trig(q);
    let [pose] = Engine::<Panda>::poses_of(&trig, OnBody::<TIP>);
    (pose, Engine::<Panda>::jacobian(&trig, OnBody::<TIP>, LocalWorldAligned))
}

#[inline(never)]
fn solve(solver: &PoseSolver<f32, 7>, ask: &Ask<7>) -> Option<PoseSolution<f32, 7>> {
    let [goal] = Engine::<Panda>::poses_of(&ask.trig, OnBody::<TIP>);
    solver.solve(&goal, &[0.0; 7], tip).ok()
}

/// All iterations that a solver may take: no pose is within this tolerance.
fn run() -> ! {
    let solver = PoseSolver {
        lower: black_box([-2.9; 7]),
        upper: [2.9; 7],
        length: 0.3,
        tolerance: 0.0,
        iterations: 130,
    };
    Row::of::<Panda, 7, 7>("pose_solver", "engine", "130_iterations", true).measure(
        solve as *const () as usize,
        &asks::<Panda, 7, 7, STATES>(),
        |ask| solve(&solver, ask),
    );
    costs::forward::both::<Panda, 7, 7, TIP>()
}

costs::main!(run());
