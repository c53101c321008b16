//! The core against Pinocchio, in f64 and f32, on every recorded state. Its loops are over run-time
//! models, which robots of one size share; `engine` has those of robots known while compiling.

use dynamics_core::algorithms::{aba, crba, inverse, ltdl, rnea};
use dynamics_core::effects::{Armature, Coriolis, Effect, Gravity, RIGID_BODY, hook};
use dynamics_core::model::{JointKind, Robot, model};
use dynamics_core::robots::{Gen3, Iiwa14, OpenArm, Panda, Puma560, So101, Ur5e, XArm7, Yam, Z1};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::state::manifold::{difference, integrate};
use host_tests::recordings::{Recording, columns, full_scale, load, row, symmetric};
use host_tests::trees::{TreeA, TreeB};
use host_tests::{export, tolerances};

/// Collects every complaint, so that one run shows the whole table.
struct Verdict(Vec<String>);

impl Verdict {
    fn check(&mut self, robot: &str, quantity: &str, scalar: &str, error: f64) {
        if let Err(e) = tolerances::check(robot, quantity, scalar, error) {
            self.0.push(e);
        }
    }
}

/// The largest error of one quantity over the states.
struct Worst {
    quantity: &'static str,
    full_scale: f64,
    error: f64,
}

impl Worst {
    fn new(quantity: &'static str, full_scale: f64) -> Self {
        Self { quantity, full_scale, error: 0.0 }
    }

    fn see<R: Real, const N: usize>(&mut self, got: [R; N], want: [f64; N]) {
        for (got, want) in got.iter().zip(want) {
            let error = (got.to_f64() - want).abs() / self.full_scale;
            if error > self.error || error.is_nan() {
                self.error = error;
            }
        }
    }
}

fn state<R: Real, const Q: usize, const V: usize>(
    recording: &Recording,
    i: usize,
) -> State<R, Q, V> {
    let velocity = |rows| row::<V>(rows, i).map(R::from_f64);
    State {
        q: row::<Q>(&recording.q, i).map(R::from_f64),
        qd: velocity(&recording.qd),
        qdd: velocity(&recording.qdd),
    }
}

/// Holds one form of the dynamics against the recording: its quantities, each with its answer.
fn compare<R: Real, const Q: usize, const V: usize>(
    recording: &Recording,
    verdict: &mut Verdict,
    names: [&'static str; 3],
    rnea: impl Fn(&State<R, Q, V>) -> [[R; V]; 3],
) {
    let (scale, rows) = (recording.full_scale, recording);
    let wanted = [&rows.rnea, &rows.gravity, &rows.bias];
    let scales = [scale.rnea, scale.gravity, scale.bias];
    let mut worst = std::array::from_fn::<_, 3, _>(|k| Worst::new(names[k], scales[k]));
    assert!(recording.q.len() > 200);
    for i in 0..recording.q.len() {
        let got = rnea(&state(recording, i));
        for ((worst, got), want) in worst.iter_mut().zip(got).zip(wanted) {
            worst.see(got, row::<V>(want, i));
        }
    }
    let scalar = std::any::type_name::<R>();
    for worst in worst {
        verdict.check(&recording.robot, worst.quantity, scalar, worst.error);
    }
}

fn core<R: Real, T, const B: usize, const Q: usize, const V: usize>(
    recording: &Recording,
    verdict: &mut Verdict,
) where
    T: Robot<B, Q, V>,
{
    let robot = model::<R, T, B, Q, V>();
    compare::<R, Q, V>(recording, verdict, ["rnea", "gravity", "bias"], |state| {
        [
            rnea(robot, state, &RIGID_BODY),
            rnea(robot, state, &Gravity::EARTH),
            rnea(robot, state, &(Gravity::EARTH, Coriolis)),
        ]
    });
    let mut forward = Worst::new("aba", recording.full_scale.aba);
    for i in 0..recording.q.len() {
        let tau = row::<V>(&recording.tau, i).map(R::from_f64);
        let qdd = aba(robot, &state(recording, i), &tau, &RIGID_BODY);
        forward.see(qdd.expect("M is positive"), row::<V>(&recording.aba, i));
    }
    let scalar = std::any::type_name::<R>();
    verdict.check(&recording.robot, forward.quantity, scalar, forward.error);
}

/// Steps and differences of configurations against the recording.
fn manifold<T, const B: usize, const Q: usize, const V: usize>(
    recording: &Recording,
    verdict: &mut Verdict,
) where
    T: Robot<B, Q, V>,
{
    let mut step = Worst::new("integrate", full_scale(&recording.integrated));
    let mut way = Worst::new("difference", full_scale(&recording.difference));
    for i in 0..recording.first_states() {
        let [q, next, want] = [
            row::<Q>(&recording.q, i),
            row::<Q>(&recording.q, i + 1),
            row::<Q>(&recording.integrated, i),
        ];
        let mut got = integrate(&T::MODEL, &q, &row::<V>(&recording.step, i));
        for link in &T::MODEL.links {
            // A quaternion and its negative are the same attitude.
            if matches!(link.joint.kind, JointKind::Spherical | JointKind::Free) {
                let at = link.idx_q..link.idx_q + 4;
                let dot = at.clone().map(|k| got[k] * want[k]).sum::<f64>();
                at.for_each(|k| got[k] *= dot.signum());
            }
        }
        step.see(got, want);
        let got = difference(&T::MODEL, &q, &next);
        way.see(got, row::<V>(&recording.difference, i));
    }
    for worst in [step, way] {
        verdict.check(&recording.robot, worst.quantity, "f64", worst.error);
    }
}

struct Wrenches<R, const B: usize>([[R; 6]; B]);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Wrenches<R, B> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::constant(|recorded, body, fx| {
        let (ang, lin) = halves(recorded.0[body]);
        *fx = Force::new(fx.ang + ang, fx.lin + lin);
    });
}

