//! The scene `scara_table`'s machine: three vertical axes have a closed planar form, and gravity
//! does no work on them.

use dynamics_core::effects::{Coriolis, Gravity, GravityVector, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::robots::Scara;
use firmware_demo::scenes::scara_table::EFFECTS;
use glam::Vec3;
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};
use host_tests::tolerances;

/// Random states up to the machine's speeds.
fn random_states<R: Real>() -> impl Iterator<Item = State<R, 3, 3>> {
    let mut rng = random_numbers();
    std::iter::repeat_with(move || State {
        q: within(&mut rng, 2.6).map(R::from_f64),
        qd: within(&mut rng, 12.0).map(R::from_f64),
        qdd: within(&mut rng, 120.0).map(R::from_f64),
    })
    .take(1000)
}

/// In angles ψ from the base to each link's centre of mass Lagrange's equations are
/// `Q_i = Σ_j D_ij (cos(ψ_j − ψ_i) ψ̈_j − sin(ψ_j − ψ_i) ψ̇_j²)` with a constant D, and
/// `τ_i = Σ_{j ≥ i} Q_j`.
fn planar(s: &State<f64, 3, 3>) -> [f64; 3] {
    // The centres of arm and forearm lie on their links: ψ is then as q for them.
    let [arm, forearm, quill] = &Scara::MODEL.links;
    assert!([arm, forearm].map(|link| link.inertia.first_moment.y) == [0.0; 2]);
    let [l1, l2] = [forearm, quill].map(|link| link.placement.pos.x);
    let h = [arm, forearm, quill].map(|link| link.inertia.first_moment.truncate());
    let izz = [arm, forearm, quill].map(|link| link.inertia.rotational.z_axis.z);
    let [m2, m3] = [forearm, quill].map(|link| link.inertia.mass);
    let d12 = l1 * (h[1].x + m3 * l2);
    let [d13, d23] = [l1, l2].map(|l| l * h[2].length());
    let d = [
        [izz[0] + (m2 + m3) * l1 * l1, d12, d13],
        [d12, izz[1] + m3 * l2 * l2, d23],
        [d13, d23, izz[2]],
    ];
    let along = |x: [f64; 3]| [x[0], x[0] + x[1], x[0] + x[1] + x[2]];
    let (mut psi, rate, change) = (along(s.q), along(s.qd), along(s.qdd));
    psi[2] += h[2].to_angle();
    let force = |i: usize| -> f64 {
        let term = |j: usize| {
            let (sin, cos) = (psi[j] - psi[i]).sin_cos();
            d[i][j] * (cos * change[j] - sin * rate[j] * rate[j])
        };
        (0..3).map(term).sum()
    };
    let q = [0, 1, 2].map(force);
    [q[0] + q[1] + q[2], q[1] + q[2], q[2]]
}

#[test]
fn a_scara_has_its_planar_form() {
    fn holds<R: Real>(scalar: &str) {
        let (mut errors, mut wanted) = (vec![], vec![]);
        for state in random_states::<R>() {
            let want = planar(&State {
                q: state.q.map(R::to_f64),
                qd: state.qd.map(R::to_f64),
                qdd: state.qdd.map(R::to_f64),
            });
            let core = Core::<Scara>::rnea(&state, &RIGID_BODY);
            let engine = Engine::<Scara>::rnea(&state, &RIGID_BODY);
            for (got, want) in core.into_iter().chain(engine).zip(want.iter().cycle()) {
                wanted.push(want.abs());
                errors.push((got.to_f64() - want).abs());
            }
        }
        let error = largest(errors) / largest(wanted);
        tolerances::check("scara", "planar form", scalar, error).unwrap_or_else(|e| panic!("{e}"));
    }
    holds::<f64>("f64");
    holds::<f32>("f32");
}

/// Not nearly: to the last bit, in core and engine, and also where the direction is known at run
/// time only.
#[test]
fn gravity_adds_nothing_to_vertical_axes() {
    fn holds<R: Real>() {
        for state in random_states::<R>() {
            let without = (Inertia, Coriolis);
            let core = Core::<Scara>::rnea(&state, &without);
            assert_eq!(Core::<Scara>::rnea(&state, &RIGID_BODY), core);
            let engine = Engine::<Scara>::rnea(&state, &without);
            assert_eq!(Engine::<Scara>::rnea(&state, &RIGID_BODY), engine);
        }
    }
    holds::<f64>();
    holds::<f32>();
    for state in random_states::<f32>() {
        let without = Engine::<Scara>::rnea(&state, &EFFECTS);
        let along = GravityVector(Vec3::NEG_Z * 9.81);
        assert_eq!(Engine::<Scara>::rnea(&state, &(Gravity::EARTH, EFFECTS)), without);
        assert_eq!(Engine::<Scara>::rnea(&state, &(along, EFFECTS)), without);
    }
}
