//! The promises of the servo bus.

use core::f32::consts::{FRAC_PI_2, PI};

use embedded_hal_mock::eh1::serial::{Mock, Transaction};
use embedded_hal_nb::nb;
use embedded_hal_nb::serial::{Error as _, ErrorKind as SerialError, Read as _, Write as _};
use embedded_io::{ErrorKind, ErrorType, Read, ReadReady, Write};
use joint_drivers::feetech::{
    FeetechError, GOAL_POSITION, PRESENT_POSITION, Packet, Parser, Servos,
};
use joint_drivers::{Direction, JointMapping, JointRange};

use super::{identity, near_zero};

/// The mock as a port of `embedded-io`, of which some bytes are there before the first packet is
/// sent.
struct Port {
    mock: Mock<u8>,
    stale: usize,
}

impl ErrorType for Port {
    type Error = ErrorKind;
}

/// No byte came in time, or the line is broken.
fn kind(error: nb::Error<SerialError>) -> ErrorKind {
    match error {
        nb::Error::WouldBlock => ErrorKind::TimedOut,
        nb::Error::Other(error) => {
            assert_eq!(error.kind(), SerialError::Noise);
            ErrorKind::InvalidData
        }
    }
}

impl Read for Port {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, ErrorKind> {
        bytes[0] = self.mock.read().map_err(kind)?;
        self.stale = self.stale.saturating_sub(1);
        Ok(1)
    }
}

impl ReadReady for Port {
    fn read_ready(&mut self) -> Result<bool, ErrorKind> {
        Ok(self.stale > 0)
    }
}

impl Write for Port {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
        bytes.iter().try_for_each(|byte| self.mock.write(*byte).map_err(kind))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<(), ErrorKind> {
        self.mock.flush().map_err(kind)
    }
}

/// The transfers on the port: the mock's transactions cannot be cloned.
#[derive(Clone)]
enum Step {
    Sent(Vec<u8>),
    Received(Vec<u8>),
    Timeout,
    Broken,
}

fn sent(bytes: &[u8]) -> Step {
    Step::Sent(bytes.to_vec())
}

fn received(bytes: &[u8]) -> Step {
    Step::Received(bytes.to_vec())
}

fn port(steps: &[Step]) -> Port {
    let mut transactions = Vec::new();
    for step in steps {
        match step {
            Step::Sent(bytes) => {
                transactions.extend([Transaction::write_many(bytes), Transaction::flush()]);
            }
            Step::Received(bytes) => transactions.push(Transaction::read_many(bytes)),
            Step::Timeout => transactions.push(Transaction::read_error(nb::Error::WouldBlock)),
            Step::Broken => {
                transactions.push(Transaction::read_error(nb::Error::Other(SerialError::Noise)));
            }
        }
    }
    Port { mock: Mock::new(&transactions), stale: 0 }
}

/// The servos 1 to N, without a mapping, on a port with these steps.
fn servos<const N: usize>(steps: &[Step]) -> Servos<Port, N> {
    let ids = core::array::from_fn(|joint| joint as u8 + 1);
    Servos::new(port(steps), ids, [identity(); N]).unwrap()
}

fn done<const N: usize>(servos: Servos<Port, N>) {
    servos.release().mock.done();
}

/// A status packet with its checksum.
fn reply(id: u8, status: u8, parameters: &[u8]) -> Vec<u8> {
    let body = [&[id, parameters.len() as u8 + 2, status], parameters].concat();
    let sum = body.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
    [&[0xff, 0xff], &body[..], &[!sum]].concat()
}

const READ_ONE: [u8; 8] = [0xff, 0xff, 0x01, 0x04, 0x02, 0x38, 0x02, 0xbe];

#[test]
fn packets_are_the_golden_ones_of_the_protocol_manual() {
    let goal = [0x00, 0x08, 0x00, 0x00, 0xe8, 0x03]; // position 2048, time 0, speed 1000
    let mut four = vec![0xff, 0xff, 0xfe, 0x20, 0x83, 0x2a, 0x06];
    (1..=4).for_each(|id| four.extend([&[id], &goal[..]].concat()));
    four.push(0x58);
    let golden = [
        (Packet::ping(1), &[0xff, 0xff, 1, 2, 1, 0xfb][..]),
        (Packet::read(1, PRESENT_POSITION, 2), &READ_ONE),
        (
            Packet::write(1, GOAL_POSITION, &[0x00, 0x08]),
            &[0xff, 0xff, 0x01, 0x05, 0x03, 0x2a, 0x00, 0x08, 0xc4],
        ),
        (
            Packet::write(1, GOAL_POSITION, &goal),
            &[0xff, 0xff, 1, 9, 3, 0x2a, 0, 8, 0, 0, 0xe8, 3, 0xd5],
        ),
        (
            Packet::sync_read(&[1, 2], PRESENT_POSITION, 8),
            &[0xff, 0xff, 0xfe, 0x06, 0x82, 0x38, 0x08, 0x01, 0x02, 0x36],
        ),
        (Packet::sync_write(GOAL_POSITION, (1..=4).map(|id| (id, goal))), &four),
    ];
    for (packet, bytes) in golden {
        assert_eq!(packet.unwrap().bytes(), bytes);
    }
}

