//! Weighted least squares of the ticks of any motion, with the nominal model for what the motion
//! does not show.
//!
//! Positions are differentiated by a filter without delay, and torques and the columns of Y pass
//! the same filter, so that neither has what the other lacks: Gautier, "Dynamic identification of
//! robots with power model" (1997), the parallel filter. A motion that does not repeat shows less
//! than an excitation does; each base parameter therefore has a prior, the nominal value with a
//! deviation by which its torque would be a stated share of the joint's. Parameters whose deviation
//! the recording hardly reduces are not determined, and are named.

use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;
use dynamics_core::state::State;
use nalgebra::DMatrix;

use crate::columns::padded;
use crate::gears::{DEFLECTIONS, Moving};
use crate::physical::{STEPS, most_probable};
use crate::reduced::{Filters, Reduced};
use crate::solved::Solved;
use crate::{BaseModel, Gears, IdentificationError, PhysicalSet, TickRecording};

/// Passes over the weights, and over the friction of gears, whose columns depend on the estimate.
const PASSES: usize = 12;
/// Noise that changes by less than this share is final.
const FINAL: f64 = 1e-3;
/// The least noise relative to a joint's torque: a simulation has none, and weights are finite.
const LEAST: f64 = 1e-6;
/// The deviation of what is known, relative to that of the prior.
const KNOWN: f64 = 1e-6;
/// The deviation of the friction of a gear per transmitted torque before the recording is known.
const GEARS: f64 = 0.2;
/// The deviation of ln h, before each pass: a decade.
const DECADE: f64 = std::f64::consts::LN_10;
/// The longest time by which residuals are correlated, s.
const CORRELATED: f64 = 0.5;
/// A parameter whose deviation is more than this share of that of its prior is not determined.
const DETERMINED: f64 = 0.1;

/// The evaluation of a recording of ticks.
///
/// # Example
/// The friction of a pendulum, from a motion that does not repeat:
/// ```
/// use dynamics_core::algorithms::rnea;
/// use dynamics_core::effects::{Coulomb, RIGID_BODY, Viscous, Width};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
/// use dynamics_core::state::State;
/// use identification::{BaseModel, ExcitationLimits, Fit, TickRecording};
///
/// let rod = Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.0, 0.0, -0.5]).inertia([0.1, 0.0, 0.0, 0.1, 0.0, 0.1]);
/// let pendulum: ArmModel<f64, 1> = Model::new("pendulum", [rod]);
/// let width = Width::new(0.05);
/// let limits = ExcitationLimits { lower: [-1.5], upper: [1.5], velocity: [4.0], acceleration: [20.0], torque: [30.0] };
/// let arm = BaseModel::new(pendulum, RIGID_BODY, width, limits);
///
/// let friction = (Viscous([0.8]), Coulomb { torque: [0.5], width });
/// let at = |t: f64| { // two frequencies without a common period
///     let [a, b] = [(2.0 * t).sin_cos(), (4.7 * t).sin_cos()];
///     State { q: [0.8 * a.0 + 0.3 * b.0], qd: [1.6 * a.1 + 1.41 * b.1], qdd: [-3.2 * a.0 - 6.627 * b.0] }
/// };
/// let states: Vec<_> = (0..10_000).map(|k| at(1e-3 * f64::from(k))).collect();
/// let torques = states.iter().map(|state| rnea(&pendulum, state, &(RIGID_BODY, friction))).collect();
/// let recording = TickRecording::try_new(vec![(states.iter().map(|state| state.q).collect(), torques)], 1e-3)?;
///
/// let nominal = [0.0, -0.7, 0.7, 0.0, 0.0, 0.0]; // m c_x, m c_z, I_yy with the armature, frictions, offset
/// let fit = Fit { delay: 0.0, ..Fit::new(1e-3) }; // torques of the samples themselves
/// let found = fit.identify(&arm, &recording, &nominal, &[false; 6], None)?;
/// let true_values = [0.0, -1.0, 0.6, 0.8, 0.5, 0.0];
/// assert!(found.base.iter().zip(true_values).all(|(found, value)| (found - value).abs() < 0.01), "{:?}", found.base);
/// assert!((0..6).all(|parameter| found.is_determined(parameter)));
/// # Ok::<(), identification::IdentificationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The frequency up to which torques are compared, Hz: above that of the motion.
    pub cutoff: f64,
    /// The time by which a torque is later than the position of the same sample, s: half a tick for
    /// a torque that was commanded at the sample and is held for a tick.
    pub delay: f64,
    /// The standard deviation of each base parameter before the recording is known, by the torque
    /// that it makes: the root mean square over motions within the limits, as a share of the
    /// joint's torque.
    pub prior: f64,
}

