//! A trial: a plant under a law that may lack a term, from a start to an outcome.

use dynamics_core::model::JointLimits;
use joint_drivers::Telemetry;
use motion_control::limits::Status;

/// The accuracy of the controller's model of the plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlantModel {
    Exact,
    /// Its inertias are off by up to 3 %, its friction by up to 10 %.
    Mismatched,
}

impl PlantModel {
    /// Its name in the log.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Mismatched => "mismatched",
        }
    }
}

/// A term of a law, as the log names it.
#[derive(Clone, Copy, Debug)]
pub struct Term {
    pub name: fn() -> &'static str,
    /// The bytes of its value where it is kept in RAM, as in the plant.
    pub bytes: usize,
}

/// The term that a law lacks, by its number in [`Trial::TERMS`]; the numbers behind them are sets of
/// terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Less(pub u8);

impl Less {
    pub const NOTHING: Self = Self(u8::MAX);

    /// The law's name in the log, in two parts: the one of a term that is left out alone, else
    /// `law`.
    pub fn name(self, terms: &[Term], law: &'static str) -> [&'static str; 2] {
        let term = terms.get(usize::from(self.0));
        term.map_or(["", law], |term| ["without-", (term.name)()])
    }
}

/// A plant with `N` motors under a law.
pub trait Trial<const N: usize> {
    /// The name on the command line.
    const NAME: &'static str;
    /// s.
    const TICK: f32;
    /// The largest error of the whole law on the exact plant.
    const BOUND: f32;
    const LIMITS: [JointLimits<f32>; N];
    /// The terms of the law, each of which is left out once.
    const TERMS: &'static [Term];

    /// The ticks of a run.
    fn ticks(&self) -> u32;
}

/// The figures of a run that every log has: of one error.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    pub rms: f32,
    pub max: f32,
    /// The greatest force that starts a motion, N.
    pub start: Option<f32>,
    pub status: Option<Status>,
}

/// A trial of another kind than those of a scene: the name of its law, and what makes it.
pub type Other<T> = (&'static str, fn() -> T);

/// A trial that is no [`Scene`](super::Scene), having no trajectory: it runs to its end in one call.
pub trait Batch<const N: usize>: Trial<N> + Sized {
    type Outcome;
    /// The terms that the law lacks with which it is compared.
    const BASELINE: Less;
    /// A run of another kind.
    const OTHER: Option<Other<Self>> = None;

    fn of_scene(less: Less, plant: PlantModel) -> Self;

    /// Runs it; nothing if there were no such law, or if the plant had no forward dynamics. Each
    /// tick is seen, with the error after it if it is known.
    fn run<F: FnMut(&Telemetry<N>, f32)>(&self, see: F) -> Option<Self::Outcome>;

    fn figures(outcome: &Self::Outcome) -> Figures;

    /// The address of the function that is called each tick.
    fn tick_at<F: FnMut(&Telemetry<N>, f32)>(_: &F) -> usize;
}
