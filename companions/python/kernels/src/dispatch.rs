//! From what is known at run time to the types of the library: the scene's terms become parameters
//! of a type.

use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use crate::algorithm::{Algorithm, Call, Done};
use crate::job::{Failure, Row, Rows};
use crate::scene::Terms;

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

/// Which scenes an algorithm distinguishes: those that have machine code of their own.
pub mod terms {
    use super::*;

    macro_rules! scenes {
        (@of $algorithm:ident $call:ident: $($pattern:pat => [$a:literal, $c:literal, $x:literal]),*) => {{
            let Terms { inertia, coriolis, extra } = $call.terms;
            let _ = (inertia, coriolis, extra);
            match (inertia, coriolis, extra) {
                $($pattern => go::<O, R, D, P, B, Q, V, $a, $c, $x>($algorithm, $call),)*
                #[allow(unreachable_patterns, reason = "the rows of some are all that there are")]
                _ => unreachable!("`fits` refuses these scenes"),
            }
        }};
        ($(#[$doc:meta])* $name:ident, fast { $($fast:tt)* }, any { $($any:tt)* }) => {
            $(#[$doc])*
            pub fn $name<O: Algorithm, R: Real, D, P, const B: usize, const Q: usize, const V: usize>(
                algorithm: &O,
                call: Call<'_, D, P, R, V>,
            ) -> Done
            where
                D: RobotModel<R, B, Q, V>,
                P: Rows<R>,
            {
                if const { O::FAST && D::SINGLE } {
                    scenes!(@of algorithm call: $($fast)*)
                } else {
                    scenes!(@of algorithm call: $($any)*)
                }
            }
        };
        ($(#[$doc:meta])* $name:ident { $($any:tt)* }) => {
            scenes! { $(#[$doc])* $name, fast { $($any)* }, any { $($any)* } }
        };
    }

    scenes! {
        /// Inverse dynamics: scenes without Inertia but with Coriolis, or the reverse, which few
        /// have, over any joints only. The code for any joints has effects at bodies in every scene:
        /// that saves copies.
        all,
        fast {
            (true, true, false) => [true, true, false],
            (true, true, true) => [true, true, true],
            (false, false, false) => [false, false, false],
            (false, false, true) => [false, false, true]
        },
        any {
            (true, true, _) => [true, true, true],
            (false, false, _) => [false, false, true],
            (true, false, _) => [true, false, true],
            (false, true, _) => [false, true, true]
        }
    }
    scenes! {
        /// Forward dynamics, which needs Inertia.
        moving,
        fast {
            (_, true, false) => [true, true, false],
            (_, true, true) => [true, true, true]
        },
        any {
            (_, true, _) => [true, true, true],
            (_, false, _) => [true, false, true]
        }
    }
    scenes! {
        /// The same by articulated bodies, with Coriolis.
        articulated,
        fast {
            (_, true, false) => [true, true, false],
            (_, true, true) => [true, true, true]
        },
        any { (_, true, _) => [true, true, true] }
    }
    scenes! {
        /// As [`moving`], with effects at bodies where there are any.
        estimated,
        fast { (_, true, _) => [true, true, true] },
        any { (_, true, _) => [true, true, true], (_, false, _) => [true, false, true] }
    }
    scenes! {
        /// Whether there are effects at bodies, where it pays.
        matrix,
        fast { (_, _, false) => [true, true, false], (_, _, true) => [true, true, true] },
        any { _ => [true, true, true] }
    }
    scenes! {
        /// None: effects at bodies act where there are any, which saves copies of algorithms.
        machine { _ => [true, true, true] }
    }
    /// As [`machine`], of an algorithm with rotors that spin.
    pub use machine as rigid;
    /// As [`machine`], of an algorithm for the smaller of the general models alone.
    pub use machine as bending;
    /// As [`rigid`], of an algorithm with forms for some kinds of robots.
    pub use machine as factored;
    /// As [`machine`], of an algorithm with forms for some kinds of robots.
    pub use machine as linked;
    scenes! {
        /// The algorithm has no terms.
        none { _ => [true, true, false] }
    }
    scenes! {
        /// [`all`] of blocks of states, without effects at bodies.
        blocks_all {
            (true, true, _) => [true, true, false], (false, false, _) => [false, false, false]
        }
    }
    /// [`moving`] and [`matrix`] of blocks of states, without effects at bodies.
    pub use none as blocks;
}