/// Base parameters by a recording of ticks.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted<const V: usize> {
    /// The base parameters, in the order of [`BaseModel`].
    pub base: Vec<f64>,
    /// Their standard deviations, the prior's where the motion does not show them.
    pub deviations: Vec<f64>,
    /// Their standard deviations without the recording.
    pub prior: Vec<f64>,
    /// The standard deviation of what the estimate does not explain, of the filtered torque, N·m or
    /// N.
    pub noise: [f64; V],
    /// The condition number of the regressor of the motion: [`BaseModel::condition`].
    pub condition: f64,
    /// The friction of the gears, if it is a part of the model, and its standard deviations.
    pub gears: Option<[Gears<V>; 2]>,
    /// S of the covariance SᵀS of the base parameters, given the friction of the gears.
    pub(crate) root: DMatrix<f64>,
}

/// Torques of a recording and of models, through the filter of [`Fit`].
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison<const V: usize> {
    /// s since the start of the recording.
    pub times: Vec<f64>,
    /// The speeds of the joints, rad/s or m/s.
    pub speeds: Vec<[f64; V]>,
    /// The measured torques, N·m or N.
    pub measured: Vec<[f64; V]>,
    /// Those of each model.
    pub modelled: Vec<Vec<[f64; V]>>,
}

/// A model in base parameters, and the friction of its gears, if there is some.
pub type Modelled<'a, const V: usize> = (&'a [f64], Option<Gears<V>>);

impl Fit {
    /// Torques up to 10 Hz, with half a tick of delay.
    ///
    /// ```
    /// assert_eq!(identification::Fit::new(2e-3).delay, 1e-3);
    /// ```
    #[must_use]
    pub fn new(tick: f64) -> Self {
        Self { cutoff: 10.0, delay: 0.5 * tick, prior: 0.5 }
    }

    /// The highest [`cutoff`](Self::cutoff) for ticks of this length, s.
    ///
    /// ```
    /// assert_eq!(identification::Fit::highest(4e-3).floor(), 8.0);
    /// ```
    #[must_use]
    pub fn highest(tick: f64) -> f64 {
        Filters::highest(tick)
    }

