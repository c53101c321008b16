//! Planar linkages have closed forms.

use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::loops::{
    Drive, LoopRobot, Loops, Moving, Stabilisation, assemble, coordinate_map, forward_dynamics,
    inverse_dynamics,
};
use dynamics_core::model::{Robot, Static};
use dynamics_core::state::State;
use host_tests::measured::{largest, within};
use loop_tests::machines::{FOUR_BAR, FiveBar, FourBar, Machine, Parallelogram, ThreeMotors};
use loop_tests::states::closed_states;

/// The angles of coupler and rocker against the ground, from that of the crank: the diagonal from
/// the crank's pin to the rocker's foot, and the law of cosines in the triangle on its other side
/// (Freudenstein, 1954).
fn angles(crank: f64) -> [f64; 2] {
    let [a, b, c, d] = FOUR_BAR;
    let (pin_x, pin_z) = (a * crank.cos(), a * crank.sin());
    let (diagonal, towards) = ((d - pin_x).hypot(pin_z), (-pin_z).atan2(d - pin_x));
    let at_pin = ((diagonal * diagonal + b * b - c * c) / (2.0 * diagonal * b)).acos();
    let coupler = towards + at_pin;
    let (x, z) = (pin_x + b * coupler.cos() - d, pin_z + b * coupler.sin());
    [coupler, z.atan2(x)]
}

/// Angles against the ground, of which a turn about y lowers what lies along x.
fn against_ground(q: &[f64; 3]) -> [f64; 3] {
    [-q[0], -q[0] - q[1], -q[2]]
}

#[test]
fn the_four_bar_angles_are_those_of_its_triangles() {
    let (mut errors, mut guess) = (Vec::new(), FourBar::HOME);
    for k in 0..=400 {
        guess[0] = -1.0 - f64::from(k) * core::f64::consts::TAU / 400.0; // right round
        let closed = assemble(&Static::<FourBar>::NEW, &FourBar::LOOPS, &guess, Moving::Passive);
        guess = closed.expect("it closes").q;
        let [crank, coupler, rocker] = against_ground(&guess);
        for (got, want) in [coupler, rocker].into_iter().zip(angles(crank)) {
            let turns = (got - want) / core::f64::consts::TAU;
            errors.push((turns - turns.round()).abs() * core::f64::consts::TAU);
        }
    }
    within("angles of the four-bar linkage", largest(errors), 5e-15);
}

/// Rates of coupler and rocker from that of the crank, by the sine rule of the velocity polygon.
fn rates([crank, coupler, rocker]: [f64; 3], rate: f64) -> [f64; 2] {
    let [a, b, c, _] = FOUR_BAR;
    [
        -rate * a * (crank - rocker).sin() / (b * (coupler - rocker).sin()),
        rate * a * (crank - coupler).sin() / (c * (rocker - coupler).sin()),
    ]
}

#[test]
fn the_four_bar_rates_are_those_of_its_velocity_polygon() {
    let mut errors = Vec::new();
    for state in closed_states::<FourBar, 3, 3, 3, 1, 5, 1>(200) {
        let [coupler, rocker] = rates(against_ground(&state.q), -state.qd[0]);
        errors.push((-state.qd[0] - state.qd[1] - coupler).abs());
        errors.push((-state.qd[2] - rocker).abs());
    }
    within("rates of the four-bar linkage, rad/s", largest(errors), 2e-13);
}

#[test]
fn four_bar_gravity_is_its_weights_virtual_work() {
    let mut errors = Vec::new();
    for state in closed_states::<FourBar, 3, 3, 3, 1, 5, 1>(200) {
        let at_rest = State::at(state.q);
        let got =
            inverse_dynamics(&Static::<FourBar>::NEW, &FourBar::LOOPS, &at_rest, &Gravity::EARTH);
        let ground = against_ground(&state.q);
        let ([a, ..], [coupler, rocker]) = (FOUR_BAR, rates(ground, 1.0));
        // The rise of each centre of mass, which lies at (x, z) in its bar, with a unit rate of the
        // crank.
        let rise = |i: usize, rate: f64| {
            let (com, (sin, cos)) =
                (FourBar::MODEL.in_link_frame(i).1.first_moment, ground[i].sin_cos());
            9.81 * rate * (com.x * cos - com.z * sin)
        };
        let carried = 9.81 * FourBar::MODEL.links[1].inertia.mass * a * ground[0].cos();
        let work = rise(0, 1.0) + carried + rise(1, coupler) + rise(2, rocker);
        errors.push((got.expect("a torque").tau[0] + work).abs());
    }
    within("virtual work of weights, N m", largest(errors), 1.5e-13);
}

/// In f32 too, and not only at zero but near it, where rounding alone tells the rows apart.
#[test]
fn a_nearly_flat_parallelogram_has_the_flat_rank() {
    let robot = Static::<Parallelogram>::NEW;
    for off in [1e-9, 1e-8] {
        let map = coordinate_map(&robot, &Parallelogram::LOOPS, &[-off, off, -off]);
        assert_eq!(map.expect("a map").rows().rank(), 1, "{off:e} rad from flat");
    }
    for off in [1e-5_f32, 1e-4] {
        let map = coordinate_map(&robot, &Parallelogram::LOOPS, &[-off, off, -off]);
        assert_eq!(map.expect("a map").rows().rank(), 1, "{off:e} rad from flat, in f32");
    }
    let map = coordinate_map(&robot, &Parallelogram::LOOPS, &[-1e-2_f64, 1e-2, -1e-2]);
    assert_eq!(map.expect("not flat").rows().rank(), 2);
    let map = coordinate_map(&robot, &Parallelogram::LOOPS, &[-5e-2_f32, 5e-2, -5e-2]);
    assert_eq!(map.expect("not flat").rows().rank(), 2);
}

