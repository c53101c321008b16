//! Claims about the scenes with closed loops, `parallel_ankle` and `delta_pick`: their references,
//! and what happens where a loop does not close.

use crate::common::{Verdict, Worst};
use dynamics_core::clusters::{ClusterProblem, Clustered};
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine};
use firmware_demo::plant::{ClusterPlant, Simulated};
use firmware_demo::robots::{G1Ankle, PickDelta};
use firmware_demo::scene::clustered::MotorReference;
use firmware_demo::scene::{Full, Scene, Start, TICK, devices};
use firmware_demo::scenes::delta_pick::Picking;
use firmware_demo::scenes::parallel_ankle::AnkleSteps;
use firmware_demo::sim_io::Wires;
use firmware_demo::trajectories::MID_STANCE;
use firmware_demo::trajectories::picks::{FEEDER, LIFT, MOVE, Picks, REACH, cranks};
use glam::Vec3;
use motion_control::{limits::Fault, reference::Reference};

fn wide<const N: usize>(state: &State<f32, N, N>) -> State<f64, N, N> {
    State { q: state.q.map(f64::from), qd: state.qd.map(f64::from), qdd: state.qdd.map(f64::from) }
}

/// The platform's rows of the tree's state.
fn platform<R: Copy + Into<f64>>(tree: &State<R, 12, 12>) -> [[f64; 3]; 3] {
    let rows = |of: &[R; 12]| [of[9], of[10], of[11]].map(Into::into);
    [rows(&tree.q), rows(&tree.qd), rows(&tree.qdd)]
}

#[test]
fn the_cranks_move_the_platform_along_its_path() {
    let picks = Picks::new().unwrap();
    let [mut double, mut single]: [[Worst; 3]; 2] = Default::default();
    for tick in 0..=picks.ticks() {
        let path = picks.platform(tick);
        let want = wide(&path);
        let exact = cranks(&want);
        let motion = Clustered::<Core<PickDelta>>::motion(&exact).unwrap();
        assert_eq!(motion.singular(), None);
        let got = platform(motion.state().state());
        for (worst, (got, want)) in
            double.iter_mut().zip(got.into_iter().zip([want.q, want.qd, want.qdd]))
        {
            worst.see(got, want);
        }
        let motion = Clustered::<Engine<PickDelta>>::motion(&cranks(&path)).unwrap();
        let got = platform(motion.state().state());
        for (worst, (got, want)) in
            single.iter_mut().zip(got.into_iter().zip([want.q, want.qd, want.qdd]))
        {
            worst.see(got, want);
        }
    }
    let mut verdict = Verdict::default();
    for (worst, scalar) in [(&double, "f64"), (&single, "f32")] {
        verdict.see("picks", "position by cranks", scalar, &worst[0]);
        verdict.see("picks", "velocity by cranks", scalar, &worst[1]);
        verdict.see("picks", "acceleration by cranks", scalar, &worst[2]);
    }
    verdict.speak();
}

#[test]
fn a_pick_takes_half_a_second_there_and_back() {
    let picks = Picks::new().unwrap();
    assert_eq!(2.0 * MOVE as f32 * TICK * 120.0, 60.0);
    let moves = picks.ticks() / MOVE;
    assert_eq!((moves, moves * MOVE), (8, picks.ticks()));
    let at = |tick: u32| Vec3::from(picks.platform(tick).q);
    for one in 0..moves {
        let (from, to) = (at(one * MOVE), at((one + 1) * MOVE));
        assert!(((to - from).length() - REACH).abs() < 1e-6);
        assert_eq!(picks.platform(one * MOVE).qd, [0.0; 3]);
        let highest = (0..MOVE).map(|tick| at(one * MOVE + tick).z).fold(f32::MIN, f32::max);
        assert!((highest - (FEEDER[2] + LIFT)).abs() < 1e-6, "{highest}");
        // The path within 20 mm of the ends is lifted and lowered there.
        for tick in 0..MOVE {
            let here = at(one * MOVE + tick);
            let flat = |v: Vec3| (v - Vec3::Z * v.z).length();
            let near = flat(here - from).min(flat(here - to)) < 0.02 + 1e-6;
            assert!(near || highest - here.z < 1e-6, "{here}");
        }
    }
}

