//! A robot near a state as a linear system, in continuous time and over a tick.
//!
//! Åström & Wittenmark, *Computer-Controlled Systems* (1997), section 3.2: the hold of order zero.

use super::AccelerationGradient;
use crate::algorithms::solve;
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::entry;

/// The linear system of small deviations δq, δq̇ of V coordinates from a state, under U inputs δu.
///
/// ```text
/// d/dt [δq; δq̇] = [0 1; ∂q̈/∂q ∂q̈/∂q̇] [δq; δq̇] + [0; ∂q̈/∂u] δu
/// ```
///
/// A spherical, planar or free joint is at rest in this state: δq̇ is the rate of δq only then.
///
/// That of a robot with a motor at each coordinate is made from the derivatives of forward
/// dynamics, here of an arm that hangs still under the torques that carry it:
///
/// ```
/// use dynamics_core::algorithms::{Linearisation, forward_dynamics_derivatives, rnea};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]);
/// let holding = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
/// let by = forward_dynamics_derivatives(&Ur5e::MODEL, &state, &holding, &RIGID_BODY)?;
/// let arm = Linearisation::new(&Ur5e::MODEL, &by);
/// // 1 N·m more at the base for a tick of 2 ms turns it by δq̈ h² / 2.
/// let [dq, _] = arm.after(&[[0.0; 6]; 2], &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 2e-3);
/// assert!((dq[0] / (0.5 * arm.du[0][0] * 4e-6) - 1.0).abs() < 1e-3);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[doc(alias = "state-space model")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearisation<R, const V: usize, const U: usize = V> {
    /// ∂q̈/∂q, 1/s² between revolute joints.
    pub dq: [[R; V]; V],
    /// ∂q̈/∂q̇, 1/s between revolute joints.
    pub dqd: [[R; V]; V],
    /// ∂q̈/∂u, by rows of q̈: 1/(kg·m²) of a torque.
    pub du: [[R; U]; V],
}

impl<R: Real, const V: usize> Linearisation<R, V> {
    /// The system of a robot with a motor at each coordinate: ∂q̈/∂u = M⁻¹. With fewer motors, such
    /// as on a free base, [`driven_at`](Self::driven_at) keeps their columns.
    pub fn new<D, const B: usize, const Q: usize>(
        robot: &D,
        by: &AccelerationGradient<R, V>,
    ) -> Self
    where
        D: RobotModel<R, B, Q, V>,
    {
        let unit = |k| core::array::from_fn(|j| if j == k { R::ONE } else { R::ZERO });
        // M⁻¹ is symmetric: its rows are its columns.
        let du = core::array::from_fn(|k| solve(robot, &by.factors, &unit(k)));
        Self { dq: by.dq, dqd: by.dqd, du }
    }

    /// The system with motors at these coordinates alone; a number that is none of the robot moves
    /// nothing.
    pub fn driven_at<const U: usize>(&self, motors: [usize; U]) -> Linearisation<R, V, U> {
        let Self { dq, dqd, du } = *self;
        Linearisation { dq, dqd, du: du.map(|row| motors.map(|motor| entry(&row, motor))) }
    }
}

impl<R: Real, const V: usize, const U: usize> Linearisation<R, V, U> {
    /// The system under the feedback δu = δw − K_q δq − K_q̇ δq̇, with δw as its input: A − B K.
    ///
    /// The gains are rows of δu, N·m/rad and N·m·s/rad of torques between revolute joints; those of
    /// PD at each joint are diagonal. The feedback is continuous: over a tick in which the torque is
    /// held, [`after`](Self::after) of the robot alone takes δu.
    ///
    /// ```
    /// use dynamics_core::algorithms::{Linearisation, forward_dynamics_derivatives, rnea};
    /// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
    /// let state = State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]);
    /// let holding = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
    /// let by = forward_dynamics_derivatives(&Ur5e::MODEL, &state, &holding, &RIGID_BODY)?;
    /// let arm = Linearisation::new(&Ur5e::MODEL, &by);
    /// // PD of the shoulder alone, which is off by 1 mrad: it comes back.
    /// let [mut kp, mut kd] = [[[0.0; 6]; 6]; 2];
    /// (kp[1][1], kd[1][1]) = (500.0, 20.0); // N·m/rad and N·m·s/rad
    /// let held = arm.controlled(&kp, &kd);
    /// let off = [[0.0, 1e-3, 0.0, 0.0, 0.0, 0.0], [0.0; 6]];
    /// let [alone, back] = [arm, held].map(|system| system.after(&off, &[0.0; 6], 2e-3)[1][1]);
    /// assert!(back < alone && back < 0.0);
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    #[doc(alias = "closed loop")]
    pub fn controlled(&self, by_q: &[[R; V]; U], by_qd: &[[R; V]; U]) -> Self {
        let Self { mut dq, mut dqd, du } = *self;
        for (rows, gains) in [(&mut dq, by_q), (&mut dqd, by_qd)] {
            for (row, of_inputs) in rows.iter_mut().zip(&du) {
                for (gains, &of_input) in gains.iter().zip(of_inputs) {
                    for (entry, &gain) in row.iter_mut().zip(gains) {
                        *entry -= of_input * gain;
                    }
                }
            }
        }
        Self { dq, dqd, du }
    }

