//! A base that floats free: the engine beside the core, on a robot of five bodies that is cheap to
//! compile.

use dynamics_core::algorithms::Prescribed::{Acceleration, Torque};
use dynamics_core::algorithms::{NotPositiveDefinite, momentum};
use dynamics_core::effects::{Armature, RIGID_BODY, Viscous};
use dynamics_core::model::{BASE, Body, Joint, Model, Robot};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use glam::DVec3;
use host_tests::measured::largest;

use super::{Drag, payload};

/// A hull whose frame is neither at the base's origin nor along its axes, with a slide that carries
/// an arm of two joints, a weld, and a second arm.
struct Hull;

const BODIES: usize = 6;
const Q: usize = 11;
const V: usize = 10;

impl Robot<BODIES, Q, V> for Hull {
    const MODEL: Model<f64, BODIES, Q, V> = Model::new(
        "hull",
        [
            Body::new("hull", BASE, Joint::free())
                .xyz([0.5, -0.25, 0.75])
                .rpy([0.5, -1.0, 2.0])
                .mass(6.0)
                .com([0.25, -0.125, 0.5])
                .inertia([0.6, -0.05, 0.03, 0.5, 0.04, 0.7]),
            Body::new("slide", 0, Joint::prismatic([0.6, 0.0, 0.8]))
                .xyz([-0.25, 0.5, 0.125])
                .rpy([1.0, 0.5, -0.75])
                .mass(2.0)
                .com([0.125, 0.25, -0.0625])
                .inertia([0.05, 0.004, -0.003, 0.06, 0.002, 0.04]),
            Body::new("arm", 1, Joint::revolute([0.48, -0.6, 0.64]))
                .xyz([0.125, 0.375, -0.5])
                .rpy([-0.5, 0.25, 1.5])
                .mass(1.5)
                .com([-0.125, 0.0625, 0.25])
                .inertia([0.03, -0.002, 0.001, 0.02, 0.003, 0.035]),
            Body::new("tool", 2, Joint::fixed())
                .xyz([0.25, -0.125, 0.0625])
                .rpy([0.25, 1.25, -0.5])
                .mass(0.75)
                .com([0.0625, 0.03125, -0.125])
                .inertia([0.004, 0.0005, -0.0003, 0.005, 0.0002, 0.003]),
            Body::new("wrist", 2, Joint::revolute([0.0, 0.6, -0.8]))
                .xyz([-0.125, 0.25, 0.375])
                .rpy([0.75, -0.25, 0.5])
                .mass(0.5)
                .com([0.03125, -0.0625, 0.09375])
                .inertia([0.003, -0.0002, 0.0004, 0.002, 0.0001, 0.0025]),
            Body::new("fin", 0, Joint::revolute([0.8, 0.36, 0.48]))
                .xyz([0.375, -0.5, 0.25])
                .rpy([-1.25, 0.75, 0.25])
                .mass(1.0)
                .com([0.125, 0.1875, -0.25])
                .inertia([0.02, 0.003, -0.001, 0.025, 0.002, 0.018]),
        ],
    );
}

/// States whose hull is turned, moved and moving.
fn states() -> impl Iterator<Item = State<f64, Q, V>> {
    (0..20).map(|k| {
        let wave = |n: usize, size: f64| size * (1.7 * k as f64 + 2.3 * n as f64).sin();
        let mut state = State {
            q: std::array::from_fn(|n| wave(n, 1.5)),
            qd: std::array::from_fn(|n| wave(n + 11, 2.0)),
            qdd: std::array::from_fn(|n| wave(n + 21, 5.0)),
        };
        let length = state.q[..4].iter().map(|x| x * x).sum::<f64>().sqrt();
        state.q[..4].iter_mut().for_each(|x| *x /= length);
        state
    })
}

fn agree(got: &[f64; V], want: &[f64; V], what: &str) {
    let scale = largest(want.iter().map(|x| x.abs()));
    let apart = largest(got.iter().zip(want).map(|(a, b)| (a - b).abs()));
    assert!(apart <= 2e-12 * scale, "{what}: {got:?}, not {want:?}");
}

#[test]
fn joints_of_a_free_base_accelerate_as_by_hybrid_dynamics() {
    let rotors = Armature(std::array::from_fn(|k| if k < 6 { 0.0 } else { 0.25 }));
    let friction = Viscous(std::array::from_fn(|k| if k < 6 { 0.0 } else { 0.5 }));
    let scene = (RIGID_BODY, Drag, payload::<f64, 2>(), rotors, friction);
    for state in states() {
        let given = std::array::from_fn(|k| match k {
            0..6 => Torque(0.0),
            _ => Acceleration(state.qdd[k]),
        });
        let want = Core::<Hull>::hybrid_dynamics(&state, &given, &scene).expect("it has mass");
        let got = Engine::<Hull>::free_base_inverse_dynamics(&state, &scene).expect("it has mass");
        agree(&got.tau, &want.tau, "τ");
        agree(&got.qdd, &want.qdd, "q̈");
        // No wrench acts on the hull, and the joints have the prescribed accelerations.
        assert_eq!(got.tau[..6], [0.0; 6]);
        assert_eq!(got.qdd[6..], state.qdd[6..]);
        let whole = State { qdd: got.qdd, ..state };
        let tau = Core::<Hull>::rnea(&whole, &scene);
        agree(&got.tau, &tau, "inverse dynamics of all");
    }
}

#[test]
fn a_free_base_moves_with_the_momentum_that_is_wanted() {
    let h = Force::new(DVec3::new(1.0, -2.0, 3.0), DVec3::new(4.0, 5.0, -6.0));
    let scene = (payload::<f64, 2>(), Drag);
    for state in states() {
        let got = Engine::<Hull>::base_velocity_from_momentum(&state, h, &scene);
        let want = Core::<Hull>::base_velocity_from_momentum(&state, h, &scene);
        let (qd, want) = (got.expect("it has mass"), want.expect("it has mass"));
        agree(&qd, &want, "q̇");
        assert_eq!(qd[6..], state.qd[6..]);
        // About the base's origin and along its axes.
        let at = momentum(&Hull::MODEL, &State { qd, ..state }, &scene);
        let apart = [at.ang - h.ang, at.lin - h.lin].map(|x| x.abs().max_element());
        assert!(largest(apart) < 1e-12, "{at:?}");
    }
}

/// Two points without mass.
struct Massless;

impl Robot<2, 8, 7> for Massless {
    const MODEL: Model<f64, 2, 8, 7> = Model::new(
        "massless",
        [
            Body::new("hull", BASE, Joint::free()),
            Body::new("arm", 0, Joint::revolute([0.0, 0.0, 1.0])),
        ],
    );
}

#[test]
fn a_free_base_without_mass_is_refused() {
    let mut state = State::<f64, 8, 7>::at([0.0; 8]);
    state.q[0] = 1.0;
    let refused = |error: NotPositiveDefinite| error.joint;
    let got = Engine::<Massless>::free_base_inverse_dynamics(&state, &RIGID_BODY);
    assert_eq!(got.map(|_| ()).map_err(refused), Err(0));
    let got = Engine::<Massless>::base_velocity_from_momentum(&state, Force::ZERO, &());
    assert_eq!(got.map_err(refused), Err(0));
}
