//! serde's traits for the types that firmware stores in flash, for the feature `serde`.
//!
//! A field at a time, under its name, arrays as tuples of their length. Only types whose fields are
//! public have them, and limits that their check rejects are not read. Types that a constructor
//! checks (models, trajectories, supervisors, payloads) have no `Deserialize`: the constructor
//! builds them from these.
//!
//! Public, and hidden, for the crates of this project whose structs have the same form.

use crate::effects::{Armature, ConstantTorque, Viscous, Width};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::SpatialInertia;
use core::fmt;
use core::marker::PhantomData;
use heapless::Vec;
use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// An array of any length: serde implements its traits only up to 32.
#[derive(Debug)]
pub struct Array<T, const N: usize>(pub [T; N]);

impl<T: Serialize, const N: usize> Serialize for Array<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(N)?;
        for value in &self.0 {
            tuple.serialize_element(value)?;
        }
        tuple.end()
    }
}

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Array<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple(N, Elements(PhantomData))
    }
}

struct Elements<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Elements<T, N> {
    type Value = Array<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of {N} values")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::<T, N>::new();
        while let Some(value) = seq.next_element()? {
            if values.push(value).is_err() {
                return Err(A::Error::invalid_length(N + 1, &self));
            }
        }
        let found = values.len();
        let array = values.into_array();
        array.map(Array).map_err(|_| A::Error::invalid_length(found, &self))
    }
}

/// A field's value in the form that serde takes, and back.
pub trait Form<F>: Copy {
    /// In that form.
    fn form(self) -> F;
    /// From that form.
    fn of(form: F) -> Self;
}

impl<R: Real> Form<Self> for R {
    fn form(self) -> Self {
        self
    }
    fn of(form: Self) -> Self {
        form
    }
}

impl Form<Self> for u32 {
    fn form(self) -> Self {
        self
    }
    fn of(form: Self) -> Self {
        form
    }
}

impl Form<Self> for bool {
    fn form(self) -> Self {
        self
    }
    fn of(form: Self) -> Self {
        form
    }
}

/// The width, not its reciprocal: 1/(1/(1/w)) is 1/w to the bit.
impl<R: Real> Form<R> for Width<R> {
    fn form(self) -> R {
        self.get()
    }
    fn of(form: R) -> Self {
        Self::new(form)
    }
}

impl<R: Real, const N: usize> Form<Array<R, N>> for [R; N] {
    fn form(self) -> Array<R, N> {
        Array(self)
    }
    fn of(form: Array<R, N>) -> Self {
        form.0
    }
}

impl<const N: usize> Form<Array<u16, N>> for [u16; N] {
    fn form(self) -> Array<u16, N> {
        Array(self)
    }
    fn of(form: Array<u16, N>) -> Self {
        form.0
    }
}

impl<R: Real, const H: usize, const N: usize> Form<Array<Array<R, H>, N>> for [[R; H]; N] {
    fn form(self) -> Array<Array<R, H>, N> {
        Array(self.map(Array))
    }
    fn of(form: Array<Array<R, H>, N>) -> Self {
        form.0.map(|row| row.0)
    }
}

/// The traits of a struct, by a twin whose arrays are [`Array`]s. A field that is missing here does
/// not compile. A value that its `check` refuses is not read.
#[macro_export]
#[doc(hidden)]
#[allow(clippy::crate_in_macro_def, reason = "the struct is of the crate that calls it")]
macro_rules! serde_record {
    ($module:ident::$name:ident<R $(, $n:ident)*> { $($field:ident: $form:ty),+ $(,)? } $($check:ident)?) => {
        const _: () = {
            use $crate::serde_form::Form;
            use serde::{Deserialize, Deserializer, Serialize, Serializer};

            #[derive(Serialize, Deserialize)]
            #[serde(
                deny_unknown_fields,
                bound(serialize = "R: Real + Serialize", deserialize = "R: Real + Deserialize<'de>")
            )]
            struct $name<R $(, const $n: usize)*> {
                $($field: $form),+
            }

            impl<R: Real + Serialize $(, const $n: usize)*> Serialize for crate::$module::$name<R $(, $n)*> {
                fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    $name { $($field: self.$field.form()),+ }.serialize(serializer)
                }
            }

            impl<'de, R: Real + Deserialize<'de> $(, const $n: usize)*> Deserialize<'de>
                for crate::$module::$name<R $(, $n)*>
            {
                fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    let read = $name::deserialize(deserializer)?;
                    let value = Self { $($field: Form::of(read.$field)),+ };
                    $(value.$check().map_err(serde::de::Error::custom)?;)?
                    Ok(value)
                }
            }
        };
    };
}

