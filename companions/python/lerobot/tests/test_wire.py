"""The bytes on the bus, against the protocol's manual and LeRobot's own encodings."""

import pytest
from lerobot.motors.encoding_utils import decode_sign_magnitude, encode_sign_magnitude
from lerobot.motors.feetech.tables import STS_SMS_SERIES_CONTROL_TABLE as TABLE

from lerobot_teleoperator_so101_floating import wire


def test_packets_are_those_of_the_manual():
    # Examples 2 and 5 of Feetech's "Communication Protocol User Manual", and the firmware driver's
    # golden frame.
    assert wire.packet(1, wire.READ, b"\x38\x02") == bytes.fromhex("ffff0104023802be")
    assert wire.sync_write(0x2C, {1: wire.encode(100, 10), 2: wire.encode(-100, 10)}) == bytes.fromhex(
        "fffffe0a832c0201640002640477"
    )


def test_addresses_are_those_of_lerobots_table():
    assert (TABLE["Phase"][0], TABLE["Operating_Mode"][0]) == (wire.PHASE, wire.OPERATING_MODE)
    assert (TABLE["Torque_Enable"][0], TABLE["Goal_Time"][0]) == (wire.TORQUE_ENABLE, wire.GOAL_DUTY)
    assert TABLE["Present_Position"][0] == wire.PRESENT
    assert TABLE["Status"][0] == wire.PRESENT + wire.PRESENT_LENGTH - 1


@pytest.mark.parametrize("bit", [10, 15])
def test_signs_are_lerobots(bit):
    for value in (0, 1, -1, 970, -970, (1 << bit) - 1, 1 - (1 << bit)):
        data = wire.encode(value, bit)
        assert int.from_bytes(data, "little") == encode_sign_magnitude(value, bit)
        assert wire.decode(data, bit) == value == decode_sign_magnitude(int.from_bytes(data, "little"), bit)


def reply(servo, data):
    return wire.HEADER + (body := bytes([servo, len(data) + 2, 0]) + data) + bytes([wire.checksum(body)])


def test_replies_are_found_after_noise_and_false_headers():
    replies = wire.Replies([1, 2], 2)
    stream = b"\x00\xff\xff\x07\x05\xff\xff\xff" + reply(2, b"\x18\x05") + b"\xff" + reply(1, b"\x01\x02")
    for byte in stream:
        replies.push(bytes([byte]))
    assert replies.found == {1: (0, b"\x01\x02"), 2: (0, b"\x18\x05")} and not replies.missing and not replies.corrupt


def test_a_wrong_checksum_is_no_reading():
    replies = wire.Replies([1], 2)
    replies.push(reply(1, b"\x01\x02")[:-1] + b"\x00")
    assert replies.missing == [1] and replies.corrupt == {1} and not replies.found


def test_replies_of_others_are_not_taken():
    replies = wire.Replies([1], 2)
    replies.push(reply(3, b"\x01\x02") + reply(1, b"\x01\x02\x03"))
    assert replies.missing == [1] and not replies.found


def test_the_end_takes_the_duty_before_the_torque():
    first, second = wire.release([1, 2]).split(wire.HEADER)[1:]
    assert first[3] == wire.GOAL_DUTY and second[3] == wire.TORQUE_ENABLE
    assert wire.release([1]).endswith(bytes.fromhex("fffffe0683280101004e"))


def test_the_error_of_a_terminal_is_one_of_a_port():
    """A flush of a port whose adapter is gone raises it, and pyserial lets it pass."""
    termios = pytest.importorskip("termios")
    assert termios.error in wire.PORT_ERRORS and not issubclass(termios.error, OSError)
