//! Effects of which a scene contains at most one.

/// The kinds of effect of which two in one scene cannot mean two things.
///
/// | effect | two of it in a scene |
/// |---|---|
/// | [`Gravity`](super::Gravity), [`GravityVector`](super::GravityVector), own fields of gravity | refused, of one type or of two: the sum of both fields would act |
/// | [`Inertia`](super::Inertia), [`Coriolis`](super::Coriolis), [`Elasticity`](super::Elasticity) | refused: a term of the equations of motion is there or not, and the second would change nothing |
/// | [`MovingBase`](super::MovingBase) | refused: a base has one motion |
/// | [`Viscous`](super::Viscous), [`Coulomb`](super::Coulomb), [`AsymmetricCoulomb`](super::AsymmetricCoulomb), [`Stribeck`](super::Stribeck), [`LoadFriction`](super::LoadFriction) | refused: the second is usually forgotten, such as one beside a robot's own scene, and doubles the friction |
/// | [`Lugre`](super::Lugre), [`PreslidingLoadFriction`](super::PreslidingLoadFriction) | refused: a joint has one set of bristles, and its gear one direction |
/// | [`Armature`](super::Armature), [`GyroscopicRotors`](super::GyroscopicRotors) | refused: a joint has one inertia of its drive, that of all its rotors |
/// | [`BaseParameters`](super::BaseParameters) | refused: the engine reads one set |
/// | [`Payload`](super::Payload) | add up: a tool and what it holds, on one body or on several |
/// | [`BodyWrench`](super::BodyWrench), [`WorldWrench`](super::WorldWrench), [`Contact`](super::Contact) | add up: several forces, several surfaces |
/// | [`Spring`](super::Spring), [`EndStops`](super::EndStops), [`Cogging`](super::Cogging), [`ConstantTorque`](super::ConstantTorque) | add up: springs of different rest positions, a bumper in front of a stop, the slots of a motor and the teeth of its gear |
/// | different kinds of friction | add up: each has its own term |
/// | your own | add up: how often they may occur is for you to decide |
///
/// If two of a kind are meant, as in two fits of Stribeck's curve, an effect of one's own calls
/// both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Once {
    named: u32,
    twice: u32,
}

/// One bit each.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    Inertia,
    Coriolis,
    Elasticity,
    MovingBase,
    Viscous,
    Coulomb,
    AsymmetricCoulomb,
    Stribeck,
    Lugre,
    LoadFriction,
    PreslidingLoadFriction,
    Armature,
    GyroscopicRotors,
}

impl Once {
    /// An effect of which a scene may contain any number.
    pub const NONE: Self = Self { named: 0, twice: 0 };

    pub(crate) const fn of(kind: Kind) -> Self {
        Self { named: 1 << kind as u32, twice: 0 }
    }

    /// Those of a forwarder.
    #[doc(hidden)]
    pub const fn forwarded(on: bool, inner: &[Self]) -> Self {
        let (mut all, mut i) = (Self::NONE, 0);
        while on && i < inner.len() {
            all.twice |= inner[i].twice | (all.named & inner[i].named);
            all.named |= inner[i].named;
            i += 1;
        }
        all
    }

    /// The mistake in a scene that contains one of them twice, and its remedy.
    pub(crate) const fn problem(self) -> Option<&'static str> {
        if self.twice == 0 {
            return None;
        }
        Some(TEXTS[self.twice.trailing_zeros() as usize])
    }
}

/// In the order of [`Kind`].
const TEXTS: [&str; 13] = [
    "the scene contains Inertia twice, which changes nothing: leave one out (RIGID_BODY contains \
     it)",
    "the scene contains Coriolis twice, which changes nothing: leave one out (RIGID_BODY contains \
     it)",
    "the scene contains Elasticity twice, which changes nothing: leave one out",
    "the scene contains MovingBase twice, but the base has one motion: write one MovingBase with \
     the sums of the velocities and of the accelerations",
    "the scene contains Viscous twice, whose torques would add: write one Viscous([..]) with the \
     sums of the coefficients",
    "the scene contains Coulomb twice, whose torques would add: write one Coulomb { .. } with the \
     sums of the torques",
    "the scene contains AsymmetricCoulomb twice, whose torques would add: write one \
     AsymmetricCoulomb { .. } with the sums of the torques",
    "the scene contains Stribeck twice, whose torques would add: write one Stribeck { .. } with \
     the sums of the excesses",
    "the scene contains Lugre twice, but a joint has one set of bristles: write one Lugre { .. } \
     with the sums of the torques",
    "the scene contains LoadFriction twice, whose torques would add: write one LoadFriction { .. } \
     with the sums of the factors",
    "the scene contains PreslidingLoadFriction twice, but a gear has one direction: write one \
     PreslidingLoadFriction { .. } with the sums of the factors",
    "the scene contains Armature twice, whose inertias would add: write one Armature([..]) with \
     the sums of the inertias",
    "the scene contains GyroscopicRotors twice, whose inertias would add: write one \
     GyroscopicRotors { .. } with the sums of the inertias",
];
