//! The engine on joints of every kind: two trees that mix them, and robots on a free base.

use dynamics_core::effects::{Armature, MovingBase, RIGID_BODY, Spring, Viscous, WorldWrench};
use dynamics_core::model::Robot;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::recordings::{Recording, load, row};
use host_tests::tolerances::Errors;
use host_tests::trees::{TreeA, TreeB};

use super::{Drag, Push, payload};

/// States that engine and core are compared on.
const STATES: usize = 40;

fn state<R: Real, const Q: usize, const V: usize>(r: &Recording, i: usize) -> State<R, Q, V> {
    State {
        q: row::<Q>(&r.q, i).map(R::from_f64),
        qd: row::<V>(&r.qd, i).map(R::from_f64),
        qdd: row::<V>(&r.qdd, i).map(R::from_f64),
    }
}

fn see<R: Real>(errors: &mut Errors, quantity: &'static str, got: &[R], want: &[R]) {
    let wide = |numbers: &[R]| numbers.iter().map(|x| x.to_f64()).collect::<Vec<_>>();
    let scalar = std::any::type_name::<R>();
    errors.add(quantity, scalar, &wide(got), &wide(want));
}

/// Every effect that joints of several coordinates meet.
fn every_effect<R: Real, const B: usize, const V: usize>()
-> impl dynamics_core::effects::Effect<R, B, V> {
    let rising = |k: f64| std::array::from_fn(|i| R::from_f64(k * (1.0 + 0.1 * i as f64)));
    let vector = |[x, y, z]: [f64; 3]| R::Vec3::new(R::from_f64(x), R::from_f64(y), R::from_f64(z));
    let carried = MovingBase {
        velocity: Motion::new(vector([0.5, -0.3, 0.8]), vector([0.2, 0.4, -0.6])),
        acceleration: Motion::new(vector([-1.0, 2.0, 0.7]), vector([1.5, -2.0, 0.9])),
    };
    let wind = WorldWrench {
        body: 12,
        wrench: Force::new(vector([1.0, 2.0, -3.0]), vector([5.0, -4.0, 2.0])),
    };
    let spring = Spring { stiffness: rising(1.0), rest: rising(0.1) };
    let (viscous, rotors) = (Viscous(rising(0.3)), Armature(rising(0.1)));
    (RIGID_BODY, carried, viscous, spring, rotors, Push, Drag, wind, payload::<R, 6>())
}

/// Inverse dynamics against Pinocchio.
fn recorded<R: Real, T, const B: usize, const Q: usize, const V: usize>()
where
    T: Robot<B, Q, V>,
{
    let (r, mut errors) = (load(T::MODEL.name), Errors::new(T::MODEL.name));
    for i in 0..r.q.len() {
        let tau = Engine::<T>::rnea(&state::<R, Q, V>(&r, i), &RIGID_BODY);
        let want = row::<V>(&r.rnea, i);
        let scalar = std::any::type_name::<R>();
        errors.add("engine rnea", scalar, &tau.map(Real::to_f64), &want);
    }
    errors.check();
}

/// Inverse dynamics under every effect against the core.
fn under_every_effect<R: Real, T, const B: usize, const Q: usize, const V: usize>()
where
    T: Robot<B, Q, V>,
{
    let (r, mut errors) = (load(T::MODEL.name), Errors::new(T::MODEL.name));
    let scene = every_effect::<R, B, V>();
    for i in 0..STATES {
        let state = state::<R, Q, V>(&r, i);
        let (engine, core) = (Engine::<T>::rnea(&state, &scene), Core::<T>::rnea(&state, &scene));
        see(&mut errors, "engine and core", &engine, &core);
    }
    errors.check();
}

#[test]
fn inverse_dynamics_of_every_kind_of_joint_agree_with_pinocchio() {
    recorded::<f64, TreeA, 17, 35, 32>();
    recorded::<f64, TreeB, 17, 35, 32>();
}

#[test]
fn engine_equals_core_on_every_kind_of_joint_under_every_effect() {
    under_every_effect::<f64, TreeA, 17, 35, 32>();
    #[cfg(feature = "full")]
    under_every_effect::<f32, TreeB, 17, 35, 32>();
}

#[cfg(feature = "full")]
mod full {

    use dynamics_core::algorithms::Prescribed::{Acceleration, Torque};
    use dynamics_core::algorithms::{self, MassMatrix, frame::LocalWorldAligned};
    use dynamics_core::model::{Calibrated, OnBody};
    use dynamics_core::robots::{A1Free, G1Free};
    use dynamics_core::spatial::SpatialInertia;
    use glam::DVec3;

    use super::*;

