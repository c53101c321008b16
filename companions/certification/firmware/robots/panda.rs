type Robot = dynamics_core::robots::Panda;
const B: usize = 7;
const N: usize = 7;
