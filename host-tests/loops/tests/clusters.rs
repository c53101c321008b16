//! The parallel robots as clusters and as general loops: two descriptions and two algorithms, the
//! same motors' torques.

use dynamics_core::Core;
use dynamics_core::algorithms::rnea;
use dynamics_core::clusters::Clustered;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{Drive, LoopRobot, Moving, assemble, inverse_dynamics};
use dynamics_core::model::{BodyInertia, Calibrated, RobotModel, Static};
use dynamics_core::state::State;
use firmware_demo::robots::{LEGS, StewartPlatform};
use glam::{DQuat, DVec3, EulerRot};
use loop_tests::clusters::{DeltaRobot, apart, hold, largest, stewart_states};
use loop_tests::machines::{Delta, Stewart};
use loop_tests::states::closed_states;

/// The largest difference of two rows of torques over the largest of them all.
#[derive(Default)]
struct Difference {
    apart: f64,
    scale: f64,
}

impl Difference {
    fn of(&mut self, a: &[f64], b: &[f64]) {
        self.apart = self.apart.max(apart(a, b));
        self.scale = self.scale.max(largest(b));
    }

    fn relative(&self) -> f64 {
        self.apart / self.scale
    }
}

// They are compared with a Delta of six rods.
#[test]
fn rod_pairs_as_one_body_need_equal_torques() {
    let mut difference = Difference::default();
    let states = closed_states::<Delta, 10, 22, 21, 6, 18, 3>(200);
    assert_eq!(states.len(), 200);
    for state in states {
        let found = inverse_dynamics(&Static::<Delta>::NEW, &Delta::LOOPS, &state, &RIGID_BODY);
        let found = found.expect("it closes");
        assert_eq!(found.drive, Drive::Determined);
        let cranks = |of: &[f64]| [6, 11, 16].map(|i| of[i]);
        let y = State { q: cranks(&state.q[1..]), qd: cranks(&state.qd), qdd: cranks(&state.qdd) };
        let tau = Clustered::<Core<DeltaRobot>>::rnea(&y, &RIGID_BODY).expect("it closes");
        difference.of(&tau, &found.tau);
    }
    hold("torques of the Delta", difference.relative(), 1e-12);
}

/// The platform's pose, and each leg's universal joint, about x and then y, and slide.
fn closed(y: &State<f64, 6, 6>, slides: &[f64; 6]) -> [f64; 25] {
    let [x, up, z, yaw, pitch, roll] = y.q;
    let at = DVec3::new(x, up, z);
    let attitude = DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll);
    let mut q = [0.0; 25];
    q[..4].copy_from_slice(&attitude.to_array());
    q[4..7].copy_from_slice(&at.to_array());
    for (i, (leg, slide)) in LEGS.iter().zip(slides).enumerate() {
        let along = at + attitude * DVec3::from(leg.platform) - DVec3::from(leg.base);
        let unit = along.normalize();
        let turn = (-unit.y).atan2(unit.z);
        q[7 + 3 * i..10 + 3 * i].copy_from_slice(&[turn, unit.x.asin(), *slide]);
    }
    q
}

/// The torques of the platform's motors by clusters less those by general loops.
fn stewart(
    as_cluster: &impl RobotModel<f64, 24, 24, 24>,
    as_loops: &impl RobotModel<f64, 13, 25, 24>,
) -> f64 {
    let mut difference = Difference::default();
    let states = stewart_states();
    assert_eq!(states.len(), 200);
    for y in states {
        let motion = Clustered::<Core<StewartPlatform>>::motion(&y).expect("it closes");
        let tau = motion.torque(&rnea(as_cluster, motion.state(), &RIGID_BODY));
        let by_clusters = motion.to_motors(&tau).expect("finite");
        let motors = Clustered::<Core<StewartPlatform>>::motors(&y).expect("it closes");

        let guess = closed(&y, &motors.q);
        let q = assemble(as_loops, &Stewart::LOOPS, &guess, Moving::Passive).expect("it closes").q;
        // The slides' lengths are those of this pose.
        assert!(apart(&q, &guess) < 1e-12, "{q:?} {guess:?}");
        let (mut qd, mut qdd) = ([0.0; 24], [0.0; 24]);
        for (i, &joint) in Stewart::LOOPS.actuated().iter().enumerate() {
            (qd[joint], qdd[joint]) = (motors.qd[i], motors.qdd[i]);
        }
        let state = State { q, qd, qdd };
        let found = inverse_dynamics(as_loops, &Stewart::LOOPS, &state, &RIGID_BODY);
        let found = found.expect("it closes");
        assert_eq!((by_clusters.singular, found.drive), (None, Drive::Determined));
        difference.of(&by_clusters.tau, &found.tau);
    }
    difference.relative()
}

/// A half of a leg that is symmetric about its axis, with this share of the inertia about it.
fn symmetric(described: BodyInertia<f64>, share: f64) -> BodyInertia<f64> {
    let [across, .., about] = described.inertia;
    BodyInertia {
        mass: described.mass,
        com: [0.0, 0.0, described.com[2]],
        inertia: [across, 0.0, 0.0, across, 0.0, share * about],
    }
}

/// The same of both robots with legs that are symmetric about their axes.
fn stewart_on(share: f64) -> f64 {
    let mut as_cluster = Calibrated::<StewartPlatform, f64, 24, 24, 24>::nominal();
    let mut as_loops = Calibrated::<Stewart, f64, 13, 25, 24>::nominal();
    for half in 0..12 {
        let of_cluster = 7 + 3 * (half / 2) + half % 2;
        let described = as_loops.inertia(1 + half).expect("a half of a leg");
        let inertia = symmetric(described, share);
        let set = as_loops.set_inertia(1 + half, inertia, 1e-9);
        set.expect("it is physical");
        let set = as_cluster.set_inertia(of_cluster, inertia, 1e-9);
        set.expect("it is physical");
    }
    stewart(&as_cluster, &as_loops)
}

/// Universal joints about y and then x, and about x and then y, point a leg alike, and differ in
/// its spin about itself.
// The legs of the cluster do not spin about themselves.
#[test]
fn a_stewart_platform_cluster_agrees_with_general_loops() {
    hold("torques, legs without inertia of spin", stewart_on(0.0), 2e-14);
    hold("torques, legs that are symmetric", stewart_on(1.0), 1e-3);
    // As described, halves of legs have centres of mass 1 and 2 mm off their axes, and products of
    // inertia.
    let described = stewart(&Static::<StewartPlatform>::NEW, &Static::<Stewart>::NEW);
    hold("torques, legs as described", described, 2e-3);
}
