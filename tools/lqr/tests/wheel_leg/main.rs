//! The gains of the scene `wheel_leg_balance`: from its model alone, and those of its table.

mod design;

use design::{Model, balanced, standing};
use dynamics_core::Core;
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, Viscous};
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use firmware_demo::robots::{Straight, WheelLeg};
use lqr::{held, lqr};

const EFFECTS: design::Effects =
    (Gravity::EARTH, Inertia, Coriolis, Viscous([0.0; 16]), Armature([0.0; 16]));

#[test]
fn the_legs_carry_the_robot_and_its_regulator_holds_it() {
    for length in [0.14, 0.24, 0.34] {
        let balanced = balanced(length, &EFFECTS);
        // Half the weight above the axles is on each leg: τ = F ∂L/∂β / 2 at each of its cranks.
        let slope = Straight::of_length(length).slopes[0];
        let weight = 0.5 * 9.81 * WheelLeg::MODEL.links.iter().map(|l| l.inertia.mass).sum::<f64>();
        let [rear, front, wheel, ..] = balanced.torque;
        assert!((rear + front).abs() < 1e-9 && wheel.abs() < 1e-9, "{:?}", balanced.torque);
        assert!(front > 0.5 * 0.6 / slope * weight && front < 0.5 / slope * weight, "{front}");
        let [phi, gamma] = held(&balanced.plant, 2e-3);
        assert!(phi.complex_eigenvalues().iter().any(|z| z.norm() > 1.01), "it falls by itself");
        let k = lqr(&balanced.plant, 2e-3, &design::DEVIATIONS).expect("gains");
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
    Core::<WheelLeg>::potential_energy(motion.configuration(), &EFFECTS)
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
        let k = balanced(length, &EFFECTS).stiffness;
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
