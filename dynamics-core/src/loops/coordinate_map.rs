//! The map from independent to all coordinates: q̇ = G ẏ, q̈ = G ÿ + ġ, and Gᵀ for torques.
//!
//! Featherstone, RBDA (2008), section 8.11. The independent coordinates are actuated ones: K is
//! eliminated with its pivots in the passive coordinates first.

use core::borrow::Borrow;

use super::Constraints;
use super::chain::LoopBodies;
use super::constraints::scaled;
use super::description::Loops;
use super::elimination::{Elimination, LoopRows, dot, subtract};
use super::error::LoopError;
use super::status::OPEN;
use crate::algorithms::{Damping, damped_inverse};
use crate::model::{JointCoordinate, RobotModel};
use crate::scalar::Real;
use crate::state::{Configuration, entry};

/// Whether the motion determines the torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Drive {
    /// As many actuated coordinates as degrees of freedom: it does.
    Determined,
    /// More of them: of all torques that give the motion, those with the least sum of squares.
    LeastNorm {
        /// The number of further ones.
        redundancy: usize,
    },
    /// It does not, or almost not: the configuration is at a dead point of the motors, or closer to
    /// one than [`Loops::damped_below`]. The passive coordinates are damped; torques are finite and
    /// bounded, and exact where the damping begins.
    Singular {
        /// The loop of the coordinate that is damped most.
        name: &'static str,
        /// The index of that coordinate in q̇.
        joint: usize,
    },
}

/// G of one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordinateMap<R, const V: usize, const C: usize, const A: usize> {
    elimination: Elimination<R, V, C>,
    /// One over the sizes of the loops.
    scale: [R; C],
    rows: LoopRows<C>,
    /// The loop and the coordinate that are damped most.
    singular: Option<(&'static str, usize)>,
    actuated: [usize; A],
    /// Which of the actuated coordinates are independent.
    independent: [bool; A],
}

/// The map G from the independent to all coordinates, q̇ = G ẏ, where the loops are closed.
///
/// # Shape
/// V × the number of degrees of freedom.
///
/// # Cost
/// The cost of [`constraints()`](super::constraints()), and 2 C (V + C) r flops for a rank r of K.
///
/// # Source
/// Featherstone, RBDA (2008), section 8.11.
///
/// # Example
/// ```
/// use dynamics_core::loops::{BodyFrame, LoopJoint, Loops, coordinate_map};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
/// const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// const TREE: ArmModel<f64, 3> = Model::new("slider_crank", [
///     Body::new("crank", BASE, Joint::revolute(Y)).mass(1.0).com([0.05, 0.0, 0.0]),
///     Body::new("rod", 0, Joint::revolute(Y)).xyz([0.1, 0.0, 0.0]).mass(1.0).com([0.15, 0.0, 0.0]),
///     Body::new("piston", BASE, Joint::prismatic([1.0, 0.0, 0.0])).xyz([0.4, 0.0, 0.0]).mass(0.5),
/// ]);
/// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [
///     LoopJoint::new("pin", Joint::revolute(Y), [
///         BodyFrame::new(2),
///         BodyFrame::new(1).xyz([0.3, 0.0, 0.0]),
///     ]),
/// ], [0]);
/// let map = coordinate_map(&TREE, &LOOPS, &[0.0_f64; 3])?;
/// assert_eq!(map.degrees_of_freedom(), 1);
/// assert!((map.velocity(&[3.0])[1] + 4.0).abs() < 1e-14); // the crank turns by 3 rad/s, the rod by −4
/// # Ok::<(), dynamics_core::loops::LoopError>(())
/// ```
///
/// # Errors
/// [`LoopError::Open`] names a loop that is open by more than [`OPEN`] of its size,
/// [`LoopError::UnderActuated`] one that still moves with all actuated coordinates held, and the
/// coordinate; [`LoopError::NotFinite`] the first loop of which a number is not finite. Near a dead
/// point of the motors there is a damped map: [`Drive::Singular`].
#[doc(alias = "explicit constraints")]
#[cfg_attr(optimised, inline(always))]
pub fn coordinate_map<
    R: Real,
    D,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    robot: &D,
    loops: &Loops<L, C, A>,
    q: &impl Configuration<R, Q>,
) -> Result<CoordinateMap<R, V, C, A>, LoopError>
where
    D: RobotModel<R, B, Q, V>,
{
    let trig = q.trig_of(robot);
    let mut closing = Constraints::blank();
    let turns = &trig.borrow().coordinates;
    let mut bodies = LoopBodies::blank();
    closing.set_positions(robot, loops, turns, &mut bodies);
    let mut map = CoordinateMap::blank(loops);
    map.set(robot, loops, (turns, &bodies), &closing)?;
    Ok(map)
}

