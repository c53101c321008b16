//! The library's algorithms over rows of numbers, for robots and scenes that are known at run time.
//!
//! All machine code of the algorithms is in this crate, which compiles in minutes; the extension
//! module beside it, which knows Python, compiles in seconds.

mod algorithm;
mod algorithms;
mod dispatch;
pub mod flexible;
pub mod job;
mod lanes;
pub mod linkages;
pub mod loops;
pub mod model;
pub mod place;
mod scene;
pub mod spec;

use dynamics_core::algorithms::frame::AnyFrame;
use dynamics_core::loops::Moving;
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use algorithm::{Algorithm, Call, Sizes};
use flexible::AnyModes;
use job::{Failure, Job};
use lanes::{Blocks, LANES, Lanes};
use linkages::Linkages;
use loops::AnyLoops;
use model::{Counts, Cut, Fast, General, Models};
use scene::Terms;
use spec::{BodyRef, Spec};

/// A call, of which the algorithm and the rows are known elsewhere.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// The numbers of the robot's bodies and coordinates.
    pub counts: Counts,
    /// The effects, which fit the robot.
    pub effects: &'a [Spec],
    /// The number of a body.
    pub body: &'a (dyn Fn(&BodyRef) -> usize + Sync),
}

/// The ranges of `dynamics_core::trig::sin_cos` and `sin_cos_f64`, rad.
pub(crate) const fn most_angle<R>() -> f64 {
    if size_of::<R>() == size_of::<f64>() { 1e5 } else { 1e4 }
}

/// A scalar that the arrays of a call can have.
pub trait Scalar: Real {
    /// The largest angle, rad, of which sines are computed to their last digits.
    const MOST_ANGLE: f64;
    /// Computes the rows of a job by an algorithm, one after the other.
    ///
    /// # Errors
    /// The row that has no result, and why.
    fn compute(
        which: &Which<'_>,
        models: &Models<Self>,
        setting: Setting<'_>,
        rows: &mut Job<'_, Self>,
    ) -> Result<(), Failure>;
}

macro_rules! which {
    ($($name:ident $({ $($field:ident: $type:ty),* })?),* $(,)?) => {
        /// The algorithm of a call, with its parameters.
        #[derive(Clone, Copy, Debug)]
        #[allow(missing_docs, reason = "their documentation is that of `algorithms`")]
        pub enum Which<'a> {
            $($name $({ $($field: $type),* })?),*
        }

        macro_rules! scalar {
            ($r:ty) => {
                impl Scalar for $r {
                    const MOST_ANGLE: f64 = most_angle::<$r>();

                    fn compute(
                        which: &Which<'_>,
                        models: &Models<Self>,
                        setting: Setting<'_>,
                        rows: &mut Job<'_, Self>,
                    ) -> Result<(), Failure> {
                        let which = which.of(spec::terms_of(setting.effects));
                        match which {
                            $(Which::$name $({ $($field),* })? => {
                                let algorithm = algorithms::$name { $($($field),*)? };
                                <$r as WithLanes>::rows(&algorithm, models, setting, rows)
                            })*
                        }
                    }
                }
            };
        }
    };
}

