//! Robots with kinematic loops: general loops and clusters against C that CasADi generates.
//!
//! The C and general loops are given closed states with sines and cosines; clusters the independent coordinates alone.
//! In forward dynamics the torques of the motors stand in the place of the first accelerations.

use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{
    BodyFrame, LoopJoint, LoopRobot, Loops, Moving, Stabilisation, assemble, coordinate_map,
    forward_dynamics, inverse_dynamics,
};
use dynamics_core::model::{BASE, Joint, Model, Robot, Static};
use dynamics_core::robots::A1Free;
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine};
use firmware_demo::robots::planar_loops::{FiveBar, FourBar};
use firmware_demo::robots::{Delta, FourBarLeg, PickDelta};
use heapless::Vec;

use crate::costs::row::numbers;
use crate::{Ask, Of, Ours, Peer, STATES, Scene, both, closed, compare};

/// The Unitree A1 with all feet held.
struct A1Held;

/// A foot, held where it is with thighs at 0.8 and calves at −1.6 rad under a level trunk at the origin.
const fn held(name: &'static str, foot: usize, [ahead, left]: [f64; 2]) -> LoopJoint {
    let below = -0.4 * 0.696_706_709_347_165_4; // cos 0.8
    let place = BodyFrame::new(BASE).xyz([ahead * 0.1805, left * (0.047 + 0.0838), below]);
    LoopJoint::new(name, Joint::spherical(), [place, BodyFrame::new(foot)])
}

impl Robot<17, 19, 18> for A1Held {
    const MODEL: Model<f64, 17, 19, 18> = {
        let mut model = A1Free::MODEL;
        model.name = "a1_held";
        model
    };
}

impl LoopRobot<17, 19, 18, 4, 12, 12> for A1Held {
    const LOOPS: Loops<4, 12, 12> = Loops::new(
        &Self::MODEL,
        [
            held("front_right", 4, [1.0, -1.0]),
            held("front_left", 8, [1.0, 1.0]),
            held("rear_right", 12, [-1.0, -1.0]),
            held("rear_left", 16, [-1.0, 1.0]),
        ],
        [6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17],
    );
}

pub fn four_bar(inverse: &[Peer], forward: &[Peer]) {
    let states = closed::four_bar().map(moving::<FourBar, 3, 3, 3, 1, 5, 1>);
    inverse_of::<FourBar, 3, 3, 3, 1, 5, 1>(&states, inverse);
    forward_of::<FourBar, 3, 3, 3, 1, 5, 1>(&states, forward);
}

pub fn five_bar(inverse: &[Peer], forward: &[Peer]) {
    let states = closed::five_bar().map(moving::<FiveBar, 4, 4, 4, 1, 5, 2>);
    inverse_of::<FiveBar, 4, 4, 4, 1, 5, 2>(&states, inverse);
    forward_of::<FiveBar, 4, 4, 4, 1, 5, 2>(&states, forward);
}

pub fn delta(inverse: &[Peer], forward: &[Peer]) {
    let states = closed::delta().map(moving::<Delta, 10, 22, 21, 6, 18, 3>);
    inverse_of::<Delta, 10, 22, 21, 6, 18, 3>(&states, inverse);
    forward_of::<Delta, 10, 22, 21, 6, 18, 3>(&states, forward);
}

pub fn four_bar_leg(inverse: &[Peer], forward: &[Peer]) {
    let reach = [2.0, 0.6, 2.0];
    clustered::<FourBarLeg, 5, 3>(reach, &[0, 1, 4], [inverse, forward]);
}

pub fn pick_delta(inverse: &[Peer], forward: &[Peer]) {
    clustered::<PickDelta, 12, 3>([0.5; 3], &PickDelta::MOTORS, [inverse, forward]);
}

/// The motors' torques do not follow from a motion that twelve of them make.
pub fn a1_held(_: &[Peer], forward: &[Peer]) {
    let mut number = numbers();
    let states = [(); STATES].map(|()| {
        let mut q = [0.0; 19];
        q[3] = 1.0;
        for (k, q) in q.iter_mut().enumerate() {
            *q += number(if k < 7 { 0.05 } else { 0.2 });
        }
        for hip in [7, 10, 13, 16] {
            q[hip + 1] += 0.8;
            q[hip + 2] -= 1.6;
        }
        let robot = &Static::<A1Held>::NEW;
        match assemble(robot, &A1Held::LOOPS, &q, Moving::All) {
            Ok(closed) => q = closed.q,
            Err(_) => defmt::panic!("a foot is not where it is held"),
        }
        moving::<A1Held, 17, 19, 18, 4, 12, 12>(State {
            q,
            qd: [(); 18].map(|()| number(2.0)),
            qdd: [(); 18].map(|()| number(10.0)),
        })
    });
    forward_of::<A1Held, 17, 19, 18, 4, 12, 12>(&states, forward);
}

