//! The gains of the scene `wheel_leg_balance`: from its model alone, and those of its table.

mod design;

use design::{DEVIATIONS, Model, balanced, standing};
use dynamics_core::Core;
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, Viscous};
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use firmware_demo::robots::{Straight, WheelLeg};
use firmware_demo::scenes::wheel_leg_balance::gains::GAINS;
use firmware_demo::scenes::wheel_leg_balance::{self, LENGTHS, TICK};
use lqr_gains::{held, lqr, source};
use nalgebra::DMatrix;

/// The effects of the scene that have derivatives at rest: sliding friction is a step there.
fn effects() -> design::Effects {
    let (.., viscous, _, rotors) = wheel_leg_balance::EFFECTS;
    let numbers = |of: [f32; 16]| of.map(f64::from);
    let (viscous, rotors) = (Viscous(numbers(viscous.0)), Armature(numbers(rotors.0)));
    (Gravity::EARTH, Inertia, Coriolis, viscous, rotors)
}

// page: begin
/// The lengths of the table, and the gains and torques of each.
fn table(effects: &design::Effects) -> Vec<(f64, DMatrix<f64>)> {
    let lengths = (0..11).map(|k| f64::from(LENGTHS[0]) + f64::from(LENGTHS[1]) * f64::from(k));
    let gains = |length| {
        let balanced = balanced(length, effects);
        let k = lqr(&balanced.plant, f64::from(TICK), &DEVIATIONS).expect("gains");
        let mut with_torque = k.insert_column(14, 0.0);
        with_torque.column_mut(14).copy_from_slice(&balanced.torque);
        (length, with_torque)
    };
    lengths.map(gains).collect()
}
// page: end

/// The largest difference of the table on the target from that of these effects, as a share of the
/// largest gain. It is not zero: processors differ in the last digits of a product of matrices.
fn staleness(effects: &design::Effects) -> f64 {
    let off = |(length, gains): (f64, DMatrix<f64>)| {
        let (on_target, _) = GAINS.at(length as f32);
        let on_target = DMatrix::from_fn(6, 15, |i, j| f64::from(on_target[i][j]));
        (on_target - &gains).amax() / gains.amax()
    };
    table(effects).into_iter().map(off).fold(0.0, f64::max)
}

/// An interpolation at the entries is off by the rounding of their lengths.
const FRESH: f64 = 2e-6;

#[test]
fn the_table_of_gains_is_that_of_the_model() {
    if std::env::var_os("TABLES_WRITE").is_some() {
        let tables: Vec<_> = table(&effects()).into_iter().map(|(_, gains)| gains).collect();
        let text = format!(
            "//! The table of gains, written by `cargo test -p lqr-gains` with `TABLES_WRITE=1`: \
             do not edit.\n\nuse super::{{Gains, LENGTHS}};\n\n#[rustfmt::skip]\n\
             pub const GAINS: Gains = Gains::new(LENGTHS[0], LENGTHS[1], {});\n",
            source(&tables)
        );
        let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../firmware-demo/src/scenes");
        std::fs::write(format!("{scenes}/wheel_leg_balance/gains.rs"), text).expect("a file");
        return;
    }
    let off = staleness(&effects());
    assert!(off < FRESH, "the table is stale by {off:.1e}: TABLES_WRITE=1 cargo test -p lqr-gains");
}

#[test]
fn another_model_has_another_table() {
    let (gravity, inertia, coriolis, mut viscous, rotors) = effects();
    viscous.0[WheelLeg::WHEELS[0]] *= 1.01;
    assert!(staleness(&(gravity, inertia, coriolis, viscous, rotors)) > FRESH);
}

#[test]
fn the_legs_carry_the_robot_and_its_regulator_holds_it() {
    for length in [0.14, 0.24, 0.34] {
        let balanced = balanced(length, &effects());
        // Half the weight above the axles is on each leg: τ = F ∂L/∂β / 2 at each of its cranks.
        let slope = Straight::of_length(length).slopes[0];
        let weight = 0.5 * 9.81 * WheelLeg::MODEL.links.iter().map(|l| l.inertia.mass).sum::<f64>();
        let [rear, front, wheel, ..] = balanced.torque;
        assert!((rear + front).abs() < 1e-9 && wheel.abs() < 1e-9, "{:?}", balanced.torque);
        assert!(front > 0.5 * 0.6 / slope * weight && front < 0.5 / slope * weight, "{front}");
        let [phi, gamma] = held(&balanced.plant, 2e-3);
        assert!(phi.complex_eigenvalues().iter().any(|z| z.norm() > 1.01), "it falls by itself");
        let k = lqr(&balanced.plant, 2e-3, &DEVIATIONS).expect("gains");
        let closed = phi - gamma * k;
        assert!(closed.complex_eigenvalues().iter().all(|z| z.norm() < 0.999));
    }
}

/// The potential energy of the robot on its wheels at pitch and motors z, J.
fn energy(z: [f64; 7]) -> f64 {
    let mut y = [0.0; 12];
    y[5..].copy_from_slice(&z);
    let motion = Model::motion(&State::at(y)).expect("a leg that closes");
    let poses = Core::<WheelLeg>::poses(motion.configuration());
    let [left, right] = WheelLeg::WHEELS.map(|wheel| poses[wheel].pos.z);
    y[4] = ((right - left) / (2.0 * WheelLeg::SIDE)).atan();
    y[2] = y[4].cos() * (WheelLeg::RADIUS - 0.5 * (left + right));
    let motion = Model::motion(&State::at(y)).expect("a leg that closes");
    Core::<WheelLeg>::potential_energy(motion.configuration(), &effects())
}

#[test]
fn the_stiffness_is_the_second_derivative_of_the_potential_energy() {
    const H: f64 = 1e-3;
    for length in [0.14, 0.24, 0.34] {
        let at = |moves: &[(usize, f64)]| {
            let mut z: [f64; 7] = core::array::from_fn(|i| standing(length)[5 + i]);
            moves.iter().for_each(|&(i, by)| z[i] += by);
            energy(z)
        };
        let k = balanced(length, &effects()).stiffness;
        for i in 0..7 {
            for j in 0..7 {
                let of = |a, b| at(&[(i, a * H), (j, b * H)]);
                let slope =
                    (of(1.0, 1.0) - of(1.0, -1.0) - of(-1.0, 1.0) + of(-1.0, -1.0)) / (4.0 * H * H);
                let error = (k[(i, j)] - slope).abs();
                assert!(error < 1e-5 * k.amax(), "{length} {i} {j}: {slope} {error:.1e}");
            }
        }
    }
}
