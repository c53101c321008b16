//! From what is known at run time to the types of the library: the scene's terms become parameters
//! of a type.

use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use crate::algorithm::{Algorithm, Call, Done, Terms};
use crate::job::{Failure, Row, Rows};
use crate::spec::Spec;

/// The terms that the effects of a scene have.
pub fn terms_of(effects: &[Spec]) -> Terms {
    let mut terms = Terms::default();
    for effect in effects {
        match effect {
            Spec::Inertia => terms.inertia = true,
            Spec::Coriolis => terms.coriolis = true,
            effect => terms.extra |= effect.is_extra(),
        }
    }
    terms
}

/// Computes the rows one after the other. One that has no result because an argument is not finite
/// marks itself.
fn go<
    O: Algorithm,
    R: Real,
    D: RobotModel<R, B, Q, V>,
    P: Rows<R>,
    const B: usize,
    const Q: usize,
    const V: usize,
    const A: bool,
    const C: bool,
    const X: bool,
>(
    algorithm: &O,
    call: Call<'_, D, P, R, V>,
) -> Done {
    for row in 0..call.rows.count() {
        let mut one = call.rows.at(row);
        let done =
            algorithm.row::<R, D, B, Q, V, A, C, X>(call.robot, call.counts, call.parts, &mut one);
        if let Err(problem) = done
            && !one.mark()
        {
            return Err(Failure { row, problem });
        }
    }
    Ok(())
}

/// Which scenes an algorithm distinguishes.
pub mod terms {
    use super::*;

    macro_rules! scenes {
        ($(#[$doc:meta])* $name:ident, $terms:ident => $($pattern:pat => [$a:literal, $c:literal, $x:literal]),*) => {
            $(#[$doc])*
            pub fn $name<O: Algorithm, R: Real, D, P, const B: usize, const Q: usize, const V: usize>(
                algorithm: &O,
                call: Call<'_, D, P, R, V>,
            ) -> Done
            where
                D: RobotModel<R, B, Q, V>,
                P: Rows<R>,
            {
                let Terms { inertia, coriolis, extra } = call.terms;
                let _ = (inertia, coriolis, extra);
                match (inertia, coriolis, extra) {
                    $($pattern => go::<O, R, D, P, B, Q, V, $a, $c, $x>(algorithm, call)),*
                }
            }
        };
    }

    scenes! {
        /// A variant of the machine code exists for each set of terms.
        all, terms =>
        (true, true, false) => [true, true, false],
        (true, false, false) => [true, false, false],
        (false, true, false) => [false, true, false],
        (false, false, false) => [false, false, false],
        (true, true, true) => [true, true, true],
        (true, false, true) => [true, false, true],
        (false, true, true) => [false, true, true],
        (false, false, true) => [false, false, true]
    }
    scenes! {
        /// Those with the products of accelerations, which the algorithm needs.
        moving, terms =>
        (_, true, false) => [true, true, false],
        (_, false, false) => [true, false, false],
        (_, true, true) => [true, true, true],
        (_, false, true) => [true, false, true]
    }
    scenes! {
        /// Whether there are effects at bodies.
        rigid, terms =>
        (_, _, false) => [true, true, false],
        (_, _, true) => [true, true, true]
    }
    /// As [`all`], of an algorithm without.
    pub use all as all_slow;
    /// As [`moving`], of an algorithm without.
    pub use moving as moved;
    scenes! {
        /// All without effects at bodies.
        rigid_all, terms =>
        (true, true, _) => [true, true, false],
        (true, false, _) => [true, false, false],
        (false, true, _) => [false, true, false],
        (false, false, _) => [false, false, false]
    }
    scenes! {
        /// Those with the products of accelerations and without effects at bodies.
        rigid_moving, terms =>
        (_, true, _) => [true, true, false],
        (_, false, _) => [true, false, false]
    }
    scenes! {
        /// The terms do not matter, and there are no effects at bodies.
        rigid_one, terms =>
        _ => [true, true, false]
    }
    /// As [`machine`], of an algorithm with forms for some kinds of robots.
    pub use machine as linked;
    /// As [`rigid`], of an algorithm without rotors that spin.
    pub use rigid as unspun;
    /// As [`rigid`], of an algorithm with forms for some kinds of robots.
    pub use rigid as matrix;

    scenes! {
        /// None: effects at bodies act where there are any, which saves copies of large algorithms.
        machine, terms =>
        _ => [true, true, true]
    }
    scenes! {
        /// One variant of the machine code exists, since the algorithm has no terms.
        none, terms =>
        _ => [true, true, false]
    }
}
