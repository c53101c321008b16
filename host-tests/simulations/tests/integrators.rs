//! Integrators: their orders, what keeps energy, what damping cannot shake, and what compensated
//! addition repairs.

use dynamics_core::Core;
use dynamics_core::algorithms::{kinetic_energy, potential_energy};
use dynamics_core::effects::{Effect, RIGID_BODY};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot, RobotModel, Static};
use dynamics_core::scalar::Real;
use dynamics_core::sim::{
    EnergyProjected, Euler, Integrator, KahanState, LinearlyImplicit, ModelDynamics, RungeKutta,
    SemiImplicit, linearly_implicit,
};
use dynamics_core::state::State;
use fixtures::accuracy::simulation::{DoublePendulum, PassiveMotion};
use host_tests::everyday_or_full;
use host_tests::measured::{largest, within};
use host_tests::tolerances::check;

/// The double pendulum's state after a second in this many steps, all of which `see` is shown;
/// nothing if some acceleration has become none.
fn watched<I, R, E, const COMPENSATED: bool>(
    steps: u32,
    effects: &E,
    mut see: impl FnMut(&State<R, 2, 2>),
) -> Option<State<R, 2, 2>>
where
    I: Integrator<R, 2, 2>,
    R: Real,
    E: Effect<R, 2, 2>,
{
    let robot = ModelDynamics { robot: &Static::<DoublePendulum>::NEW, tau: [R::ZERO; 2], effects };
    let [q, qd] = DoublePendulum::START.map(|numbers| numbers.map(R::from_f64));
    let mut motion = KahanState::<R, 2, COMPENSATED>::at(State { q, qd, qdd: [R::ZERO; 2] });
    let integrator = I::start(&robot, &motion.state);
    let h = R::from_f64(1.0 / f64::from(steps));
    for _ in 0..steps {
        motion.add(&integrator.step(&robot, &motion.state, h).ok()?, h);
        see(&motion.state);
    }
    Some(motion.state)
}

fn free<I: Integrator<R, 2, 2>, R: Real, const COMPENSATED: bool>(steps: u32) -> State<R, 2, 2> {
    watched::<I, R, _, COMPENSATED>(steps, &RIGID_BODY, |_| ()).expect("a pendulum has inertia")
}

/// The largest distance of q from where it is after many steps, rad.
fn off<R: Real>(state: &State<R, 2, 2>) -> f64 {
    let truth = free::<RungeKutta, f64, true>(20_000);
    let pairs = state.q.iter().zip(truth.q);
    largest(pairs.map(|(q, truth)| (q.to_f64() - truth).abs()))
}

#[test]
fn integrators_are_of_their_order() {
    let order =
        |coarse: State<f64, 2, 2>, fine: State<f64, 2, 2>| (off(&coarse) / off(&fine)).log2();
    let orders = [
        (1.0, order(free::<Euler, f64, true>(8000), free::<Euler, f64, true>(16_000))),
        (1.0, order(free::<SemiImplicit, f64, true>(1000), free::<SemiImplicit, f64, true>(2000))),
        (
            1.0,
            order(
                free::<LinearlyImplicit, f64, true>(1000),
                free::<LinearlyImplicit, f64, true>(2000),
            ),
        ),
        (4.0, order(free::<RungeKutta, f64, true>(250), free::<RungeKutta, f64, true>(500))),
        (
            4.0,
            order(
                free::<EnergyProjected<f64>, f64, true>(250),
                free::<EnergyProjected<f64>, f64, true>(500),
            ),
        ),
    ];
    for (want, order) in orders {
        let (what, bound) = (format!("order {want}"), if want > 1.0 { 0.3 } else { 0.05 });
        within(&what, (order - want).abs(), bound);
    }
}

#[test]
fn energy_projection_keeps_the_energy() {
    fn lost<R: Real>(scalar: &str) -> Result<(), String>
    where
        EnergyProjected<R>: Integrator<R, 2, 2>,
    {
        let energy = |q: [f64; 2], qd: [f64; 2]| {
            let state = State { q, qd, qdd: [0.0; 2] };
            let kinetic = Core::<DoublePendulum>::kinetic_energy(&state, &RIGID_BODY);
            kinetic + Core::<DoublePendulum>::potential_energy(&q, &RIGID_BODY)
        };
        let [q, qd] = DoublePendulum::START;
        let start = energy(q, qd);
        let mut errors = vec![];
        let see = |at: &State<R, 2, 2>| {
            let now = energy(at.q.map(R::to_f64), at.qd.map(R::to_f64));
            errors.push((now / start - 1.0).abs());
        };
        watched::<EnergyProjected<R>, R, _, false>(1000, &RIGID_BODY, see)
            .ok_or("no acceleration")?;
        let error = largest(errors);
        check("double pendulum", "energy kept for a second", scalar, error)
    }
    lost::<f64>("f64").unwrap();
    lost::<f32>("f32").unwrap();
}

