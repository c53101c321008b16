//! A load and a direction of gravity that are known at run time: `..._tool` of the header.

use core::marker::PhantomData;

use dynamics_core::delegate_effect;
use dynamics_core::effects::{Effect, GravityVector, Payload, hook};
use dynamics_core::model::{ArmModel, BodyInertia, Link, Problem, Robot};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::SpatialInertia;

use crate::status::{self, NULL};
use crate::{Exports, Library, check, status_of};

/// A load as a data sheet has it: `..._load` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Load {
    /// Mass, kg.
    pub mass: f32,
    /// Centre of mass in the frame of the body that carries it, m.
    pub com: [f32; 3],
    /// Inertia about the centre of mass, along that frame's axes: xx, xy, xz, yy, yz, zz in kg·m².
    pub inertia: [f32; 6],
}

/// A checked load on a body, and gravity: any bits are a value of it, and the first word says whether it was set.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Tool {
    magic: u32,
    pub(crate) body: u32,
    mass: f32,
    first_moment: [f32; 3],
    /// About the origin of the body's frame: xx, xy, xz, yy, yz, zz.
    second_moment: [f32; 6],
    gravity: [f32; 3],
}

/// The words of a tool in the header.
const _: () = assert!(size_of::<Tool>() == 4 * 15 && align_of::<Tool>() == 4);

