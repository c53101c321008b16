//! The rows of a call: what an algorithm reads and writes, and the threads that compute them.

use std::num::NonZero;
use std::sync::LazyLock;
use std::thread;

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::clusters::ClusterProblem;
use dynamics_core::drivetrain::MultiDofJoint;
use dynamics_core::flexible::FlexibleError;
use dynamics_core::loops::LoopError;
use dynamics_core::scalar::Real;
use dynamics_core::state::all_finite;
use dynamics_core::state::manifold::NoAttitude;

/// An array of arguments, in row-major order.
#[derive(Clone, Copy)]
pub struct Input<'a, R> {
    /// All numbers of the array.
    pub data: &'a [R],
    /// The numbers of a row.
    pub width: usize,
}

/// A row-major array to be written.
pub struct Output<'a, R> {
    /// All numbers of the array.
    pub data: &'a mut [R],
    /// The numbers of a row.
    pub width: usize,
}

/// The arrays that an algorithm reads and writes for many states.
pub struct Job<'a, R> {
    /// The arrays of the arguments.
    pub inputs: Vec<Input<'a, R>>,
    /// The arrays of the results.
    pub outputs: Vec<Output<'a, R>>,
    /// The number of states.
    pub rows: usize,
}

/// Why a state has no result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Problem {
    /// M is not positive definite at a velocity coordinate.
    Singular(NotPositiveDefinite),
    /// An algorithm for joints of one coordinate, and a body on another joint.
    Joint(MultiDofJoint),
    /// A quaternion without a direction.
    Attitude(NoAttitude),
    /// Loops; M not positive definite is [`Problem::Singular`].
    Loop(LoopError),
    /// A linkage by its number, or none.
    Linkage(usize, ClusterProblem),
    /// A linkage by its number, with an angle of which sines are not computed.
    Angle(usize, f64),
    /// A robot with links that bend.
    Flexible(FlexibleError),
}

macro_rules! problems {
    ($($name:ident $of:ident),*) => {$(
        impl From<$of> for Problem {
            fn from(error: $of) -> Self {
                Self::$name(error)
            }
        }
    )*};
}

problems!(Singular NotPositiveDefinite, Joint MultiDofJoint, Attitude NoAttitude, Flexible FlexibleError);

impl From<LoopError> for Problem {
    fn from(error: LoopError) -> Self {
        match error {
            LoopError::NotPositiveDefinite(error) => Self::Singular(error),
            error => Self::Loop(error),
        }
    }
}

impl From<(usize, ClusterProblem)> for Problem {
    fn from((linkage, problem): (usize, ClusterProblem)) -> Self {
        Self::Linkage(linkage, problem)
    }
}

/// A state without a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// The number of the state.
    pub row: usize,
    /// The reason why it has no result.
    pub problem: Problem,
}

impl Failure {
    /// The same row of a job that begins so many rows later.
    pub(crate) fn after(self, rows: usize) -> Self {
        Self { row: self.row + rows, ..self }
    }
}

/// Fewer states than this per thread are computed sooner by one.
const ROWS_PER_THREAD: usize = 512;

/// One state's numbers, as an algorithm sees them.
pub trait Row<R> {
    /// Number `column` of argument `input`.
    fn get(&self, input: usize, column: usize) -> R;
    /// Writes number `column` of result `output`.
    fn put(&mut self, output: usize, column: usize, value: R);
    /// Makes all results NaN if an argument is not finite, and says whether it is so. Several
    /// states at once are never marked: a block without a result is computed again state by state.
    fn mark(&mut self) -> bool {
        false
    }
}

/// Rows that are computed one after the other.
pub trait Rows<R> {
    /// The number of rows.
    fn count(&self) -> usize;
    /// The row with this number.
    fn at(&mut self, row: usize) -> impl Row<R>;
}

impl<R: Real> Rows<R> for Job<'_, R> {
    fn count(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn at(&mut self, row: usize) -> impl Row<R> {
        One { job: self, row }
    }
}

