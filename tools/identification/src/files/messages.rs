//! The messages of an MCAP as rows of named texts: JSON, and ROS 2's `sensor_msgs/msg/JointState`
//! in CDR, which rosbag2 writes. Nothing in the file is believed.
//!
//! The form of CDR is that of OMG, "Common Object Request Broker Architecture", 15.3, with a header
//! of four bytes that names the order of bytes: each number is aligned to its own size.

use std::collections::HashMap;
use std::io::Read;

use mcap::read::LinearReader;
use mcap::records::Record;
use serde_json::Value;

use super::error::Problem;

/// The largest file and the largest chunk, bytes.
pub const LARGEST_FILE: u64 = 1 << 30;
const LARGEST_CHUNK: u64 = 1 << 28;
/// The most bytes that chunks have in all, of each byte of the file and beside: records of joints
/// are compressed to a tenth.
const PACKED: u64 = 16;
const BESIDE: u64 = 1 << 22;
/// The longest path of a number, bytes.
const LONGEST_PATH: usize = 1024;
/// The most numbers and texts of a message.
const MOST: usize = 4096;
const JOINT_STATE: [&str; 2] = ["sensor_msgs/msg/JointState", "sensor_msgs/JointState"];

type Checked<T> = std::result::Result<T, Problem>;
/// Names and texts of a message.
pub type Message = Vec<(String, String)>;

/// The reader of a topic.
struct Reader<'a, F> {
    topic: Option<&'a str>,
    states: HashMap<u16, bool>,
    /// The channels that are read, and whether they are JSON.
    channels: HashMap<u16, bool>,
    topics: Vec<String>,
    /// The bytes that chunks may still have.
    left: u64,
    each: F,
}

/// Gives each message of a topic; without a name, of the only one that can be read.
pub fn read(
    bytes: &[u8],
    topic: Option<&str>,
    each: impl FnMut(Message) -> Checked<()>,
) -> Checked<()> {
    let (states, channels) = (HashMap::new(), HashMap::new());
    let left = BESIDE + PACKED * bytes.len() as u64;
    let mut reader = Reader { topic, states, channels, topics: Vec::new(), left, each };
    reader.all(LinearReader::new(bytes).map_err(wrong)?)?;
    match reader.channels.is_empty() {
        false => Ok(()),
        true => Err(Problem::Mcap(format!(
            "no topic{} of JSON or of sensor_msgs/msg/JointState in CDR; it has {}",
            topic.map_or(String::new(), |topic| format!(" `{topic}`")),
            reader.topics.join(", ")
        ))),
    }
}

fn wrong(error: impl std::fmt::Display) -> Problem {
    Problem::Mcap(error.to_string())
}

