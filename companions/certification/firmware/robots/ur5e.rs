type Robot = dynamics_core::robots::Ur5e;
const B: usize = 6;
const N: usize = 6;
