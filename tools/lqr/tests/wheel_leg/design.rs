//! The gains of `wheel_leg_balance` from the robot's model, at one length of its legs.
//!
//! With the wheels' contacts as constraints A ẏ = 0 of the independent coordinates y = (d, z), of
//! which pitch and motors z are left, δy = G δz, and vertical forces f that carry the robot:
//!
//! ```text
//! M δÿ + D δẏ + (K − Σ f_i ∂²h_i/∂y²) δy = S δu + Aᵀ δf      G = [−A_d⁻¹ A_z; 1]
//! ```
//!
//! and both sides times Gᵀ. The horizontal forces are zero at rest, so that of the constraints'
//! own derivatives those of the heights h count alone.

use core::f64::consts::PI;

use dynamics_core::Core;
use dynamics_core::algorithms::{Linearisation, frame};
use dynamics_core::clusters::Clustered;
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, Viscous};
use dynamics_core::state::State;
use firmware_demo::robots::{Straight, WheelLeg};
use lqr_gains::Deviations;
use nalgebra::{SMatrix, SVector};

pub type Model = Clustered<Core<WheelLeg>>;
pub type Effects = (Gravity, Inertia, Coriolis, Viscous<f64, 16>, Armature<f64, 16>);

/// The robot at rest with legs of one length.
pub struct Balanced {
    pub plant: Linearisation<f64, 7, 6>,
    /// The motors' torques that carry it, N·m.
    pub torque: [f64; 6],
    /// Gᵀ (K − Σ f ∂²h) G.
    pub stiffness: SMatrix<f64, 7, 7>,
}

/// The deviations of pitch, cranks and wheels that are as bad as each other.
pub const DEVIATIONS: Deviations<7, 6> = Deviations {
    q: [0.2, 0.1, 0.1, 2.0, 0.1, 0.1, 2.0],
    qd: [1.0, 4.0, 4.0, 10.0, 4.0, 4.0, 10.0],
    u: [10.0, 10.0, 2.0, 10.0, 10.0, 2.0],
};

/// y at rest.
pub fn standing(length: f64) -> [f64; 12] {
    let Straight { front, .. } = Straight::of_length(length);
    let (up, rear) = (WheelLeg::RADIUS + length, PI - front);
    [0.0, 0.0, up, 0.0, 0.0, 0.0, rear, front, 0.0, rear, front, 0.0]
}

// page: begin
/// ∂²h/∂y² of a wheel's height: the axle's, whose vertical acceleration at ÿ = 0 is ẏᵀ ∂²h ẏ, less
/// r cos ρ of the rolling body.
fn bend_of_height(y: &[f64; 12], wheel: usize) -> SMatrix<f64, 12, 12> {
    let along = |rate: SVector<f64, 12>| {
        let state = State { qd: rate.into(), ..State::at(*y) };
        let motion = Model::motion(&state).expect("a leg that closes");
        let all = Core::<WheelLeg>::kinematics(motion.state(), &());
        all.classical(wheel, frame::LocalWorldAligned).lin.z + WheelLeg::RADIUS * rate[4] * rate[4]
    };
    let unit = |k: usize| SVector::ith(k, 1.0);
    let own: [f64; 12] = core::array::from_fn(|k| along(unit(k)));
    SMatrix::from_fn(|i, j| 0.5 * (along(unit(i) + unit(j)) - own[i] - own[j]))
}

pub fn balanced(length: f64, effects: &Effects) -> Balanced {
    let y = standing(length);
    let motion = Model::motion(&State::at(y)).expect("a leg that closes");
    let of_tree = Core::<WheelLeg>::crba(motion.configuration(), effects);
    let m = motion.inertia(&of_tree);
    let mut m = SMatrix::<f64, 12, 12>::from_fn(|i, j| m.get(i, j));
    m.fill_upper_triangle_with_lower_triangle();
    let k = Model::stiffness(&y, effects).expect("a leg that closes");
    let mut k = SMatrix::<f64, 12, 12>::from_fn(|i, j| k[i][j]);
    let d = motion.torque(&effects.3.0);
    let held = Model::rnea(&State::at(y), effects).expect("a leg that closes");

    // A: both wheels roll along x and stay on the ground, and the left one does not slip sideways.
    let mut a = SMatrix::<f64, 5, 12>::zeros();
    for (side, wheel) in WheelLeg::WHEELS.into_iter().enumerate() {
        let of_tree =
            Core::<WheelLeg>::jacobian(motion.configuration(), wheel, frame::LocalWorldAligned);
        for (v, column) in motion.jacobian(&of_tree).into_iter().enumerate() {
            let below = column.lin - column.ang.cross(glam::DVec3::Z) * WheelLeg::RADIUS;
            (a[(side, v)], a[(2 + side, v)]) = (below.x, below.z);
            if side == 0 {
                a[(4, v)] = below.y;
            }
        }
        // Half the weight.
        k -= bend_of_height(&y, wheel) * (0.5 * held[2]);
    }
    let to_d = -a.fixed_columns::<5>(0).try_inverse().expect("wheels on the ground");
    let mut g = SMatrix::<f64, 12, 7>::zeros();
    g.fixed_rows_mut::<5>(0).copy_from(&(to_d * a.fixed_columns::<7>(5)));
    g.fixed_rows_mut::<7>(5).fill_with_identity();

    let d = SMatrix::from_diagonal(&SVector::from(d));
    let [m, d, k] = [m, d, k].map(|x: SMatrix<f64, 12, 12>| g.transpose() * x * g);
    let m_inv = m.try_inverse().expect("a positive definite M");
    let rows =
        |x: SMatrix<f64, 7, 7>| core::array::from_fn(|i| core::array::from_fn(|j| x[(i, j)]));
    let carried = g.transpose() * SVector::from(held);
    Balanced {
        plant: Linearisation {
            dq: rows(-m_inv * k),
            dqd: rows(-m_inv * d),
            // The pitch has no motor.
            du: core::array::from_fn(|i| core::array::from_fn(|j| m_inv[(i, j + 1)])),
        },
        torque: core::array::from_fn(|i| carried[i + 1]),
        stiffness: k,
    }
}
// page: end
