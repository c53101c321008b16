//! Rotors as spinning bodies: what they do beyond [`Armature`](crate::effects::Armature)'s
//! diagonal.
//!
//! A rotor on the joint's axis z, mounted on the parent link, turns ρ times as fast as the joint.
//! With the parent it has the angular momentum that the parent's inertia counts; on top of it I ρ
//! q̇ z. Its rate of change, n = I ρ (q̈ z + q̇ ω × z), is a couple that the parent bears, and its
//! motor also turns the rotor with the parent: ρ I (ρ q̈ + z·α_λ) at the joint. Featherstone, RBDA
//! (2008), section 9.6; Chen, "The effects of gear reduction on robot dynamics" (1989).

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, hook};
use crate::scalar::Real;
use crate::state::entry;

/// The rotor of each joint's motor, as a body that spins on the parent link about the joint's axis.
///
/// The parent's own inertia counts the whole rotor, as if it were locked; so do data sheets that
/// give a link's mass with its motor. For joints of one degree of freedom (a slide's rotor spins
/// about its direction). Cost: 25 flops a joint. Matters at low ratios: relative to the diagonal
/// the coupling is 1/ρ. Part of dynamics, M and its factors, energies, momenta and the centre of
/// mass. The engine's articulated bodies do not have it:
///
/// ```compile_fail,E0080
/// use dynamics_core::effects::{Gravity, Inertia, GyroscopicRotors};
/// use dynamics_core::{Engine, robots::Ur5e, state::State};
/// let rotors = GyroscopicRotors { inertia: [1e-4_f32; 6], ratio: [5.0; 6] };
/// let _ = Engine::<Ur5e>::aba(&State::at([0.0; 6]), &[0.0; 6], &(Gravity::EARTH, Inertia, rotors));
/// // error: the engine's articulated bodies carry no rotors that spin as bodies; use `forward_dynamics`
/// ```
///
/// ```
/// use dynamics_core::effects::{Inertia, Armature, GyroscopicRotors};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let rotors = GyroscopicRotors { inertia: [1e-4_f64; 6], ratio: [5.0; 6] };
/// let diagonal = Armature([25e-4; 6]);
/// let mut state = State::at([0.0, -1.0, 1.0, 0.0, 0.0, 0.0]);
/// state.qdd[2] = 10.0; // the elbow starts: its rotor pushes back on the upper arm
/// let [full, less] = [Core::<Ur5e>::rnea(&state, &(Inertia, rotors)), Core::<Ur5e>::rnea(&state, &(Inertia, diagonal))];
/// assert!((full[1] - less[1] - 1e-4 * 5.0 * 10.0).abs() < 1e-14 && full[2] == less[2]);
/// ```
#[doc(alias = "rotor")]
#[doc(alias = "gyroscope")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroscopicRotors<R, const V: usize> {
    /// Moment of inertia I of each rotor about its axis, kg·m².
    pub inertia: [R; V],
    /// Ratio ρ of each gear, rad of the rotor per rad or m of the joint; negative for the opposite
    /// sense.
    pub ratio: [R; V],
}

impl<R: Real, const V: usize> GyroscopicRotors<R, V> {
    /// ρ I.
    #[cfg_attr(optimised, inline(always))]
    fn once(&self, joint: usize) -> R {
        entry(&self.inertia, joint) * entry(&self.ratio, joint)
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for GyroscopicRotors<R, V> {
    const ONCE: Once = Once::of(Kind::GyroscopicRotors);
    const ROTOR: hook::Rotor<Self, R> = hook::Rotor::coupling(|rotors, joint, coupling| {
        *coupling += rotors.once(joint);
    });

    #[cfg_attr(optimised, inline(always))]
    fn inertia(&self, joint: usize) -> Option<R> {
        Some(self.once(joint) * entry(&self.ratio, joint))
    }
}
