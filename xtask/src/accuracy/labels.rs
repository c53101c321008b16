//! Where to write names beside points, so that none covers another.

/// A rectangle in pixels: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area(pub [f64; 4]);

impl Area {
    /// How many square pixels both cover.
    pub fn shared(self, other: Self) -> f64 {
        let [a, b] = [self.0, other.0];
        let wide = a[2].min(b[2]) - a[0].max(b[0]);
        let high = a[3].min(b[3]) - a[1].max(b[1]);
        wide.max(0.0) * high.max(0.0)
    }

    fn size(self) -> f64 {
        let [left, top, right, bottom] = self.0;
        (right - left) * (bottom - top)
    }

    fn grown(self, by: f64) -> Self {
        let [left, top, right, bottom] = self.0;
        Self([left - by, top - by, right + by, bottom + by])
    }
}

/// What names must keep clear of.
pub struct Canvas {
    bounds: Area,
    taken: Vec<Area>,
    /// What a name may cover if it must: lines, points of lesser interest.
    thin: Vec<Area>,
}

/// Directions from a point to its name's middle.
const DIRECTIONS: usize = 24;
/// Pixels from a point to the edge of its name, nearest first.
const DISTANCES: [f64; 8] = [7.0, 14.0, 24.0, 36.0, 52.0, 72.0, 100.0, 140.0];

impl Canvas {
    /// An empty one.
    pub fn new(bounds: Area) -> Self {
        Self {
            bounds,
            taken: Vec::new(),
            thin: Vec::new(),
        }
    }

    /// Nothing may be written here.
    pub fn take(&mut self, area: Area) {
        self.taken.push(area);
    }

    /// Better nothing is written here.
    pub fn spare(&mut self, area: Area) {
        self.thin.push(area);
    }

    /// Keeps a dot of this radius clear.
    pub fn dot(&mut self, [x, y]: [f64; 2], radius: f64) {
        self.take(Area([x - radius, y - radius, x + radius, y + radius]));
    }

    /// Keeps a straight line from being written over.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        let long = f64::hypot(to[0] - from[0], to[1] - from[1]);
        let pieces = (long / 8.0).ceil().max(1.0) as usize;
        for i in 0..=pieces {
            let s = i as f64 / pieces as f64;
            let [x, y] = [0, 1].map(|k| from[k] + s * (to[k] - from[k]));
            self.spare(Area([x - 2.0, y - 2.0, x + 2.0, y + 2.0]));
        }
    }

    /// The best place for a name of this width and height near a point; it is taken then.
    pub fn place(&mut self, at: [f64; 2], size: [f64; 2]) -> Area {
        let places = DISTANCES.iter().flat_map(|distance| {
            (0..DIRECTIONS).map(move |i| {
                let (sine, cosine) =
                    (i as f64 / DIRECTIONS as f64 * std::f64::consts::TAU).sin_cos();
                // The middle, so that the edge is that far off.
                let x = at[0] + cosine * (size[0] / 2.0 + distance);
                let y = at[1] + sine * (size[1] / 2.0 + distance);
                let [w, h] = size.map(|s| s / 2.0);
                (*distance, Area([x - w, y - h, x + w, y + h]))
            })
        });
        let cost = |distance: f64, area: Area| {
            let room = area.grown(2.0);
            let hits: f64 = self.taken.iter().map(|other| room.shared(*other)).sum();
            let touches: f64 = self.thin.iter().map(|other| area.shared(*other)).sum();
            let outside = area.size() - area.shared(self.bounds);
            1e3 * (hits + outside) + 1.0 * touches + distance
        };
        let best = places
            .map(|(distance, area)| (cost(distance, area), area))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let area = best.map_or(self.bounds, |(_, area)| area);
        self.take(area);
        area
    }
}

/// Heights as near as can be to those wished, in their order, each so far from the next.
pub fn spread(wished: &[f64], apart: f64, [top, bottom]: [f64; 2]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wished.len()).collect();
    order.sort_by(|&a, &b| wished[a].total_cmp(&wished[b]));
    let mut at: Vec<f64> = order.iter().map(|&i| wished[i]).collect();
    // Neighbours push each other away, until all have room.
    for _ in 0..200 {
        for i in 1..at.len() {
            let lack = apart - (at[i] - at[i - 1]);
            if lack > 0.0 {
                at[i] += lack / 2.0;
                at[i - 1] -= lack / 2.0;
            }
        }
        at.iter_mut().for_each(|y| *y = y.clamp(top, bottom));
    }
    let mut heights = vec![0.0; wished.len()];
    for (i, y) in order.into_iter().zip(at) {
        heights[i] = y;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::{Area, Canvas, spread};

    #[test]
    fn names_of_a_crowd_do_not_cover_each_other() {
        let mut canvas = Canvas::new(Area([0.0, 0.0, 600.0, 400.0]));
        let points: Vec<[f64; 2]> = (0..8).map(|i| [300.0 + f64::from(i), 200.0]).collect();
        points.iter().for_each(|&at| canvas.dot(at, 4.0));
        let names: Vec<Area> = points
            .iter()
            .map(|&at| canvas.place(at, [120.0, 14.0]))
            .collect();
        for (i, one) in names.iter().enumerate() {
            assert!(names[..i].iter().all(|other| one.shared(*other) == 0.0));
        }
    }

    #[test]
    fn heights_are_spread_no_more_than_needed() {
        let heights = spread(&[100.0, 102.0, 300.0], 16.0, [0.0, 400.0]);
        assert!((heights[1] - heights[0] - 16.0).abs() < 0.1, "{heights:?}");
        assert_eq!(heights[2], 300.0);
    }
}
