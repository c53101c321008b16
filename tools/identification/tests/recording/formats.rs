//! Logs in the formats of public projects give the parameters that the same samples give in the
//! project's own format, and each mistake in them is named.

use std::collections::BTreeMap;

use identification::files::map::Map;
use identification::files::mistakes::Mistake;
use identification::files::report::Findings;
use identification::files::run::{JointEffect, Options};

use crate::arm::OPTIONS;
use crate::logs::*;

const CURRENTS: &str = "torque_constant = 0.0088\ngear = 345\n";

/// A format: its times, its text, and what a map adds.
struct Format {
    name: &'static str,
    times: fn() -> Vec<f64>,
    rate: f64,
    text: fn(&Samples) -> Vec<u8>,
    map: Option<String>,
}

const SECONDS: f64 = 24.0;

fn formats() -> [Format; 5] {
    let degrees = "time = \"timestamp\"\ntime_unit = \"s\"\nposition = \"{joint}.pos\"\nposition_unit = \"deg\"\n";
    let by_number = "time = \"timestamp\"\ntime_unit = \"s\"\nposition = \"actual_q_{index}\"\nposition_unit = \"rad\"\n\
                torque = \"actual_current_{index}\"\ntorque_unit = \"A\"\n";
    let by_bracket = "time = \"time\"\ntime_unit = \"ms\"\nposition = \"q[{index}]\"\nposition_unit = \"rad\"\n\
                  torque = \"tau_J[{index}]\"\ntorque_unit = \"Nm\"\n";
    [
        Format {
            name: "LeRobot",
            times: || uneven(30.0, 3.0 * SECONDS, 1e-3, 0.0, 0.0),
            rate: 30.0,
            text: |samples| lerobot(samples).into(),
            map: Some(format!("{degrees}torque = \"{{joint}}.torque\"\ntorque_unit = \"Nm\"\n")),
        },
        Format {
            name: "rosbag2",
            times: || uneven(200.0, SECONDS, 3e-4, 0.002, 0.0),
            rate: 200.0,
            text: bag,
            map: None,
        },
        Format {
            name: "RTDE",
            times: || even(125.0, SECONDS).collect(),
            rate: 125.0,
            text: |samples| rtde(samples).into(),
            map: Some(format!("{by_number}{CURRENTS}")),
        },
        Format {
            name: "libfranka",
            times: || even(500.0, SECONDS).collect(),
            rate: 500.0,
            text: |samples| franka(samples).into(),
            map: Some(by_bracket.to_owned()),
        },
        Format {
            name: "SO-101's bus",
            times: || uneven(250.0, SECONDS, 2e-4, 0.005, 0.003),
            rate: 250.0,
            text: |samples| bus(samples).into(),
            map: Some(format!(
                "{degrees}torque = \"{{joint}}.current_mA\"\ntorque_unit = \"mA\"\n{CURRENTS}"
            )),
        },
    ]
}

impl Format {
    fn found(&self, wrong: Wrong) -> Findings {
        let text = (self.text)(&samples((self.times)().into_iter(), wrong));
        let recorded = read(&text, self.map.as_deref()).expect("a log");
        identified(&recorded, &OPTIONS())
    }

    /// The arm in the project's own format at the same rate. There a torque is held for a tick.
    fn converted(&self) -> Findings {
        let seconds = (self.times)().last().copied().expect("times");
        let text =
            own(&samples(even(self.rate, seconds), Wrong { late: -0.5 / self.rate, ..RIGHT }));
        identified(&read(text.as_bytes(), None).expect("a record"), &OPTIONS())
    }
}

#[test]
fn five_formats_give_what_the_converted_file_gives() {
    for format in formats() {
        let [found, converted] = [format.found(RIGHT), format.converted()];
        let text = found.text();
        assert_eq!(
            (found.mistake.clone(), found.joints.len()),
            (None, V),
            "{}: {text}",
            format.name
        );
        for (own, other) in found.parameters.iter().zip(&converted.parameters) {
            let deviation = own.deviation.hypot(other.deviation);
            let off = (own.found - other.found).abs() / deviation;
            assert!(off < 4.0, "{}: {}, {off} deviations", format.name, own.name);
        }
        let [own, other] = [found.worst(), converted.worst()].map(|worst| worst.expect("joints").1);
        assert!(own < 1.15 * other + 0.005, "{}: {own} {other}", format.name);
        for (joint, truth) in found.joints.iter().zip(COULOMB) {
            assert!((joint.after[1] / truth - 1.0).abs() < 0.15, "{}: {joint:?}", format.name);
        }
        assert!(found.kinds.is_empty(), "{}: {:?}", format.name, found.kinds);
    }
}

