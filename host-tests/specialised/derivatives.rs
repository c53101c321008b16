//! ∂ID/∂q and ∂ID/∂q̇ by the engine: against Pinocchio, and against the core under effects.

use dynamics_core::Engine;
use dynamics_core::algorithms::{forward_dynamics_derivatives, rnea, rnea_derivatives};
use dynamics_core::effects::{
    Armature, Coriolis, Effect, GravityVector, Inertia, MovingBase, Payload, RIGID_BODY, Spring,
    Viscous,
};
use dynamics_core::model::{BodyInertia, Calibrated, Robot, RobotModel, Static};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use firmware_demo::robots::Scara;
use host_tests::measured::largest;
use host_tests::random::{random_numbers, state_of};
use host_tests::recordings::{Recording, load, row};
use host_tests::tolerances;
use host_tests::trees::TreeA;

/// The largest difference of two matrices relative to the largest entry of the second.
struct Worst {
    error: f64,
    scale: f64,
}

impl Worst {
    const NONE: Self = Self { error: 0.0, scale: 0.0 };

    fn see<R: Real, const V: usize>(&mut self, got: &[[R; V]; V], want: &[[f64; V]]) {
        for (got, want) in got.as_flattened().iter().zip(want.as_flattened()) {
            self.error = largest([self.error, (got.to_f64() - want).abs()]);
            self.scale = self.scale.max(want.abs());
        }
    }
}

/// The errors of ∂ID/∂q and ∂ID/∂q̇ against the recording, of which `share` is taken.
fn recorded<R: Real, T, const B: usize, const Q: usize, const V: usize>(share: f64) -> [f64; 2]
where
    T: Robot<B, Q, V>,
{
    let recording = load(T::MODEL.name);
    let mut worst = [Worst::NONE; 2];
    for i in 0..recording.rnea_by_q.len() {
        let by = Engine::<T>::rnea_derivatives(&state_at::<R, Q, V>(&recording, i), &RIGID_BODY);
        let wanted = [&recording.rnea_by_q[i], &recording.rnea_by_qd[i]];
        for ((worst, got), wanted) in worst.iter_mut().zip([by.dq, by.dqd]).zip(wanted) {
            let wanted: Vec<f64> = wanted.iter().map(|x| share * x).collect();
            worst.see(&got, wanted.as_chunks::<V>().0);
        }
    }
    worst.map(|worst| worst.error / worst.scale)
}

/// The same of ∂FD/∂q and ∂FD/∂q̇.
fn forward<R: Real, T, const B: usize, const Q: usize, const V: usize>() -> [f64; 2]
where
    T: Robot<B, Q, V>,
{
    let recording = load(T::MODEL.name);
    let mut worst = [Worst::NONE; 2];
    for i in 0..recording.rnea_by_q.len() {
        let tau = row::<V>(&recording.rnea, i).map(R::from_f64);
        let state = state_at::<R, Q, V>(&recording, i);
        let by = Engine::<T>::forward_dynamics_derivatives(&state, &tau, &RIGID_BODY);
        let by = by.expect("M is positive");
        let wanted = recording.forward_derivatives::<V>(i);
        for ((worst, got), wanted) in worst.iter_mut().zip([by.dq, by.dqd]).zip(wanted) {
            worst.see(&got, &wanted);
        }
    }
    worst.map(|worst| worst.error / worst.scale)
}

fn state_at<R: Real, const Q: usize, const V: usize>(
    recording: &Recording,
    i: usize,
) -> State<R, Q, V> {
    let [qd, qdd] = [&recording.qd, &recording.qdd].map(|rows| row::<V>(rows, i).map(R::from_f64));
    State { q: row::<Q>(&recording.q, i).map(R::from_f64), qd, qdd }
}

/// The largest errors of any robot, of each quantity in f64 and f32.
#[derive(Default)]
struct Most([[f64; 2]; 2]);

impl Most {
    fn see(&mut self, errors: [[f64; 2]; 2]) {
        for (most, errors) in self.0.as_flattened_mut().iter_mut().zip(errors.as_flattened()) {
            *most = largest([*most, *errors]);
        }
    }

