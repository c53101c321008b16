//! The reply that a request waits for, from the bytes of a port.

use embedded_io::ErrorKind;

use super::{FeetechError, MOST_NOISE, Parser, Reply};

/// The reply to a request to the servo `id`, if what the port gave ends one: a byte, or none within
/// its time limit.
pub(super) fn next_reply(
    received: Result<Option<u8>, FeetechError>,
    parser: &mut Parser,
    id: u8,
) -> Result<Option<Reply>, FeetechError> {
    let reply = match received {
        Ok(Some(byte)) => parser.push(byte),
        Ok(None) | Err(FeetechError::Port(ErrorKind::TimedOut)) => match parser.finish() {
            None if parser.has_wrong_checksum() => return Err(FeetechError::Checksum { id }),
            None => return Err(FeetechError::NoReply { id }),
            reply => reply,
        },
        Err(error) => return Err(error),
    };
    if reply.is_none() && parser.skipped() > MOST_NOISE {
        return Err(FeetechError::Noise);
    }
    Ok(reply)
}

/// The parameters of a reply that should be the servo's.
pub(super) fn parameters<const L: usize>(reply: &Reply, id: u8) -> Result<[u8; L], FeetechError> {
    if reply.id != id {
        let found = reply.id;
        return Err(FeetechError::Unexpected { id, found });
    }
    if reply.status != 0 {
        let status = reply.status;
        return Err(FeetechError::Servo { id, status });
    }
    let parameters = reply.parameters().try_into();
    parameters.map_err(|_| FeetechError::Unexpected { id, found: id })
}
