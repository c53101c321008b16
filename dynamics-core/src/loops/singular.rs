//! Singular configurations of the motors: the passive columns of K, damped where they are nearly
//! dependent.
//!
//! The motors determine the passive coordinates by K_p q̇_p = k − K_a q̇_a. Near a dead point the
//! least singular value of K_p goes to zero, and q̇_p and the torques Gᵀ τ grow without bound.
//! Below a threshold ε the inverse of K_p is that of damped least squares (Wampler, 1986; Nakamura
//! & Hanafusa, 1986),
//!
//! W = (K_pᵀ K_p + λ² 1)⁻¹ K_pᵀ, λ² = ε² − ς², ς² = 1 / tr (K_pᵀ K_p)⁻¹,
//!
//! where ς, at most the least singular value, is the distance from the singularity. At ς = ε the
//! damping is zero. A singular value σ ≥ ς has the gain σ / (σ² + ε² − ς²) ≤ 1/ε, thus |W| ≤ 1/ε
//! everywhere. Only columns count: redundant rows do not make ς small.

use core::iter::once;

use super::description::{Loops, NONE};
use super::elimination::{Elimination, dot, subtract};
use super::thresholds::{RANK_TOLERANCE, thresholds};
use crate::algorithms::shifted_inverse;
use crate::scalar::Real;
use crate::state::entry;

impl<const L: usize, const C: usize, const A: usize> Loops<L, C, A> {
    /// These loops with another distance from a singular configuration of the motors below which
    /// the passive coordinates are damped, in place of [`SINGULAR`](super::SINGULAR).
    ///
    /// It bounds the torques: |τ_a| ≤ |τ_m| + √(2 L) / ε · |τ_p| of the tree's torques τ_m at the
    /// motors and τ_p at the passive coordinates. The distance is 1 / √(tr (K_pᵀ K_p)⁻¹) of the
    /// passive columns of K, rows relative to the sizes of their loops: at most the least singular
    /// value. With p passive coordinates the least threshold is √(C − p + 1) times
    /// [`RANK_TOLERANCE`]; a smaller one counts as that.
    ///
    /// ```
    /// use dynamics_core::effects::RIGID_BODY;
    /// use dynamics_core::loops::{self, BodyFrame, Drive, LoopJoint, Loops};
    /// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
    /// use dynamics_core::state::State;
    /// const Y: [f64; 3] = [0.0, 1.0, 0.0];
    /// const TREE: ArmModel<f64, 3> = Model::new("slider_crank", [
    ///     Body::new("crank", BASE, Joint::revolute(Y)).mass(1.0).com([0.05, 0.0, 0.0]),
    ///     Body::new("rod", 0, Joint::revolute(Y)).xyz([0.1, 0.0, 0.0]).mass(1.0).com([0.15, 0.0, 0.0]),
    ///     Body::new("piston", BASE, Joint::prismatic([1.0, 0.0, 0.0])).xyz([0.4, 0.0, 0.0]).mass(0.5),
    /// ]);
    /// const PIN: LoopJoint =
    ///     LoopJoint::new("pin", Joint::revolute(Y), [BodyFrame::new(2), BodyFrame::new(1).xyz([0.3, 0.0, 0.0])]);
    /// // The piston has the motor: with crank and rod in line it turns the crank in neither direction.
    /// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [PIN], [2]).damped_below(0.02);
    /// let dead = loops::inverse_dynamics(&TREE, &LOOPS, &State::at([0.0_f64; 3]), &RIGID_BODY)?;
    /// assert!(matches!(dead.drive, Drive::Singular { name: "pin", .. }));
    /// assert!(dead.tau[0].abs() < 1.0); // N
    /// # Ok::<(), loops::LoopError>(())
    /// ```
    ///
    /// # Panics
    /// If the threshold is not within 0 and 1.
    #[must_use]
    pub const fn damped_below(mut self, threshold: f64) -> Self {
        assert!(
            threshold >= 0.0 && threshold <= 1.0,
            "a threshold of damping is not within 0 and 1"
        );
        self.threshold = thresholds(threshold, self.constrained(), self.undriven);
        self
    }
}

impl<R: Real, const V: usize, const C: usize> Elimination<R, V, C> {
    /// Whether ς exceeds ε for certain: T K_p = 1, and no left inverse has a lesser sum of squares
    /// than K_p's, 1/ς².
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn is_regular(&self, passive: &[bool; V], threshold: R) -> bool {
        let mut squares = R::ZERO;
        for (transform, &column) in self.transform.iter().zip(&self.column_of) {
            if entry(passive, column) {
                squares += dot(transform, transform);
            }
        }
        let driven = self.free().all(|joint| !entry(passive, joint));
        driven && squares * (threshold * threshold) < R::ONE
    }