#[test]
fn a_third_motor_shares_the_torque_with_the_least_norm() {
    let (mut errors, mut saved) = (Vec::new(), 0);
    for state in closed_states::<FiveBar, 4, 4, 4, 1, 5, 2>(200) {
        let two = inverse_dynamics(&Static::<FiveBar>::NEW, &FiveBar::LOOPS, &state, &RIGID_BODY);
        let two = two.expect("a torque");
        let three = inverse_dynamics(
            &Static::<ThreeMotors>::NEW,
            &ThreeMotors::LOOPS,
            &two.state,
            &RIGID_BODY,
        );
        let three = three.expect("a torque");
        assert_eq!(two.drive, Drive::Determined);
        assert_eq!(three.drive, Drive::LeastNorm { redundancy: 1 });
        // The same work on every motion: the rates of the third motor are those of the map.
        let map =
            coordinate_map(&Static::<FiveBar>::NEW, &FiveBar::LOOPS, &two.state.q).expect("a map");
        let [left, right] = [[1.0, 0.0], [0.0, 1.0]].map(|rates| map.velocity(&rates)[1]);
        let [a, b, c] = three.tau;
        errors.push((a + left * b - two.tau[0]).abs());
        errors.push((c + right * b - two.tau[1]).abs());
        // No torque that does no work is left in it: (−left, 1, −right) is the direction of those.
        errors.push((b - left * a - right * c).abs());
        let norm = |tau: &[f64]| tau.iter().map(|x| x * x).sum::<f64>();
        saved += usize::from(norm(&three.tau) < norm(&two.tau));
    }
    within("shared torque, N m", largest(errors), 4e-15);
    assert_eq!(saved, 200, "two motors with less than three");
}

/// The linkage with the motor at its rocker, where crank and coupler are in one line: a dead point.
// Forward dynamics computes across it.
#[test]
fn inverse_dynamics_names_a_dead_point() {
    let joints = *FourBar::LOOPS.joints();
    let loops = Loops::<1, 5, 1>::new(&FourBar::MODEL, joints, [2]);
    let robot = Static::<FourBar>::NEW;
    let [a, b, c, d] = FOUR_BAR;
    let reach = a + b;
    let crank = ((reach * reach + d * d - c * c) / (2.0 * reach * d)).acos();
    let rocker = (reach * crank.sin()).atan2(reach * crank.cos() - d);
    let dead = [-crank, 0.0, -rocker];
    let state = State { qd: [1.0, 0.0, 0.0], ..State::at(dead) };
    let torque = inverse_dynamics(&robot, &loops, &state, &RIGID_BODY);
    let drive = torque.expect("a damped torque").drive;
    let Drive::Singular { name, joint } = drive else {
        panic!("{drive:?}");
    };
    assert!(name == "joint" && joint < 2, "{drive:?}");
    let motion = forward_dynamics(&robot, &loops, &state, &[1.0], Stabilisation::NONE, &RIGID_BODY);
    assert_eq!(motion.expect("accelerations").rows.rank(), 2);
}

#[test]
fn a_parallelogram_without_damping_moves_on_near_its_flat_configuration() {
    let robot = Static::<Parallelogram>::NEW;
    let undamped = Parallelogram::LOOPS.damped_below(0.0);
    let mut errors = Vec::new();
    for off in [1e-1_f64, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let state =
            State { qd: [1.0, -1.0, 1.0], qdd: [2.0, -2.0, 2.0], ..State::at([-off, off, -off]) };
        let id = inverse_dynamics(&robot, &undamped, &state, &RIGID_BODY);
        let (id, none) = (id.expect("a torque"), Stabilisation::NONE);
        let fd =
            forward_dynamics(&robot, &Parallelogram::LOOPS, &state, &id.tau, none, &RIGID_BODY);
        let qdd = fd.expect("accelerations").qdd;
        // Rounding errors grow with the inverse of the angle from flat: the error times the angle
        // is bounded.
        let error = largest(qdd.iter().zip(state.qdd).map(|(got, want)| (got - want).abs()));
        errors.push(error * off);
    }
    within("accelerations near flat, times the angle", largest(errors), 1.5e-15);
    let flat = State { qd: [1.0, -1.0, 1.0], ..State::at([0.0_f64; 3]) };
    let none = Stabilisation::NONE;
    let motion = forward_dynamics(&robot, &Parallelogram::LOOPS, &flat, &[1.0], none, &RIGID_BODY);
    let motion = motion.expect("accelerations");
    assert_eq!((motion.rows.rank(), motion.rows.redundant().count()), (1, 4));
    assert!(
        motion.rows.redundant().all(|row| Parallelogram::LOOPS.name_of_row(row) == "far_corner")
    );
}
