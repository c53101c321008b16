//! Forwarding of effects, for tuples, for wrappers of this crate and for those of users.

use super::{BodyState, JointState, LoadFactors, RegroupedInertia};
use crate::scalar::Real;
use crate::spatial::{Force, Motion, SpatialInertia};

/// Calls the function of a hook, if it has one, directly: the `const` block names it while
/// compiling.
#[doc(hidden)]
#[macro_export]
macro_rules! call_hook {
    ($function:expr, $($argument:expr),*) => {
        if let Some(function) = const { $function } {
            function($($argument),*);
        }
    };
}

/// A function that is inlined where this crate is optimised. An exported macro cannot ask for the
/// cfg `optimised` itself: it would be that of the crate in which the macro is expanded.
#[cfg(optimised)]
#[doc(hidden)]
#[macro_export]
macro_rules! inlined {
    ($($function:tt)*) => {
        #[inline(always)]
        $($function)*
    };
}

/// A function that is inlined where this crate is optimised, which it is not.
#[cfg(not(optimised))]
#[doc(hidden)]
#[macro_export]
macro_rules! inlined {
    ($($function:tt)*) => { $($function)* };
}

/// The functions of a forwarder's hooks. `delegate_effect!` implements it. It has no default
/// bodies, so that no hook is omitted.
#[doc(hidden)]
pub trait Forwarder<R: Real, const B: usize, const V: usize> {
    fn forward_field(&self, g: &mut R::Vec3);
    fn forward_base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>);
    fn forward_wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>);
    fn forward_payload(&self, body: usize, inertia: &mut SpatialInertia<R>);
    fn forward_spin(&self, joint: usize, coupling: &mut R);
    fn forward_load(&self, joint: usize, at: JointState<R>, factors: &mut LoadFactors<R>);
    fn forward_load_slopes(&self, joint: usize, at: JointState<R>, slopes: &mut LoadFactors<R>);
    fn forward_regrouped(&self, joint: usize, body: &mut RegroupedInertia<R>);
}

/// The sum of the values that are present.
#[doc(hidden)]
#[cfg_attr(optimised, inline(always))]
pub fn sum<R: Real>(a: Option<R>, b: Option<R>) -> Option<R> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a + b),
        (a, None) => a,
        (None, b) => b,
    }
}

