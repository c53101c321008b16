//! The Delta robot near its home.

use firmware_demo::robots::Delta;

use super::Machine;

impl Machine<10, 22, 21, 6, 18, 3> for Delta {
    const HOME: [f64; 22] = {
        let (crank, rod) = (0.2, 0.7);
        let mut home = [0.0; 22];
        (home[3], home[6]) = (1.0, -0.33);
        let mut side = 0;
        while side < 3 {
            let first = 7 + 5 * side;
            (home[first], home[first + 1], home[first + 3]) = (crank, rod, rod);
            side += 1;
        }
        home
    };
    const RANGE: f64 = 0.4;
    const ACTUATED_Q: [usize; 3] = [7, 12, 17];
}
