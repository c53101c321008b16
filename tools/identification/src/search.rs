//! The excitation whose regressor has the least condition number: random restarts and a local
//! search.

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;

use crate::{BaseModel, FourierMotion};

/// The search for an excitation.
///
/// From the best of some random series of each start, random changes of all amplitudes that reduce
/// the condition number are kept; their size follows the one-fifth rule. Every motion that is tried
/// uses the limits fully, so that the condition number compares forms. The same seed gives the same
/// motion.
///
/// # Source
/// Swevers et al. (1997), section IV, with the condition number of the regressor with scaled
/// columns, after Gautier & Khalil, "Exciting trajectories for the identification of base inertial
/// parameters of robots" (1992); Rechenberg's one-fifth rule in the form of Kern et al., "Learning
/// probability distributions in continuous evolutionary algorithms" (2004).
///
/// # Example
/// ```
/// # use dynamics_core::effects::{RIGID_BODY, Width};
/// # use dynamics_core::{model::Robot, robots::Ur5e};
/// # use identification::{BaseModel, ExcitationLimits};
/// use identification::Search;
/// # let torque = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];
/// # let lower = [-2.0, -2.2, -1.5, -2.0, -2.0, -2.0];
/// # let upper = [2.0, -0.6, 1.5, 2.0, 2.0, 2.0];
/// # let limits = ExcitationLimits { lower, upper, velocity: [2.0; 6], acceleration: [6.0; 6], torque };
/// # let arm = BaseModel::new(Ur5e::MODEL, RIGID_BODY, Width::new(0.05), limits);
/// let search = Search { period: 5.0, harmonics: 5, samples: 50, starts: 1, fresh: 20, steps: 60, seed: 1 };
/// let mut first = f64::INFINITY;
/// let found = search.run(&arm, |_| true, |progress| first = first.min(progress.condition)).expect("a motion within the limits");
/// assert!(found.condition <= first);
/// let start = found.motion.at(0.0);
/// assert!(start.qd.iter().chain(&start.qdd).all(|rate| rate.abs() < 1e-9)); // at rest
/// ```
#[doc(alias = "optimal excitation")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// The time after which the motion repeats, s.
    pub period: f64,
    /// The harmonics of each joint, at least three.
    pub harmonics: usize,
    /// States of a period whose rows are compared, and whose torques and positions are checked.
    pub samples: usize,
    /// Random restarts.
    pub starts: u32,
    /// Random series of each start, of which the best is improved.
    pub fresh: u32,
    /// Local steps from it.
    pub steps: u32,
    /// The seed of the random numbers.
    pub seed: u64,
}

/// The best result of a search so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The start, from zero.
    pub start: u32,
    /// The motions that this start has tried.
    pub tried: u32,
    /// The least condition number of all starts.
    pub condition: f64,
}

/// The best motion of a [`Search`].
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation<const V: usize> {
    /// The motion.
    pub motion: FourierMotion<V>,
    /// The condition number of its regressor, as [`BaseModel::condition`].
    pub condition: f64,
}

/// Amplitudes before they are scaled to the limits, and where the swing is.
#[derive(Clone)]
struct Form<const V: usize> {
    motion: FourierMotion<V>,
    place: [f64; V],
}

impl Search {
    /// The best motion; `None` if no motion that was tried keeps the torques' limits and is clear.
    ///
    /// `clear` says whether a configuration is allowed beyond the limits of the joints, such as
    /// clear of the table. `report` is called after each motion that was tried.
    ///
    /// # Panics
    /// With fewer than three harmonics, which leave no motion that starts at rest.
    pub fn run<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        clear: impl Fn(&[f64; V]) -> bool,
        mut report: impl FnMut(Progress),
    ) -> Option<Excitation<V>>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        assert!(self.harmonics > 2, "{} harmonics", self.harmonics);
        let mut rng = fastrand::Rng::with_seed(self.seed);
        let mut best: Option<Excitation<V>> = None;
        for start in 0..self.starts {
            let mut local: Option<(Form<V>, f64)> = None;
            let mut step = 0.3;
            for tried in 0..self.fresh + self.steps {
                let form = match &local {
                    Some((form, _)) if tried >= self.fresh => form.changed(step, &mut rng),
                    _ => self.random(&mut rng),
                };
                let motion = arm.limits.fill(&form.motion, &form.place);
                let condition = self.condition(arm, &motion, &clear);
                let least = local.as_ref().map_or(f64::INFINITY, |(_, least)| *least);
                let better = condition < least;
                if better {
                    local = Some((form, condition));
                }
                if tried >= self.fresh {
                    step *= f64::exp(if better { 0.8 } else { -0.2 } / 3.0);
                    step = step.clamp(1e-4, 1.0);
                }
                if best.as_ref().is_none_or(|best| condition < best.condition)
                    && condition.is_finite()
                {
                    best = Some(Excitation { motion, condition });
                }
                report(Progress {
                    start,
                    tried,
                    condition: best.as_ref().map_or(f64::INFINITY, |best| best.condition),
                });
            }
        }
        best
    }

    /// The condition number of a motion; infinite if it exceeds a torque or is not clear.
    fn condition<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        motion: &FourierMotion<V>,
        clear: impl Fn(&[f64; V]) -> bool,
    ) -> f64
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let time = |k| self.period * k as f64 / self.samples as f64;
        let states: Vec<_> = (0..self.samples).map(|k| motion.at(time(k))).collect();
        let allowed = states.iter().all(|state| {
            let torques = rnea(&arm.robot, state, &arm.scene);
            let within = torques.iter().zip(arm.limits.torque);
            within.into_iter().all(|(tau, most)| tau.abs() <= most) && clear(&state.q)
        });
        if allowed { arm.condition(&states) } else { f64::INFINITY }
    }

    /// Amplitudes of equal velocity in all harmonics.
    fn random<const V: usize>(&self, rng: &mut fastrand::Rng) -> Form<V> {
        let mut of = |h: usize| std::array::from_fn(|_| normal(rng) / h as f64);
        let sines = (1..=self.harmonics).map(&mut of).collect();
        let cosines = (1..=self.harmonics).map(of).collect();
        let motion = FourierMotion { period: self.period, centre: [0.0; V], sines, cosines };
        Form { motion, place: std::array::from_fn(|_| rng.f64()) }
    }
}

impl<const V: usize> Form<V> {
    /// With a random change of all numbers.
    fn changed(&self, step: f64, rng: &mut fastrand::Rng) -> Self {
        let mut new = self.clone();
        for series in [&mut new.motion.sines, &mut new.motion.cosines] {
            for (h, amplitudes) in (1_u32..).zip(series) {
                for amplitude in amplitudes {
                    *amplitude += step * normal(rng) / f64::from(h);
                }
            }
        }
        for place in &mut new.place {
            *place = (*place + step * normal(rng)).clamp(0.0, 1.0);
        }
        new
    }
}

/// A number of the standard normal distribution: Box & Muller (1958).
fn normal(rng: &mut fastrand::Rng) -> f64 {
    let radius = (-2.0 * (1.0 - rng.f64()).ln()).sqrt();
    radius * (std::f64::consts::TAU * rng.f64()).cos()
}
