//! Base parameters: the combinations of parameters that the torques of an arm depend on.
//!
//! With columns Y = [Y_s Y_d] and Y_d = Y_s K, torques need those of the selection alone, and
//! what they multiply are the base parameters β = θ_s + K θ_d: Gautier, "Numerical calculation of
//! the base inertial parameters of robots" (1991). The selection takes columns in their order, so
//! that a parameter that cannot be distinguished is a part of those of bodies nearer to the base.

use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;
use dynamics_core::state::State;
use nalgebra::{DMatrix, DVector};

use crate::columns::{OF_JOINT, columns};
use crate::{ExcitationLimits, Friction, Parameter};

/// States whose columns decide which parameters are independent.
const STATES: usize = 400;
/// A column is a combination of others if these leave less than this share of it,
const INDEPENDENT: f64 = 1e-8;
/// and without effect below this share of the largest one.
const EFFECT: f64 = 1e-11;
/// Factors of combinations below this are rounding.
const ROUNDING: f64 = 1e-9;

/// An arm with its base parameters: friction, armatures and offsets of the joints and what of the
/// bodies is distinguishable.
///
/// The model of the torques, linear in the parameters: rigid bodies under the effects of the scene,
/// and of each joint viscous and Coulomb friction with a smooth sign, the armature, the offset of
/// its torque, and what else its [`Friction`] has.
///
/// # Example
/// ```
/// use dynamics_core::effects::{RIGID_BODY, Width};
/// use dynamics_core::{model::Robot, robots::Ur5e};
/// use identification::{BaseModel, ExcitationLimits};
/// let limits = ExcitationLimits {
///     lower: [-1.5; 6],
///     upper: [1.5; 6],
///     velocity: [2.0; 6],
///     acceleration: [6.0; 6],
///     torque: [150.0, 150.0, 150.0, 28.0, 28.0, 28.0],
/// };
/// let arm = BaseModel::new(Ur5e::MODEL, RIGID_BODY, Width::new(0.05), limits);
/// // 36 of bodies alone; four of the six armatures are distinguishable from these; and 18 of friction and offsets.
/// assert_eq!(arm.len(), 36 + 4 + 18);
/// assert_eq!(arm.name(1), "body 1 m c_x − 0.425 body 2 m − 0.425 body 3 m − 0.425 body 4 m − 0.425 body 5 m");
/// ```
#[derive(Clone, Debug)]
pub struct BaseModel<D, E, const B: usize, const V: usize> {
    pub(crate) robot: D,
    pub(crate) scene: E,
    pub(crate) friction: Friction,
    pub(crate) limits: ExcitationLimits<V>,
    /// The selected columns.
    selected: Vec<usize>,
    /// K_β, by base parameters and all parameters.
    pub(crate) grouping: DMatrix<f64>,
    /// The root mean square of each selected column over states within the limits, relative to the
    /// joints' torques.
    pub(crate) scale: DVector<f64>,
}

