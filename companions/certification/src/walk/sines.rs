//! The places where sines and cosines come into an expression: comparisons at the state zero, and
//! calls of their function.

use std::cmp::Ordering;

use super::{ARGUMENTS, Comparison, RANGE, Walk, Word};
use crate::error::Result;
use crate::graph::{Input, Node};
use crate::image::Image;

/// The function that computes sine and cosine, and where they lie among inputs.
pub struct Sines {
    pub address: u32,
    trig: [u32; 4],
}

/// The places of the coordinates among the inputs: [`crate::state_box::Robot::trig`].
fn trig(image: &Image) -> Option<[u32; 4]> {
    image.variable("CERTIFIED_TRIG").ok()?.1.try_into().ok()
}

impl Sines {
    pub fn of(image: &Image) -> Option<Self> {
        let (_, words) = image.variable("CERTIFIED_SINES").ok()?;
        Some(Self { address: words.first()? & !1, trig: trig(image)? })
    }
}

impl Walk<'_> {
    /// The flags of the comparison of real numbers: those of the state zero, which is noted.
    pub fn take_flags(&mut self) -> Result<()> {
        let nodes = self.compared.ok_or_else(|| self.declined("no comparison"))?;
        let trig = trig(self.image);
        // Cosines are one, all else is zero.
        let zero = |input: Input| match trig {
            Some([stride, _, cosine, _]) if input.argument == 1 => {
                f32::from(u8::from(input.offset % stride == cosine))
            }
            _ => 0.0,
        };
        let mut values = Vec::new();
        self.graph.evaluate(zero, &mut values);
        let [a, b] = nodes.map(|k| values[k]);
        let ordering = a
            .partial_cmp(&b)
            .ok_or_else(|| self.declined("a comparison with what is no number"))?;
        self.comparisons.push(Comparison { address: self.here, nodes, ordering });
        let flags = match ordering {
            Ordering::Less => [true, false, false, false],
            Ordering::Equal => [false, true, true, false],
            Ordering::Greater => [false, false, true, false],
        };
        self.flags = flags.map(Some);
        Ok(())
    }

    /// A call of the function for sines: of a position, the first numbers of the state.
    pub fn sine_and_cosine(&mut self) -> Result<()> {
        let of = match self.real(0)? {
            Word::Real(node) => match self.graph.nodes[node] {
                Node::Input(Input { argument: 2, offset }) => Some(offset / 4),
                _ => None,
            },
            _ => None,
        };
        let (Some(joint), Some(sines)) = (of, &self.sines) else {
            return Err(self.declined("a sine of what is no coordinate"));
        };
        let [stride, sine, cosine, _] = sines.trig;
        let at = [sine, cosine].map(|within| ARGUMENTS + RANGE + stride * joint + within);
        // A call may overwrite these registers.
        self.core[..4].fill(None);
        self.core[12] = None;
        self.real[..16].fill(None);
        self.flags = [None; 4];
        for (register, at) in at.into_iter().enumerate() {
            self.real[register] = Some(self.load(at)?);
        }
        Ok(())
    }
}