/// A recorded motion of the base.
struct BaseMotion<R>([R; 6], [R; 6]);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for BaseMotion<R> {
    const BASE: hook::Base<Self, R> = hook::Base::moving(|recorded, velocity, acceleration| {
        for (at, add) in [(velocity, recorded.0), (acceleration, recorded.1)] {
            let (ang, lin) = halves(add);
            *at = Motion::new(at.ang + ang, at.lin + lin);
        }
    });
}

fn halves<R: Real>([a, b, c, d, e, f]: [R; 6]) -> (R::Vec3, R::Vec3) {
    (R::Vec3::new(a, b, c), R::Vec3::new(d, e, f))
}

/// Forces on the bodies, a moving base and rotors against the recording.
fn surroundings<R: Real, T, const B: usize, const Q: usize, const V: usize>(
    recording: &Recording,
    verdict: &mut Verdict,
) where
    T: Robot<B, Q, V>,
{
    let (r, robot) = (recording, model::<R, T, B, Q, V>());
    let answers = [
        ("rnea with wrenches", &r.rnea_wrenches),
        ("aba with wrenches", &r.aba_wrenches),
        ("rnea on a moving base", &r.rnea_moving_base),
        ("rnea with rotors", &r.rnea_armature),
        ("aba with rotors", &r.aba_armature),
    ];
    let mut worst = answers.map(|(name, rows)| Worst::new(name, full_scale(rows)));
    let (gravity, inertia, coriolis) = RIGID_BODY;
    let rotors = std::array::from_fn(|k| R::from_f64(r.armature[k]));
    let rotors = (gravity, inertia, coriolis, Armature(rotors));
    for i in 0..r.first_states() {
        let (state, tau) = (state::<R, Q, V>(r, i), row::<V>(&r.tau, i).map(R::from_f64));
        let fx = columns::<B>(&r.wrenches, i).map(|f| f.map(R::from_f64));
        let loaded = (gravity, inertia, coriolis, Wrenches(fx));
        let base = [&r.base_velocity, &r.base_acceleration];
        let [v0, a0] = base.map(|rows| row::<6>(rows, i).map(R::from_f64));
        let carried = (gravity, inertia, coriolis, BaseMotion(v0, a0));
        let got = [
            rnea(robot, &state, &loaded),
            aba(robot, &state, &tau, &loaded).expect("M is positive"),
            rnea(robot, &state, &carried),
            rnea(robot, &state, &rotors),
            aba(robot, &state, &tau, &rotors).expect("M is positive"),
        ];
        for ((worst, got), (_, rows)) in worst.iter_mut().zip(got).zip(answers) {
            worst.see(got, row::<V>(rows, i));
        }
    }
    let scalar = std::any::type_name::<R>();
    for worst in worst {
        verdict.check(&r.robot, worst.quantity, scalar, worst.error);
    }
}

/// M and M⁻¹ against the recording: M by the table, M⁻¹ within what its condition allows.
fn matrices<R: Real, T, const B: usize, const Q: usize, const V: usize>(
    recording: &Recording,
    verdict: &mut Verdict,
) where
    T: Robot<B, Q, V>,
{
    let (r, robot) = (recording, model::<R, T, B, Q, V>());
    let mut m_worst = Worst::new("crba", r.full_scale.mass_matrix);
    let mut inverse_worst = Worst::new("M⁻¹", full_scale(&r.inverse_mass_matrix));
    for i in 0..r.first_states() {
        let m = crba(robot, &state::<R, Q, V>(r, i).q, &RIGID_BODY);
        let inverted = inverse(robot, &ltdl(robot, &m).expect("M is positive"));
        let wanted = symmetric::<V>(&r.mass_matrix, i);
        let wanted_inverse = symmetric::<V>(&r.inverse_mass_matrix, i);
        for k in 0..V {
            m_worst.see::<R, V>(std::array::from_fn(|l| m.get(k, l)), wanted[k]);
            inverse_worst
                .see::<R, V>(std::array::from_fn(|l| inverted.get(k, l)), wanted_inverse[k]);
        }
    }
    let (scalar, kappa) = (std::any::type_name::<R>(), r.condition);
    verdict.check(&r.robot, m_worst.quantity, scalar, m_worst.error);
    let (floor, epsilon) = (1e-11_f64, f64::EPSILON);
    let (error, double) = (inverse_worst.error, scalar == "f64");
    println!("{scalar} M⁻¹ of {}: {error:.1e}, κ(M) = {kappa:.1e}", r.robot);
    let bound = if double {
        floor.max(10.0 * kappa * epsilon)
    } else {
        10.0 * kappa * f64::from(f32::EPSILON)
    };
    if error.is_nan() || error > bound {
        verdict.0.push(format!("{scalar} M⁻¹ of {}: {error:.1e} > {bound:.1e}", r.robot));
    }
}

