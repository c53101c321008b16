//! The return onto a trajectory that was stopped during a fault.
//!
//! Two references that both have finite accelerations: one that comes to rest from the position and
//! velocity of the arm, a(t) with ȧ' = −λ ȧ, and the trajectory q(σ), whose time starts at zero
//! rate. With x the share of the return from 0 to 1 over T and w = x³ (10 − 15 x + 6 x²),
//!
//! ```text
//! r = a + w (q(σ) − a)        σ' = w
//! ```
//!
//! so that position, velocity and acceleration are those of a at the start and of q at the end.

use crate::estimate::Estimate;
use crate::limits::Circles;
use crate::real;
use crate::reference::Reference;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

#[cfg(test)]
mod tests;

/// A reference that leads from the state of the arm onto its stopped trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ResumeTrajectory<R, const V: usize> {
    tick: R,
    /// λ.
    decay: R,
    /// The ticks that the trajectory advances during the return.
    half: u32,
    /// 1 / λ in ticks.
    lead: u32,
    /// Share of the return in a tick, and share in a second.
    ticks_inv: R,
    seconds_inv: R,
    /// a.
    rest: State<R, V, V>,
    /// σ: whole ticks, and the fraction of the next one.
    clock: u32,
    advanced: u32,
    fraction: R,
    active: bool,
}

impl<R: Real, const V: usize> ResumeTrajectory<R, V> {
    /// A return that has not begun, in ticks of `tick` seconds: for an arm whose speed decays at
    /// the rate `decay`, 1/s, over an even number of `ticks`, to which an odd one is rounded up.
    pub(crate) fn new(tick: R, decay: R, ticks: u32) -> Self {
        let half = ticks.div_ceil(2).max(1);
        let ticks_inv = R::from_f64(0.5) / real(half);
        Self {
            tick,
            decay,
            half,
            // A value that is no number of ticks becomes none or very many: the end of the
            // trajectory.
            lead: (R::ONE / (decay * tick)).to_u32(),
            ticks_inv,
            seconds_inv: ticks_inv / tick,
            rest: State::at([R::ZERO; V]),
            clock: 0,
            advanced: 0,
            fraction: R::ZERO,
            active: false,
        }
    }

    /// The decay rate λ, 1/s.
    #[inline(always)]
    pub(crate) fn decay_rate(&self) -> R {
        self.decay
    }

    /// Whether a return has been started and not finished.
    #[inline(always)]
    pub(crate) fn active(&self) -> bool {
        self.active
    }

    /// Starts from the state of the arm; the trajectory continues from the tick `clock`.
    pub(crate) fn start(&mut self, estimate: &Estimate<R, V>, clock: u32) {
        self.rest.q = estimate.q;
        self.rest.qd = estimate.qd;
        self.rest.qdd = estimate.qd.map(|qd| -(self.decay * qd));
        self.clock = clock;
        self.advanced = 0;
        self.fraction = R::ZERO;
        self.active = true;
    }

    /// Moves the start by whole turns of the circles to within half a turn of `to`.
    pub(crate) fn turn_to(&mut self, circles: Circles, to: &[R; V]) {
        self.rest.q = circles.near(&self.rest.q, to);
    }

    /// Starts a return at the first point of the trajectory, for an arm that stands.
    pub(crate) fn stand(&mut self) {
        self.active = true;
    }

    /// The tick from which a trajectory should continue for an arm that leaves it at the tick
    /// `clock` with a decaying speed: 1 / λ later the trajectory is near the point at which the arm
    /// comes to rest, so that the return does not lead backwards.
    pub(crate) fn resume_tick(&self, clock: u32) -> u32 {
        clock.saturating_add(self.lead)
    }

    /// Ends a completed return and gives the tick of the trajectory.
    pub(crate) fn finish(&mut self) -> u32 {
        self.active = false;
        self.clock.saturating_add(self.half)
    }