#[test]
fn replies_are_the_golden_ones_of_the_protocol_manual() {
    let bytes = [
        [255, 255, 1, 10, 0, 0x00, 8, 0, 0, 0, 0, 0x79, 0x1e, 0x55],
        [255, 255, 2, 10, 0, 0xff, 7, 0, 0, 0, 0, 0x77, 0x23, 0x53],
    ];
    let (mut parser, all) = (Parser::new(), bytes.as_flattened().iter());
    let replies: Vec<_> = all.filter_map(|byte| parser.push(*byte)).collect();
    assert_eq!(replies.len(), 2);
    for (reply, bytes) in replies.iter().zip(bytes) {
        assert_eq!((reply.id, reply.status), (bytes[2], 0));
        assert_eq!(reply.parameters(), &bytes[5..13]);
    }
    assert_eq!(parser.skipped(), 0);
}

// Signs and mappings to the joints are applied.
#[test]
fn six_positions_are_read_in_one_exchange() {
    let request = Packet::sync_read(&[1, 2, 3, 4, 5, 6], PRESENT_POSITION, 2).unwrap();
    let counts = [0_u16, 1024, 2048, 4095, 0x8400, 0x7fff];
    let replies = (1..).zip(counts).map(|(id, counts)| reply(id, 0, &counts.to_le_bytes()));
    let replies: Vec<u8> = replies.flatten().collect();
    // The figures of the module's documentation.
    assert_eq!(request.bytes().len() + replies.len(), 62);
    let request = sent(request.bytes());
    let port = port(&[request, received(&replies)]);
    let reverse = JointMapping::new(PI, Direction::Reverse, 1.0).unwrap();
    let near = [PI, 1.5, 0.2, -3.0, 4.5, -47.0].map(JointRange::Near);
    let mappings = near.map(|near| reverse.with_range(near, 1e-3).unwrap());
    let mut servos = Servos::new(port, [1, 2, 3, 4, 5, 6], mappings).unwrap();
    let positions = servos.positions().unwrap();
    let counts = [0, 1024, 2048, 4095, -1024, 32_767];
    for (position, counts) in positions.into_iter().zip(counts) {
        let expected = PI - counts as f32 * PI / 2048.0;
        let off = (position - expected) / expected.abs().max(1.0);
        assert!(off.abs() < 1e-5, "{counts}: {position}");
    }
    done(servos);
}

// Signs, limits and directions are applied.
#[test]
fn goals_of_all_servos_are_sent_in_one_packet() {
    let duties = [0, 500, 0x0400 | 250, 1000, 0x0400 | 1000, 0_u16];
    let positions = [0, 1024, 2048, 1, 0, 4095_u16];
    let data = |goals: [u16; 6]| (1..).zip(goals.map(u16::to_le_bytes));
    let packets = [
        Packet::sync_write(0x2c, data(duties)).unwrap(),
        Packet::sync_write(0x2a, data(positions)).unwrap(),
    ];
    assert_eq!(packets[0].bytes().len(), 26);
    let transactions = packets.map(|packet| sent(packet.bytes()));
    // The range of each joint is one turn of its servo, from its count 0: no reading is needed.
    let range = JointRange::Within { lower: 0.0, upper: 4093.0 / 2048.0 * PI };
    let mapping = JointMapping::IDENTITY.with_range(range, 1e-3).unwrap();
    let port = port(&transactions);
    let mut servos = Servos::new(port, [1, 2, 3, 4, 5, 6], [mapping; 6]).unwrap();
    servos.set_duties(&[0.0, 0.5, -0.25, 7.0, f32::NEG_INFINITY, f32::NAN]).unwrap();
    let count = PI / 2048.0;
    let ends = [0.6, -0.4, 4095.4].map(|counts| counts * count);
    let goals = [0.0, FRAC_PI_2, PI, ends[0], ends[1], ends[2]];
    servos.set_positions(&goals).unwrap();
    let beyond = [-0.6, 4095.6].map(|counts| counts * count);
    for goal in [f32::NAN, f32::INFINITY, 60.0, -60.0].into_iter().chain(beyond) {
        let mut goals = [0.0; 6];
        goals[3] = goal;
        let refused = Err(FeetechError::Goal { joint: 3 });
        assert_eq!(servos.set_positions(&goals), refused);
    }
    done(servos);

    let request = Packet::sync_write(0x2c, [(9, [0x2c, 0x05])]).unwrap();
    let port = self::port(&[sent(request.bytes())]);
    let reverse = JointMapping::new(0.0, Direction::Reverse, 5.0).unwrap();
    let mut one = Servos::new(port, [9], [near_zero(reverse)]).unwrap();
    one.set_duties(&[0.3]).unwrap();
    done(one);
}