impl<R: Real, const V: usize, const C: usize, const A: usize> CoordinateMap<R, V, C, A> {
    /// Nothing, to be filled where it stands: it is large.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn blank<const L: usize>(loops: &Loops<L, C, A>) -> Self {
        let elimination = Elimination::blank();
        Self {
            rows: elimination.loop_rows(),
            elimination,
            scale: [R::ONE; C],
            singular: None,
            actuated: loops.actuated,
            independent: [false; A],
        }
    }

    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<D, const B: usize, const Q: usize, const L: usize>(
        &mut self,
        robot: &D,
        loops: &Loops<L, C, A>,
        (turns, bodies): (&[JointCoordinate<R>; Q], &LoopBodies<R, B>),
        closing: &Constraints<R, V, L, C>,
    ) -> Result<(), LoopError>
    where
        D: RobotModel<R, B, Q, V>,
    {
        closing.check(loops)?;
        let (error, row) = closing.worst();
        if error > R::from_f64(OPEN) {
            let (name, error) = (loops.name_of_row(row), error.to_f64());
            return Err(LoopError::Open { name, error });
        }
        let passive = loops.passive();
        self.scale = closing.scale();
        let elimination = &mut self.elimination;
        elimination.eliminate(closing, loops, |joint| entry(&passive, joint), &self.scale);
        self.rows = elimination.loop_rows();
        for joint in elimination.free().filter(|&joint| entry(&passive, joint)) {
            let bias = |qd| {
                let mut moving = *closing;
                moving.set_rates(robot, loops, bodies, (turns, &qd));
                moving.scaled_bias()
            };
            if !elimination.is_isolated(&passive, joint, bias) {
                let name = closing.name_of(loops, joint);
                return Err(LoopError::UnderActuated { name, joint });
            }
        }
        let threshold = R::select(loops.threshold.0, loops.threshold.1);
        self.singular = if elimination.is_regular(&passive, threshold) {
            None
        } else {
            let joint = elimination.damp(&closing.scaled(), &passive, threshold);
            joint.map(|joint| (closing.name_of(loops, joint), joint))
        };
        for joint in elimination.free() {
            for (independent, &actuated) in self.independent.iter_mut().zip(&self.actuated) {
                *independent |= actuated == joint;
            }
        }
        Ok(())
    }

    /// The number of independent coordinates; of actuated ones where the map is damped.
    pub fn degrees_of_freedom(&self) -> usize {
        self.elimination.free().count()
    }

    /// The independent coordinates y, as indices in q̇.
    pub fn independent(&self) -> impl Iterator<Item = usize> {
        self.elimination.free()
    }

    /// Which rows of K are independent.
    pub fn rows(&self) -> LoopRows<C> {
        self.rows
    }

    /// Whether there are more actuated than independent coordinates, or the motors are near a dead
    /// point.
    pub fn drive(&self) -> Drive {
        if let Some((name, joint)) = self.singular {
            return Drive::Singular { name, joint };
        }
        match self.motors().saturating_sub(self.degrees_of_freedom()) {
            0 => Drive::Determined,
            redundancy => Drive::LeastNorm { redundancy },
        }
    }

    /// The number of actuated coordinates: of robots of run time fewer than A, which is then V
    /// at least.
    #[cfg_attr(optimised, inline(always))]
    fn motors(&self) -> usize {
        if const { A < V } {
            return A;
        }
        self.actuated.iter().filter(|joint| **joint < V).count()
    }

    /// q̇ = G ẏ from the rates of the actuated coordinates; of a redundantly driven robot the
    /// independent ones count.
    #[cfg_attr(optimised, inline(always))]
    pub fn velocity(&self, rates: &[R; A]) -> [R; V] {
        self.elimination.complete(&self.spread(rates))
    }

    /// q̈ = G ÿ + ġ from the accelerations of the actuated coordinates and the k of
    /// [`Constraints::bias`].
    #[cfg_attr(optimised, inline(always))]
    pub fn acceleration(&self, accelerations: &[R; A], bias: &[R; C]) -> [R; V] {
        let mut qdd = self.elimination.particular(&scaled(*bias, &self.scale));
        subtract(&mut qdd, -R::ONE, &self.velocity(accelerations));
        qdd
    }

    /// The torques of the actuated coordinates that do what torques of all coordinates would: Gᵀ
    /// τ_a = Gᵀ τ, N·m or N.
    ///
    /// Among several, that with the least sum of squares, in which an N counts as an N·m.
    #[cfg_attr(optimised, inline(always))]
    pub fn torque(&self, tau: &[R; V]) -> [R; A] {
        let mut wanted = [R::ZERO; A];
        for ((wanted, &joint), &independent) in
            wanted.iter_mut().zip(&self.actuated).zip(&self.independent)
        {
            if independent {
                *wanted = self.elimination.transposed(joint, tau);
            }
        }
        if !matches!(self.drive(), Drive::LeastNorm { .. }) {
            return wanted;
        }
        // G of the actuated coordinates; a unit in the place of each that is not independent keeps
        // Gᵀ G regular.
        let g = self.actuated.map(|joint| self.row(joint));
        let mut squares = [[R::ZERO; A]; A];
        for (i, (squares, &independent)) in squares.iter_mut().zip(&self.independent).enumerate() {
            for (j, square) in squares.iter_mut().enumerate() {
                *square = g.iter().fold(R::ZERO, |sum, row| sum + row[i] * row[j]);
            }
            if !independent {
                squares[i] = R::ONE;
            }
        }
        let (inverse, _) = damped_inverse(&squares, Damping::relative(R::ZERO));
        let weights = inverse.map(|row| dot(&row, &wanted));
        g.map(|row| dot(&row, &weights))
    }

    /// The λ that takes the place of the torques `rest` = τ − τ_a.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn lambda(&self, rest: &[R; V]) -> [R; C] {
        scaled(self.elimination.lambda(rest), &self.scale)
    }

    /// Numbers of the independent coordinates in their places of all coordinates.
    #[cfg_attr(optimised, inline(always))]
    fn spread(&self, of_actuated: &[R; A]) -> [R; V] {
        let mut all = [R::ZERO; V];
        let places = self.actuated.iter().zip(&self.independent);
        for ((&joint, &independent), &x) in places.zip(of_actuated) {
            if let (true, Some(place)) = (independent, all.get_mut(joint)) {
                *place = x;
            }
        }
        all
    }

    /// The row of G of one coordinate, in the places of the actuated ones.
    #[cfg_attr(optimised, inline(always))]
    fn row(&self, joint: usize) -> [R; A] {
        let mut g = [R::ZERO; A];
        if const { A >= V } && joint >= V {
            return g;
        }
        let pivot_row = self.elimination.row_of(joint);
        let places = self.actuated.iter().zip(&self.independent);
        for (g, (&of, &independent)) in g.iter_mut().zip(places) {
            if independent {
                let own = if of == joint { R::ONE } else { R::ZERO };
                *g = pivot_row.map_or(own, |row| -entry(row, of));
            }
        }
        g
    }
}
