//! One robot: every algorithm in both precisions.

use std::borrow::Cow;
use std::error::Error;

use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::recordings::{self, Recording};

use crate::ours::Merged;
use crate::subject::{Row, Subject, interleaved};
use crate::{Manifest, foreign, ours};

/// States in a timed batch; the recording is gone through again until there are enough of them. The
/// matrices of a G1 then fit into a cache of 1 MiB, as the one of a control loop does; those of 256
/// states did not, and times differed by a fifth between starts.
const BATCH: usize = 64;

/// Ours in f64, and in f32 if that is compared, over a robot that is known while compiling.
pub type Known<const Q: usize, const V: usize> =
    (ours::Subjects<f64, Q, V>, Option<ours::Subjects<f32, Q, V>>);

/// Checks, times and prints these algorithms of a robot of B bodies, of which M move.
pub fn run<T, const B: usize, const M: usize, const Q: usize, const V: usize>(
    manifest: &Manifest,
    algorithms: &[&str],
    (double, single): Known<Q, V>,
) -> Result<(), Box<dyn Error>>
where
    T: Robot<B, Q, V>,
{
    let recording = &recordings::load(T::MODEL.name);
    for algorithm in algorithms {
        one(manifest, recording, algorithm, "f64", |states| {
            let mut subjects = double(algorithm, states);
            subjects.extend(ours::run_time::<Merged<T, B>, f64, M, Q, V>(algorithm, states));
            subjects
        })?;
        if let Some(single) = single {
            one(manifest, recording, algorithm, "f32", |states| {
                let mut subjects = single(algorithm, states);
                subjects.extend(ours::run_time::<Merged<T, B>, f32, M, Q, V>(algorithm, states));
                subjects
            })?;
        }
    }
    Ok(())
}

fn one<R: Real, const Q: usize, const V: usize>(
    manifest: &Manifest,
    recording: &Recording,
    algorithm: &str,
    precision: &str,
    own: impl Fn(&[State<R, Q, V>]) -> Vec<Subject<R>>,
) -> Result<(), Box<dyn Error>> {
    let theirs = foreign::their_order(recording.model.bodies.iter().map(|body| &*body.joint));
    // Ours first.
    let gather = |states: &[State<R, Q, V>]| -> Result<Vec<Subject<R>>, Box<dyn Error>> {
        let mut subjects = own(states);
        for foreign in &manifest.foreign {
            let key = (&*foreign.robot, &*foreign.algorithm, &*foreign.precision);
            if key == (&*recording.robot, algorithm, precision) {
                subjects.push(foreign.load(states, &theirs)?);
            }
        }
        Ok(subjects)
    };
    let (expected, full_scale) = expected(recording, algorithm);
    let states = states(recording, algorithm, expected.len());
    let mut checked = gather(&states)?;
    let mut errors = Vec::new();
    for subject in &mut checked {
        let bound = bound(algorithm, precision, recording.condition);
        let error = subject.check(states.len(), &expected, full_scale, bound);
        errors.push(error.map_err(|e| format!("{algorithm} of {}: {e}", recording.robot))?);
    }
    let states = self::states(recording, algorithm, BATCH);
    print([&recording.robot, algorithm, precision], gather(&states)?, BATCH, errors)
}

/// Times subjects on this many states, and prints robot, algorithm and precision with their times
/// and errors.
pub fn print<R: Real>(
    [robot, algorithm, precision]: [&str; 3],
    mut subjects: Vec<Subject<R>>,
    states: usize,
    errors: Vec<f64>,
) -> Result<(), Box<dyn Error>> {
    let mut timed: Vec<_> = subjects.iter_mut().filter(|subject| subject.timed).collect();
    let mut times = interleaved(&mut timed, states).into_iter();
    for (subject, error) in std::iter::zip(&subjects, errors) {
        let row = Row {
            robot,
            algorithm,
            peer: &subject.peer,
            precision,
            error,
            ns: if subject.timed { times.next() } else { None },
        };
        println!("{}", serde_json::to_string(&row)?);
    }
    Ok(())
}

/// This number of recorded states; for forward dynamics the torque takes the place of q̈.
fn states<R: Real, const Q: usize, const V: usize>(
    recording: &Recording,
    algorithm: &str,
    count: usize,
) -> Vec<State<R, Q, V>> {
    let last = if algorithm == "aba" { &recording.tau } else { &recording.qdd };
    let rates = |rows: &[Vec<f64>], k| recordings::row::<V>(rows, k).map(R::from_f64);
    (0..recording.q.len())
        .cycle()
        .take(count)
        .map(|k| State {
            q: recordings::row(&recording.q, k).map(R::from_f64),
            qd: rates(&recording.qd, k),
            qdd: rates(last, k),
        })
        .collect()
}

/// Pinocchio's results, and their full scale.
fn expected<'a>(recording: &'a Recording, algorithm: &str) -> (Cow<'a, [Vec<f64>]>, f64) {
    let scale = &recording.full_scale;
    let (rows, scale) = match algorithm {
        "gradient" => {
            let both = recording.rnea_by_q.iter().zip(&recording.rnea_by_qd);
            let rows: Vec<_> = both.map(|(q, qd)| [&q[..], qd].concat()).collect();
            let scale = recordings::full_scale(&rows);
            return (rows.into(), scale);
        }
        "rnea" => (&recording.rnea, scale.rnea),
        "bias" => (&recording.bias, scale.bias),
        "gravity" => (&recording.gravity, scale.gravity),
        "crba" => (&recording.mass_matrix, scale.mass_matrix),
        "osim" => {
            let rows = &recording.operational_inverse;
            (rows, recordings::full_scale(rows))
        }
        _ => (&recording.aba, scale.aba),
    };
    (rows.into(), scale)
}

/// Largest error of a function that is worth timing, relative to full scale. Forward dynamics and
/// Λ⁻¹ are ill-conditioned: their rounding errors are those of the mass matrix's inverse, up to
/// κ(M) of those of a number.
fn bound(algorithm: &str, precision: &str, condition: f64) -> f64 {
    match (algorithm, precision) {
        ("aba" | "osim", "f32") => 1e-3,
        (_, "f32") => 1e-5,
        ("aba" | "osim", _) => f64::max(1e-11, condition * f64::EPSILON / 2.0),
        _ => 1e-12,
    }
}