/// The core against the recording, which is returned.
fn core_of<T, const B: usize, const Q: usize, const V: usize>(verdict: &mut Verdict) -> Recording
where
    T: Robot<B, Q, V>,
{
    let recording = load(T::MODEL.name);
    assert_eq!(
        recording.model,
        export::robot(&T::MODEL),
        "the recording is of other numbers: run host-tests/oracle/record.py again"
    );
    core::<f64, T, B, Q, V>(&recording, verdict);
    core::<f32, T, B, Q, V>(&recording, verdict);
    matrices::<f64, T, B, Q, V>(&recording, verdict);
    matrices::<f32, T, B, Q, V>(&recording, verdict);
    recording
}

/// The core and the manifold of configurations against the recording.
fn joints_of<T, const B: usize, const Q: usize, const V: usize>(verdict: &mut Verdict)
where
    T: Robot<B, Q, V>,
{
    let recording = core_of::<T, B, Q, V>(verdict);
    manifold::<T, B, Q, V>(&recording, verdict);
}

#[test]
fn the_core_agrees_with_pinocchio_within_the_table() {
    let mut verdict = Verdict(vec![]);
    core_of::<Ur5e, 6, 6, 6>(&mut verdict);
    core_of::<Panda, 7, 7, 7>(&mut verdict);
    core_of::<Iiwa14, 7, 7, 7>(&mut verdict);
    core_of::<XArm7, 7, 7, 7>(&mut verdict);
    core_of::<Puma560, 6, 6, 6>(&mut verdict);
    core_of::<OpenArm, 7, 7, 7>(&mut verdict);
    core_of::<Yam, 6, 6, 6>(&mut verdict);
    core_of::<Z1, 7, 7, 7>(&mut verdict);
    core_of::<So101, 6, 6, 6>(&mut verdict);
    assert!(verdict.0.is_empty(), "\n{}", verdict.0.join("\n"));
}

#[test]
fn every_kind_of_joint_agrees_with_pinocchio_within_the_table() {
    let mut verdict = Verdict(vec![]);
    core_of::<Gen3, 7, 7, 7>(&mut verdict);
    joints_of::<TreeA, 17, 35, 32>(&mut verdict);
    joints_of::<TreeB, 17, 35, 32>(&mut verdict);
    assert!(verdict.0.is_empty(), "\n{}", verdict.0.join("\n"));
}

#[cfg(feature = "full")]
#[test]
fn walking_and_floating_robots_agree_with_pinocchio() {
    use dynamics_core::robots::{A1, A1Free, G1, G1Free};
    let mut verdict = Verdict(vec![]);
    core_of::<A1, 16, 12, 12>(&mut verdict);
    surroundings_of::<A1, 16, 12, 12>(&mut verdict);
    core_of::<G1, 29, 29, 29>(&mut verdict);
    joints_of::<A1Free, 17, 19, 18>(&mut verdict);
    joints_of::<G1Free, 30, 36, 35>(&mut verdict);
    surroundings_of::<G1Free, 30, 36, 35>(&mut verdict);
    assert!(verdict.0.is_empty(), "\n{}", verdict.0.join("\n"));
}

/// Forces, a moving base and rotors in both scalars.
fn surroundings_of<T, const B: usize, const Q: usize, const V: usize>(verdict: &mut Verdict)
where
    T: Robot<B, Q, V>,
{
    let recording = load(T::MODEL.name);
    surroundings::<f64, T, B, Q, V>(&recording, verdict);
    surroundings::<f32, T, B, Q, V>(&recording, verdict);
}

#[test]
fn wrenches_moving_bases_and_rotors_agree_with_pinocchio() {
    let mut verdict = Verdict(vec![]);
    surroundings_of::<Panda, 7, 7, 7>(&mut verdict);
    surroundings_of::<TreeA, 17, 35, 32>(&mut verdict);
    surroundings_of::<TreeB, 17, 35, 32>(&mut verdict);
    assert!(verdict.0.is_empty(), "\n{}", verdict.0.join("\n"));
}
