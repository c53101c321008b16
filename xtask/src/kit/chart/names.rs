//! Names beside points, each at the nearest place where it covers nothing.

use super::{Area, HPos, MUTED, Outcome, Place, RGBColor, TEXT, coloured, path, wide};

/// px: half the height of a text, and what stays free around it.
const HALF: i32 = 7;
const GAP: i32 = 2;
/// px: the distances from a point at which its name may begin, and the steps up and down.
const BESIDE: [i32; 4] = [9, 16, 30, 50];
const STEPS: i32 = 24;
const STEP: i32 = 5;
/// px: a name that is farther away has a line to its point.
const NEAR: i32 = 9;
/// The points of such a line that are looked at.
const POINTS: i32 = 16;

/// The left upper and the right lower corner.
type Corners = [Place; 2];

/// The places that names must not cover.
pub struct Names {
    boxes: Vec<Corners>,
    /// The edges within which names are.
    within: Corners,
}

impl Names {
    pub fn new(within: Corners) -> Self {
        Self { boxes: Vec::new(), within }
    }

    /// Keeps names away from a line of upright and level strokes.
    pub fn keep_off_line(&mut self, places: &[Place]) {
        let strokes = places.windows(2);
        self.boxes.extend(strokes.map(|ends| around(ends, 1)));
    }

    pub fn keep_off_dot(&mut self, at: Place, radius: i32) {
        self.boxes.push(around(&[at], radius));
    }

    /// A name at the first of these places that is free, or at the first one.
    pub fn first_free(
        &mut self,
        area: &Area<'_>,
        (words, colour): (&str, RGBColor),
        places: &[(Place, HPos)],
    ) -> Outcome {
        let mut free = places.iter().filter(|(at, side)| self.is_free(room(words, *at, *side)));
        let (at, side) = free.next().map_or(places[0], |place| *place);
        self.boxes.push(room(words, at, side));
        coloured(area, words, at, (TEXT, colour), side)
    }

    /// A name for a point, with a line to it where it is not beside it.
    pub fn beside(
        &mut self,
        area: &Area<'_>,
        words: &str,
        at @ (x, y): Place,
        colour: RGBColor,
    ) -> Outcome {
        let sides = [(-1, HPos::Right), (1, HPos::Left)];
        let ups = (0..STEPS).flat_map(|step| [step * STEP, -step * STEP]);
        let each = ups.flat_map(|up| BESIDE.map(|far| (far, up)));
        let mut places: Vec<_> = each
            .flat_map(|(far, up)| sides.map(|(sign, side)| ((x + sign * far, y + up), side)))
            .collect();
        places.sort_by_key(|((to, up), _)| (to - x).abs() + 2 * (up - y).abs());
        let nearest = places[0];
        places.retain(|&(to, side)| self.is_free(room(words, to, side)));
        let others = self.boxes.iter().filter(|one| !meet(**one, around(&[at], 1)));
        let is_clear = |(to, _): &&(Place, HPos)| {
            leader(at, *to).all(|on| !others.clone().any(|one| meet(around(&[on], 0), *one)))
        };
        // A line to a name crosses another one only if there is no other place.
        let free = places.iter().find(is_clear).or(places.first());
        let (to, side) = *free.unwrap_or(&nearest);
        if leader(at, to).next().is_some() {
            path(area, &[at, (to.0 + (x - to.0).signum() * 2, to.1)], MUTED, 1)?;
            self.boxes.extend(leader(at, to).map(|on| around(&[on], 0)));
        }
        self.boxes.push(room(words, to, side));
        coloured(area, words, to, (TEXT, colour), side)
    }

    fn is_free(&self, one: Corners) -> bool {
        let [(left, top), (right, bottom)] = one;
        let [(x0, y0), (x1, y1)] = self.within;
        let inside = left >= x0 && top >= y0 && right <= x1 && bottom <= y1;
        inside && !self.boxes.iter().any(|other| meet(one, *other))
    }
}

/// Points of the line from a point to its name, if that is not beside it.
fn leader((x, y): Place, to: Place) -> impl Iterator<Item = Place> {
    let is_near = (to.0 - x).abs() + (to.1 - y).abs() <= NEAR;
    let points = 1..if is_near { 1 } else { POINTS };
    points.map(move |k| (x + k * (to.0 - x) / POINTS, y + k * (to.1 - y) / POINTS))
}

/// The room of a text.
fn room(words: &str, (x, y): Place, side: HPos) -> Corners {
    let long = wide(words, TEXT);
    let left = match side {
        HPos::Left => x,
        HPos::Center => x - long / 2,
        HPos::Right => x - long,
    };
    [(left, y - HALF), (left + long, y + HALF)]
}

fn around(places: &[Place], more: i32) -> Corners {
    let fold = |of: fn(&Place) -> i32| {
        let all = places.iter().map(of);
        [all.clone().min().unwrap_or(0) - more, all.max().unwrap_or(0) + more]
    };
    let [[left, right], [top, bottom]] = [fold(|place| place.0), fold(|place| place.1)];
    [(left, top), (right, bottom)]
}

fn meet([a, b]: Corners, [c, d]: Corners) -> bool {
    a.0 < d.0 + GAP && c.0 < b.0 + GAP && a.1 < d.1 + GAP && c.1 < b.1 + GAP
}