    /// The errors that the table does not allow.
    fn check(&self, robots: &str, quantities: [&str; 2]) -> Vec<String> {
        let mut complaints = Vec::new();
        for (scalar, errors) in ["f64", "f32"].iter().zip(self.0) {
            let checked = quantities.iter().zip(errors);
            complaints.extend(checked.filter_map(|(of, error)| match cfg!(feature = "full") {
                true => tolerances::check(robots, of, scalar, error).err(),
                false => tolerances::within(robots, of, scalar, error).err(),
            }));
        }
        complaints
    }
}

fn see<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(most: &mut Most) {
    most.see([recorded::<f64, T, B, Q, V>(1.0), recorded::<f32, T, B, Q, V>(1.0)]);
}

#[test]
fn the_engines_derivatives_are_pinocchios() {
    let mut most = Most::default();
    see::<Ur5e, 6, 6, 6>(&mut most);
    #[cfg(feature = "full")]
    {
        use dynamics_core::robots::*;
        use host_tests::trees::TreeB;
        see::<Panda, 7, 7, 7>(&mut most);
        see::<Iiwa14, 7, 7, 7>(&mut most);
        see::<Gen3, 7, 7, 7>(&mut most);
        see::<XArm7, 7, 7, 7>(&mut most);
        see::<Puma560, 6, 6, 6>(&mut most);
        see::<OpenArm, 7, 7, 7>(&mut most);
        see::<Yam, 6, 6, 6>(&mut most);
        see::<Z1, 7, 7, 7>(&mut most);
        see::<So101, 6, 6, 6>(&mut most);
        see::<A1, 16, 12, 12>(&mut most);
        see::<A1Free, 17, 19, 18>(&mut most);
        see::<TreeA, 17, 35, 32>(&mut most);
        see::<TreeB, 17, 35, 32>(&mut most);
        see::<G1, 29, 29, 29>(&mut most);
        see::<G1Free, 30, 36, 35>(&mut most);
    }
    let mut complaints = most.check("recorded robots", ["∂ID/∂q", "∂ID/∂qd"]);
    let off = recorded::<f64, Ur5e, 6, 6, 6>(1.001);
    assert!(off.iter().all(|&error| error > 1e-5), "{off:?}");
    let mut most = Most::default();
    most.see([forward::<f64, Ur5e, 6, 6, 6>(), forward::<f32, Ur5e, 6, 6, 6>()]);
    complaints.extend(most.check("ur5e", ["engine ∂FD/∂q", "engine ∂FD/∂qd"]));
    #[cfg(feature = "full")]
    {
        use dynamics_core::robots::A1Free;
        let mut most = Most::default();
        most.see([forward::<f64, A1Free, 17, 19, 18>(), forward::<f32, A1Free, 17, 19, 18>()]);
        complaints.extend(most.check("a1_free", ["engine ∂FD/∂q", "engine ∂FD/∂qd"]));
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
}

/// Under effects, and with prismatic joints, core and engine are each other's oracle.
fn alike<T: Robot<B, Q, V>, E, const B: usize, const Q: usize, const V: usize>(scene: &E)
where
    E: Effect<f64, B, V>,
{
    alike_to::<T, _, _, _, B, Q, V>(scene, &Static::<T>::NEW, scene);
}

/// The same of a robot and a scene that the core has in their place.
fn alike_to<T, D, E, F, const B: usize, const Q: usize, const V: usize>(
    scene: &E,
    robot: &D,
    of_core: &F,
) where
    T: Robot<B, Q, V>,
    D: RobotModel<f64, B, Q, V>,
    E: Effect<f64, B, V>,
    F: Effect<f64, B, V>,
{
    let (mut worst, mut random) = ([Worst::NONE; 4], random_numbers());
    for _ in 0..20 {
        let state = state_of(&Static::<T>::NEW, &mut random);
        let tau = rnea(robot, &state, of_core);
        let got = Engine::<T>::forward_dynamics_derivatives(&state, &tau, scene);
        let want = forward_dynamics_derivatives(robot, &state, &tau, of_core);
        let [got, want] = [got, want].map(|by| by.expect("inertia everywhere"));
        worst[2].see(&got.dq, &want.dq);
        worst[3].see(&got.dqd, &want.dqd);
        let got = Engine::<T>::rnea_derivatives(&state, scene);
        let want = rnea_derivatives(robot, &state, of_core);
        worst[0].see(&got.dq, &want.dq);
        worst[1].see(&got.dqd, &want.dqd);
    }
    let errors = worst.map(|worst| worst.error / worst.scale);
    let bounds = [1e-14, 1e-14, 1e-11, 1e-11];
    println!("{}: {errors:?}", T::MODEL.name);
    let close = errors.iter().zip(bounds).all(|(&error, bound)| error < bound);
    assert!(close, "{}: {errors:?}", T::MODEL.name);
}

#[test]
fn core_and_engine_have_the_same_derivatives_under_effects() {
    let load = Payload::<f64, 5>::from_inertia(BodyInertia {
        mass: 1.5,
        com: [0.1, -0.2, 0.05],
        inertia: [0.01, 0.0, 0.0, 0.02, 0.0, 0.015],
    });
    let vector = |x, y, z| <f64 as Real>::Vec3::new(x, y, z);
    let ship = MovingBase {
        velocity: Motion::new(vector(0.3, -0.5, 0.7), vector(0.1, 0.2, -0.3)),
        acceleration: Motion::new(vector(-1.0, 2.0, 0.5), vector(0.4, 1.0, -2.0)),
    };
    let springs = Spring { stiffness: [30.0; 32], rest: [0.1; 32] };
    let tip = Payload::<f64, 16>(load.0);
    let all = (RIGID_BODY, Armature([0.3; 32]), tip, ship, Viscous([0.7; 32]), springs);
    alike::<TreeA, _, 17, 35, 32>(&all);
    alike::<Ur5e, _, 6, 6, 6>(&(RIGID_BODY, Armature([0.3; 6]), load, ship, Viscous([0.7; 6])));
    alike::<Scara, _, 3, 3, 3>(&(RIGID_BODY, ship));
    alike::<Scara, _, 3, 3, 3>(&(Inertia, Coriolis, GravityVector(vector(2.0, -3.0, -9.0))));
    #[cfg(feature = "full")]
    {
        use dynamics_core::robots::A1Free;
        alike::<host_tests::trees::TreeB, _, 17, 35, 32>(&all);
        let springs = Spring { stiffness: [30.0; 18], rest: [0.1; 18] };
        alike::<A1Free, _, 17, 19, 18>(&(RIGID_BODY, Viscous([0.7; 18]), springs));
        alike::<A1Free, _, 17, 19, 18>(&(RIGID_BODY, ship));
        alike::<Scara, _, 3, 3, 3>(&RIGID_BODY);
    }
}

#[test]
fn the_engines_derivatives_are_those_of_the_base_parameters_that_are_loaded() {
    let mut arm = Calibrated::<Ur5e, f64, 6, 6, 6>::nominal();
    let described = arm.inertia(1).expect("a body");
    let heavier = BodyInertia { mass: described.mass + 0.4, ..described };
    arm.set_inertia(1, heavier, 1e-6).expect("a body's inertia");
    let learned = Engine::<Ur5e>::base_parameters(&arm, &()).expect("base parameters");
    alike_to::<Ur5e, _, _, _, 6, 6, 6>(&(RIGID_BODY, learned), &arm, &RIGID_BODY);
    let state = State::at([0.3; 6]);
    let [by, without] = [
        Engine::<Ur5e>::rnea_derivatives(&state, &(RIGID_BODY, learned)),
        Engine::<Ur5e>::rnea_derivatives(&state, &RIGID_BODY),
    ];
    assert!((by.dq[1][1] / without.dq[1][1] - 1.0).abs() > 1e-3);
}
