type Robot = dynamics_core::robots::So101;
const B: usize = 6;
const N: usize = 6;