    /// The damped map of `rows` in place of the eliminated one, and the passive coordinate that is
    /// damped most; nothing changes where ς is at least ε.
    #[cold]
    #[inline(never)]
    pub(super) fn damp(
        &mut self,
        rows: &[[R; V]; C],
        passive: &[bool; V],
        threshold: R,
    ) -> Option<usize> {
        let mut squares = [[R::ZERO; V]; V];
        for row in rows {
            for ((sums, &x), &of) in squares.iter_mut().zip(row).zip(passive) {
                for ((sum, &y), &other) in sums.iter_mut().zip(row).zip(passive) {
                    *sum += if of && other { x * y } else { R::ZERO };
                }
            }
        }
        for (i, (row, &passive)) in squares.iter_mut().zip(passive).enumerate() {
            row[i] = if passive { row[i] } else { R::ONE };
        }
        let of_passive = |inverse: &[[R; V]; V], i: usize| match entry(passive, i) {
            true => inverse.get(i).map_or(R::ZERO, |row| entry(row, i)),
            false => R::ZERO,
        };
        let trace = shifted_inverse(&squares, R::ZERO)
            .map(|inverse| (0..V).fold(R::ZERO, |sum, i| sum + of_passive(&inverse, i)));
        let driven = self.free().all(|joint| !entry(passive, joint));
        // False of an infinite trace.
        let distance = match trace {
            Some(trace) if trace.is_finite() && trace > R::ZERO => R::ONE / trace,
            _ => R::ZERO,
        };
        let damping = threshold * threshold - distance;
        if driven && damping <= R::ZERO {
            return None;
        }
        let damping = if damping > R::ZERO { damping } else { R::ZERO };
        let inverse = shifted_inverse(&squares, damping).unwrap_or([[R::ZERO; V]; V]);
        self.replace(rows, passive, &inverse);
        let candidates = (0..V).filter(|&i| entry(passive, i));
        candidates.reduce(|most, i| {
            if of_passive(&inverse, i) > of_passive(&inverse, most) { i } else { most }
        })
    }

    /// W K in place of T K, a row for each passive coordinate, of (K_pᵀ K_p + λ² 1)⁻¹.
    fn replace(&mut self, rows: &[[R; V]; C], passive: &[bool; V], inverse: &[[R; V]; V]) {
        self.row_of = [NONE; V];
        self.column_of = [NONE; C];
        let joints = inverse.iter().enumerate().filter(|(i, _)| entry(passive, *i));
        let places = self.rows.iter_mut().zip(&mut self.transform);
        let mut places = places.zip(&mut self.column_of).enumerate();
        for ((joint, weights), (place, ((of_joint, transform), column))) in joints.zip(&mut places)
        {
            (*of_joint, *column) = ([R::ZERO; V], joint);
            for (w, row) in transform.iter_mut().zip(rows) {
                // The inverse is block diagonal: actuated columns have no weight.
                *w = dot(weights, row);
                subtract(of_joint, -*w, row);
            }
            for (i, (x, &passive)) in of_joint.iter_mut().zip(passive).enumerate() {
                if passive {
                    *x = if i == joint { R::ONE } else { R::ZERO };
                }
            }
            if let Some(row) = self.row_of.get_mut(joint) {
                *row = place;
            }
        }
        for (_, ((row, transform), _)) in places {
            (*row, *transform) = ([R::ZERO; V], [R::ZERO; C]);
        }
        self.find_free();
    }

    /// Whether the machine leaves the configuration at which `joint` moves with all motors held: a
    /// rate of K along one of the motions that the loops allow acts on that motion.
    ///
    /// `bias` is k of velocities, over the sizes of the loops. If no rate does, the joint moves
    /// on to the second order, and no motor holds it: Connelly & Whiteley, "Second-order rigidity
    /// and prestress stability for tensegrity frameworks" (1996).
    #[cold]
    #[inline(never)]
    pub(super) fn is_isolated(
        &self,
        passive: &[bool; V],
        joint: usize,
        bias: impl Fn([R; V]) -> [R; C],
    ) -> bool {
        let along = |free: usize| {
            let mut unit = [R::ZERO; V];
            if let Some(unit) = unit.get_mut(free) {
                *unit = R::ONE;
            }
            let motion = self.complete(&unit);
            let largest = motion
                .iter()
                .fold(R::ONE, |largest, x| if x.abs() > largest { x.abs() } else { largest });
            motion.map(|x| x * (R::ONE / largest))
        };
        let own = along(joint);
        let tolerance = R::select(RANK_TOLERANCE.0, RANK_TOLERANCE.1);
        once(joint).chain(self.free()).any(|free| {
            let mut rate = [R::ZERO; C];
            for sign in [R::ONE, -R::ONE] {
                let mut sum = own;
                subtract(&mut sum, -sign, &along(free));
                subtract(&mut rate, -sign, &bias(sum));
            }
            let rows = self.transform.iter().zip(&self.column_of);
            let mut undriven = rows.filter(|(_, column)| !entry(passive, **column));
            undriven.any(|(transform, _)| dot(transform, &rate).abs() > tolerance)
        })
    }
}
