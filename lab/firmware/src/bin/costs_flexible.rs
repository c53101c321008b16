//! The cost of dynamics of an arm whose links bend, and of inverse dynamics of the same arm without
//! modes.
#![no_std]
#![no_main]

mod costs;

use costs::row::{Row, numbers};
use costs::{STATES, done};
use dynamics_core::effects::{Elasticity, RIGID_BODY};
use dynamics_core::flexible::{
    Bending, BendingRobot, FlexibleInertia, JointsAndModes, ModalFeedforward, Modes, crba,
    forward_dynamics, rnea,
};
use dynamics_core::model::Static;
use dynamics_core::state::State;
use dynamics_core::{Engine, algorithms};
use firmware_demo::robots::TwoLink;
use firmware_demo::robots::two_link::{MODES_1, MODES_2};

const ROBOT: Static<TwoLink> = Static::NEW;

/// A state of joints and modes, and torques.
struct Case<const M: usize> {
    joints: State<f32, 2, 2>,
    bent: State<f32, M, M>,
    tau: [f32; 2],
}

/// Cases from a fixed seed; deflections up to 20 mm.
fn cases<const M: usize>() -> [Case<M>; STATES] {
    let mut number = numbers();
    [(); STATES].map(|()| Case {
        joints: State {
            q: [(); 2].map(|()| number(3.0)),
            qd: [(); 2].map(|()| number(3.0)),
            qdd: [(); 2].map(|()| number(10.0)),
        },
        bent: State {
            q: [(); M].map(|()| number(0.02)),
            qd: [(); M].map(|()| number(1.0)),
            qdd: [(); M].map(|()| number(50.0)),
        },
        tau: [(); 2].map(|()| number(5.0)),
    })
}

#[inline(never)]
fn rigid<const M: usize>(case: &Case<M>) -> [f32; 2] {
    algorithms::rnea(&ROBOT, &case.joints, &RIGID_BODY)
}

/// A robot's modes, as a constant of the measured functions.
trait Table<const M: usize> {
    const MODES: Modes<f32, M>;
}

/// The arm with the first mode of each link.
struct One;
struct Two;

impl Table<2> for One {
    const MODES: Modes<f32, 2> = MODES_1;
}

impl Table<4> for Two {
    const MODES: Modes<f32, 4> = MODES_2;
}

#[inline(never)]
fn inverse<T: Table<M>, const M: usize>(case: &Case<M>) -> JointsAndModes<f32, 2, M> {
    let scene = (RIGID_BODY, Elasticity);
    rnea(&ROBOT, const { &T::MODES }, &case.joints, &case.bent, &scene)
}

#[inline(never)]
fn inertia<T: Table<M>, const M: usize>(case: &Case<M>) -> FlexibleInertia<f32, 2, M> {
    let scene = (RIGID_BODY, Elasticity);
    let (q, eta) = (&case.joints.q, &case.bent.q);
    crba(&ROBOT, const { &T::MODES }, q, eta, &scene)
}

#[inline(never)]
fn forward<T: Table<M>, const M: usize>(case: &Case<M>) -> Option<JointsAndModes<f32, 2, M>> {
    let scene = (RIGID_BODY, Elasticity);
    let Case { joints, bent, tau } = case;
    forward_dynamics(&ROBOT, const { &T::MODES }, joints, bent, tau, &scene).ok()
}

#[inline(never)]
fn feedforward<T: Table<M>, const M: usize>(case: &Case<M>) -> Option<[f32; 2]> {
    let scene = (RIGID_BODY, Elasticity);
    let mut modes = ModalFeedforward { bent: case.bent };
    let found = modes.tick(&ROBOT, const { &T::MODES }, &case.joints, &scene, 1e-3);
    core::hint::black_box(&modes);
    found.ok()
}

#[inline(never)]
fn rigid_engine<const M: usize>(case: &Case<M>) -> [f32; 2] {
    Engine::<TwoLink>::rnea(&case.joints, &RIGID_BODY)
}

#[inline(never)]
fn folded<const M: usize>(case: &Case<M>) -> JointsAndModes<f32, 2, M>
where
    TwoLink: BendingRobot<2, 2, 2, M>,
{
    Bending::<Engine<TwoLink>>::rnea(&case.joints, &case.bent, &(RIGID_BODY, Elasticity))
}

#[inline(never)]
fn folded_inertia<const M: usize>(case: &Case<M>) -> FlexibleInertia<f32, 2, M>
where
    TwoLink: BendingRobot<2, 2, 2, M>,
{
    let (q, eta) = (&case.joints.q, &case.bent.q);
    Bending::<Engine<TwoLink>>::crba(q, eta, &(RIGID_BODY, Elasticity))
}

#[inline(never)]
fn folded_forward<const M: usize>(case: &Case<M>) -> Option<JointsAndModes<f32, 2, M>>
where
    TwoLink: BendingRobot<2, 2, 2, M>,
{
    let (Case { joints, bent, tau }, scene) = (case, (RIGID_BODY, Elasticity));
    Bending::<Engine<TwoLink>>::forward_dynamics(joints, bent, tau, &scene).ok()
}

#[inline(never)]
fn folded_feedforward<const M: usize>(case: &Case<M>) -> Option<[f32; 2]>
where
    TwoLink: BendingRobot<2, 2, 2, M>,
{
    let scene = (RIGID_BODY, Elasticity);
    let mut modes = ModalFeedforward { bent: case.bent };
    let found = Bending::<Engine<TwoLink>>::tick(&mut modes, &case.joints, &scene, 1e-3);
    core::hint::black_box(&modes);
    found.ok()
}

/// The rows of M modes in all.
fn rows<T: Table<M>, const M: usize>(inputs: &'static str, cases: &[Case<M>])
where
    TwoLink: BendingRobot<2, 2, 2, M>,
{
    let of = |algorithm| Row::of::<TwoLink, 2, 2>(algorithm, "core", inputs, true);
    for case in cases {
        defmt::assert!(forward::<T, M>(case).is_some() && feedforward::<T, M>(case).is_some());
    }
    of("rnea").measure(inverse::<T, M> as *const () as usize, cases, inverse::<T, M>);
    of("crba").measure(inertia::<T, M> as *const () as usize, cases, inertia::<T, M>);
    of("forward_dynamics").measure(forward::<T, M> as *const () as usize, cases, forward::<T, M>);
    let run = feedforward::<T, M>;
    of("modal_feedforward").measure(run as *const () as usize, cases, run);
    let of = |algorithm| Row::of::<TwoLink, 2, 2>(algorithm, "engine", inputs, true);
    of("rnea").measure(folded::<M> as *const () as usize, cases, folded);
    of("crba").measure(folded_inertia::<M> as *const () as usize, cases, folded_inertia);
    let run = folded_forward::<M>;
    of("forward_dynamics").measure(run as *const () as usize, cases, run);
    let run = folded_feedforward::<M>;
    of("modal_feedforward").measure(run as *const () as usize, cases, run);
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let cases = (cases::<2>(), cases::<4>());
    let row = Row::of::<TwoLink, 2, 2>("rnea", "core", "full", true);
    row.measure(rigid::<2> as *const () as usize, &cases.0, rigid);
    let row = Row::of::<TwoLink, 2, 2>("rnea", "engine", "full", true);
    row.measure(rigid_engine::<2> as *const () as usize, &cases.0, rigid_engine);
    rows::<One, 2>("2_modes", &cases.0);
    rows::<Two, 4>("4_modes", &cases.1);
    done()
}