/// One row of a job.
pub struct One<'j, 'a, R> {
    /// The job that has the row.
    pub job: &'j mut Job<'a, R>,
    /// The number of the row.
    pub row: usize,
}

impl<R: Real> Row<R> for One<'_, '_, R> {
    #[inline(always)]
    fn get(&self, input: usize, column: usize) -> R {
        let Input { data, width } = self.job.inputs[input];
        data[self.row * width + column]
    }

    #[inline(always)]
    fn put(&mut self, output: usize, column: usize, value: R) {
        let Output { data, width } = &mut self.job.outputs[output];
        data[self.row * *width + column] = value;
    }

    fn mark(&mut self) -> bool {
        let row = self.row;
        let own = |width: usize| row * width..(row + 1) * width;
        let mut inputs = self.job.inputs.iter();
        if inputs.all(|input| all_finite(&input.data[own(input.width)])) {
            return false;
        }
        for output in &mut self.job.outputs {
            output.data[own(output.width)].fill(R::from_f64(f64::NAN));
        }
        true
    }
}

impl<R: Copy + Send + Sync> Job<'_, R> {
    /// Computes all rows, on all cores if there are many. `part` computes the rows of a part of the
    /// job.
    ///
    /// # Errors
    /// The first row that cannot be computed.
    pub fn compute(
        mut self,
        part: impl Fn(&mut Job<'_, R>) -> Result<(), Failure> + Sync,
    ) -> Result<(), Failure> {
        let most = self.rows / ROWS_PER_THREAD;
        let threads = if most > 1 { most.min(cores()) } else { 1 };
        if threads == 1 {
            return part(&mut self);
        }
        // A multiple of the rows that are computed at once.
        let length = self.rows.div_ceil(threads).next_multiple_of(16);
        let part = &part;
        thread::scope(|scope| {
            let (mut running, rows, mut rest) = (Vec::new(), self.rows, self);
            for first in (0..rows).step_by(length) {
                let (mut job, after) = rest.split(length.min(rows - first));
                rest = after;
                running
                    .push(scope.spawn(move || part(&mut job).map_err(|error| error.after(first))));
            }
            let finished = running.into_iter().map(|thread| match thread.join() {
                Ok(result) => result,
                Err(panic) => std::panic::resume_unwind(panic),
            });
            let results: Vec<_> = finished.collect();
            results.into_iter().collect()
        })
    }

    /// The rows from `first` to `end`.
    pub(crate) fn part(&mut self, first: usize, end: usize) -> Job<'_, R> {
        let outputs = self
            .outputs
            .iter_mut()
            .map(|output| Output { data: &mut *output.data, width: output.width });
        let all = Job { inputs: self.inputs.clone(), outputs: outputs.collect(), rows: self.rows };
        all.split(first).1.split(end - first).0
    }
}

impl<'a, R: Copy> Job<'a, R> {
    /// The first so many rows, and the others.
    fn split(self, rows: usize) -> (Self, Self) {
        let inputs = self.inputs.into_iter().map(|Input { data, width }| {
            let (first, rest) = data.split_at(rows * width);
            (Input { data: first, width }, Input { data: rest, width })
        });
        let outputs = self.outputs.into_iter().map(|Output { data, width }| {
            let (first, rest) = data.split_at_mut(rows * width);
            (Output { data: first, width }, Output { data: rest, width })
        });
        let ((inputs, more), (outputs, rest)) = (inputs.unzip(), outputs.unzip());
        let of = |inputs, outputs, rows| Job { inputs, outputs, rows };
        (of(inputs, outputs, rows), of(more, rest, self.rows - rows))
    }
}

/// The number of threads that a batch uses.
pub fn cores() -> usize {
    // To ask the operating system takes longer than a state.
    static CORES: LazyLock<usize> =
        LazyLock::new(|| thread::available_parallelism().map_or(1, NonZero::get));
    *CORES
}
