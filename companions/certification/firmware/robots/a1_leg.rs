type Robot = dynamics_core::robots::A1Leg;
const B: usize = 4;
const N: usize = 3;