impl<F: FnMut(Message) -> Checked<()>> Reader<'_, F> {
    fn all(&mut self, records: LinearReader<'_>) -> Checked<()> {
        for record in records {
            match record.map_err(wrong)? {
                Record::Schema { header, .. } => {
                    self.states.insert(header.id, JOINT_STATE.contains(&header.name.as_str()));
                }
                Record::Channel(channel) => {
                    let is_json = channel.message_encoding == "json";
                    let is_state = self.states.get(&channel.schema_id) == Some(&true);
                    let is_read = is_json || is_state && channel.message_encoding == "cdr";
                    let is_wanted = self.topic.is_none_or(|topic| topic == channel.topic);
                    if is_read && is_wanted {
                        self.channels.insert(channel.id, is_json);
                    }
                    if !self.topics.contains(&channel.topic) && self.topics.len() < MOST {
                        self.topics.push(channel.topic);
                    }
                    if self.topic.is_none() && self.channels.len() > 1 {
                        let topics = self.topics.join(", ");
                        let reason = format!(
                            "more than one topic can be read ({topics}): the map names one, topic = \"…\""
                        );
                        return Err(Problem::Mcap(reason));
                    }
                }
                Record::Message { header, data } => {
                    let Some(is_json) = self.channels.get(&header.channel_id) else { continue };
                    let mut message = vec![("log_time".to_owned(), header.log_time.to_string())];
                    match is_json {
                        true => {
                            flat("", &serde_json::from_slice(&data).map_err(wrong)?, &mut message)?
                        }
                        false => joint_state(&data, &mut message)
                            .ok_or_else(|| wrong("a JointState is cut short"))?,
                    }
                    (self.each)(message)?;
                }
                Record::Chunk { header, data } => {
                    let size = header.uncompressed_size;
                    let left = self.left.checked_sub(size).filter(|_| size <= LARGEST_CHUNK);
                    self.left = left.ok_or_else(|| wrong(format!("a chunk of {size} bytes")))?;
                    match header.compression.as_str() {
                        "" => self.all(LinearReader::sans_magic(of_chunk(&data)?))?,
                        "zstd" => {
                            let mut plain = Vec::new();
                            let decoder = ruzstd::decoding::StreamingDecoder::new(&data[..]);
                            decoder
                                .map_err(wrong)?
                                .take(size)
                                .read_to_end(&mut plain)
                                .map_err(wrong)?;
                            self.all(LinearReader::sans_magic(of_chunk(&plain)?))?;
                        }
                        other => {
                            return Err(wrong(format!(
                                "compressed by {}; `mcap compress --compression zstd` writes what is read",
                                shortened(other)
                            )));
                        }
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// The records of a chunk; the reader would follow other chunks in it without an end.
fn of_chunk(records: &[u8]) -> Checked<&[u8]> {
    let mut rest = records;
    while let Some(([op, length @ ..], body)) = rest.split_first_chunk::<9>() {
        if *op == mcap::records::op::CHUNK {
            return Err(wrong("a chunk in a chunk"));
        }
        let length = usize::try_from(u64::from_le_bytes(*length)).ok();
        rest = length.and_then(|length| body.get(length..)).unwrap_or_default();
    }
    Ok(records)
}

/// The numbers and texts of JSON by their paths; those of joints with names by these.
fn flat(path: &str, value: &Value, into: &mut Message) -> Checked<()> {
    if into.len() > MOST || path.len() > LONGEST_PATH {
        return Err(wrong(format!(
            "a message has more than {MOST} numbers, or a name of more than {LONGEST_PATH} bytes"
        )));
    }
    match value {
        Value::Object(fields) => {
            let names = fields.get("name").and_then(Value::as_array);
            for (key, value) in fields {
                match (names, value) {
                    (Some(names), Value::Array(all)) if all.len() == names.len() => {
                        for (name, value) in names.iter().zip(all) {
                            flat(
                                &format!("{}/{key}", name.as_str().unwrap_or_default()),
                                value,
                                into,
                            )?;
                        }
                    }
                    _ => flat(
                        &[path, key].join(if path.is_empty() { "" } else { "." }),
                        value,
                        into,
                    )?,
                }
            }
        }
        Value::Array(all) => {
            for (index, value) in all.iter().enumerate() {
                flat(&format!("{path}[{index}]"), value, into)?;
            }
        }
        Value::String(text) => into.push((path.to_owned(), text.clone())),
        Value::Null => {}
        other => into.push((path.to_owned(), other.to_string())),
    }
    Ok(())
}

/// Stamp, names, positions, velocities and efforts.
fn joint_state(data: &[u8], into: &mut Message) -> Option<()> {
    let (head, body) = data.split_at_checked(4)?;
    let mut cdr = Cdr { body, at: 0, little: head[1] & 1 == 1 };
    let [seconds, rest] = [cdr.word()?, cdr.word()?];
    cdr.text()?;
    let count = cdr.word()? as usize;
    let names = (0..count).map(|_| cdr.text()).collect::<Option<Vec<_>>>()?;
    into.push(("stamp".to_owned(), format!("{seconds}.{rest:09}")));
    for what in ["position", "velocity", "effort"] {
        let count = cdr.word()? as usize;
        for place in 0..count {
            let value = cdr.number()?;
            let name = names.get(place).map_or("", String::as_str);
            into.push((format!("{name}/{what}"), value.to_string()));
        }
    }
    (into.len() <= MOST).then_some(())
}

/// A text of CDR, read from its start.
struct Cdr<'a> {
    body: &'a [u8],
    at: usize,
    little: bool,
}

impl Cdr<'_> {
    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.at = self.at.next_multiple_of(N);
        let mut bytes: [u8; N] = self.body.get(self.at..self.at + N)?.try_into().ok()?;
        self.at += N;
        if !self.little {
            bytes.reverse();
        }
        Some(bytes)
    }

    fn word(&mut self) -> Option<u32> {
        self.bytes().map(u32::from_le_bytes)
    }

    fn number(&mut self) -> Option<f64> {
        self.bytes().map(f64::from_le_bytes)
    }

    /// With a zero at its end, which counts.
    fn text(&mut self) -> Option<String> {
        let count = self.word()? as usize;
        let text = self.body.get(self.at..self.at.checked_add(count)?)?;
        self.at += count;
        Some(String::from_utf8_lossy(text.strip_suffix(&[0])?).into_owned())
    }
}

/// A field for a message.
pub(crate) fn shortened(field: &str) -> String {
    robot_import::text::visible(&field.chars().take(40).collect::<String>())
}
