//! The inertia of a body: stated, or that of its geoms, and the bounds of the compiler.

use dynamics_core::glam::{DMat3, DVec3};

use super::compiler::{Compiler, FromGeoms};
use super::defaults::View;
use super::element::Element;
use super::geom::Solid;
use super::pose::Placement;
use crate::description::{Inertial, Link, Pose, Snap};
use crate::error::{Problem, Result};

const KNOWN: &str = "axisangle diaginertia euler fullinertia mass pos quat xyaxes zaxis";
/// A coordinate of a sum over geoms below this is the rounding of the sum, m.
const NOISE: f64 = 1e-12;

/// The inertia of a body of which `stated` and `geoms` are in the file.
///
/// # Errors
/// An `<inertial>` without its attributes.
pub fn of_body(
    stated: Option<(&Element, &Placement)>,
    geoms: &[Solid],
    compiler: &Compiler,
) -> Result<(Option<Inertial>, Vec<Snap>)> {
    let explicit = match stated {
        Some((element, frame)) => Some(explicit(element, frame, compiler)?),
        None => None,
    };
    // Those of geoms are of the geoms' frames.
    let of_geoms = || Some((sum(geoms)?, Vec::new()));
    let inertial = match compiler.from_geoms {
        FromGeoms::Never => explicit,
        FromGeoms::Auto => explicit.or_else(of_geoms),
        FromGeoms::Always => of_geoms().or(explicit),
    };
    let (inertial, snapped) = inertial.unzip();
    Ok((bounded(inertial, compiler), snapped.unwrap_or_default()))
}

/// The inertia that an element `<inertial>` states.
fn explicit(
    element: &Element,
    frame: &Placement,
    compiler: &Compiler,
) -> Result<(Inertial, Vec<Snap>)> {
    element.only(KNOWN)?;
    let view = View::plain(element);
    for name in ["pos", "mass"] {
        if element.get(name).is_none() {
            return Err(element.error(Problem::Missing(name)));
        }
    }
    let placement = frame.then(&Placement::read(view, compiler)?);
    let full = view.numbers::<6>("fullinertia")?;
    if full.is_some() {
        let other = super::defaults::ORIENTATIONS.into_iter().chain(["diaginertia"]);
        if let Some(other) = other.into_iter().find(|name| element.get(name).is_some()) {
            return Err(element.value(format!("`fullinertia` and `{other}` exclude each other")));
        }
    }
    let mass = view.number("mass")?;
    if mass < 0.0 {
        return Err(element.value(format!("its mass is {mass} kg")));
    }
    let [x, y, z] = view.numbers::<3>("diaginertia")?.unwrap_or_default();
    let inertial = Inertial {
        mass,
        frame: placement.pose,
        exact: placement.exact,
        // The file has the products of inertia after the moments: xx yy zz xy xz yz.
        inertia: full
            .map_or([x, 0.0, 0.0, y, 0.0, z], |[xx, yy, zz, xy, xz, yz]| [xx, xy, xz, yy, yz, zz]),
    };
    Ok((inertial, placement.snapped))
}

/// The inertia of all geoms together.
fn sum(geoms: &[Solid]) -> Option<Inertial> {
    if let [geom] = geoms {
        let [x, y, z] = geom.inertia;
        return Some(Inertial {
            mass: geom.mass,
            frame: geom.frame.pose,
            exact: geom.frame.exact,
            inertia: [x, 0.0, 0.0, y, 0.0, z],
        });
    }
    let mass: f64 = geoms.iter().map(|geom| geom.mass).sum();
    if mass == 0.0 {
        return None;
    }
    let moments = geoms.iter().map(|geom| geom.mass * geom.frame.pose.position);
    let center = moments.fold(DVec3::ZERO, |sum, moment| sum + moment) / mass;
    let mut total = DMat3::ZERO;
    for geom in geoms {
        let Pose { position, rotation } = geom.frame.pose;
        let principal = DMat3::from_diagonal(DVec3::from_array(geom.inertia));
        total +=
            rotation * principal * rotation.transpose() + steiner(geom.mass, position - center);
    }
    let snapped = center.to_array().map(|x| if x.abs() < NOISE { 0.0 } else { x });
    Some(Inertial {
        mass,
        frame: Pose::translation(center),
        exact: Pose::translation(DVec3::from_array(snapped)),
        inertia: entries(&total),
    })
}

