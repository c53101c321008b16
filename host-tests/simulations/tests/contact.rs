//! Claims about a UR5e that finds contacts without sensors, in f32 as in firmware.

use simulation_tests::contact::crash::{FRICTIONS, RESPONSES, STIFFNESSES};
use simulation_tests::contact::watch::{LAPS, LATER, PEAK, WATCHES, required, worst};

// It is relieved half a second later, with either friction.
#[test]
fn a_contact_peaks_below_its_bar_and_is_relieved() {
    for friction in FRICTIONS {
        for stiffness in STIFFNESSES {
            for (number, (name, response)) in RESPONSES.into_iter().enumerate() {
                let worst = worst(friction, stiffness, number);
                println!("{friction} {stiffness} {name}: {worst:?}");
                assert!(worst.early == 0 && worst.found <= 40, "{worst:?}");
                let [later, after] = worst.later;
                match response {
                    Some(_) => assert!(
                        worst.peak <= PEAK && later <= LATER && after <= LATER,
                        "{worst:?}"
                    ),
                    None => assert!(worst.peak > 1.5 && later > 200.0, "{worst:?}"),
                }
            }
        }
    }
}

#[test]
fn pushes_at_shoulder_and_wrist_are_found_within_their_bars() {
    for watch in &WATCHES[..2] {
        for delays in watch.delays(4) {
            let longest = delays.last().copied();
            println!("{watch:?}: {longest:?} of {} ms", required(watch.bits));
            assert!(
                longest.is_some_and(|ticks| ticks <= required(watch.bits)),
                "{watch:?}"
            );
        }
    }
}

// The motion is the pick and place.
#[test]
fn a_hundred_thousand_ticks_have_no_false_alarm() {
    let [ticks, found] = WATCHES[0].alarms(LAPS.div_ceil(10));
    assert!(ticks >= 100_000 && found == 0, "{found} in {ticks}");
}

#[cfg(feature = "full")]
#[test]
fn a_million_ticks_have_no_false_alarm() {
    let [ticks, found] = WATCHES[0].alarms(LAPS);
    assert!(ticks >= 1_000_000 && found == 0, "{found} in {ticks}");
}

// Stated stiction gives none.
#[test]
fn unstated_stiction_gives_false_alarms() {
    let [_, stated] = WATCHES[2].alarms(10);
    let [_, sliding] = WATCHES[4].alarms(10);
    assert!(stated == 0 && sliding > 1000, "{stated} {sliding}");
}
