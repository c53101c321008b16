type Robot = dynamics_core::robots::Iiwa14;
const B: usize = 7;
const N: usize = 7;