    /// [δq̇; δq̈] of [δq; δq̇] under δu.
    pub fn rates(&self, [q, qd]: &[[R; V]; 2], u: &[R; U]) -> [[R; V]; 2] {
        let qdd = core::array::from_fn(|i| {
            let terms = (self.dq.get(i).zip(self.dqd.get(i))).zip(self.du.get(i));
            terms.map_or(R::ZERO, |((dq, dqd), du)| dot(dq, q) + dot(dqd, qd) + dot(du, u))
        });
        [*qd, qdd]
    }

    /// [δq; δq̇] after a tick of h seconds in which δu is held: exact but for rounding.
    ///
    /// The columns of the system in discrete time, δx⁺ = Φ δx + Γ δu, are those of unit vectors.
    ///
    /// ```text
    /// δx⁺ = δx + Σ hᵏ/k! Aᵏ⁻¹ (A δx + B δu)      k = 1, 2, …
    /// ```
    ///
    /// A tick that is long for the system, h ‖A‖ > 2, is the 2ˢ-th part of itself, doubled s times:
    /// Φ(2t) = Φ(t)², and the motion from rest under δu is γ(2t) = Φ(t) γ(t) + γ(t) (Moler &
    /// Van Loan 2003, method 3). ‖A‖ is that of A in a unit of time in which its blocks are alike,
    /// √‖∂q̈/∂q‖ + ‖∂q̈/∂q̇‖ by sums of rows. Numbers that are not finite stay so.
    ///
    /// # Cost
    /// 2 V (2 V + U) flops, and 4 V² for each further term, of which there are 24; in a long tick
    /// these for each of 2 V + 1 columns, and 16 V³ flops for each doubling.
    pub fn after(&self, state: &[[R; V]; 2], u: &[R; U], h: R) -> [[R; V]; 2] {
        let norm = |rows: &[[R; V]; V]| {
            let sums = rows.iter().map(|row| row.iter().fold(R::ZERO, |sum, x| sum + x.abs()));
            sums.fold(R::ZERO, |most, sum| if sum > most { sum } else { most })
        };
        let mut size = h.abs() * (norm(&self.dq).sqrt() + norm(&self.dqd));
        let (of, mut part, mut doublings) = (R::from_f64, h, 0);
        while size > of(2.0) && size.is_finite() {
            (size, part, doublings) = (size * of(0.5), part * of(0.5), doublings + 1);
        }
        if doublings == 0 {
            return self.series(state, u, h);
        }
        // The columns of Φ by unit vectors, δq first; each column has the rows of δq and of δq̇.
        let unit = |block: usize, j: usize| {
            let mut x = [[R::ZERO; V]; 2];
            if let Some(entry) = x.get_mut(block).and_then(|rows| rows.get_mut(j)) {
                *entry = R::ONE;
            }
            x
        };
        let column = |block, j| self.series(&unit(block, j), &[R::ZERO; U], part);
        let mut phi: [[[[R; V]; 2]; V]; 2] =
            core::array::from_fn(|block| core::array::from_fn(|j| column(block, j)));
        let mut driven = self.series(&[[R::ZERO; V]; 2], u, part);
        for _ in 0..doublings {
            driven = sum(&product(&phi, &driven), &driven);
            phi = phi.map(|columns| columns.map(|column| product(&phi, &column)));
        }
        sum(&product(&phi, state), &driven)
    }

    /// The sum of 24 terms, which are enough while h ‖A‖ is at most 2.
    fn series(&self, state: &[[R; V]; 2], u: &[R; U], h: R) -> [[R; V]; 2] {
        let (mut end, still) = (*state, [R::ZERO; U]);
        let mut term = scaled(self.rates(state, u), h);
        for k in 2..26 {
            end = sum(&end, &term);
            term = scaled(self.rates(&term, &still), h / R::from_f64(f64::from(k)));
        }
        end
    }
}

/// Φ x, of a matrix by columns.
fn product<R: Real, const V: usize>(phi: &[[[[R; V]; 2]; V]; 2], x: &[[R; V]; 2]) -> [[R; V]; 2] {
    let columns = phi.iter().flatten().zip(x.iter().flatten());
    columns.fold([[R::ZERO; V]; 2], |end, (column, &x)| sum(&end, &scaled(*column, x)))
}

fn sum<R: Real, const V: usize>(x: &[[R; V]; 2], y: &[[R; V]; 2]) -> [[R; V]; 2] {
    let mut sums = *x;
    for (sum, &y) in sums.iter_mut().flatten().zip(y.iter().flatten()) {
        *sum += y;
    }
    sums
}

fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    a.iter().zip(b).fold(R::ZERO, |sum, (&a, &b)| sum + a * b)
}

fn scaled<R: Real, const V: usize>(x: [[R; V]; 2], by: R) -> [[R; V]; 2] {
    x.map(|x| x.map(|x| x * by))
}