#[test]
fn each_mistake_is_named_in_a_format() {
    let [lerobot, rosbag, rtde, franka, bus] = formats();
    let reversed = franka.found(Wrong { reversed: true, ..RIGHT });
    let sign = Mistake::TorqueSign { joints: vec!["elbow_flex".to_owned()] };
    assert_eq!(reversed.mistake, Some(sign));
    match bus.found(Wrong { shift: 0.2, ..RIGHT }).mistake {
        Some(Mistake::Zero { shifts }) => {
            let [(joint, shift)] = &shifts[..] else { panic!("{shifts:?}") };
            assert!(joint == "shoulder_lift" && (shift + 0.2).abs() < 0.06, "{joint} {shift}");
        }
        other => panic!("{other:?}"),
    }
    match rosbag.found(Wrong { factor: 1e3, ..RIGHT }).mistake {
        Some(Mistake::Unit { factor }) => assert!((factor / 1e3).ln().abs() < 0.5, "{factor}"),
        other => panic!("{other:?}"),
    }
    let late = rtde.found(Wrong { late: 0.02, ..RIGHT });
    assert!((late.delay + 0.02).abs() < 4e-3, "{}", late.delay);
    assert!(late.text().contains("the torques lag behind the positions by"), "{}", late.text());
    // Degrees that a map takes as radians.
    for format in [lerobot, bus] {
        let text = (format.text)(&samples((format.times)().into_iter(), RIGHT));
        let map = format.map.unwrap_or_default().replace("\"deg\"", "\"rad\"");
        let error = tried(&read(&text, Some(&map)).expect("a log")).expect_err("degrees");
        assert!(error.to_string().contains("are the positions in degrees?"), "{error}");
    }
}

#[test]
fn friction_that_the_model_lacks_is_named_and_identified() {
    let [.., bus] = formats();
    let found = bus.found(Wrong { stribeck: 0.8, ..RIGHT });
    assert_eq!(found.mistake, None);
    let first: Vec<&str> = found.kinds.iter().map(|one| one.joint.as_str()).collect();
    assert!(first.contains(&"gripper"), "{:?}", found.kinds);
    assert!(found.kinds.iter().all(|one| one.effect == JointEffect::Stribeck), "{:?}", found.kinds);
    assert!(found.text().contains("Stribeck's effect below some"), "{}", found.text());
    assert!(found.text().contains("are no noise"), "{}", found.text());
    let text = (bus.text)(&samples((bus.times)().into_iter(), Wrong { stribeck: 0.8, ..RIGHT }));
    let recorded = read(&text, bus.map.as_deref()).expect("a log");
    let mut options: Options = OPTIONS();
    options.effects.push(JointEffect::Stribeck);
    let better = identified(&recorded, &options);
    assert_eq!(better.stribeck_speed, Some(0.16), "{}", better.text());
    assert!(better.kinds.is_empty(), "{:?}", better.kinds);
    for (joint, coulomb) in better.joints.iter().zip(COULOMB) {
        assert!((joint.after[4] / (0.8 * coulomb) - 1.0).abs() < 0.4, "{joint:?}");
    }
}