    #[test]
    fn robots_on_a_free_base_agree_with_pinocchio() {
        recorded::<f64, A1Free, 17, 19, 18>();
        recorded::<f32, A1Free, 17, 19, 18>();
        recorded::<f32, G1Free, 30, 36, 35>();
    }

    /// The other algorithms against those of the core.
    fn algorithms<T, const B: usize, const Q: usize, const V: usize>()
    where
        T: Robot<B, Q, V>,
    {
        let (r, mut errors) = (load(T::MODEL.name), Errors::new(T::MODEL.name));
        let scene = every_effect::<f64, B, V>();
        let mut calibrated = Calibrated::<T, f64, B, Q, V>::nominal();
        for inertia in calibrated.inertias() {
            let more = [0.2, 0.03, -0.02, 0.01, 0.05, 0.004, 0.06, -0.003, 0.002, 0.07];
            *inertia = *inertia + SpatialInertia::from_parameters(more);
        }
        let set = Engine::<T>::base_parameters(&calibrated, &()).expect("finite");
        for i in 0..STATES {
            let (state, tau) = (state::<f64, Q, V>(&r, i), row::<V>(&r.tau, i));
            let (a, b) = (Engine::<T>::crba(&state.q, &scene), Core::<T>::crba(&state.q, &scene));
            for k in 0..V {
                let row = |m: &MassMatrix<f64, V>| std::array::from_fn::<_, V, _>(|l| m.get(k, l));
                see(&mut errors, "engine and core, M", &row(&a), &row(&b));
            }
            let want = Core::<T>::aba(&state, &tau, &scene).expect("M is positive");
            let qdd = Engine::<T>::forward_dynamics(&state, &tau, &scene);
            see(&mut errors, "engine and core, q̈ by M", &qdd.expect("M is positive"), &want);
            let qdd = Engine::<T>::aba(&state, &tau, &scene).expect("M is positive");
            see(&mut errors, "engine and core, q̈", &qdd, &want);
            let (a, b) = (
                Engine::<T>::momentum_and_drift(&state, &scene),
                Core::<T>::momentum_and_drift(&state, &scene),
            );
            see(&mut errors, "engine and core, p", &a.p, &b.p);
            see(&mut errors, "engine and core, β", &a.beta, &b.beta);
            let a = Engine::<T>::jacobian(&state.q, OnBody::<16>, LocalWorldAligned);
            let b = algorithms::jacobian(&T::MODEL, &state.q, 16, LocalWorldAligned);
            for (a, b) in a.iter().zip(b) {
                for (a, b) in [(a.ang, b.ang), (a.lin, b.lin)] {
                    see(&mut errors, "engine and core, J", &a.to_array(), &b.to_array());
                }
            }
            let tau = Engine::<T>::rnea(&state, &(RIGID_BODY, &set));
            let want = algorithms::rnea(&calibrated, &state, &RIGID_BODY);
            see(&mut errors, "engine and core, loaded", &tau, &want);
        }
        errors.check();
    }

    #[test]
    fn every_algorithm_of_the_engine_takes_every_kind_of_joint() {
        algorithms::<TreeA, 17, 35, 32>();
        algorithms::<TreeB, 17, 35, 32>();
        algorithms::<A1Free, 17, 19, 18>();
    }

    #[test]
    fn a_free_base_recoils_as_by_hybrid_dynamics() {
        let (r, mut errors) = (load("a1_free"), Errors::new("a1_free"));
        let scene = (RIGID_BODY, Push, Drag, payload::<f64, 6>());
        let h = Force::new(DVec3::new(1.0, -2.0, 3.0), DVec3::new(4.0, 5.0, -6.0));
        for i in 0..STATES {
            let state = state::<f64, 19, 18>(&r, i);
            let given = std::array::from_fn(|k| match k {
                0..6 => Torque(0.0),
                _ => Acceleration(state.qdd[k]),
            });
            let want = Core::<A1Free>::hybrid_dynamics(&state, &given, &scene);
            let got = Engine::<A1Free>::free_base_inverse_dynamics(&state, &scene);
            let (got, want) = (got.expect("it has mass"), want.expect("it has mass"));
            see(&mut errors, "recoil, τ", &got.tau, &want.tau);
            see(&mut errors, "recoil, q̈", &got.qdd, &want.qdd);
            let got = Engine::<A1Free>::base_velocity_from_momentum(&state, h, &scene);
            let want = Core::<A1Free>::base_velocity_from_momentum(&state, h, &scene);
            let (got, want) = (got.expect("it has mass"), want.expect("it has mass"));
            see(&mut errors, "recoil, q̇", &got, &want);
        }
        errors.check();
    }
}