/// At zero the servo is at 5.9 rad, count 3846; its seam is at +0.38 rad.
#[test]
fn a_servo_reads_small_steps_across_its_seam() {
    let range = JointRange::Within { lower: -0.8, upper: 0.8 };
    let mapping = JointMapping::new(5.9, Direction::Forward, 1.0).unwrap();
    let mapping = mapping.with_range(range, 0.1).unwrap();
    let request = Packet::sync_read(&[1], PRESENT_POSITION, 2).unwrap();
    let turn = |truth: f32| ((truth + 5.9) / (2.0 * PI)).rem_euclid(1.0);
    let reading = |truth| {
        let count = (turn(truth) * 4096.0).round() as u16 & 4095;
        [sent(request.bytes()), received(&reply(1, 0, &count.to_le_bytes()))]
    };
    let goal = Packet::sync_write(GOAL_POSITION, [(1, 141_u16.to_le_bytes())]).unwrap();
    let truths: Vec<f32> = (-8..=8).map(|step| 0.1 * step as f32).collect();
    let mut steps = truths.iter().copied().flat_map(reading).collect::<Vec<_>>();
    steps.push(sent(goal.bytes()));
    let mut servos = Servos::new(port(&steps), [1], [mapping]).unwrap();
    for truth in truths {
        let [read] = servos.positions().unwrap();
        assert!((read - truth).abs() < 8e-4, "{truth} {read}");
    }
    // A goal within the turn of the servo's count, and one for which it would turn back by 5.9 rad.
    servos.set_positions(&[0.6]).unwrap();
    let refused = servos.set_positions(&[0.3]);
    assert_eq!(refused, Err(FeetechError::Goal { joint: 0 }));
    done(servos);
    // From any place at power-up.
    for truth in [-0.8, -0.3, 0.3, 0.4, 0.8] {
        let mut servos = Servos::new(port(&reading(truth)), [1], [mapping]).unwrap();
        let [read] = servos.positions().unwrap();
        assert!((read - truth).abs() < 8e-4, "{truth} {read}");
        done(servos);
    }
}

#[test]
fn a_reply_after_noise_and_false_headers_is_found() {
    let good = reply(1, 0, &[0x18, 0x05]);
    // As many bytes as may come before it.
    let transactions = [sent(&READ_ONE), received(&[0x55; 64]), received(&good)];
    let mut servos = self::servos::<1>(&transactions);
    assert_eq!(servos.read(1, PRESENT_POSITION), Ok([0x18, 0x05]));
    done(servos);
    // A false header that promises more bytes than come.
    let request = sent(&READ_ONE);
    let long = received(&[0xff, 0xff, 0x07, 0x12]);
    let mut servos = self::servos::<1>(&[request, long, received(&good), Step::Timeout]);
    assert_eq!(servos.read(1, PRESENT_POSITION), Ok([0x18, 0x05]));
    done(servos);
}

#[test]
fn each_failure_of_the_bus_is_a_typed_error() {
    let noise = [0x55; 65];
    let wrong = [0xff, 0xff, 0x01, 0x04, 0x00, 0x18, 0x05, 0xdc];
    let id = 1;
    let answer = |bytes: &[u8], then: Option<Step>| -> Vec<_> {
        [received(bytes)].into_iter().chain(then).collect()
    };
    let whole = |id, status, bytes: &[u8]| answer(&reply(id, status, bytes), None);
    use FeetechError::{Checksum, NoReply, Noise, Port, Servo, Unexpected};
    let (silent, broken) = (vec![Step::Timeout], vec![Step::Broken]);
    let late = Some(Step::Timeout);
    let cases = [
        (silent, NoReply { id }),
        (answer(&READ_ONE[..3], late.clone()), NoReply { id }),
        (answer(&wrong, late), Checksum { id }),
        (answer(&noise, None), Noise),
        (broken, Port(ErrorKind::InvalidData)),
        (whole(2, 0, &[0, 0]), Unexpected { id, found: 2 }),
        (whole(1, 0, &[0]), Unexpected { id, found: 1 }),
        (whole(1, 0x24, &[0, 0]), Servo { id, status: 0x24 }),
    ];
    for (answer, error) in cases {
        let mut servos = servos::<1>(&[vec![sent(&READ_ONE)], answer].concat());
        assert_eq!(servos.read::<2>(1, PRESENT_POSITION), Err(error));
        done(servos);
    }
}