#[test]
fn what_is_missing_is_named_at_once_and_no_unit_is_guessed() {
    let samples = samples(even(250.0, 1.0), RIGHT);
    let refused = |text: &str, map: Option<&str>| {
        read(text.as_bytes(), map).expect_err("a map that lacks something").to_string()
    };
    // A known layout whose units are not.
    let error = refused(&bus(&samples), None);
    for part in
        ["time_unit = \"s\"", "position_unit = \"rad\" (one of rad, deg", "torque_constant = …"]
    {
        assert!(error.contains(part), "{part}: {error}");
    }
    let error = refused(
        &bus(&samples).replacen("gripper.pos", "griper.pos", 1).replacen("wrist_roll", "roll", 2),
        Some(formats()[4].map.as_deref().expect("a map")),
    );
    for part in [
        "`gripper.pos` (did you mean `griper.pos`?)",
        "`wrist_roll.pos`",
        "it has timestamp, shoulder_pan.pos",
    ] {
        assert!(error.contains(part), "{part}: {error}");
    }
    for (map, part) in [
        ("torque_units = \"Nm\"", "unknown field `torque_units`"),
        ("gear = \"345\"", "invalid type"),
        ("position = ", "TOML parse error"),
    ] {
        let error = Map::of(map).expect_err(map);
        assert!(error.contains(part), "{error}");
    }
    let map = formats()[4].map.clone().expect("a map") + "[joint.griper]\nsign = -1\n";
    let error = refused(&bus(&samples), Some(&map));
    assert!(
        error.contains("no joint `griper` for [joint.griper]; did you mean `gripper`?"),
        "{error}"
    );
}

/// The first chunk of a file, compressed by zstd under a name, as the only one.
fn compressed(whole: &[u8], name: &str) -> Vec<u8> {
    let number = |at: usize| u64::from_le_bytes(whole[at..at + 8].try_into().expect("8")) as usize;
    let mut at = mcap::MAGIC.len();
    let mut out = whole[..at + 9 + number(at + 1)].to_vec();
    while at + 9 < whole.len() {
        let (op, length) = (whole[at], number(at + 1));
        if op == mcap::records::op::CHUNK {
            // Times, size, checksum, no name of a compression, and the length of the records.
            let records = &whole[at + 9 + 40..at + 9 + length];
            let level = ruzstd::encoding::CompressionLevel::Fastest;
            let small = ruzstd::encoding::compress_to_vec(records, level);
            let named = [&(name.len() as u32).to_le_bytes(), name.as_bytes()].concat();
            let body = [
                &whole[at + 9..at + 37],
                &[0; 0],
                &named,
                &(small.len() as u64).to_le_bytes(),
                &small,
            ];
            // Without a checksum.
            let mut body = body.concat();
            body[24..28].fill(0);
            out.push(op);
            out.extend((body.len() as u64).to_le_bytes());
            out.extend(body);
        } else if [mcap::records::op::DATA_END, mcap::records::op::FOOTER].contains(&op) {
            let mut own = whole[at..at + 9 + length].to_vec();
            own[9..].fill(0);
            out.extend(own);
        }
        at += 9 + length;
    }
    [&out, mcap::MAGIC].concat()
}

#[test]
fn a_file_of_mcap_that_is_damaged_or_compressed_is_read_or_refused() {
    let whole = bag(&samples(even(200.0, 20.0), RIGHT));
    assert_eq!(read(&whole, None).expect("a bag").stretches[0].len(), 4000);
    for cut in [9, 100, whole.len() / 2, whole.len() - 9] {
        assert!(read(&whole[..cut], None).is_err());
    }
    let mut rng = fastrand::Rng::with_seed(1);
    for _ in 0..200 {
        let mut damaged = whole.clone();
        (0..20).for_each(|_| damaged[rng.usize(..whole.len() / 50)] = rng.u8(..));
        let _ = read(&damaged, None);
    }
    let zstd = compressed(&whole, "zstd");
    assert_eq!(read(&zstd, None).expect("a bag"), read(&whole, None).expect("a bag"));
    let error = read(&compressed(&whole, "lz4"), None).expect_err("another way").to_string();
    assert!(error.contains("compressed by lz4; `mcap compress --compression zstd`"), "{error}");
    let error = read(&whole, Some("topic = \"/other\"")).expect_err("no such topic").to_string();
    assert!(error.contains("no topic `/other`") && error.contains("/joint_states"), "{error}");
}

