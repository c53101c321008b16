//! Links that bend, of a robot that is known at run time: the library's modes, filled up.

use std::any::Any;

use dynamics_core::flexible::{FlexibleLink, Mode, ModeError, Modes};
use dynamics_core::model::Model;
use dynamics_core::scalar::{Matrix, Real};

use crate::model::{Bodies, Counts, NoModel};

/// The most modes of a robot.
pub const MOST_MODES: usize = 8;

/// ω² of what fills the modes up, 1/s²: above those of all links.
const FILLER: f64 = 1e20;

/// The modes of a robot's links.
#[derive(Debug)]
pub struct AnyModes {
    single: Modes<f32, MOST_MODES>,
    double: Modes<f64, MOST_MODES>,
    /// The number of modes that are used.
    pub count: usize,
}

/// Why there are no modes.
#[derive(Debug)]
pub enum NoModes {
    /// The robot has no model of the supported sizes.
    Model(NoModel),
    /// The library refuses the modes of these links.
    Modes(ModeError),
}

impl AnyModes {
    /// The modes of links, of which there are up to [`MOST_MODES`].
    ///
    /// # Errors
    /// The library's reason for its refusal.
    pub fn of(bodies: &Bodies, links: &[FlexibleLink]) -> Result<Self, NoModes> {
        let Counts { bodies: own, v, .. } = bodies.counts();
        if !bodies.is_small() {
            let what = "velocity coordinates or bodies of a robot with links that bend";
            return Err(NoModes::Model(NoModel::TooLarge { what, found: v.max(own), most: 16 }));
        }
        let model = bodies.filled::<f64, 28, 32>(false).map_err(NoModes::Model)?;
        let mut model: Model<f64, 28, 32, 28> = *model;
        let count = links.iter().map(|link| link.count).sum();
        let mut all = links.to_vec();
        // A mode along the joint's axis, which couples with nothing, on each of the last bodies.
        let mut mode = Mode::ZERO;
        mode.shift = [0.0, 0.0, 1.0];
        for body in own..own + MOST_MODES.saturating_sub(count) {
            let mut filler = FlexibleLink::new(body, [0.0; 3], &[mode]);
            filler.products[0][0][2][2] = 1.0;
            filler.stiffness[0][0] = FILLER;
            all.push(filler);
            let inertia = &mut model.links[body].inertia;
            (inertia.mass, inertia.rotational) = (1.0, Matrix::IDENTITY);
        }
        let double = Modes::try_new(&model, &all).map_err(NoModes::Modes)?;
        let single = double.to_f32();
        Ok(Self { single, double, count })
    }

    /// Those of a scalar, which is f32 or f64.
    pub(crate) fn get<R: Real>(&self) -> &Modes<R, MOST_MODES> {
        let [single, double]: [&dyn Any; 2] = [&self.single, &self.double];
        match single.downcast_ref().or_else(|| double.downcast_ref()) {
            Some(modes) => modes,
            None => unreachable!("modes are not computed in other scalars"),
        }
    }
}