impl<D, E, const B: usize, const V: usize> BaseModel<D, E, B, V>
where
    D: RobotModel<f64, B, V, V>,
    E: Effect<f64, B, V>,
{
    /// The parameters that are independent in motions within the limits.
    ///
    /// Its bodies' own numbers only matter for the torques of an excitation: the base parameters
    /// depend on the geometry.
    ///
    /// # Panics
    /// If the limits are [impossible](ExcitationLimits::are_possible).
    #[must_use]
    pub fn new(
        robot: D,
        scene: E,
        friction: impl Into<Friction>,
        limits: ExcitationLimits<V>,
    ) -> Self {
        let friction = friction.into();
        assert!(limits.are_possible(), "limits: {limits:?}");
        let mut rng = fastrand::Rng::with_seed(1);
        let n = 10 * B + OF_JOINT * V;
        let mut rows = DMatrix::zeros(STATES * V, n);
        for k in 0..STATES {
            let state = random_state(&limits, &mut rng);
            for (j, row) in columns(&robot, &scene, friction, &state).iter().enumerate() {
                for (i, y) in row.iter().enumerate() {
                    rows[(k * V + j, i)] = y / limits.torque[j];
                }
            }
        }
        let per_state = 1.0 / (STATES as f64).sqrt();
        let norms = DVector::from_iterator(n, rows.column_iter().map(|c| c.norm()));
        let (selected, orthonormal) = independent(&rows, &norms);
        let within = orthonormal.tr_mul(&rows.select_columns(&selected));
        let mut grouping =
            (within.lu()).solve(&orthonormal.tr_mul(&rows)).expect("independent columns");
        for (row, &at) in selected.iter().enumerate() {
            for column in 0..n {
                let share = &mut grouping[(row, column)];
                let size = share.abs() * norms[at];
                if size <= ROUNDING * norms[column].max(norms[at]) {
                    *share = 0.0;
                }
            }
            grouping.column_mut(at).fill(0.0);
            grouping[(row, at)] = 1.0;
        }
        let scale = DVector::from_iterator(
            selected.len(),
            selected.iter().map(|&at| norms[at] * per_state),
        );
        Self { robot, scene, friction, limits, selected, grouping, scale }
    }

    /// The number of base parameters.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "every joint has friction")]
    pub fn len(&self) -> usize {
        self.selected.len()
    }

    /// The root mean square of the column of each base parameter over random states within the
    /// limits, each row relative to the torque of its joint: what [`Self::condition`] divides the
    /// columns by.
    #[must_use]
    pub fn scales(&self) -> Vec<f64> {
        self.scale.iter().copied().collect()
    }

    /// The torque of each joint per unit of each base parameter.
    #[must_use]
    pub fn rows(&self, state: &State<f64, V, V>) -> [Vec<f64>; V] {
        columns(&self.robot, &self.scene, self.friction, state)
            .map(|row| self.selected.iter().map(|&at| row[at]).collect())
    }

    /// The torque of each joint by base parameters, N·m or N.
    #[must_use]
    pub fn torques(&self, base: &[f64], state: &State<f64, V, V>) -> [f64; V] {
        let dot = |row: Vec<f64>| row.iter().zip(base).map(|(y, beta)| y * beta).sum();
        self.rows(state).map(dot)
    }

    /// The base parameters of a set of all parameters, ten of each body and of each joint the first
    /// N of [`OfJoint`](crate::OfJoint).
    #[must_use]
    pub fn of_all<const N: usize>(
        &self,
        bodies: &[[f64; 10]; B],
        joints: &[[f64; N]; V],
    ) -> Vec<f64> {
        let joints = crate::columns::padded(joints);
        let all = bodies.as_flattened().iter().chain(joints.as_flattened());
        let all = DVector::from_iterator(10 * B + OF_JOINT * V, all.copied());
        (&self.grouping * all).iter().copied().collect()
    }

    /// The parameters that a base parameter is the sum of, with their factors: the selected one
    /// with the factor 1 first.
    #[must_use]
    pub fn terms(&self, base: usize) -> Vec<(f64, Parameter)> {
        let own = self.selected[base];
        let term = |at: usize| (self.grouping[(base, at)], Parameter::at(at, B));
        let others = (0..self.grouping.ncols()).filter(|&at| at != own);
        let others = others.map(term).filter(|(factor, _)| *factor != 0.0);
        std::iter::once(term(own)).chain(others).collect()
    }

    /// The first five terms of a base parameter, with the number of all.
    #[must_use]
    pub fn name(&self, base: usize) -> String {
        let terms = self.terms(base);
        let mut name = String::new();
        for (k, (factor, parameter)) in terms.iter().take(5).enumerate() {
            let size = (factor.abs() * 1e4).round() / 1e4;
            let sign = if *factor < 0.0 { "−" } else { "+" };
            name += &match (k, size == 1.0) {
                (0, _) => parameter.to_string(),
                (_, true) => format!(" {sign} {parameter}"),
                _ => format!(" {sign} {size} {parameter}"),
            };
        }
        match terms.len() {
            0..=5 => name,
            all => format!("{name} + … ({all})"),
        }
    }

    /// The condition number of the regressor of states, each column relative to its root mean
    /// square over random states within the limits, each row to the torque of its joint:
    /// √(λ_max/λ_min) of the sum of the squares. Infinite if rank is lost.
    #[must_use]
    pub fn condition<'a>(&self, states: impl IntoIterator<Item = &'a State<f64, V, V>>) -> f64 {
        let mut rows = Vec::new();
        for state in states {
            for (row, torque) in self.rows(state).iter().zip(self.limits.torque) {
                let scaled = row.iter().zip(&self.scale);
                rows.extend(scaled.map(|(y, scale)| y / (torque * scale)));
            }
        }
        let scaled = DMatrix::from_row_slice(rows.len() / self.len(), self.len(), &rows);
        let values = scaled.tr_mul(&scaled).symmetric_eigenvalues();
        match values.min() {
            least if least > 0.0 => (values.max() / least).sqrt(),
            _ => f64::INFINITY,
        }
    }
}

/// The columns that are independent of those before them, and an orthonormal base of what they
/// span: Gram–Schmidt, twice.
fn independent(rows: &DMatrix<f64>, norms: &DVector<f64>) -> (Vec<usize>, DMatrix<f64>) {
    let (mut selected, mut base) = (Vec::new(), Vec::<DVector<f64>>::new());
    for (at, column) in rows.column_iter().enumerate() {
        let mut rest = column.into_owned();
        for unit in base.iter().chain(&base) {
            rest.axpy(-unit.dot(&rest), unit, 1.0);
        }
        if rest.norm() > (INDEPENDENT * norms[at]).max(EFFECT * norms.max()) {
            base.push(rest.normalize());
            selected.push(at);
        }
    }
    (selected, DMatrix::from_columns(&base))
}

/// Any state within the limits.
fn random_state<const V: usize>(
    limits: &ExcitationLimits<V>,
    rng: &mut fastrand::Rng,
) -> State<f64, V, V> {
    let mut symmetric = |x: &[f64; V]| x.map(|x| x * (2.0 * rng.f64() - 1.0));
    let half = std::array::from_fn(|j| 0.5 * (limits.upper[j] - limits.lower[j]));
    let swing = symmetric(&half);
    State {
        q: std::array::from_fn(|j| limits.lower[j] + half[j] + swing[j]),
        qd: symmetric(&limits.velocity),
        qdd: symmetric(&limits.acceleration),
    }
}