    /// The base parameters by a recording and a `nominal` set of them, of which those that are
    /// `known` stay as they are. With the `gears` of the nominal model, their friction is found as
    /// well.
    ///
    /// # Errors
    /// [`IdentificationError::Cutoff`] and [`IdentificationError::TooShort`].
    ///
    /// # Panics
    /// If there are not as many nominal or known parameters as the arm has.
    ///
    /// # Source
    /// The weights as in Gautier & Poignet, "Extended Kalman filtering and weighted least squares
    /// dynamic identification of robot" (2001), section 3; the variance of a mean of correlated
    /// residuals after Newey & West, "A simple, positive semi-definite, heteroskedasticity and
    /// autocorrelation consistent covariance matrix" (1987).
    pub fn identify<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        recording: &TickRecording<V>,
        nominal: &[f64],
        known: &[bool],
        gears: Option<Gears<V>>,
    ) -> Result<Fitted<V>, IdentificationError>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let p = arm.len();
        assert_eq!([nominal.len(), known.len()], [p; 2], "of each parameter");
        let filters = Filters::new(self.cutoff, self.delay, recording.tick())?;
        let each = gears.map_or(0, |gears| gears.each());
        let extra = each * V;
        let prior: Vec<f64> = (arm.scale.iter().zip(known))
            .map(|(scale, known)| self.prior * if *known { KNOWN } else { 1.0 } / scale)
            .collect();
        let own = (0..extra).map(|at| (at / each, at % each));
        let of_gears = own.clone().map(|(_, k)| if k < 2 { GEARS } else { DECADE });
        let ridge: Vec<f64> = prior.iter().copied().chain(of_gears).collect();
        let of_gears =
            own.map(|(j, k)| if k < 2 { gears.map_or(0.0, |g| g.joint(j)[k]) } else { 0.0 });
        let target: Vec<f64> = nominal.iter().copied().chain(of_gears).collect();
        let mut noise = arm.limits.torque.map(|torque| 0.01 * torque);
        let mut gears = gears;
        let mut least = [f64::INFINITY; V];
        for tried in gears.iter().flat_map(Gears::scan).collect::<Vec<_>>() {
            let reduced = self.columns(&filters, arm, recording, nominal, Some(tried))?;
            let equations = Equations::of(&reduced, &target);
            let found = equations.solve(&noise, &ridge).estimate;
            for (j, least) in least.iter_mut().enumerate() {
                let square = equations.square(&found, j);
                if square < *least {
                    *least = square;
                    let of = |gears: Gears<V>| {
                        gears.map(|i, k| if i == j { tried.joint(i)[k] } else { gears.joint(i)[k] })
                    };
                    gears = gears.map(of);
                }
            }
        }
        let mut reduced = self.columns(&filters, arm, recording, nominal, gears)?;
        let (mut solved, mut equations) = (None, Equations::of(&reduced, &target));
        for pass in 0..PASSES {
            let found = equations.solve(&noise, &ridge);
            let mut change = 0.0_f64;
            for (j, noise) in noise.iter_mut().enumerate() {
                let free = equations.count as f64 - equations.of_joint(&found.leverages, j);
                let square = equations.square(&found.estimate, j) / free.max(1.0);
                let new = square.sqrt().max(LEAST * arm.limits.torque[j]);
                change = change.max((new / *noise - 1.0).abs());
                *noise = new;
            }
            let (base, of_gears) = found.estimate.as_slice().split_at(p);
            let done = change < FINAL && (extra == 0 || pass > 3);
            gears = gears.map(|gears| gears.stepped(of_gears));
            if extra > 0 && !done {
                reduced = self.columns(&filters, arm, recording, base, gears)?;
                equations = Equations::of(&reduced, &target);
            }
            solved = Some(found);
            if done {
                break;
            }
        }
        let solved = solved.expect("a pass");
        let lags = (CORRELATED / (filters.seconds(recording.tick()))).ceil() as usize;
        let mut squares = vec![1.0; equations.rows.nrows()];
        for (j, squares) in squares.chunks_mut(equations.each).take(V).enumerate() {
            squares.fill(inflation(&residuals(&reduced, &solved.estimate, j), lags));
        }
        let root = solved.deviations(&squares);
        // The bodies that go with these gears: what is known of them if the gears are.
        let of_bodies = match extra {
            0 => root.clone(),
            _ => {
                let known = prior.iter().copied().chain(std::iter::repeat_n(KNOWN, extra));
                let solved = equations.solve(&noise, &known.collect::<Vec<_>>());
                solved.deviations(&squares)
            }
        };
        let deviations: Vec<f64> = root.column_iter().map(|column| column.norm()).collect();
        let gears = gears.map(|gears| {
            let deviation = |j: usize, k: usize| {
                let own = deviations[p + each * j + k];
                if k < 2 { own } else { own * gears.joint(j)[k] }
            };
            [gears, gears.map(deviation)]
        });
        Ok(Fitted {
            base: solved.estimate.as_slice()[..p].to_vec(),
            deviations: deviations[..p].to_vec(),
            prior,
            noise,
            condition: arm.condition(&reduced.states),
            gears,
            root: of_bodies.columns(0, p).clone_owned().qr().r(),
        })
    }

    /// Torques of a recording beside those of models.
    ///
    /// # Errors
    /// As [`Fit::identify`].
    pub fn compare<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        recording: &TickRecording<V>,
        models: &[Modelled<'_, V>],
    ) -> Result<Comparison<V>, IdentificationError>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let filters = Filters::new(self.cutoff, self.delay, recording.tick())?;
        let width = models.len() + 1;
        let moving = |(_, gears): &Modelled<'_, V>| {
            gears.map(|of| Moving::new(of, arm.friction.width.get()))
        };
        let mut moving: Vec<_> = models.iter().map(moving).collect();
        let reduced = filters.reduce(recording, |state, start| {
            let rows = arm.rows(state);
            moving.iter_mut().flatten().for_each(|moving| moving.advance(state, start));
            std::array::from_fn(|j| {
                let of = |((base, _), moving): (&Modelled<'_, V>, &Option<Moving<V>>)| {
                    let still: f64 = rows[j].iter().zip(*base).map(|(y, beta)| y * beta).sum();
                    moving.as_ref().map_or(still, |moving| moving.torque(j, state.qd[j], still))
                };
                models.iter().zip(&moving).map(of).collect()
            })
        });
        let count = reduced.times.len();
        if count == 0 {
            return Err(self.too_short(recording));
        }
        let of = |k: usize, column: usize| -> [f64; V] {
            std::array::from_fn(|j| reduced.rows[j][k * width + column])
        };
        let column = |column: usize| (0..count).map(|k| of(k, column)).collect();
        Ok(Comparison {
            measured: column(models.len()),
            modelled: (0..models.len()).map(column).collect(),
            speeds: reduced.states.iter().map(|state| state.qd).collect(),
            times: reduced.times,
        })
    }

    /// The rows of the base parameters, and of the gears' friction under the torques that the
    /// estimate implies.
    fn columns<D, E, const B: usize, const V: usize>(
        &self,
        filters: &Filters,
        arm: &BaseModel<D, E, B, V>,
        recording: &TickRecording<V>,
        estimate: &[f64],
        gears: Option<Gears<V>>,
    ) -> Result<Reduced<V>, IdentificationError>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let (p, extra) = (estimate.len(), gears.map_or(0, |gears| gears.each() * V));
        let mut moving = gears.map(|gears| Moving::new(gears, arm.friction.width.get()));
        let mut reduced = filters.reduce(recording, |state: &State<f64, V, V>, start| {
            let mut rows = arm.rows(state);
            if let Some(moving) = &mut moving {
                moving.advance(state, start);
                for (j, row) in rows.iter_mut().enumerate() {
                    let still: f64 = row.iter().zip(estimate).map(|(y, beta)| y * beta).sum();
                    row.resize(p + extra, 0.0);
                    moving.fill(j, state.qd[j], still, row, p);
                }
            }
            rows
        });
        // The slopes are those about the estimate, at which the base parameters' part is the whole.
        if let Some(Gears::Presliding(all)) = gears {
            for (j, rows) in reduced.rows.iter_mut().enumerate() {
                for row in rows.chunks_exact_mut(p + extra + 1) {
                    let own: f64 = (0..2).map(|k| all[j][k] * row[p + 3 * j + k]).sum();
                    row[p + extra] += own;
                }
            }
        }
        // With fewer rows than parameters the residuals say nothing of the noise.
        if reduced.times.len() * V < 2 * (p + extra) {
            return Err(self.too_short(recording));
        }
        Ok(reduced)
    }

    fn too_short<const V: usize>(&self, recording: &TickRecording<V>) -> IdentificationError {
        IdentificationError::TooShort { seconds: recording.tick() * recording.ticks() as f64 }
    }
}