    /// Cancels the return and gives the present tick of the trajectory.
    pub(crate) fn cancel(&mut self) -> u32 {
        self.active = false;
        self.clock.saturating_add(self.advanced)
    }

    /// The reference of the next tick, at `share` of the return, 0 to 1.
    ///
    /// The first one after [`Self::start`], with a share of zero, is the start.
    ///
    /// # Cost
    /// The cost of the trajectory and about 40 flops per joint.
    #[cold]
    #[inline(never)]
    pub(crate) fn at<T: Reference<R, V>>(&mut self, trajectory: &T, share: R) -> State<R, V, V> {
        let [w, slope, bend] = self.weights(share);
        let goal = self.goal(trajectory, share, w, slope);
        self.decay_step(share);
        let mut next = self.rest;
        let rates = next.qd.iter_mut().zip(&mut next.qdd);
        let goals = goal.q.iter().zip(goal.qd.iter().zip(&goal.qdd));
        for ((q, (qd, qdd)), (&q_d, (&qd_d, &qdd_d))) in next.q.iter_mut().zip(rates).zip(goals) {
            let (gap, gap_d, gap_dd) = (q_d - *q, qd_d - *qd, qdd_d - *qdd);
            *q += w * gap;
            *qd += w * gap_d + slope * gap;
            *qdd += w * gap_dd + (slope + slope) * gap_d + bend * gap;
        }
        next
    }

    /// w and its derivatives by the time.
    fn weights(&self, x: R) -> [R; 3] {
        // One by one: at opt-level s an array of them is converted while the code runs, in
        // software.
        let (six, ten) = (R::from_f64(6.0), R::from_f64(10.0));
        let (fifteen, thirty) = (R::from_f64(15.0), R::from_f64(30.0));
        let (xx, r) = (x * x, R::ONE - x);
        let slope = thirty * xx * r * r * self.seconds_inv;
        let bend = (thirty + thirty) * x * r * (r - x) * self.seconds_inv * self.seconds_inv;
        [xx * x * (ten - fifteen * x + six * xx), slope, bend]
    }

    /// The trajectory at σ, advanced by one tick of a time that passes at the rate w.
    fn goal<T: Reference<R, V>>(
        &mut self,
        trajectory: &T,
        share: R,
        rate: R,
        slope: R,
    ) -> State<R, V, V> {
        // Rates of the middles of ticks: their sum over the whole return is exactly half its ticks.
        let middle = share - R::from_f64(0.5) * self.ticks_inv;
        let [passed, ..] = self.weights(middle.clamped(R::ZERO, R::ONE));
        self.fraction += passed;
        if self.fraction >= R::ONE {
            self.fraction -= R::ONE;
            self.advanced = self.advanced.saturating_add(1);
        }
        let mut goal = trajectory.at(self.clock.saturating_add(self.advanced));
        let ahead = self.fraction * self.tick;
        let rates = goal.qd.iter_mut().zip(&mut goal.qdd);
        for (q, (qd, qdd)) in goal.q.iter_mut().zip(rates) {
            *q += ahead * (*qd + R::from_f64(0.5) * ahead * *qdd);
            *qd += ahead * *qdd;
            *qdd = rate * rate * *qdd + slope * *qd;
            *qd = rate * *qd;
        }
        goal
    }

    /// a, advanced by one tick except in the first one.
    fn decay_step(&mut self, share: R) {
        let moving = share > R::ZERO;
        let h = if moving { self.tick } else { R::ZERO };
        let keep = (R::ONE - h * self.decay).clamped(R::ZERO, R::ONE);
        let rates = self.rest.qd.iter_mut().zip(&mut self.rest.qdd);
        for (q, (qd, qdd)) in self.rest.q.iter_mut().zip(rates) {
            let before = *qd;
            *qd = before * keep;
            *q += R::from_f64(0.5) * h * (before + *qd);
            *qdd = -(self.decay * *qd);
        }
    }
}