/// Implements [`Effect`](crate::effects::Effect) by forwarding every hook to other effects, in
/// their order: those of the type on the left of each arrow, found at the place on its right.
/// Bounds of the impl stand in `where [..]` after the type. With `, advance` their internal states
/// are advanced, too; without it, for effects that are borrowed or built for each call, they are
/// not. With `if` and a constant, nothing is forwarded if the constant is false.
///
/// ```
/// use dynamics_core::delegate_effect;
/// use dynamics_core::effects::{Effect, RIGID_BODY, Viscous};
/// use dynamics_core::{Core, robots::Ur5e, scalar::Real, state::State};
///
/// /// What a robot always has, and what a scene adds.
/// struct Cell<E> {
///     friction: Viscous<f32, 6>,
///     scene: E,
/// }
/// delegate_effect! {
///     impl[E: Effect<f32, B, 6>, const B: usize] Effect<f32, B, 6> for Cell<E>,
///     |this| { Viscous<f32, 6> => this.friction, E => this.scene }, advance
/// }
///
/// let cell = Cell { friction: Viscous([0.5; 6]), scene: RIGID_BODY };
/// let moving = State { qd: [1.0; 6], ..State::at([0.3; 6]) };
/// let direct = Core::<Ur5e>::rnea(&moving, &(Viscous([0.5; 6]), RIGID_BODY));
/// assert_eq!(Core::<Ur5e>::rnea(&moving, &cell), direct);
/// ```
#[macro_export]
macro_rules! delegate_effect {
    (
        impl[$($generics:tt)*] Effect<$R:ty, $B:tt, $V:tt> for $type:ty $(where [$($bounds:tt)*])?,
        |$this:ident| { $($inner:ty => $to:expr),* $(,)? } $(, $advance:ident)?
    ) => {
        $crate::delegate_effect! {
            @if [true, true, true, true]
            impl[$($generics)*] Effect<$R, $B, $V> for $type $(where [$($bounds)*])?,
            |$this| { $($inner => $to),* } $(, $advance)?
        }
    };
    (
        if $on:expr,
        impl[$($generics:tt)*] Effect<$R:ty, $B:tt, $V:tt> for $type:ty $(where [$($bounds:tt)*])?,
        |$this:ident| { $($inner:ty => $to:expr),* $(,)? } $(, $advance:ident)?
    ) => {
        $crate::delegate_effect! {
            @if [$on, true, true, true]
            impl[$($generics)*] Effect<$R, $B, $V> for $type $(where [$($bounds)*])?,
            |$this| { $($inner => $to),* } $(, $advance)?
        }
    };
    // All hooks, where `on` is true; those that go with q̈, where `accelerations` is true; those at
    // joints, where `joints` is; the derivatives of these, where `slopes` is.
    (
        @if [$on:expr, $accelerations:expr, $joints:expr, $slopes:expr]
        impl[$($generics:tt)*] Effect<$R:ty, $B:tt, $V:tt> for $type:ty $(where [$($bounds:tt)*])?,
        |$this:ident| { $($inner:ty => $to:expr),* } $(, $advance:ident)?
    ) => {
        impl<$($generics)*> $crate::effects::Effect<$R, $B, $V> for $type
        $(where $($bounds)*)?
        {
            const GRAVITY_FIELD: $crate::effects::hook::Field<Self, $R> = $crate::effects::hook::Field::NONE
                $(.with(&<$inner as $crate::effects::Effect<$R, $B, $V>>::GRAVITY_FIELD))*
                .through($on, <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_field);
            const BASE: $crate::effects::hook::Base<Self, $R> = $crate::effects::hook::Base::NONE
                $(.with(&<$inner as $crate::effects::Effect<$R, $B, $V>>::BASE))*
                .through($on, <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_base);
            const EXTERNAL_WRENCH: $crate::effects::hook::Wrench<Self, $R> = $crate::effects::hook::Wrench::NONE
                $(.with(&<$inner as $crate::effects::Effect<$R, $B, $V>>::EXTERNAL_WRENCH))*
                .through($on, <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_wrench);
            const ADDED_INERTIA: $crate::effects::hook::Inertia<Self, $R, $B> = $crate::effects::hook::Inertia::NONE
                $(.with(&<$inner as $crate::effects::Effect<$R, $B, $V>>::ADDED_INERTIA))*
                .through($on, <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_payload);
            const ROTOR: $crate::effects::hook::Rotor<Self, $R> = $crate::effects::hook::Rotor::NONE
                $(.with(&<$inner as $crate::effects::Effect<$R, $B, $V>>::ROTOR))*
                .through($on, <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_spin);
            const LOAD_FRICTION: $crate::effects::hook::LoadFriction<Self, $R> = $crate::effects::hook::LoadFriction::NONE
                $(.with(&<$inner as $crate::effects::Effect<$R, $B, $V>>::LOAD_FRICTION))*
                .through(
                    // It is no part of a bias: forward dynamics solves for it.
                    ($on) & ($accelerations) & ($joints),
                    <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_load,
                    <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_load_slopes,
                );
            const REGROUPED: $crate::effects::hook::Regrouped<Self, $R> = $crate::effects::hook::Regrouped::NONE
                $(.with(&<$inner as $crate::effects::Effect<$R, $B, $V>>::REGROUPED))*
                .through($on, <Self as $crate::effects::Forwarder<$R, $B, $V>>::forward_regrouped);
            const ACCELERATIONS: bool = ($on) & ($accelerations)
                & (false $(| <$inner as $crate::effects::Effect<$R, $B, $V>>::ACCELERATIONS)*);
            const VELOCITY_PRODUCTS: bool = ($on)
                & (false $(| <$inner as $crate::effects::Effect<$R, $B, $V>>::VELOCITY_PRODUCTS)*);
            const ELASTICITY: bool = ($on)
                & (false $(| <$inner as $crate::effects::Effect<$R, $B, $V>>::ELASTICITY)*);
            const DIFFERENTIABLE: bool = !(($on) & ($slopes))
                | (true $(& <$inner as $crate::effects::Declared<$R, $B, $V>>::HAS_DERIVATIVES)*);
            const ONCE: $crate::effects::Once = $crate::effects::Once::forwarded(
                $on,
                &[$(<$inner as $crate::effects::Effect<$R, $B, $V>>::ONCE),*],
            );

            $crate::inlined! {
                fn torque(&self, joint: usize, at: $crate::effects::JointState<$R>, tau: &mut $R) {
                    let $this = self;
                    if const { ($on) & ($joints) } {
                        $(<$inner as $crate::effects::Effect<$R, $B, $V>>::torque(&$to, joint, at, tau);)*
                    }
                }
            }

            $crate::inlined! {
                fn derivatives(
                    &self,
                    joint: usize,
                    at: $crate::effects::JointState<$R>,
                    derivatives: &mut $crate::effects::TorqueDerivatives<$R>,
                ) {
                    let $this = self;
                    if const { ($on) & ($joints) & ($slopes) } {
                        $(<$inner as $crate::effects::Effect<$R, $B, $V>>::derivatives(&$to, joint, at, derivatives);)*
                    }
                }
            }

            $crate::inlined! {
                fn slopes(
                    &self,
                    joint: usize,
                    at: $crate::effects::JointState<$R>,
                    slopes: &mut $crate::effects::TorqueDerivatives<$R>,
                ) {
                    let $this = self;
                    if const { ($on) & ($joints) & ($slopes) } {
                        $(<$inner as $crate::effects::Effect<$R, $B, $V>>::slopes(&$to, joint, at, slopes);)*
                    }
                }
            }

            $crate::inlined! {
                fn inertia(&self, joint: usize) -> Option<$R> {
                    let $this = self;
                    let sum = None;
                    if const { ($on) & ($accelerations) & ($joints) } {
                        $(let sum = $crate::effects::sum(
                            sum,
                            <$inner as $crate::effects::Effect<$R, $B, $V>>::inertia(&$to, joint),
                        );)*
                        return sum;
                    }
                    sum
                }
            }

            $crate::delegate_effect!(@advance [$($advance)?] $on, [$R, $B, $V] |$this| { $($inner => $to),* });
        }

        impl<$($generics)*> $crate::effects::Forwarder<$R, $B, $V> for $type
        $(where $($bounds)*)?
        {
            $crate::inlined! {
                fn forward_field(&self, g: &mut <$R as $crate::scalar::Real>::Vec3) {
                    let $this = self;
                    $($crate::call_hook!(<$inner as $crate::effects::Effect<$R, $B, $V>>::GRAVITY_FIELD.add, &$to, g);)*
                }
            }

            $crate::inlined! {
                fn forward_base(
                    &self,
                    velocity: &mut $crate::spatial::Motion<$R>,
                    acceleration: &mut $crate::spatial::Motion<$R>,
                ) {
                    let $this = self;
                    $($crate::call_hook!(<$inner as $crate::effects::Effect<$R, $B, $V>>::BASE.add, &$to, velocity, acceleration);)*
                }
            }

            $crate::inlined! {
                fn forward_wrench(
                    &self,
                    body: usize,
                    at: &$crate::effects::BodyState<$R>,
                    fx: &mut $crate::spatial::Force<$R>,
                ) {
                    let $this = self;
                    $($crate::effects::hook::add_wrench::<$R, $inner, $B, $V>(&$to, body, at, fx);)*
                }
            }

            $crate::inlined! {
                fn forward_payload(
                    &self,
                    body: usize,
                    inertia: &mut $crate::spatial::SpatialInertia<$R>,
                ) {
                    let $this = self;
                    $($crate::call_hook!(<$inner as $crate::effects::Effect<$R, $B, $V>>::ADDED_INERTIA.add, &$to, body, inertia);)*
                }
            }

            $crate::inlined! {
                fn forward_spin(&self, joint: usize, coupling: &mut $R) {
                    let $this = self;
                    $($crate::call_hook!(<$inner as $crate::effects::Effect<$R, $B, $V>>::ROTOR.add, &$to, joint, coupling);)*
                }
            }

            $crate::inlined! {
                fn forward_load(
                    &self,
                    joint: usize,
                    at: $crate::effects::JointState<$R>,
                    factors: &mut $crate::effects::LoadFactors<$R>,
                ) {
                    let $this = self;
                    $($crate::call_hook!(<$inner as $crate::effects::Effect<$R, $B, $V>>::LOAD_FRICTION.factors, &$to, joint, at, factors);)*
                }
            }

            $crate::inlined! {
                fn forward_load_slopes(
                    &self,
                    joint: usize,
                    at: $crate::effects::JointState<$R>,
                    slopes: &mut $crate::effects::LoadFactors<$R>,
                ) {
                    let $this = self;
                    $($crate::call_hook!(<$inner as $crate::effects::Effect<$R, $B, $V>>::LOAD_FRICTION.slopes, &$to, joint, at, slopes);)*
                }
            }

            $crate::inlined! {
                fn forward_regrouped(
                    &self,
                    joint: usize,
                    body: &mut $crate::effects::RegroupedInertia<$R>,
                ) {
                    let $this = self;
                    $($crate::call_hook!(<$inner as $crate::effects::Effect<$R, $B, $V>>::REGROUPED.load, &$to, joint, body);)*
                }
            }
        }
    };
    (@advance [] $on:expr, [$R:ty, $B:tt, $V:tt] |$this:ident| $rest:tt) => {};
    (@advance [advance] $on:expr, [$R:ty, $B:tt, $V:tt] |$this:ident| { $($inner:ty => $to:expr),* }) => {
        $crate::inlined! {
            fn advance(&mut self, joint: usize, at: $crate::effects::JointState<$R>, h: $R) {
                let $this = self;
                if const { $on } {
                    $(<$inner as $crate::effects::Effect<$R, $B, $V>>::advance(&mut $to, joint, at, h);)*
                }
            }
        }
    };
}

pub(crate) use {call_hook, delegate_effect};