/// The sum of the products of residuals with later ones.
pub(crate) fn lagged(residuals: &[f64], lag: usize) -> f64 {
    residuals.iter().zip(residuals.iter().skip(lag)).map(|(a, b)| a * b).sum()
}

/// By how much correlation multiplies the variance of a mean of residuals, at least one.
fn inflation(residuals: &[f64], lags: usize) -> f64 {
    let product = |lag| lagged(residuals, lag);
    let all = product(0).max(1e-300);
    let weight = |lag: usize| 1.0 - lag as f64 / (lags + 1) as f64;
    let sum: f64 = (1..=lags).map(|lag| weight(lag) * product(lag) / all).sum();
    (1.0 + 2.0 * sum).max(1.0)
}

/// The filtered rows of all joints, and those of the prior below them. Those of a joint, which have
/// one weight, are reduced to the factor R of [rows, torques] = Q R: sums of squares remain.
pub(crate) struct Equations {
    rows: DMatrix<f64>,
    right: DMatrix<f64>,
    /// Rows of a joint, and those before.
    each: usize,
    count: usize,
}

impl Equations {
    pub(crate) fn of<const V: usize>(reduced: &Reduced<V>, target: &[f64]) -> Self {
        let (count, p) = (reduced.times.len(), target.len());
        let each = count.min(p + 1);
        let mut rows = DMatrix::zeros(V * each + p, p);
        let mut right = DMatrix::zeros(V * each + p, 1);
        for (j, all) in reduced.rows.iter().enumerate() {
            let factor = DMatrix::from_row_slice(count, p + 1, all).qr().r();
            rows.view_mut((j * each, 0), (each, p)).copy_from(&factor.columns(0, p));
            right.view_mut((j * each, 0), (each, 1)).copy_from(&factor.columns(p, 1));
        }
        for (i, value) in target.iter().enumerate() {
            rows[(V * each + i, i)] = 1.0;
            right[(V * each + i, 0)] = *value;
        }
        Self { rows, right, each, count }
    }

