//! States of the joints, and their exact torques.

use dynamics_core::state::State;
use host_tests::random::within;
use proptest::test_runner::TestRng;

/// A desired state of the joints, and its exact torques.
pub struct Problem<const N: usize> {
    pub state: State<f32, N, N>,
    pub truth: [f64; N],
}

/// Random positions, speeds and accelerations within ± these bounds.
pub fn drawn<const N: usize>(random: &mut TestRng, bounds: [f64; 3]) -> State<f32, N, N> {
    let [q, qd, qdd] = bounds.map(|bound| within::<N>(random, bound).map(|x| x as f32));
    State { q, qd, qdd }
}
