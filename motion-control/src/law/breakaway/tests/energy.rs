//! The energy that push and dither deliver, for random motions that take as much as they can.

use super::*;

/// A sequence of xorshift, in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The kinds of a motion, with a share of the greatest speed.
#[derive(Clone, Copy)]
enum Kind {
    Stands,
    /// It leaves its place, and then goes along the torque.
    Follows,
    /// It follows the torque within half a count, which is not measured.
    Hides,
    Goes,
    /// Another speed in each tick.
    Shakes,
}
use Kind::*;

const ALL: [Kind; 5] = [Stands, Follows, Hides, Goes, Shakes];
/// The energy of a law, J: less than a tenth of a second of its torque at the greatest speed.
const ENERGY: f64 = 0.05;
const FRICTION: f64 = (1.0 - CONFIG.share) * CONFIG.friction[0];

/// The greatest excess, J, of the delivered energy over `ENERGY` and what friction has absorbed,
/// of laws that have thirty motions each, of 5 to 60 ticks; and the least energy of a law.
fn excess(config: BreakawayConfig<f64, 1>, laws: u32, kinds: &[Kind]) -> [f64; 2] {
    let (mut random, mut most, mut least) = (Random(0x5eed), f64::NEG_INFINITY, f64::INFINITY);
    let farthest = CONFIG.speed[0] * CONFIG.tick;
    for _ in 0..laws {
        let (mut law, mut q, mut hidden) = (law(config), 0.3 * random.next(), 0.0);
        let (mut late, mut delivered, mut absorbed) = (q, 0.0, 0.0);
        for _ in 0..30 {
            let kind = kinds[(kinds.len() as f64 * random.next()) as usize];
            let speed = 2.0 * farthest * (random.next() - 0.5);
            let loses = random.next() < 0.02;
            for tick in 0..5 + (55.0 * random.next()) as u32 {
                // Noise and quantisation of half a count each; what hides is not measured.
                let noise = if hidden == 0.0 { random.next() - 0.5 } else { 0.0 };
                let exact = ((q - hidden) / COUNT + noise).round() * COUNT;
                let now = if config.late { core::mem::replace(&mut late, exact) } else { exact };
                let lost = loses && random.next() < 0.2;
                let [tau] = law.torque(&[if lost { f64::NAN } else { now }]);
                let sign = if tau == 0.0 { 0.0 } else { tau.signum() };
                let step = match kind {
                    Stands | Hides => 0.0,
                    Follows if tick == 0 => 4.5 * COUNT * speed.signum(),
                    Follows => sign * speed.abs(),
                    Goes => speed,
                    Shakes => speed * (2.0 * random.next() - 1.0),
                };
                // The most that hiding takes: half a count to and fro at the greatest torques.
                let place = match kind {
                    Hides if tau.abs() > 0.9 * DITHER => 0.499 * COUNT * sign,
                    Hides => hidden,
                    _ => 0.0,
                };
                let step = (step + place - hidden).clamp(-farthest, farthest);
                hidden = place;
                q += step;
                delivered += tau * step;
                absorbed += FRICTION * step.abs();
                most = most.max(delivered - ENERGY - absorbed);
                least = least.min(law.energy()[0]);
            }
        }
    }
    [most, least]
}

#[test]
fn no_motion_takes_more_than_the_energy_and_what_friction_absorbs() {
    // A hundred thousand motions of all kinds, and some of those that take most.
    for late in [true, false] {
        let config = BreakawayConfig { late, energy: [ENERGY], ..CONFIG };
        for (laws, kinds) in
            [(1700, &ALL[..]), (300, &ALL[..2]), (300, &[Hides]), (300, &[Stands, Goes])]
        {
            let [most, least] = excess(config, laws, kinds);
            println!(
                "late {late}, {} of the kinds: excess {most} J, least energy {least} J",
                kinds.len()
            );
            assert!(most <= 0.0 && least >= -1e-15, "{most} J, {least} J");
        }
    }
}

#[test]
fn without_the_tank_or_its_price_for_the_resolution_the_claim_fails() {
    let endless = BreakawayConfig { energy: [1e9], ..CONFIG };
    for kinds in [&ALL[..2], &[Hides]] {
        let [most, _] = excess(endless, 100, kinds);
        println!("without the tank: {most} J");
        assert!(most > 0.005, "{most} J");
    }
    // Encoders that are sixteen times as coarse as stated.
    let coarse = BreakawayConfig { resolution: COUNT / 16.0, energy: [ENERGY], ..CONFIG };
    let [most, _] = excess(coarse, 100, &[Hides]);
    println!("coarse encoders: {most} J");
    assert!(most > 0.005, "{most} J");
}