    /// With the noise of each joint, and the deviation of each prior.
    pub(crate) fn solve(&self, noise: &[f64], prior: &[f64]) -> Solved {
        let each = self.each;
        Solved::of(&self.rows, &self.right, |at| match noise.get(at / each) {
            Some(noise) => noise * noise,
            None => prior[at - noise.len() * each].powi(2),
        })
    }

    /// The sum of the squares of a joint's residuals, N·m or N.
    pub(crate) fn square(&self, estimate: &nalgebra::DVector<f64>, joint: usize) -> f64 {
        let own = |of: &DMatrix<f64>| of.rows(joint * self.each, self.each).into_owned();
        (own(&self.right) - own(&self.rows) * estimate).norm_squared()
    }

    fn of_joint(&self, all: &nalgebra::DVector<f64>, joint: usize) -> f64 {
        all.rows(joint * self.each, self.each).sum()
    }
}

/// The residuals of a joint's rows, N·m or N.
fn residuals<const V: usize>(
    reduced: &Reduced<V>,
    estimate: &nalgebra::DVector<f64>,
    joint: usize,
) -> Vec<f64> {
    let p = estimate.len();
    let row =
        |row: &[f64]| row[p] - row.iter().zip(estimate).map(|(y, beta)| y * beta).sum::<f64>();
    reduced.rows[joint].chunks_exact(p + 1).map(row).collect()
}

impl<const V: usize> Fitted<V> {
    /// The covariance of the base parameters, row by row.
    #[must_use]
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let covariance = self.root.tr_mul(&self.root);
        covariance.row_iter().map(|row| row.iter().copied().collect()).collect()
    }

    /// Whether the recording determines a base parameter.
    #[must_use]
    pub fn is_determined(&self, base: usize) -> bool {
        self.deviations[base] <= DETERMINED * self.prior[base]
    }

    /// Whether it determines a number of a joint's gear.
    #[must_use]
    pub fn is_gear_determined(&self, joint: usize, number: usize) -> bool {
        self.gears.is_some_and(|gears| {
            let [found, deviation] = gears.each_ref().map(|gears| gears.joint(joint)[number]);
            match number {
                0 | 1 => deviation <= DETERMINED * GEARS,
                _ => !DEFLECTIONS.contains(&found) && deviation <= DETERMINED * DECADE * found,
            }
        })
    }

    /// The possible parameters that agree best with the estimate and with nominal ones, if each
    /// nominal number has this relative standard deviation: the most probable set.
    ///
    /// Parameters that the motion does not distinguish remain as near to the nominal numbers as the
    /// estimate allows. A body without mass and a viscous friction, a Coulomb friction or an
    /// armature of zero remains so; an offset is free. Each joint has the first N of
    /// [`OfJoint`](crate::OfJoint).
    ///
    /// # Errors
    /// [`IdentificationError::ImpossibleBody`] names a nominal body without a positive definite
    /// pseudo-inertia.
    pub fn physical<D, E, const B: usize, const N: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        bodies: &[[f64; 10]; B],
        joints: &[[f64; N]; V],
        share: f64,
    ) -> Result<PhysicalSet<B, V>, IdentificationError>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        most_probable(&self.base, &self.root, arm, bodies, &padded(joints), share, STEPS)
    }
}
