//! Friction of gears that grows with the transmitted torque: F = s (m |τ| + d s τ), m, d = (μ₁ ±
//! μ₂) / 2.
//!
//! τ is the torque that the motor must supply for all else at the joint, s = s(q̇ / w) the smooth
//! sign of [`Coulomb`](crate::effects::Coulomb). If s is ±1, the motor supplies τ (1 + μ₁) while
//! it drives the load, τ q̇ > 0, and τ (1 − μ₂) while the load drives it: the efficiencies of the
//! gear are 1/(1 + μ₁) and 1 − μ₂. Since |d| ≤ m, F q̇ is never negative. Duclusaud, Passault,
//! Padois & Ly, "Extended friction models for the physics simulation of servo actuators" (2025),
//! models M3 to M5, solved for the motor's torque.

use super::coulomb::sign_beyond;
use crate::effects::once::{Kind, Once};
use crate::effects::{
    Effect, JointState, LoadFactors, Width, hook, smooth_sign, smooth_sign_slope,
};
use crate::scalar::Real;
use crate::state::entry;

/// Friction of each joint's gear in proportion to the torque that it transmits.
///
/// The transmitted torque is that of all other effects at the joint, other friction and
/// [`Armature`](crate::effects::Armature) included. In inverse dynamics the friction is added last,
/// in forward dynamics it is solved for in closed form, which needs `backdriving` < 1: results are
/// not finite where the load drives a gear that it cannot turn. At rest the smooth sign is zero.
/// Robots with loops, clusters or elastic joints, whose motors do not supply the tree's torques, do
/// not compile with it.
///
/// Cost: some 14 flops a joint; in forward dynamics a division more.
///
/// ```
/// use dynamics_core::effects::{Gravity, LoadFriction, Width};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let gears = LoadFriction { driving: [0.25_f64; 6], backdriving: [0.2; 6], width: Width::new(0.01) };
/// let arm = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);
/// let holding = Core::<Ur5e>::rnea(&arm, &Gravity::EARTH)[1]; // negative
/// let torque = |qd| Core::<Ur5e>::rnea(&State { qd: [qd; 6], ..arm }, &(Gravity::EARTH, gears))[1];
/// assert_eq!(torque(0.0), holding);
/// assert!((torque(-1.0) - 1.25 * holding).abs() < 1e-12); // the motor lifts the arm
/// assert!((torque(1.0) - 0.8 * holding).abs() < 1e-12); // the arm sinks and drives the motor
/// ```
///
/// ```compile_fail,E0080
/// use dynamics_core::drivetrain::{ElasticJoints, MotorState, elastic_step};
/// use dynamics_core::effects::{LoadFriction, RIGID_BODY, Width};
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// let gears = LoadFriction { driving: [0.25_f64; 6], backdriving: [0.2; 6], width: Width::new(0.01) };
/// let joints = ElasticJoints { stiffness: [1e7_f64; 6], rotor: [1.0; 6], friction: [20.0; 6] };
/// let (mut arm, mut motors) = (State::at([0.0; 6]), MotorState { position: [0.0; 6], velocity: [0.0; 6] });
/// let _ = elastic_step(&Ur5e::MODEL, &joints, &mut arm, &mut motors, &[0.0; 6], &mut (RIGID_BODY, gears), 1e-3);
/// // error: load-dependent friction needs the torque of each gear
/// ```
#[doc(alias = "gear efficiency")]
#[doc(alias = "transmission loss")]
#[doc(alias = "load-dependent friction")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadFriction<R, const V: usize> {
    /// Friction μ₁ per transmitted torque while the motor drives the load: 1/η − 1 of the
    /// efficiency η.
    pub driving: [R; V],
    /// Friction μ₂ per transmitted torque while the load drives the motor: 1 − η′ of the efficiency
    /// η′ of back-driving.
    pub backdriving: [R; V],
    /// The speed w below which friction fades, rad/s or m/s.
    pub width: Width<R>,
}

impl<R: Real, const V: usize> LoadFriction<R, V> {
    /// From the efficiencies 0 < η ≤ 1 of the gears while the motors drive, and η′ while the loads
    /// drive.
    ///
    /// ```
    /// use dynamics_core::effects::{LoadFriction, Width};
    /// let gears = LoadFriction::of_efficiency([0.8_f64], [0.75], Width::new(0.01));
    /// assert_eq!((gears.driving, gears.backdriving), ([0.25], [0.25]));
    /// ```
    pub fn of_efficiency(driving: [R; V], backdriving: [R; V], width: Width<R>) -> Self {
        Self {
            driving: driving.map(|efficiency| R::ONE / efficiency - R::ONE),
            backdriving: backdriving.map(|efficiency| R::ONE - efficiency),
            width,
        }
    }