/// Whether the rows are orthonormal and right-handed, within 1e-3.
pub(crate) fn is_rotation([x, y, z]: &[[f32; 3]; 3]) -> bool {
    let dot = |a: &[f32; 3], b: &[f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
    let near = |value: f32, to: f32| (value - to).abs() < 1e-3;
    near(dot(x, x), 1.0)
        && near(dot(y, y), 1.0)
        && near(dot(z, z), 1.0)
        && near(dot(x, y), 0.0)
        && near(dot(&cross, z), 1.0)
}

/// Accepts gravity in m/s²: a direction of length one is none, nor is a number in mm/s².
///
/// # Errors
/// `NOT_FINITE`, `GRAVITY`.
pub(crate) fn is_gravity(gravity: &[f32; 3]) -> Result<(), i32> {
    check::inputs([gravity])?;
    let [x, y, z] = gravity;
    let square = x * x + y * y + z * z;
    let is_direction = (0.9..1.1).contains(&square);
    if square <= 1e4 && !is_direction { Ok(()) } else { Err(status::GRAVITY) }
}

impl Tool {
    /// Whether it is on a body.
    #[inline(always)]
    pub(crate) fn is_on(&self, body: usize) -> bool {
        self.body == body as u32
    }

    #[inline(always)]
    pub(crate) fn inertia(&self) -> SpatialInertia<f32> {
        let vector = |x, y, z| <f32 as Real>::Vec3::new(x, y, z);
        let ([x, y, z], [xx, xy, xz, yy, yz, zz]) = (self.first_moment, self.second_moment);
        SpatialInertia {
            mass: self.mass,
            first_moment: vector(x, y, z),
            rotational: <f32 as Real>::Mat3::from_cols(
                vector(xx, xy, xz),
                vector(xy, yy, yz),
                vector(xz, yz, zz),
            ),
        }
    }

    /// Its gravity.
    #[inline(always)]
    pub(crate) fn gravity(&self) -> GravityVector<f32> {
        let [x, y, z] = self.gravity;
        GravityVector(<f32 as Real>::Vec3::new(x, y, z))
    }

    /// Its load on the usual body.
    #[inline(always)]
    pub(crate) fn load<const TOOL: usize>(&self) -> Payload<f32, TOOL> {
        Payload(self.inertia())
    }

    /// Its load on any body.
    #[inline(always)]
    pub(crate) fn anywhere(&self) -> Anywhere {
        Anywhere { body: self.body as usize, inertia: self.inertia() }
    }
}

/// A load on the body of a number that is known at run time.
pub(crate) struct Anywhere {
    body: usize,
    inertia: SpatialInertia<f32>,
}

impl<const N: usize> Effect<f32, N, N> for Anywhere {
    const ADDED_INERTIA: hook::Inertia<Self, f32, N> = hook::Inertia::on([true; N], Self::add_to);
}

impl Anywhere {
    // As part of the algorithms: in a crate of its own it would be called.
    #[inline(always)]
    fn add_to(&self, body: usize, inertia: &mut SpatialInertia<f32>) {
        if body == self.body {
            *inertia = *inertia + self.inertia;
        }
    }
}

/// What acts on the robot with a tool: the scene, whose parameters stay constants of the machine code, and the tool.
pub(crate) struct With<L, P> {
    pub gravity: GravityVector<f32>,
    pub load: P,
    pub library: PhantomData<L>,
}

delegate_effect! {
    impl[L, P, const N: usize, const TOOL: usize, const POINTS: usize] Effect<f32, N, N>
    for With<Exports<L, N, TOOL, POINTS>, P> where [L: Library<N, TOOL, POINTS>, P: Effect<f32, N, N>],
    |this| { L::Forces => L::EFFECTS.1, GravityVector<f32> => this.gravity, P => this.load }
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// A word that zeros and the tools of other libraries do not have.
    const TOOL_MAGIC: u32 = L::HASH as u32 | 1;

    /// No load, and the scene's gravity.
    pub(crate) const NO_TOOL: Tool = Tool {
        magic: Self::TOOL_MAGIC,
        body: TOOL as u32,
        mass: 0.0,
        first_moment: [0.0; 3],
        second_moment: [0.0; 6],
        gravity: [0.0, 0.0, -(L::GRAVITY as f32)],
    };

    /// The greatest mass of a load, kg, and the greatest coordinate of its centre of mass, m: ten
    /// times those of the robot with its arm stretched out, or 10 kg and 1 m, if these are more.
    /// Numbers beyond look like grams or millimetres. A robot without masses has no such bounds.
    const fn most_of_a_load() -> (f32, f32) {
        let model: ArmModel<f64, N> = <L::Arm as Robot<N, N, N>>::MODEL;
        let (mut mass, mut length, mut body) = (0.0, 0.0, 0);
        while body < N {
            let Link { placement, inertia, .. } = &model.links[body];
            let (offset, moment) = (placement.pos, inertia.first_moment);
            mass += inertia.mass;
            length += offset.x.abs() + offset.y.abs() + offset.z.abs();
            if inertia.mass > 0.0 {
                length += (moment.x.abs() + moment.y.abs() + moment.z.abs()) / inertia.mass;
            }
            body += 1;
        }
        match mass > 0.0 {
            true => ((10.0 * mass).max(10.0) as f32, (10.0 * length).max(1.0) as f32),
            false => (f32::MAX, f32::MAX),
        }
    }

    /// The tool, if it was set.
    #[inline(always)]
    pub(crate) fn set_tool(tool: &Tool) -> Result<&Tool, i32> {
        let is_set = tool.magic == Self::TOOL_MAGIC && tool.body < N as u32;
        if is_set { Ok(tool) } else { Err(status::TOOL) }
    }

    fn tool(body: i32, load: &Load, gravity: &[f32; 3]) -> Result<Tool, i32> {
        let body = usize::try_from(body).ok().filter(|&body| body < N);
        let body = body.ok_or(status::NO_BODY)?;
        check::inputs([&[load.mass], &load.com, &load.inertia])?;
        let Load { mass, com, inertia } = *load;
        let (heaviest, farthest) = const { Self::most_of_a_load() };
        if mass > heaviest {
            return Err(status::LOAD_MASS);
        }
        if com.iter().any(|x| x.abs() > farthest) {
            return Err(status::LOAD_COM);
        }
        is_gravity(gravity)?;
        let described = BodyInertia { mass, com, inertia };
        let checked = Payload::<f32, 0>::try_new(described, 1e-6);
        let inertia = checked.map_err(|error| match error.problem {
            Problem::Mass(_) => status::MASS,
            Problem::Massless => status::MASSLESS,
            Problem::NotFinite => status::OVERFLOW,
            _ => status::MOMENTS,
        })?;
        let [x, y, z] = inertia.0.rotational.to_cols_array_2d();
        Ok(Tool {
            magic: Self::TOOL_MAGIC,
            body: body as u32,
            mass,
            first_moment: inertia.0.first_moment.to_array(),
            second_moment: [x[0], x[1], x[2], y[1], y[2], z[2]],
            gravity: *gravity,
        })
    }

    /// Sets a tool.
    pub fn tool_set(
        tool: Option<&mut Tool>,
        body: i32,
        load: Option<&Load>,
        gravity: Option<&[f32; 3]>,
    ) -> i32 {
        let (Some(tool), Some(load), Some(gravity)) = (tool, load, gravity) else {
            return status::NULL;
        };
        status_of(|| Self::tool(body, load, gravity).map(|new| *tool = new))
    }

    /// Gravity in the coordinates of a base of this attitude.
    pub fn gravity_of_base(
        attitude: Option<&[[f32; 3]; 3]>,
        gravity: Option<&mut [f32; 3]>,
    ) -> i32 {
        status_of(|| {
            let (attitude, gravity) = (attitude.ok_or(NULL)?, gravity.ok_or(NULL)?);
            check::inputs([attitude.as_flattened()])?;
            if !is_rotation(attitude) {
                return Err(status::ROTATION);
            }
            // −g z of the world is the third row of the matrix.
            let [_, _, up] = attitude;
            *gravity = up.map(|of| -(L::GRAVITY as f32) * of);
            Ok(())
        })
    }
}
