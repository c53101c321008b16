//! Seven joints behind a controller of three places.

use joint_drivers::Outbox;

use super::*;

#[test]
fn frames_wait_for_places_the_oldest_first_and_a_newer_one_takes_the_place_of_its_own() {
    let joints = CanJoints::new(Outbox::<FdFrame, 7>::new(), [1, 2, 3, 4, 5, 6, 7].map(moteus));
    let mut bus = Bus { is_small: true, ..Bus::default() };
    // Sends so many, one after the other, the lowest identifier in the places first.
    let mut sent = |frames: usize| {
        let mut send = |_| {
            joints.exchange(&mut bus);
            let first = (0..bus.sent.len()).min_by_key(|at| bus.sent[*at].id());
            first.map(|first| bus.sent.remove(first))
        };
        (0..frames).filter_map(&mut send).collect::<Vec<_>>()
    };
    let of =
        |torque, nodes: &[u8]| nodes.iter().map(|n| torque_frame(*n, torque)).collect::<Vec<_>>();
    let late = |joint| Err(at(joint, CanError::Full));
    // A whole tick, with a request behind the commands: no other is taken before it is sent.
    (&joints).set_torques(&[1.0; 7]).unwrap();
    joints.clear_errors(6).unwrap();
    assert_eq!(joints.clear_errors(6), late(6));
    let stop = [moteus(7).stop::<FdFrame>().unwrap()];
    assert_eq!(sent(9), [&of(1.0, &[1, 2, 3, 4, 5, 6, 7])[..], &stop].concat());
    // A short one: three are sent, two of the others are in the places, and two have none.
    (&joints).set_torques(&[2.0; 7]).unwrap();
    assert_eq!(sent(3), of(2.0, &[1, 2, 3]));
    assert_eq!((&joints).set_torques(&[3.0; 7]), late(5));
    // A frame that waited is before the newer ones, with its newer torque alone. One that gives up
    // its place is neither lost nor doubled; what was in a place is not taken back.
    let all = [of(2.0, &[4]), of(3.0, &[1, 2, 3, 4]), of(2.0, &[5]), of(3.0, &[5, 6, 7])];
    assert_eq!(sent(12), all.concat());
    // A bus that fails is the error of the next reading alone.
    let error = Some(nb::Error::Other(ErrorKind::Acknowledge));
    joints.exchange(&mut Bus { error, ..Bus::default() });
    assert_eq!((&joints).read(), Err(at(0, CanError::Bus(ErrorKind::Acknowledge))));
    assert_eq!((&joints).read(), Err(at(0, CanError::NoReply)));
}

#[test]
fn without_an_outbox_a_frame_that_waits_or_is_given_up_is_an_error() {
    // Every joint gets a frame: in the first order the last has no place, in the second one it
    // takes that of the first.
    for (order, kept) in [([1, 2, 3, 4], [1, 2, 3]), ([4, 3, 2, 1], [1, 3, 2])] {
        let joints = CanJoints::new(Bus { is_small: true, ..Bus::default() }, order.map(moteus));
        assert_eq!((&joints).set_torques(&[0.0; 4]), Err(at(3, CanError::Full)));
        assert_eq!(joints.release().sent, kept.map(|node| torque_frame(node, 0.0)));
    }
}