#[test]
fn compensated_addition_repairs_fine_steps() {
    let coarse = off(&free::<RungeKutta, f32, false>(1000));
    let plain = off(&free::<RungeKutta, f32, false>(50_000));
    let compensated = off(&free::<RungeKutta, f32, true>(50_000));
    assert!(plain > 2.0 * coarse, "finer steps are worse: {plain:.1e}, {coarse:.1e}");
    within("compensated, of plain", compensated / plain, 0.05);
    let quantity = "compensated Runge-Kutta in fine steps";
    check("double pendulum", quantity, "f32", compensated).unwrap();
}

/// A double pendulum of two uneven links.
const TWO: ArmModel<f64, 2> = Model::new(
    "two",
    [
        Body::new("a", BASE, Joint::revolute([0.0, 1.0, 0.0]))
            .mass(1.3)
            .com([0.0, 0.0, -0.25])
            .inertia([0.02, 0.0, 0.0, 0.02, 0.0, 0.001]),
        Body::new("b", 0, Joint::revolute([0.0, 1.0, 0.0]))
            .xyz([0.0, 0.0, -0.5])
            .mass(0.9)
            .com([0.0, 0.0, -0.2])
            .inertia([0.015, 0.0, 0.0, 0.015, 0.0, 0.001]),
    ],
);

struct Two;
impl Robot<2, 2, 2> for Two {
    const MODEL: ArmModel<f64, 2> = TWO;
}

/// The energy of the pendulum after some seconds by steps of h without friction, as a share of that
/// at the start: the least and the greatest of the last hundred steps' in each second.
fn energies<R: Real>(start: [f64; 2], seconds: u32, h: f64) -> [f64; 2]
where
    Static<Two>: RobotModel<R, 2, 2, 2>,
{
    let energy = |state: &State<R, 2, 2>| {
        let [q, qd] = [state.q, state.qd].map(|x| x.map(R::to_f64));
        let state = State { q, qd, qdd: [0.0_f64; 2] };
        kinetic_energy(&TWO, &state, &RIGID_BODY) + potential_energy(&TWO, &state.q, &RIGID_BODY)
    };
    let mut state = State::at(start.map(R::from_f64));
    let rest = energy(&State::at([R::ZERO; 2]));
    let full = energy(&state) - rest;
    let steps = (1.0 / h).round() as u32;
    let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
    for _ in 0..seconds {
        for step in 0..steps {
            linearly_implicit(
                &Static::<Two>::NEW,
                &mut state,
                &[R::ZERO; 2],
                &mut { RIGID_BODY },
                R::from_f64(h),
            )
            .expect("a pendulum has inertia");
            if step >= steps - 100 {
                let share = (energy(&state) - rest) / full;
                (least, greatest) = (least.min(share), greatest.max(share));
            }
        }
    }
    [least, greatest]
}

// The doc comment of `linearly_implicit` states these.
#[test]
fn the_energy_of_a_pendulum_drifts_little_within_an_hour() {
    for (start, least, greatest) in
        [([0.5, -0.3], 0.997, 1.003), ([1.5, 0.5], 0.92, 1.02), ([2.5, 1.0], 0.65, 1.02)]
    {
        let found = energies::<f64>(start, 3600, 1e-3);
        assert!(found[0] > least && found[1] < greatest, "{start:?}: {found:?}");
    }
}

/// The step and the scalar of the scenes' plants; the doc comment of `linearly_implicit` states
/// these, too.
#[test]
fn the_energy_of_a_plant_in_f32_drifts_little_within_an_hour() {
    for (start, share) in [([0.5, -0.3], 0.002), ([1.5, 0.5], 0.03), ([2.5, 1.0], 0.12)] {
        let [least, most] = energies::<f32>(start, everyday_or_full(300, 3600), 2.5e-4);
        let off = (1.0 - least).max(most - 1.0);
        assert!(off < share, "{start:?}: {least} to {most}");
    }
}
