//! Inverse dynamics by `Engine`, the form that is specialised to a robot at compile time, over rows
//! of numbers.
//!
//! A scene of the engine is known to the compiler: the wheel has that of rigid bodies, which is that
//! of bias and of gravity where rates are zero, but for the signs of zeros.

use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::robots::{A1, A1Free, A1Leg, Gen3, Iiwa14, Panda, So101, Ur5e, XArm7, Z1};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use robot_dynamics_kernels::job::{Job, One, Row};

/// A scalar in which the engines are compiled.
pub trait InEngine: Real {
    /// The function that computes the rows of a robot, if the wheel has an engine for it.
    fn engine(robot: &str) -> Option<fn(&mut Job<'_, Self>)>;
}

fn rows<T: Robot<B, Q, V>, R: Real, const B: usize, const Q: usize, const V: usize>(
    job: &mut Job<'_, R>,
) {
    let given = job.inputs.len();
    for row in 0..job.rows {
        let mut one = One { job, row };
        let part = |input| match input < given {
            true => std::array::from_fn(|i| one.get(input, i)),
            false => [R::ZERO; V],
        };
        let state = State {
            q: std::array::from_fn::<R, Q, _>(|i| one.get(0, i)),
            qd: part(1),
            qdd: part(2),
        };
        let tau = Engine::<T>::rnea(&state, &RIGID_BODY);
        for (i, tau) in tau.into_iter().enumerate() {
            one.put(0, i, tau);
        }
    }
}

macro_rules! engines {
    ($r:ty: $($name:literal $robot:ident $b:literal $q:literal $v:literal),* $(,)?) => {
        impl InEngine for $r {
            fn engine(robot: &str) -> Option<fn(&mut Job<'_, Self>)> {
                match robot {
                    $($name => Some(rows::<$robot, $r, $b, $q, $v>),)*
                    _ => None,
                }
            }
        }
    };
}

macro_rules! all {
    ($($r:ty),*) => {$(
        engines! {
            $r:
            "ur5e" Ur5e 6 6 6,
            "panda" Panda 7 7 7,
            "iiwa14" Iiwa14 7 7 7,
            "a1" A1 16 12 12,
            "a1_leg" A1Leg 4 3 3,
            "a1_free" A1Free 17 19 18,
            "gen3" Gen3 7 7 7,
            "so101" So101 6 6 6,
            "xarm7" XArm7 7 7 7,
            "z1" Z1 7 7 7,
        }
    )*};
}

all!(f32, f64);