/// Torques and speeds of a scene's way as shares of its limits.
fn shares<S, const B: usize, const V: usize>() -> [f32; 2]
where
    S: Scene<B, V, V, 3>,
{
    let reference = S::reference().unwrap();
    let limits = S::LIMITS;
    let mut most = [0.0_f32; 2];
    for tick in 0..=reference.ticks() {
        let (wanted, environment) = (reference.at(tick), S::environment(&reference, tick as f32));
        let tau = S::inverse(&wanted, &environment, &S::EFFECTS);
        for (j, limit) in limits.iter().enumerate() {
            assert!((limit.lower..=limit.upper).contains(&wanted.q[j]), "{wanted:?}");
            let used = [tau[j].abs() / limit.torque, wanted.qd[j].abs() / limit.velocity];
            assert!(used.iter().all(|share| *share < 1.0), "{used:?}");
            most = core::array::from_fn(|k| most[k].max(used[k]));
        }
    }
    println!("{}: {most:?} of torque and speed", S::NAME);
    most
}

/// Motions far below the limits would make small tracking errors meaningless.
#[test]
fn the_motions_use_a_good_share_of_motor_limits() {
    let [torque, speed] = shares::<Picking, 12, 12>();
    assert!(torque > 0.3 && speed > 0.3);
    let [_, speed] = shares::<AnkleSteps, 9, 9>();
    assert!(speed > 0.15);
}

#[test]
fn motor_derivatives_agree_with_differences() {
    let reference = AnkleSteps::reference().unwrap();
    let states: Vec<_> = (0..=reference.ticks()).map(|tick| reference.at(tick)).collect();
    let (mut positions, mut velocities) = (Worst::default(), Worst::default());
    for pair in states.windows(2) {
        let [from, to] = [wide(&pair[0]), wide(&pair[1])];
        let mean = |a: f64, b: f64| 0.5 * f64::from(TICK) * (a + b);
        for j in 0..3 {
            positions.see([to.q[j] - from.q[j]], [mean(from.qd[j], to.qd[j])]);
            velocities.see([to.qd[j] - from.qd[j]], [mean(from.qdd[j], to.qdd[j])]);
        }
    }
    let mut verdict = Verdict::default();
    verdict.see("ankle", "velocity by difference", "f32", &positions);
    verdict.see("ankle", "acceleration by difference", "f32", &velocities);
    verdict.speak();
}

/// A foot that its rods do not reach from the 20th tick on.
struct Torn;

impl Reference<f32, 3> for Torn {
    fn at(&self, tick: u32) -> State<f32, 3, 3> {
        let [knee, pitch, roll] = MID_STANCE;
        State::at([knee, if tick < 20 { pitch } else { 2.0 }, roll])
    }

    fn ticks(&self) -> u32 {
        100
    }
}

// It gives no torque.
#[test]
fn a_reference_that_cannot_close_is_a_fault() {
    let torn = Clustered::<Engine<G1Ankle>>::motors(&Torn.at(20)).unwrap_err();
    assert_eq!((torn.cluster, torn.problem), ("ankle", ClusterProblem::CannotClose));
    assert_eq!(
        AnkleSteps::inverse(&State::at([0.0; 3]), &Torn.at(20), &AnkleSteps::EFFECTS),
        [0.0; 3]
    );

    let wires: &'static Wires<3> = Box::leak(Box::new(Wires::new()));
    let reference = MotorReference::<G1Ankle, Torn, 9, 9>::new(Torn);
    wires.publish(&reference.at(0).q);
    let gains = AnkleSteps::gains(&Torn.at(0));
    let mut control =
        AnkleSteps::control_loop(devices(wires), gains, (), Start::OnTrajectory).unwrap();
    for tick in 0..60 {
        let telemetry = control.tick::<Full<AnkleSteps, 9, 9, 9>, _, _>(&reference, &Torn.at(tick));
        assert!(telemetry.torque.iter().all(|tau| tau.is_finite()), "{telemetry:?}");
        let fault = telemetry.status.fault;
        if tick < 20 {
            assert_eq!(fault, None);
        } else {
            assert!(matches!(fault, Some(Fault::Torque { .. })), "{tick}: {fault:?}");
        }
    }
}

#[test]
fn a_plant_that_cannot_close_fails_its_step() {
    let torn = Torn.at(20).q;
    let nominal = dynamics_core::model::Calibrated::nominal();
    let mut plant = ClusterPlant::<G1Ankle, _, 9, 9, 3>::new(nominal, AnkleSteps::EFFECTS, torn);
    assert!(plant.step(&[0.0; 3], &(), 1e-3).is_err());
}