/// m (r·r 1 − r rᵀ).
fn steiner(mass: f64, r: DVec3) -> DMat3 {
    let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
    (DMat3::from_diagonal(DVec3::splat(r.dot(r))) - outer) * mass
}

fn entries(tensor: &DMat3) -> [f64; 6] {
    let [x, y, z] = [tensor.x_axis, tensor.y_axis, tensor.z_axis];
    [x.x, y.x, z.x, y.y, z.y, z.z]
}

/// The inertia within the bounds `boundmass`, `boundinertia` and `balanceinertia`.
fn bounded(inertial: Option<Inertial>, compiler: &Compiler) -> Option<Inertial> {
    let bounds = compiler.bound_mass > 0.0 || compiler.bound_inertia > 0.0;
    let none =
        Inertial { mass: 0.0, frame: Pose::IDENTITY, exact: Pose::IDENTITY, inertia: [0.0; 6] };
    let mut inertial = match inertial {
        Some(inertial) => inertial,
        None if bounds => none,
        None => return None,
    };
    inertial.mass = inertial.mass.max(compiler.bound_mass);
    if !bounds && !compiler.balance {
        return Some(inertial);
    }
    let (axes, mut principal) = principal(inertial.inertia);
    let apart = principal.map(|x| x < compiler.bound_inertia);
    principal = principal.map(|x| x.max(compiler.bound_inertia));
    let total: f64 = principal.iter().sum();
    let largest = principal.iter().fold(0.0, |most: f64, x| most.max(*x));
    let unbalanced = compiler.balance && 2.0 * largest > total * (1.0 + 1e-12);
    if unbalanced {
        principal = [total / 3.0; 3];
    }
    if unbalanced || apart.contains(&true) {
        let diagonal = DMat3::from_diagonal(DVec3::from_array(principal));
        inertial.inertia = entries(&(axes * diagonal * axes.transpose()));
    }
    Some(inertial)
}

/// The principal axes, as columns, and inertias: Jacobi's rotations.
fn principal([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> (DMat3, [f64; 3]) {
    let mut a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let mut axes = DMat3::IDENTITY;
    for sweep in 0..90 {
        let (p, q) = [(0, 1), (0, 2), (1, 2)][sweep % 3];
        if a[p][q] == 0.0 {
            continue;
        }
        let theta = 0.5 * (2.0 * a[p][q]).atan2(a[p][p] - a[q][q]);
        let (s, c) = theta.sin_cos();
        let mut turn = [[0.0; 3]; 3];
        for (i, row) in turn.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        // Columns of the rotation.
        turn[p][p] = c;
        turn[p][q] = s;
        turn[q][p] = -s;
        turn[q][q] = c;
        let turn = DMat3::from_cols_array_2d(&turn);
        a = (turn.transpose() * DMat3::from_cols_array_2d(&a) * turn).to_cols_array_2d();
        axes *= turn;
    }
    (axes, [a[0][0], a[1][1], a[2][2]])
}

/// Scales all masses and inertias so that the masses have this sum.
pub fn scale(links: &mut [Link], total: f64) {
    let all = links.iter().filter_map(|link| link.inertial.as_ref());
    let mass: f64 = all.map(|inertial| inertial.mass).sum();
    if mass <= 0.0 {
        return;
    }
    let factor = total / mass;
    for inertial in links.iter_mut().filter_map(|link| link.inertial.as_mut()) {
        inertial.mass *= factor;
        inertial.inertia = inertial.inertia.map(|x| x * factor);
    }
}
