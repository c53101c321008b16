//! The bar.

use crate::plant::*;
use crate::setup::*;
use identification::*;

#[test]
fn explore() {
    let chosen = &*CHOSEN;
    println!("cond {}", chosen.condition);
    let mut ok = [0; 4];
    let mut z2 = [0.0; 4];
    let mut n = 0;
    for seed in 0..30 {
        let truth = Parameters::off(seed);
        let run = Run::new(&chosen.motion, &truth, Friction::Modelled);
        let rec = run.recorded(NOISE, seed + 1000);
        for (k, harmonics) in [30, 50, 75, 100].into_iter().enumerate() {
            let found = Batch::new(harmonics, TICK).identify(&*ARM, &rec).unwrap();
            if seed == 0 {
                for h in (0..=harmonics).step_by(10) {
                    println!("{h} {:.3?}", found.noise[h]);
                }
                println!("{}", found.condition);
            }
            for ((b, d), x) in found.base.iter().zip(&found.deviations).zip(truth.base()) {
                let z: f64 = (b - x) / d;
                if z.abs() < 2.0 {
                    ok[k] += 1;
                }
                z2[k] += z * z;
            }
        }
        n += ARM.len();
    }
    println!(
        "{:.4?} {:.4?}",
        ok.map(|o| o as f64 / n as f64),
        z2.map(|z| (z / n as f64).sqrt())
    );
}
