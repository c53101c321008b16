//! The temperatures after many blocks of the same torque.
//!
//! A block is an affine map x ← x + P x + g, and so are two: x + (2 P + P²) x + (2 g + P g). Maps
//! of 2ᵏ blocks are therefore made by squaring, and any number of blocks by up to k of them.

use super::{Joint, Sum, ThermalLimit, ticks};
use dynamics_core::scalar::Real;

/// Up to 2²⁴ − 1 blocks, 149 h at 1 kHz.
const LEVELS: usize = 24;

#[derive(Clone, Copy)]
struct Blocks<R> {
    p: [[R; 2]; 2],
    g: [R; 2],
}

impl<R: Real> Blocks<R> {
    fn change(&self, [w, c]: [R; 2]) -> [R; 2] {
        let [[a, b], [d, e]] = self.p;
        [a * w + b * c, d * w + e * c]
    }

    fn after(&self, x: [R; 2]) -> [R; 2] {
        let ([w, c], [g, f], [dw, dc]) = (x, self.g, self.change(x));
        [w + (dw + g), c + (dc + f)]
    }

    fn twice(self) -> Self {
        let [[a, b], [d, e]] = self.p;
        let (g, [left, right]) = (self.change(self.g), [self.change([a, d]), self.change([b, e])]);
        let sum = |x: R, y: R| x + x + y;
        Self {
            p: [[sum(a, left[0]), sum(b, right[0])], [sum(d, left[1]), sum(e, right[1])]],
            g: [sum(self.g[0], g[0]), sum(self.g[1], g[1])],
        }
    }

    /// Maps of 1, 2, 4 … blocks.
    fn doubled(mut self) -> [Self; LEVELS] {
        core::array::from_fn(|_| {
            let map = self;
            self = map.twice();
            map
        })
    }
}

impl<R: Real> Joint<R> {
    /// A block with heat g.
    fn block(&self, g: R) -> Blocks<R> {
        let (d, flow) = (self.d, self.kappa * (R::ONE - self.d));
        Blocks { p: [[-flow, flow], [d, -(d + self.sigma)]], g: [g + self.kappa * d * g, d * g] }
    }

    /// So many blocks without torque.
    pub(super) fn cool(&mut self, blocks: u32) {
        let mut x = [self.winding.sum, self.housing.sum];
        let blocks = blocks.min((1 << LEVELS) - 1);
        for (k, map) in self.block(R::ZERO).doubled().iter().enumerate() {
            if (blocks >> k) & 1 == 1 {
                x = map.after(x);
            }
        }
        [self.winding, self.housing] = x.map(Sum::of);
    }

    /// The blocks after which, and after Σ τ² before them, w exceeds the one at which this torque
    /// is the limit; `None` if never.
    ///
    /// In the steady state of heat g, w − c = r g and σ c = d (1 + r) g. With g from a steady w
    /// above the bound, w crosses it once. Otherwise the steady state at the bound is above w and c
    /// for ever, unless the housing is hotter: then it is assumed to stay so.
    fn blocks(&self, before: R, torque: R, g: R) -> Option<u32> {
        let bound = (self.base - torque) / self.slope;
        let mut x = [self.winding.sum + self.heat * before, self.housing.sum];
        let holds = (torque <= self.peak) & (x[0] <= bound);
        if !holds {
            return Some(0);
        }
        let mut block = self.block(g);
        let r = (R::ONE + self.kappa * self.d) / (self.kappa * (R::ONE - self.d));
        let housing = self.d * (R::ONE + r) / self.sigma;
        let winding = r + housing;
        if winding * g <= bound {
            if x[1] * winding <= bound * housing {
                return None;
            }
            (block.p[1], block.g[1]) = ([R::ZERO; 2], R::ZERO);
        }
        let mut blocks = 0;
        for (k, map) in block.doubled().iter().enumerate().rev() {
            let next = map.after(x);
            if next[0] <= bound {
                (x, blocks) = (next, blocks | 1 << k);
            }
        }
        (blocks < (1 << LEVELS) - 1).then_some(blocks)
    }
}

impl<R: Real, const V: usize> ThermalLimit<R, V> {
    /// How long from now a joint can hold a torque (N·m or N) before its limit is less, s: infinite
    /// for ever, and zero if the limit is less already. It is a lower bound, by the model that
    /// limits.
    ///
    /// # Cost
    /// By count: 1,100 flops and 4 divisions, for a planner; 600 bytes of stack in f32.
    pub fn holds_for(&self, joint: usize, torque: R) -> R {
        let block = ticks::<R, V>();
        let torque = torque.abs();
        let at = self.joints.get(joint).zip(self.energy.get(joint));
        let blocks = at.map_or(Some(0), |(joint, &energy)| {
            joint.blocks(energy, torque, joint.heat * block * torque * torque)
        });
        blocks
            .map_or(R::ONE / R::ZERO, |blocks| crate::real::<R>(blocks) * block * self.config.tick)
    }
}
