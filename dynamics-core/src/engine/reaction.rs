//! The wrenches in joints, beside inverse dynamics.
//!
//! Regrouping to base parameters leaves τ as it is, and not the forces within the robot. The wrench
//! in the joint of a body is that of the inertia beyond it in the field of its joint, with what the
//! joints beyond return: each of these has passed constant parameters, which [`Cut`] adds again.
//! Where all that moves with a joint is beyond the cut, the parameters that the joint passed are
//! added to its own total: behind a revolute joint they are a mass, h_z and Σ_zz.

use core::marker::PhantomData;

use super::acceleration_field::{AccelerationField, Inertia, Wrench};
use super::call::Call;
use super::compile::{Compiled, Cut, Distribution, JointPair};
use super::folding::{Folded, Mat3, Sym3, Vec3};
use crate::effects::{Declared, Effect};
use crate::model::{Bodies, JointCoordinate};
use crate::scalar::Real;
use crate::spatial::Force;

/// The wrenches that a recursion keeps: none, or those in the joints of a list of bodies.
pub(crate) trait Reactions<R: Real, T: Compiled> {
    /// The bodies.
    const BODIES: &'static [usize] = &[];
    /// Whether there are some. A recursion without them makes no call of this trait: an empty one
    /// that takes references makes the compiler order its products otherwise.
    const KEEPS: bool = !Self::BODIES.is_empty();
    /// The sum over the joints that each body carries.
    type Sums;
    /// The sums over none.
    const NOTHING: Self::Sums;

    /// Adds what joint J returns.
    fn add<const J: usize>(sums: &mut Self::Sums, returned: &Wrench<R>);

    /// Keeps the wrenches of the bodies that move with joint I, which carries `total`, in axes that
    /// `turn` is still to turn.
    fn keep<E, const I: usize, const B: usize, const Q: usize, const V: usize>(
        &mut self,
        call: Call<'_, R, T, E, B, Q, V>,
        field: &AccelerationField<R>,
        total: &Wrench<R>,
        sums: &Self::Sums,
        turn: Option<JointCoordinate<R>>,
    ) where
        E: Effect<R, B, V>;
}

impl<R: Real, T: Compiled> Reactions<R, T> for () {
    type Sums = ();
    const NOTHING: () = ();

    #[cfg_attr(optimised, inline(always))]
    fn add<const J: usize>((): &mut (), _: &Wrench<R>) {}

    #[cfg_attr(optimised, inline(always))]
    fn keep<E, const I: usize, const B: usize, const Q: usize, const V: usize>(
        &mut self,
        _: Call<'_, R, T, E, B, Q, V>,
        _: &AccelerationField<R>,
        _: &Wrench<R>,
        (): &(),
        _: Option<JointCoordinate<R>>,
    ) where
        E: Effect<R, B, V>,
    {
    }
}

/// The wrenches of a list of N bodies, each in its body's own frame.
pub(crate) struct Wrenches<R: Real, List, const N: usize>(
    pub(super) [Force<R>; N],
    pub(super) PhantomData<List>,
);

impl<R: Real, T: Compiled, List: Bodies<N>, const N: usize> Reactions<R, T>
    for &mut Wrenches<R, List, N>
{
    const BODIES: &'static [usize] = &List::NUMBERS;
    type Sums = [Wrench<R>; N];
    const NOTHING: Self::Sums = [Wrench::ZERO; N];

    #[cfg_attr(optimised, inline(always))]
    fn add<const J: usize>(sums: &mut Self::Sums, returned: &Wrench<R>) {
        for_each_joint!(K, {
            if Cut::<T, List, N, J, K>::CARRIES_JOINT {
                sums[K] = sums[K] + *returned;
            }
        });
    }

    #[cfg_attr(optimised, inline(always))]
    fn keep<E, const I: usize, const B: usize, const Q: usize, const V: usize>(
        &mut self,
        call: Call<'_, R, T, E, B, Q, V>,
        field: &AccelerationField<R>,
        total: &Wrench<R>,
        sums: &Self::Sums,
        turn: Option<JointCoordinate<R>>,
    ) where
        E: Effect<R, B, V>,
    {
        for_each_joint!(
            K,
            Cut::<T, List, N, I, K>::IS_ON_JOINT,
            beyond = Call::beyond::<List, N, I, K> as fn(_, &_, &_, &_, _) -> _,
            {
                self.0[K] = beyond(call, field, total, &sums[K], turn);
            }
        );
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The wrench in the joint of the K-th body of the list, which moves with joint I: `total` is
    /// that of the joint over base parameters, `carried` that of the joints on the body.
    #[cfg_attr(optimised, inline(always))]
    fn beyond<List: Bodies<N>, const N: usize, const I: usize, const K: usize>(
        self,
        field: &AccelerationField<R>,
        total: &Wrench<R>,
        carried: &Wrench<R>,
        turn: Option<JointCoordinate<R>>,
    ) -> Force<R> {
        let place = Cut::<T, List, N, I, K>::PLACE;
        let (p, length_inv) = (Vec3::constant(place.pos), Folded::constant(T::LENGTH_INV));
        let wrench = if Cut::<T, List, N, I, K>::IS_WHOLE {
            let Inertia { mass, moment, .. } = constant(Cut::<T, List, N, I, K>::PASSED);
            let (mass, moment) = (mass * length_inv, moment.scale(length_inv));
            let passed = field.wrench(&Inertia { mass, moment, second: Sym3::ZERO });
            let about = field.wrench(&constant(Cut::<T, List, N, I, K>::PASSED_ABOUT_BODY));
            let n = total.n - p.cross(total.f) + about.n;
            Wrench { f: total.f.scale(length_inv) + passed.f, n }
        } else {
            let mut inertia = constant(Cut::<T, List, N, I, K>::CARRIED);
            let mut sum = *carried;
            for_each_joint!(M, {
                if JointPair::<T, I, M>::HAS_BODY {
                    let (body, place) = JointPair::<T, I, M>::BODY;
                    if Cut::<T, List, N, I, K>::is_beyond(*body) {
                        if E::PAYLOAD[*body] {
                            inertia = self.with_load(*body, place, inertia);
                        }
                        if E::WRENCH {
                            let fx = self.exerted(*body, place, field);
                            sum = Wrench { f: sum.f - fx.f, n: sum.n - fx.n };
                        }
                    }
                }
            });
            let all = sum + field.wrench(&inertia);
            Wrench { f: all.f.scale(length_inv), n: all.n - p.cross(all.f) }
        };
        let rot = Mat3::constant(&place.rot);
        let (f, n) = (turned(wrench.f, turn), turned(wrench.n, turn));
        Force::new(rot.transpose_mul(n).get(), rot.transpose_mul(f).get())
    }
}

/// A vector in the axes of a body that this turn is still to turn, if any.
#[cfg_attr(optimised, inline(always))]
fn turned<R: Real>(v: Vec3<R>, turn: Option<JointCoordinate<R>>) -> Vec3<R> {
    match turn {
        Some(turn) => v.turn_back(Folded::runtime(turn.sin), Folded::runtime(turn.cos)),
        None => v,
    }
}

/// Parameters that are known while compiling.
#[cfg_attr(optimised, inline(always))]
fn constant<R: Real>(of: &Distribution) -> Inertia<R> {
    Inertia {
        mass: Folded::constant(of.mass),
        moment: Vec3::constant(of.moment),
        second: Sym3::of(&Mat3::constant(&of.second)),
    }
}