    /// Friction of |k_m τ_m + k_e τ|, of the motor's torque τ_m and the torque τ of all else, with
    /// k_m < 1: the directional models of Duclusaud et al., whose external torque is −τ. With k_m =
    /// k_e it is their model M3.
    ///
    /// ```
    /// use dynamics_core::effects::{LoadFriction, Width};
    /// let gears = LoadFriction::of_motor_and_load([0.2_f64], [0.1], Width::new(0.01));
    /// let (load, motor) = (3.0, 3.0 * (1.0 + gears.driving[0]));
    /// assert!((motor - (load + 0.2 * motor + 0.1 * load)).abs() < 1e-14);
    /// ```
    pub fn of_motor_and_load(motor: [R; V], load: [R; V], width: Width<R>) -> Self {
        let sum = |joint| entry(&motor, joint) + entry(&load, joint);
        Self {
            driving: core::array::from_fn(|j| sum(j) / (R::ONE - entry(&motor, j))),
            backdriving: core::array::from_fn(|j| sum(j) / (R::ONE + entry(&motor, j))),
            width,
        }
    }

    /// Half of μ₁ + μ₂ and of μ₁ − μ₂.
    #[cfg_attr(optimised, inline(always))]
    fn halves(&self, joint: usize) -> (R, R) {
        let half = R::from_f64(0.5);
        let (ahead, back) = (entry(&self.driving, joint), entry(&self.backdriving, joint));
        (half * (ahead + back), half * (ahead - back))
    }

    /// a = m s and b = d s².
    #[cfg_attr(optimised, inline(always))]
    fn factors(&self, joint: usize, at: JointState<R>, add: &mut LoadFactors<R>) {
        let (even, odd) = self.halves(joint);
        let s = sign_beyond(self.width, at.qd);
        add.magnitude += even * s;
        add.torque += odd * (s * s);
    }

    /// Their derivatives m s′ and 2 d s s′.
    #[cfg_attr(optimised, inline(always))]
    fn slopes(&self, joint: usize, at: JointState<R>, add: &mut LoadFactors<R>) {
        let (even, odd) = self.halves(joint);
        let u = at.qd * self.width.inverse();
        let rise = self.width.inverse() * smooth_sign_slope(u);
        add.magnitude += even * rise;
        add.torque += (odd + odd) * (smooth_sign(u) * rise);
    }
}

/// [`LoadFriction::of_efficiency`] and [`LoadFriction::of_motor_and_load`] of numbers that the
/// compiler knows.
macro_rules! known_gears {
    ($r:ident, $of_efficiency:ident, $of_motor_and_load:ident) => {
        impl<const V: usize> LoadFriction<$r, V> {
            /// [`LoadFriction::of_efficiency`] of numbers that the compiler knows, for a scene in a
            /// `const` or `static`.
            ///
            /// ```
            /// use dynamics_core::effects::{LoadFriction, Width};
            #[doc = concat!("const WIDTH: Width<", stringify!($r), "> = Width::", stringify!($r), "(0.01);")]
            #[doc = concat!("const GEARS: LoadFriction<", stringify!($r), ", 1> = LoadFriction::",
                stringify!($of_efficiency), "([0.8], [0.75], WIDTH);")]
            /// assert_eq!(GEARS, LoadFriction::of_efficiency([0.8], [0.75], WIDTH));
            /// ```
            pub const fn $of_efficiency(
                mut driving: [$r; V],
                mut backdriving: [$r; V],
                width: Width<$r>,
            ) -> Self {
                let mut j = 0;
                while j < V {
                    driving[j] = 1.0 / driving[j] - 1.0;
                    backdriving[j] = 1.0 - backdriving[j];
                    j += 1;
                }
                Self {
                    driving,
                    backdriving,
                    width,
                }
            }

            /// [`LoadFriction::of_motor_and_load`] of numbers that the compiler knows, for a scene
            /// in a `const` or `static`.
            ///
            /// ```
            /// use dynamics_core::effects::{LoadFriction, Width};
            #[doc = concat!("const WIDTH: Width<", stringify!($r), "> = Width::", stringify!($r), "(0.01);")]
            #[doc = concat!("const GEARS: LoadFriction<", stringify!($r), ", 1> = LoadFriction::",
                stringify!($of_motor_and_load), "([0.2], [0.1], WIDTH);")]
            /// assert_eq!(GEARS, LoadFriction::of_motor_and_load([0.2], [0.1], WIDTH));
            /// ```
            pub const fn $of_motor_and_load(
                motor: [$r; V],
                load: [$r; V],
                width: Width<$r>,
            ) -> Self {
                let (mut driving, mut backdriving, mut j) = ([0.0; V], [0.0; V], 0);
                while j < V {
                    let sum = motor[j] + load[j];
                    driving[j] = sum / (1.0 - motor[j]);
                    backdriving[j] = sum / (1.0 + motor[j]);
                    j += 1;
                }
                Self {
                    driving,
                    backdriving,
                    width,
                }
            }
        }
    };
}

known_gears!(f32, of_efficiency_f32, of_motor_and_load_f32);
known_gears!(f64, of_efficiency_f64, of_motor_and_load_f64);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for LoadFriction<R, V> {
    const ONCE: Once = Once::of(Kind::LoadFriction);
    const LOAD_FRICTION: hook::LoadFriction<Self, R> =
        hook::LoadFriction::new(Self::factors, Self::slopes);
}