serde_record!(state::State<R, Q, V> { q: Array<R, Q>, qd: Array<R, V>, qdd: Array<R, V> });
serde_record!(model::JointLimits<R> { lower: R, upper: R, velocity: R, torque: R });
serde_record!(model::BodyInertia<R> { mass: R, com: Array<R, 3>, inertia: Array<R, 6> });

serde_record!(effects::Coulomb<R, V> { torque: Array<R, V>, width: R });
serde_record!(effects::AsymmetricCoulomb<R, V> {
    forward: Array<R, V>,
    backward: Array<R, V>,
    width: R,
});
serde_record!(effects::LoadFriction<R, V> {
    driving: Array<R, V>,
    backdriving: Array<R, V>,
    width: R,
});
serde_record!(effects::PreslidingLoadFriction<R, V> {
    magnitude: Array<R, V>,
    torque: Array<R, V>,
    deflection: Array<R, V>,
    direction: Array<R, V>,
});
serde_record!(effects::Stribeck<R, V> { excess: Array<R, V>, stribeck_speed: R, width: R });
serde_record!(effects::Lugre<R, V> {
    stiffness: Array<R, V>,
    damping: Array<R, V>,
    viscous: Array<R, V>,
    sliding: Array<R, V>,
    excess: Array<R, V>,
    stribeck_speed: R,
    bristle: Array<R, V>,
});
serde_record!(effects::Cogging<R, H, V> {
    per_turn: Array<R, V>,
    cos: Array<Array<R, H>, V>,
    sin: Array<Array<R, H>, V>,
});
serde_record!(effects::Spring<R, V> { stiffness: Array<R, V>, rest: Array<R, V> });
serde_record!(effects::EndStops<R, V> {
    lower: Array<R, V>,
    upper: Array<R, V>,
    stiffness: R,
    damping: R,
    damping_depth: R,
});

/// The traits of a number per joint: those of the array.
macro_rules! per_joint {
    ($($name:ident),+) => {$(
        impl<R: Real + Serialize, const V: usize> Serialize for $name<R, V> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                Array(self.0).serialize(serializer)
            }
        }

        impl<'de, R: Real + Deserialize<'de>, const V: usize> Deserialize<'de> for $name<R, V> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Array::deserialize(deserializer).map(|values| Self(values.0))
            }
        }
    )+};
}

per_joint!(Viscous, Armature, ConstantTorque);

/// Ten numbers, so that what is read is symmetric: the rotational inertia is xx, xy, xz, yy, yz,
/// zz.
#[derive(Serialize, Deserialize)]
#[serde(rename = "SpatialInertia", deny_unknown_fields)]
struct TenNumbers<R> {
    mass: R,
    first_moment: Array<R, 3>,
    rotational: Array<R, 6>,
}

impl<R: Real + Serialize> Serialize for SpatialInertia<R> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = self.rotational.cols().map(R::Vec3::array);
        let form = TenNumbers {
            mass: self.mass,
            first_moment: Array(self.first_moment.array()),
            rotational: Array([xx, xy, xz, yy, yz, zz]),
        };
        form.serialize(serializer)
    }
}

impl<'de, R: Real + Deserialize<'de>> Deserialize<'de> for SpatialInertia<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = TenNumbers::<R>::deserialize(deserializer)?;
        let ([x, y, z], [xx, xy, xz, yy, yz, zz]) = (read.first_moment.0, read.rotational.0);
        let column = R::Vec3::new;
        Ok(Self {
            mass: read.mass,
            first_moment: column(x, y, z),
            rotational: R::Mat3::from_cols(
                column(xx, xy, xz),
                column(xy, yy, yz),
                column(xz, yz, zz),
            ),
        })
    }
}
