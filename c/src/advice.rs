//! The numbers of a configuration that look like another unit, or cannot act:
//! `..._config_advice` of the header.

use core::fmt::{self, Write};

use crate::control::Config;
use crate::{Exports, Library, status};

/// The bytes of the text in the header, with the zero at its end.
const BYTES: usize = 2048;

/// Sentences, one a line: `..._advice` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct AdviceText {
    /// UTF-8, ended by a zero.
    pub text: [u8; BYTES],
}

/// Fills a text, and leaves out what does not fit.
struct Writer<'a> {
    text: &'a mut [u8; BYTES],
    used: usize,
}

impl Write for Writer<'_> {
    fn write_str(&mut self, part: &str) -> fmt::Result {
        for &byte in part.as_bytes() {
            if self.used + 1 < BYTES
                && let Some(place) = self.text.get_mut(self.used)
            {
                *place = byte;
                self.used += 1;
            }
        }
        Ok(())
    }
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// Writes the advice and returns how many sentences it has.
    pub fn config_advice(config: Option<&Config<N>>, advice: Option<&mut AdviceText>) -> i32 {
        let (Some(config), Some(advice)) = (config, advice) else {
            return status::NULL;
        };
        advice.text = [0; BYTES];
        let mut writer = Writer { text: &mut advice.text, used: 0 };
        let config = config.motion_controller();
        let mut count = 0;
        for one in config.advice() {
            // Writing cannot fail: what is too long is cut off.
            let _ = writeln!(writer, "{}", one.named(&L::JOINTS));
            count += 1;
        }
        count
    }
}
