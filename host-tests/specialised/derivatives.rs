//! ∂ID/∂q and ∂ID/∂q̇ by the engine: against Pinocchio, and against the core under effects.

use dynamics_core::algorithms::{rnea, rnea_derivatives};
use dynamics_core::effects::{Armature, Effect, MovingBase, Payload, RIGID_BODY, Spring, Viscous};
use dynamics_core::model::{BodyInertia, Robot, Static};
use dynamics_core::robots::{
    A1, A1Free, Gen3, Iiwa14, OpenArm, Panda, Puma560, So101, Ur5e, XArm7, Yam, Z1,
};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::robots::Scara;
use host_tests::measured::largest;
use host_tests::random::{random_numbers, state_of};
use host_tests::recordings::{load, row};
use host_tests::trees::{TreeA, TreeB};

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
        let real = |rows| row::<V>(rows, i).map(R::from_f64);
        let [qd, qdd] = [&recording.qd, &recording.qdd].map(|rows| real(rows));
        let q = row::<Q>(&recording.q, i).map(R::from_f64);
        let by = Engine::<T>::rnea_derivatives(&State { q, qd, qdd }, &RIGID_BODY);
        let wanted = [&recording.rnea_by_q[i], &recording.rnea_by_qd[i]];
        for ((worst, got), wanted) in worst.iter_mut().zip([by.dq, by.dqd]).zip(wanted) {
            let wanted: Vec<f64> = wanted.iter().map(|x| share * x).collect();
            worst.see(&got, wanted.as_chunks::<V>().0);
        }
    }
    worst.map(|worst| worst.error / worst.scale)
}

fn check<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>() {
    for (scalar, bound, errors) in [
        ("f64", 1e-14, recorded::<f64, T, B, Q, V>(1.0)),
        ("f32", 2.5e-6, recorded::<f32, T, B, Q, V>(1.0)),
    ] {
        println!("{} {scalar}: {errors:?}", T::MODEL.name);
        assert!(errors.iter().all(|&e| e < bound), "{} {scalar}: {errors:?}", T::MODEL.name);
    }
}

#[test]
fn the_engines_derivatives_are_pinocchios() {
    check::<Ur5e, 6, 6, 6>();
    check::<Panda, 7, 7, 7>();
    check::<Iiwa14, 7, 7, 7>();
    check::<Gen3, 7, 7, 7>();
    check::<XArm7, 7, 7, 7>();
    check::<Puma560, 6, 6, 6>();
    check::<OpenArm, 7, 7, 7>();
    check::<Yam, 6, 6, 6>();
    check::<Z1, 7, 7, 7>();
    check::<So101, 6, 6, 6>();
    check::<A1, 16, 12, 12>();
    check::<A1Free, 17, 19, 18>();
    check::<TreeA, 17, 35, 32>();
    check::<TreeB, 17, 35, 32>();
    let off = recorded::<f64, Panda, 7, 7, 7>(1.001);
    assert!(off.iter().all(|&error| error > 1e-5), "{off:?}");
}

/// Under effects, and with prismatic joints, core and engine are each other's oracle.
fn alike<T: Robot<B, Q, V>, E, const B: usize, const Q: usize, const V: usize>(scene: &E)
where
    E: Effect<f64, B, V>,
{
    let (mut worst, mut random) = ([Worst::NONE; 4], random_numbers());
    for _ in 0..20 {
        let state = state_of(&Static::<T>::NEW, &mut random);
        let tau = rnea(&Static::<T>::NEW, &state, scene);
        let got = Engine::<T>::forward_dynamics_derivatives(&state, &tau, scene);
        let want = Core::<T>::forward_dynamics_derivatives(&state, &tau, scene);
        let [got, want] = [got, want].map(|by| by.expect("inertia everywhere"));
        worst[2].see(&got.dq, &want.dq);
        worst[3].see(&got.dqd, &want.dqd);
        let got = Engine::<T>::rnea_derivatives(&state, scene);
        let want = rnea_derivatives(&Static::<T>::NEW, &state, scene);
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
    let springs = Spring { stiffness: [30.0; 18], rest: [0.1; 18] };
    alike::<A1Free, _, 17, 19, 18>(&(RIGID_BODY, Viscous([0.7; 18]), springs));
    alike::<A1Free, _, 17, 19, 18>(&(RIGID_BODY, ship));
    let springs = Spring { stiffness: [30.0; 32], rest: [0.1; 32] };
    let tip = Payload::<f64, 16>(load.0);
    let all = (RIGID_BODY, Armature([0.3; 32]), tip, ship, Viscous([0.7; 32]), springs);
    alike::<TreeA, _, 17, 35, 32>(&all);
    alike::<TreeB, _, 17, 35, 32>(&all);
    alike::<Ur5e, _, 6, 6, 6>(&(RIGID_BODY, Armature([0.3; 6]), load, ship, Viscous([0.7; 6])));
    alike::<Scara, _, 3, 3, 3>(&RIGID_BODY);
    alike::<Scara, _, 3, 3, 3>(&(RIGID_BODY, ship));
}
