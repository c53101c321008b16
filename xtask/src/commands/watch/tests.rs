//! The comparison of runs fails where it should.

use cycle_meter::Sample;

use crate::kit::elf::{Function, Image};

use super::{
    KEPT, LONGEST, MASKED, RECORD, TICKS, every_tick_arrived, longest, masked_nowhere_else, verdict,
};

/// A run whose records take this many instructions.
fn run(record: u64) -> Vec<Sample> {
    let sample = |region, instructions| Sample::of(region, [instructions, instructions, 0]);
    let tick =
        (0..=RECORD).map(|region| sample(region, if region == RECORD { record } else { 50 }));
    let ticks = std::iter::repeat_n(tick, TICKS).flatten();
    ticks.chain([sample(MASKED, LONGEST)]).collect()
}

/// The run with a change to one sample.
fn changed(at: usize, change: impl Fn(&mut Sample)) -> Vec<Sample> {
    let mut run = run(KEPT);
    change(&mut run[at]);
    run
}

#[test]
fn the_guide_states_what_is_checked() {
    let page = include_str!("../../../../docs/guide/src/telemetry.md");
    for words in [
        format!("interrupts masked takes {LONGEST} instructions"),
        format!("takes at most {KEPT} instructions"),
        "runs 3,000 ticks".to_owned(),
    ] {
        assert!(page.contains(&words), "{words}");
    }
    assert_eq!(TICKS, 3000);
}

#[test]
fn a_tick_a_record_or_a_masked_stretch_that_takes_longer_fails() {
    let (kept, full) = (&run(KEPT), &run(KEPT / 2));
    assert_eq!(longest(kept), 50 + KEPT);
    let slower = &changed(7 * 100, |sample| sample.cycles += 1);
    let masked = &changed(7 * TICKS, |sample| sample.instructions += 1);
    let (longer, short) = (&run(KEPT + 1), &kept[..7 * (TICKS - 1)]);
    // Runs with a listener, without one, and with a full queue.
    for (heard, alone, full, why) in [
        (&kept[..], &kept[..], &full[..], None),
        (slower, kept, full, Some("a listener, tick 100")),
        (kept, kept, slower, Some("a full queue, tick 100")),
        (longer, longer, full, Some("")),
        (kept, kept, longer, Some("")),
        (kept, masked, full, Some("")),
        (short, short, short, Some("")),
        (kept, kept, short, Some("")),
    ] {
        let error = verdict(heard, alone, full).err().map(|e| e.to_string());
        let said = error.as_deref().zip(why).map(|(said, why)| said.contains(why));
        assert_eq!(said, why.map(|_| true), "{error:?}");
        assert_eq!(error.is_some(), why.is_some(), "{error:?}");
    }
}

#[test]
fn lost_ticks_bad_frames_and_disturbed_arms_fail() {
    let summary = |ticks: usize, bad: u64, events: &str| {
        every_tick_arrived(&format!(
            r#"{{"ticks":{ticks},"bad_frames":{bad},"dropped":0,"lost":0,"restarts":0,"events":[{events}]}}"#
        ))
    };
    assert!(summary(TICKS, 0, "").is_ok());
    assert!(summary(TICKS - 1, 0, "").is_err() && summary(TICKS, 1, "").is_err());
    let error = summary(TICKS, 0, r#"[8,"hold"]"#).expect_err("a false alarm");
    assert!(error.to_string().contains("disturbed"), "{error}");
    assert!(every_tick_arrived("{}").is_err());
}

#[test]
fn another_ending_of_a_record_is_refused_at_once() {
    let is_taken = |name: &str| super::recorded(name).is_ok();
    assert!(is_taken("run.csv") && is_taken("a/run.mcap"));
    assert!(!is_taken("run.txt") && !is_taken("csv") && !is_taken("run.CSV"));
}

#[test]
fn a_tick_that_masks_interrupts_fails() {
    let image = |name, code| Image::of(vec![Function::of(name, 0x1000, &[code, 0x4770])]);
    let masking = 0xb672;
    assert!(masked_nowhere_else(&image("SysTick", masking)).is_ok());
    assert!(masked_nowhere_else(&image("tick", 0xbf00)).is_ok());
    let error = masked_nowhere_else(&image("tick", masking)).expect_err("it masks");
    assert_eq!(error.to_string(), "`tick` masks interrupts");
}