which! {
    Rnea { given: usize, still: bool },
    RneaAndWrenches,
    RneaTwoVelocities,
    Crba,
    CrbaJacobian { body: usize },
    LtdlOf,
    Solve,
    Inverse,
    CholeskyOf,
    CholeskySolve,
    SpatialOperatorLtdl,
    SpatialOperatorInverse,
    InverseMass,
    ForwardWithError,
    AccelerationError,
    ElasticInverseDynamics { joints: [&'a [f64]; 3] },
    RneaDerivatives,
    Aba,
    ForwardDynamics,
    ForwardDynamicsDerivatives,
    Hybrid,
    Transmitted,
    Jacobian { body: usize, frame: AnyFrame },
    BiasAcceleration { body: usize, frame: AnyFrame },
    Poses,
    Kinematics { frame: AnyFrame },
    KineticEnergy,
    PotentialEnergy,
    Momentum,
    CentroidalMomentum,
    CentroidalMatrix,
    CenterOfMass,
    MomentumAndCoriolis,
    MomentumAndDrift,
    CoriolisMatrix,
    BaseVelocity,
    OsimInverse { body: usize, frame: AnyFrame },
    OperationalSpaceOf { body: usize, frame: AnyFrame, damping: f64 },
    Regressor { first: usize, end: usize },
    RegressorRow { coordinate: usize },
    InertialParameters,
    FrictionRegressor { width: f64 },
    Assemble { loops: &'a AnyLoops, moving: Moving },
    LoopConstraints { loops: &'a AnyLoops },
    CoordinateMapOf { loops: &'a AnyLoops },
    MobilityOf { loops: &'a AnyLoops },
    LoopInverse { loops: &'a AnyLoops },
    LoopForward { loops: &'a AnyLoops, stabilisation: [f64; 2] },
    LinkageMotion { linkages: &'a Linkages },
    LinkageRnea { linkages: &'a Linkages },
    LinkageForward { linkages: &'a Linkages },
    FlexibleRnea { modes: &'a AnyModes },
    FlexibleCrba { modes: &'a AnyModes },
    Frequencies { modes: &'a AnyModes },
    FlexibleForward { modes: &'a AnyModes },
    ModalDynamics { modes: &'a AnyModes },
    ModesAtRest { modes: &'a AnyModes },
    FeedforwardTick { modes: &'a AnyModes, h: f64 },
    Integrate,
    Normalise,
    Difference,
    Neutral,
}

scalar!(f32);
scalar!(f64);

/// The computation of a job's rows in a scalar.
trait WithLanes: Real {
    fn rows<O: Algorithm>(
        algorithm: &O,
        models: &Models<Self>,
        setting: Setting<'_>,
        rows: &mut Job<'_, Self>,
    ) -> Result<(), Failure>;
}

impl WithLanes for f64 {
    fn rows<O: Algorithm>(
        algorithm: &O,
        models: &Models<Self>,
        setting: Setting<'_>,
        rows: &mut Job<'_, Self>,
    ) -> Result<(), Failure> {
        over(algorithm, models, setting, rows)
    }
}

impl WithLanes for f32 {
    fn rows<O: Algorithm>(
        algorithm: &O,
        models: &Models<Self>,
        setting: Setting<'_>,
        rows: &mut Job<'_, Self>,
    ) -> Result<(), Failure> {
        let count = rows.rows / LANES;
        let terms = spec::terms_of(setting.effects);
        if !O::LANES || count == 0 || terms.extra || !O::fits(terms) {
            return over(algorithm, models, setting, rows);
        }
        let Some(lanes) = &models.lanes else {
            return over(algorithm, models, setting, rows);
        };
        let mut first = 0;
        // Each turn ends all rows, or the block in which a state is singular, whose states are then
        // found one by one.
        while first < count {
            let mut rest = rows.part(first * LANES, rows.rows);
            let mut blocks = Blocks { job: &mut rest, count: count - first };
            let done = in_lanes(algorithm, lanes, setting, &mut blocks);
            let Err(Failure { row: block, .. }) = done else {
                break;
            };
            let at = (first + block) * LANES;
            over(algorithm, models, setting, &mut rows.part(at, at + LANES))
                .map_err(|error| error.after(at))?;
            first += block + 1;
        }
        let at = count * LANES;
        let end = rows.rows;
        over(algorithm, models, setting, &mut rows.part(at, end)).map_err(|error| error.after(at))
    }
}

/// Computes blocks of eight rows at once.
fn in_lanes<O: Algorithm>(
    algorithm: &O,
    model: &Fast<Lanes>,
    setting: Setting<'_>,
    rows: &mut Blocks<'_, '_>,
) -> Result<(), Failure> {
    let Setting { counts, effects, body } = setting;
    macro_rules! run {
        ($robot:expr) => {
            algorithm.blocks(Call {
                robot: &Cut($robot, counts.bodies),
                counts,
                terms: spec::terms_of(effects),
                parts: &spec::parts(effects, &body),
                rows,
            })
        };
    }
    match model {
        Fast::Chain(model) => match model.as_revolute_chain() {
            Some(chain) => run!(&chain),
            None => unreachable!("the model was built as a chain"),
        },
        Fast::Revolute(model) => match model.as_all_revolute() {
            Some(revolute) => run!(&revolute),
            None => unreachable!("the model was built of revolute joints"),
        },
        Fast::None => unreachable!("other models are not built"),
    }
}

/// Computes the rows over a model of any size.
fn over<O: Algorithm, R: Real>(
    algorithm: &O,
    models: &Models<R>,
    setting: Setting<'_>,
    rows: &mut Job<'_, R>,
) -> Result<(), Failure> {
    let Setting { counts, effects, body } = setting;
    let terms: Terms = spec::terms_of(effects);
    let bodies = if O::WHOLE { usize::MAX } else { counts.bodies };
    macro_rules! run {
        ($robot:expr) => {{
            let mut parts = spec::parts(effects, &body);
            if O::WHOLE {
                parts.fill(counts.v);
            }
            if O::TERMS_ALONE && !terms.coriolis {
                parts.stop_base();
            }
            algorithm.all(Call { robot: &Cut($robot, bodies), counts, terms, parts: &parts, rows })
        }};
    }
    if O::FAST && O::fits(terms) {
        match &models.fast {
            Fast::Chain(model) => {
                if let Some(chain) = model.as_revolute_chain() {
                    return run!(&chain);
                }
            }
            Fast::Revolute(model) => {
                if let Some(revolute) = model.as_all_revolute() {
                    return run!(&revolute);
                }
            }
            Fast::None => {}
        }
    }
    let General { small, large } = &models.general;
    match small {
        Some(model) if const { O::SIZES as u8 != Sizes::Large as u8 } => run!(&**model),
        _ if const { O::SIZES as u8 != Sizes::Small as u8 } => run!(&**large),
        _ => unreachable!("modes are of smaller robots"),
    }
}

impl Which<'_> {
    /// The algorithm that is compiled for these terms: without Coriolis, M and its factors stand in
    /// for articulated bodies.
    fn of(self, terms: Terms) -> Self {
        if matches!(self, Self::Aba) && !terms.coriolis { Self::ForwardDynamics } else { self }
    }
}