#[test]
fn jitter_changes_torques_by_less_than_is_stated() {
    let times = uneven(250.0, SECONDS, 8e-4, 0.0, 0.0);
    let text = own(&samples(times.into_iter(), RIGHT));
    let recorded = read(text.as_bytes(), None).expect("a record");
    assert!(recorded.sampling.is_resampled && recorded.sampling.jitter[1] < 0.45);
    let [stated, _] = recorded.sampling.error(8.8, recorded.tick);
    assert!(stated < 1e-3, "{stated}");
    // Against samples without jitter: the noise and the counts remain.
    let found = identified(&recorded, &OPTIONS());
    let even = own(&samples(even(250.0, SECONDS), RIGHT));
    let other = identified(&read(even.as_bytes(), None).expect("a record"), &OPTIONS());
    for (own, other) in found.joints.iter().zip(&other.joints) {
        let [own, other] = [own, other].map(|joint| joint.fitted.residuals[1].rms);
        assert!((own / other - 1.0).abs() < 0.1, "{own} {other}");
    }
}

#[test]
fn decimal_commas_units_and_comments_are_read() {
    let map = formats()[4].map.clone().expect("a map");
    let plain = bus(&samples(even(250.0, 1.0), RIGHT));
    let (titles, rows) = plain.split_once('\n').expect("titles");
    let commas = rows.replace('.', ",");
    let units = titles.split(';').map(|_| "unit").collect::<Vec<_>>().join(";");
    let expected = read(plain.as_bytes(), Some(&map)).expect("a log");
    for text in [
        format!("{titles}\n{commas}"),
        format!("{titles}\n{units}\n{rows}"),
        format!("\u{feff}# it was, recorded\r\n# 2026-11-30\n{titles}\n{units}\n# here\n{commas}"),
        format!("# recorded\n# {titles}\n{rows}# the end\n"),
    ] {
        let found = read(text.as_bytes(), Some(&map)).expect(&text[..60]);
        assert!(found == expected, "{}", &text[..60]);
    }
    let latin: Vec<u8> = units.bytes().map(|byte| if byte == b'u' { 0xb5 } else { byte }).collect();
    let latin = [titles.as_bytes(), b"\n", &latin, b"\n", rows.as_bytes()].concat();
    assert!(read(&latin, Some(&map)).expect("Latin-1") == expected);
    let text = format!("# recorded\n{titles}\n\n{units}\n{}", rows.replacen(';', ";x", 1));
    let error = read(text.as_bytes(), Some(&map)).expect_err("no number").to_string();
    assert!(error.starts_with("log, line 5: column `shoulder_pan.pos`: `x"), "{error}");
}

/// A file of MCAP with one record.
fn with_record(op: u8, body: &[u8]) -> Vec<u8> {
    let header = [&8_u64.to_le_bytes()[..], &[0; 8]].concat();
    let record = [&[op][..], &(body.len() as u64).to_le_bytes(), body].concat();
    [mcap::MAGIC, &[1], &header, &record, mcap::MAGIC].concat()
}

/// The body of a chunk that is said to have so many bytes.
fn chunk(size: u64, records: &[u8]) -> Vec<u8> {
    let size = size.to_le_bytes();
    [&[0; 16], &size[..], &[0; 8], &(records.len() as u64).to_le_bytes(), records].concat()
}

#[test]
fn a_file_of_mcap_cannot_ask_for_more_memory_than_it_has() {
    let inner = chunk(0, &[]);
    let inner = [&[6][..], &(inner.len() as u64).to_le_bytes(), &inner].concat();
    for (body, words) in [
        (chunk(inner.len() as u64, &inner), "a chunk in a chunk"),
        (chunk(1 << 27, &[0; 8]), "a chunk of 134217728 bytes"),
    ] {
        let error = read(&with_record(6, &body), None).expect_err(words).to_string();
        assert!(error.contains(words), "{words}: {error}");
    }
    let mut writer = mcap::Writer::new(std::io::Cursor::new(Vec::new())).expect("a file");
    let channel = writer.add_channel(0, "/j", "json", &BTreeMap::new()).expect("a channel");
    let header = mcap::records::MessageHeader {
        channel_id: channel,
        sequence: 0,
        log_time: 1,
        publish_time: 1,
    };
    let data = format!("{{\"{}\": [1, 2]}}", "k".repeat(2000));
    writer.write_to_known_channel(&header, data.as_bytes()).expect("a message");
    writer.finish().expect("an end");
    let error = read(&writer.into_inner().into_inner(), None).expect_err("a name").to_string();
    assert!(error.contains("a name of more than 1024 bytes"), "{error}");
}