/// The state with velocities that fit its loops.
fn moving<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    mut state: State<f32, Q, V>,
) -> State<f32, Q, V>
where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    let rates = T::LOOPS.actuated().map(|at| state.qd[at]);
    match coordinate_map(&Static::<T>::NEW, &T::LOOPS, &state.q) {
        Ok(map) => state.qd = map.velocity(&rates),
        Err(_) => defmt::panic!("a loop is open"),
    }
    state
}

fn asks<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(
    states: &[State<f32, Q, V>; STATES],
) -> [Ask<Q, V>; STATES] {
    states.map(|state| Ask::new(state, Core::<T>::joint_trig(&state.q), ()))
}

fn inverse_of<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    states: &[State<f32, Q, V>; STATES],
    peers: &[Peer],
) where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    let run: for<'a> fn(&'a Ask<Q, V>) -> Option<[f32; A]> = |ask| {
        let state = ask.trig.with(&ask.state);
        let found = inverse_dynamics(&Static::<T>::NEW, &T::LOOPS, state, &RIGID_BODY);
        found.ok().map(|found| found.tau)
    };
    one::<T, A, B, Q, V>("loops_inverse", states, peers, run);
}

fn forward_of<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    states: &[State<f32, Q, V>; STATES],
    peers: &[Peer],
) where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    let run: for<'a> fn(&'a Ask<Q, V>) -> Option<[f32; V]> = |ask| {
        let (state, by) = (ask.trig.with(&ask.state), Stabilisation::NONE);
        let tau = ask.state.qdd.first_chunk()?;
        let found = forward_dynamics(&Static::<T>::NEW, &T::LOOPS, state, tau, by, &RIGID_BODY);
        found.ok().map(|found| found.qdd)
    };
    one::<T, V, B, Q, V>("loops_forward", states, peers, run);
}

/// A function of general loops, which has one form.
fn one<T: Robot<B, Q, V>, const N: usize, const B: usize, const Q: usize, const V: usize>(
    algorithm: &'static str,
    states: &[State<f32, Q, V>; STATES],
    peers: &[Peer],
    run: for<'a> fn(&'a Ask<Q, V>) -> Option<[f32; N]>,
) {
    let asks = &asks::<T, B, Q, V>(states);
    let ours: [Ours<_>; 1] = [("core", run, run as usize)];
    let of = Of::robot::<T, B, Q, V>(algorithm);
    compare((of, asks, peers), &ours, |run, ask| run(ask), flat);
}

/// The numbers, or none, which counts as wrong.
fn flat<const N: usize>(found: Option<[f32; N]>) -> Vec<f32, { crate::MOST }> {
    found.into_iter().flatten().collect()
}

fn clustered<T, const N: usize, const Y: usize>(
    reach: [f32; Y],
    independent: &'static [usize; Y],
    [inverse, forward]: [&[Peer]; 2],
) where
    T: ClusteredRobot<N, N, N, Y, Y>,
{
    let mut number = numbers();
    let mut asks = [(); STATES].map(|()| {
        let y = State {
            q: reach.map(&mut number),
            qd: [(); Y].map(|()| number(3.0)),
            qdd: [(); Y].map(|()| number(10.0)),
        };
        match Clustered::<Core<T>>::motion(&y) {
            Ok(motion) => Ask::new(*motion.state().state(), *motion.configuration(), y),
            Err(_) => defmt::panic!("a cluster does not close"),
        }
    });
    type OfY<T, const Y: usize> = fn(&State<f32, Y, Y>, &Scene) -> Result<[f32; Y], T>;
    let forms: [OfY<_, Y>; 2] = [Clustered::<Core<T>>::rnea, Clustered::<Engine<T>>::rnea];
    let of = Of::robot::<T, N, N, N>("loops_inverse");
    compare(
        (of, &asks, inverse),
        &both(forms.map(|run| (run, run as usize))),
        |run, ask| run(&ask.own, &RIGID_BODY),
        |tau| flat(tau.ok()),
    );
    for ask in &mut asks {
        ask.state.qdd[..Y].copy_from_slice(&ask.own.qdd);
    }
    type Forward<T, const Y: usize> =
        fn(&State<f32, Y, Y>, &[f32; Y], &Scene) -> Result<[f32; Y], T>;
    let forms: [Forward<_, Y>; 2] = [
        Clustered::<Core<T>>::aba,
        Clustered::<Engine<T>>::forward_dynamics,
    ];
    let of = Of {
        outputs: independent,
        ..Of::robot::<T, N, N, N>("loops_forward")
    };
    compare(
        (of, &asks, forward),
        &both(forms.map(|run| (run, run as usize))),
        |run, ask| run(&ask.own, &ask.own.qdd, &RIGID_BODY),
        |ydd| flat(ydd.ok()),
    );
}
