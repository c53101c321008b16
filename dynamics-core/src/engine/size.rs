//! What the pivots of forward dynamics are held against: the largest inertia that each joint could move.
//!
//! As in [`crate::algorithms`], m, |h| and ∫ r² dm of all that a joint carries, as if it stood in one line away from
//! it. Turns do not change them, so that they are constants of the robot; slides and a payload add to them.

use super::prepare::Prepared;
use crate::effects::Effect;
use crate::model::{BASE, JointKind, Model, Robot, Turn};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::SpatialInertia;
use glam::DVec3;

/// How many roundings of it a pivot must exceed: up to 3.1 were seen of articulated bodies and 12 of LᵀDL where M is
/// singular, and no fewer than 51 where it is regular (a rope of ten light rods with a weight at its end, in f32).
const ROUNDINGS: f64 = 16.0;

/// Mass, kg, largest first moment, kg·m, and largest ∫ r² dm, kg·m², of what a joint carries, about its origin.
#[derive(Clone, Copy)]
struct Size {
    mass: f64,
    moment: f64,
    second: f64,
    /// The longest way to the origin of the last body, m, if the joint carries it.
    tip: f64,
}

const NOTHING: Size = Size {
    mass: 0.0,
    moment: 0.0,
    second: 0.0,
    tip: 0.0,
};

/// Carries the constants of a robot.
struct Sizes<T, const B: usize, const Q: usize, const V: usize>(core::marker::PhantomData<T>);

impl<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize> Sizes<T, B, Q, V> {
    const ALL: [Size; V] = sizes(&T::MODEL);

    /// That of joint `i`; beyond the last one something harmless.
    const fn of(i: usize) -> Size {
        if i < V { Self::ALL[i] } else { NOTHING }
    }
}

const fn sizes<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
) -> [Size; V] {
    let (mut bodies, mut joints) = ([NOTHING; B], [NOTHING; V]);
    // The body nearest to the base so far of those that lead to the last one.
    let (mut i, mut to_tip) = (B, B.saturating_sub(1));
    while i > 0 {
        i -= 1;
        let link = &model.links[i];
        let own = &link.inertia;
        let mut size = bodies[i];
        size.mass += own.mass;
        size.moment += length(own.moment);
        size.second += 0.5 * (own.inertia.x_axis.x + own.inertia.y_axis.y + own.inertia.z_axis.z);
        if !matches!(link.joint.kind, JointKind::Fixed) {
            joints[link.v_at] = size;
        }
        if link.parent != BASE {
            let (r, parent) = (length(link.placement.pos), &mut bodies[link.parent]);
            let moment = size.moment + r * size.mass;
            parent.mass += size.mass;
            parent.moment += moment;
            parent.second += size.second + r * (size.moment + moment);
            if i == to_tip {
                parent.tip = size.tip + r;
                to_tip = link.parent;
            }
        }
    }
    joints
}

const fn length(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// The pivots that rounding may leave of a singular M: of each joint, kg·m² or kg.
#[inline(always)]
pub(crate) fn noise<R, T, E, const B: usize, const Q: usize, const V: usize>(
    turns: &[Turn<R>; Q],
    effects: &E,
) -> [R; V]
where
    R: Real,
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let mut noise = [R::ZERO; V];
    for_each_joint!(J, {
        if const { J < V } {
            let size = of_joint::<R, T, E, B, Q, V, J>(turns, effects);
            noise[J] = size * (R::EPSILON * R::from_f64(ROUNDINGS));
        }
    });
    noise
}

/// The largest inertia that joint I could move: a constant of robots without slides and payload.
#[inline(always)]
fn of_joint<R, T, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    turns: &[Turn<R>; Q],
    effects: &E,
) -> R
where
    R: Real,
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let own = const { Sizes::<T, B, Q, V>::of(I) };
    let prismatic = const { Prepared::<T, B, Q, V>::joint(I).prismatic };
    let loaded = const {
        E::PAYLOAD && Prepared::<T, B, Q, V>::supports(I, Prepared::<T, B, Q, V>::last().joint)
    };
    let mut load = SpatialInertia::ZERO;
    if loaded {
        effects.payload(&mut load);
    }
    if prismatic {
        let mass = R::from_f64(own.mass);
        return if loaded { mass + load.mass } else { mass };
    }
    let (mut size, mut slides) = (R::from_f64(own.second), R::ZERO);
    for_each_joint!(K, {
        if const { Prepared::<T, B, Q, V>::above(I, K) && Prepared::<T, B, Q, V>::joint(K).prismatic }
        {
            slides += turns[K].q.abs();
        }
    });
    if const { slides_beyond::<T, B, Q, V>(I) } {
        size += slides * (R::from_f64(2.0 * own.moment) + slides * R::from_f64(own.mass));
    }
    if loaded {
        let [x, y, z] = load.inertia.cols().map(Vector::array);
        let [hx, hy, hz] = load.moment.array();
        let (moment, tip) = (
            hx.abs() + hy.abs() + hz.abs(),
            slides + R::from_f64(own.tip),
        );
        size += (x[0] + y[1] + z[2]) * R::from_f64(0.5);
        size += tip * (moment + moment + tip * load.mass);
    }
    size
}

/// Whether joint `i` carries a joint that slides.
const fn slides_beyond<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(
    i: usize,
) -> bool {
    let mut k = 0;
    while k < V {
        if Prepared::<T, B, Q, V>::above(i, k) && Prepared::<T, B, Q, V>::joint(k).prismatic {
            return true;
        }
        k += 1;
    }
    false
}
