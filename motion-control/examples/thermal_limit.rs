//! A motor that lifts with all that its temperature allows, and what a restart knows of it.
//!
//! `cargo run -p motion-control --example thermal_limit`

use motion_control::{ConfigError, SafetyLimits, ThermalConfig, ThermalLimit, ThermalState};

fn main() -> Result<(), ConfigError> {
    let gate =
        SafetyLimits { torque: [9.0], rate: [4.0], speed: [8.0], lower: [-1.0], upper: [1.0] };
    // From a data sheet: torques behind the gear, times in s, temperatures in °C.
    let motor = ThermalConfig {
        tick: 1e-3,
        continuous: [3.0_f32],
        peak: [9.0],
        winding_time: [12.0],
        housing_time: [600.0],
        share: [0.4], // of the resistance from winding to housing
        hottest: [120.0],
        ambient: 30.0,
    };
    let cold = ThermalState { winding: [0.0], housing: [0.0] };
    let mut thermal = ThermalLimit::try_new(motor, &gate)?.resumed(&cold, 0.0);
    println!("7 N·m can be held for {:.1} s", thermal.holds_for(0, 7.0));

    println!("time, s | limit, N·m | winding, °C");
    for second in 0..=60 {
        if second % 10 == 0 {
            println!("{second:7} | {:10.2} | {:.1}", thermal.torque()[0], thermal.celsius(0));
        }
        for _ in 0..1000 {
            thermal.update(&[thermal.torque()[0]]); // the torque that the drive has in this tick
        }
    }
    assert!(thermal.celsius(0) <= 120.0 && thermal.torque()[0] >= 2.98);

    // Saved before the supply was switched off; else motors are as hot as they may be.
    let saved = thermal.state();
    let unknown = ThermalLimit::try_new(motor, &gate)?;
    let known = unknown.resumed(&saved, 300.0);
    println!("after 5 minutes {:.1} °C, or {:.1}", known.celsius(0), unknown.celsius(0));
    assert!(known.torque()[0] > 2.0 * unknown.torque()[0]);
    Ok(())
}