#[test]
fn a_missing_servo_of_a_synchronous_read_is_named() {
    let request = Packet::sync_read(&[1, 2, 3], PRESENT_POSITION, 2).unwrap();
    let request = sent(request.bytes());
    let replies = [reply(1, 0, &[0, 0]), reply(3, 0, &[0, 0])].concat();
    let mut servos = servos::<3>(&[request, received(&replies)]);
    let unexpected = FeetechError::Unexpected { id: 2, found: 3 };
    assert_eq!(servos.positions(), Err(unexpected));
    done(servos);
}

#[test]
fn a_late_reply_is_not_taken_for_the_next() {
    let late = reply(1, 0, &[0x11, 0x11]);
    let request = sent(&READ_ONE);
    let good = received(&reply(1, 0, &[0x18, 0x05]));
    let mut port = port(&[received(&late), request, good]);
    port.stale = late.len();
    let mut servos = Servos::new(port, [1], [identity()]).unwrap();
    assert_eq!(servos.read(1, PRESENT_POSITION), Ok([0x18, 0x05]));
    done(servos);
}

#[test]
fn an_echo_is_dropped_and_a_collision_found() {
    let request = sent(&READ_ONE);
    let good = [&READ_ONE[..], &reply(1, 0, &[0x18, 0x05])].concat();
    let mut echoing = servos::<1>(&[request.clone(), received(&good)]).with_echo();
    assert_eq!(echoing.read(1, PRESENT_POSITION), Ok([0x18, 0x05]));
    done(echoing);
    let mut collided = servos::<1>(&[request, received(&[0xff, 0xff, 0x03])]).with_echo();
    let read = collided.read::<2>(1, PRESENT_POSITION);
    assert_eq!(read, Err(FeetechError::Echo));
    done(collided);
}

#[test]
fn torque_is_disabled_even_if_one_servo_is_silent() {
    let switch = |id, value| sent(Packet::write(id, 0x28, &[value]).unwrap().bytes());
    let confirmed = |id| received(&reply(id, 0, &[]));
    let off = [switch(1, 0), Step::Timeout, switch(2, 0), confirmed(2)];
    let mut silent = servos::<2>(&off);
    let no_reply = FeetechError::NoReply { id: 1 };
    assert_eq!(silent.enable_torque(false), Err(no_reply));
    done(silent);
    let on = [switch(1, 1), confirmed(1), switch(2, 1), confirmed(2)];
    let mut both = servos::<2>(&on);
    assert_eq!(both.enable_torque(true), Ok(()));
    done(both);
}

#[test]
fn invalid_servo_ids_and_too_long_packets_are_refused() {
    for (ids, wrong) in [([1, 1], 1), ([254, 1], 254), ([0, 255], 255)] {
        let unused = port(&[]);
        let mut mock = unused.mock.clone();
        let refused = Servos::new(unused, ids, [identity(); 2]).map(|_| ());
        assert_eq!(refused, Err(FeetechError::Id(wrong)));
        mock.done();
    }
    let lengths = |packet: Result<Packet, _>| packet.map(|packet| packet.bytes().len());
    let too_long = Err(FeetechError::TooLong);
    assert_eq!(lengths(Packet::read(1, 0, 17)), too_long);
    assert!(Packet::read(1, 0, 16).is_ok());
    assert_eq!(lengths(Packet::write(1, 0, &[0; 122])), too_long);
    assert_eq!(lengths(Packet::write(1, 0, &[0; 121])), Ok(128));
}

#[test]
fn no_bytes_panic_the_parser_or_hide_a_later_reply() {
    let good = reply(1, 0, &[0x18, 0x05]);
    let mut random = 3_u32;
    let mut next = || {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 20) as u8
    };
    for _ in 0..100_000 {
        let mut parser = Parser::new();
        // Half of the bytes are those that packets begin with.
        let mut byte = |_| if next() & 1 == 0 { 0xff } else { next() % 20 };
        let count = byte(()) % 24;
        let noise: Vec<u8> = (0..count).map(|_| byte(())).collect();
        let all = noise.iter().chain(&good);
        let mut found: Vec<_> = all.filter_map(|byte| parser.push(*byte)).collect();
        found.extend(core::iter::from_fn(|| parser.finish()));
        let mut parameters = found.iter().map(|reply| reply.parameters());
        assert!(parameters.any(|bytes| bytes == [0x18, 0x05]), "{noise:x?}");
    }
}
