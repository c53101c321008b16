//! Which coordinates of the tree belong to which cluster, checked while compiling.

use crate::model::{BASE, JointKind, Link, Model};

/// The largest number of clusters.
pub(super) const CLUSTERS: usize = 8;

/// The largest number of independent coordinates of a cluster.
pub(super) const INDEPENDENT: usize = 6;

/// The number of blocks that [`for_each_joint`](crate::engine::for_each_joint) expands.
pub(super) const EXPANDED: usize = 64;

/// No cluster, or no place.
pub(super) const NONE: usize = usize::MAX;

/// The places of coordinates: of the tree's in clusters and in y.
#[derive(Clone, Copy)]
pub(super) struct Layout<const Q: usize, const V: usize> {
    /// The cluster of each velocity coordinate of the tree.
    pub(super) cluster: [usize; V],
    /// Its row there.
    pub(super) row: [usize; V],
    /// The place in ẏ of each velocity coordinate in no cluster.
    pub(super) free: [usize; V],
    /// The place in y of each position coordinate in no cluster.
    pub(super) free_q: [usize; Q],
    /// The position that belongs to each velocity coordinate in a cluster.
    pub(super) position: [usize; V],
    /// The place of a cluster's first coordinate in y and in ẏ.
    pub(super) first: [[usize; 2]; CLUSTERS],
    /// Their number.
    pub(super) count: [usize; CLUSTERS],
    /// The first body of each cluster, which is the last that a pass from the tips reaches.
    pub(super) root: [usize; CLUSTERS],
    /// One past the last body of each cluster.
    pub(super) end: [usize; CLUSTERS],
    /// Whether the joints of a cluster have limits within ±4π.
    pub(super) near: [bool; CLUSTERS],
}

impl<const Q: usize, const V: usize> Layout<Q, V> {
    /// The layout of the clusters that drive these coordinates of a model and have these sizes M
    /// and N; a description that cannot be does not compile.
    pub(super) const fn of<const B: usize>(
        model: &Model<f64, B, Q, V>,
        coordinates: &[&[usize]],
        sizes: &[[usize; 2]],
        [p, y]: [usize; 2],
    ) -> Self {
        let mut layout = Self {
            cluster: [NONE; V],
            row: [NONE; V],
            free: [NONE; V],
            free_q: [NONE; Q],
            position: [NONE; V],
            first: [[NONE; 2]; CLUSTERS],
            count: [0; CLUSTERS],
            root: [NONE; CLUSTERS],
            end: [NONE; CLUSTERS],
            near: [true; CLUSTERS],
        };
        assert!(sizes.len() <= CLUSTERS, "a robot has up to 8 clusters");
        assert!(
            coordinates.len() == sizes.len(),
            "there is not one list of coordinates for each cluster"
        );
        let mut c = 0;
        while c < sizes.len() {
            layout.assign(c, coordinates[c], sizes[c]);
            c += 1;
        }
        let mut outer = [None; CLUSTERS];
        let (mut i, mut next) = (0, [0, 0]);
        while i < B {
            next = layout.body(model, i, next, &mut outer);
            i += 1;
        }
        assert!(
            next[0] == p && next[1] == y,
            "P and Y are not the numbers of independent positions and velocities: coordinates in \
             no cluster, and each cluster's N"
        );
        layout
    }

    /// Gives the coordinates to cluster `c`.
    const fn assign(&mut self, c: usize, coordinates: &[usize], [m, n]: [usize; 2]) {
        assert!(
            coordinates.len() == m,
            "a cluster's list of coordinates does not have its M entries"
        );
        assert!(n <= INDEPENDENT, "a cluster has up to 6 independent coordinates");
        self.count[c] = n;
        let mut k = 0;
        while k < m {
            let v = coordinates[k];
            assert!(v < V, "a cluster drives a coordinate that the robot does not have");
            assert!(
                self.cluster[v] == NONE,
                "a coordinate is driven twice, by one cluster or by two"
            );
            self.cluster[v] = c;
            self.row[v] = k;
            k += 1;
        }
    }

    /// Places the coordinates of body `i`, `next` being the first places of y and ẏ that are left;
    /// returns those after.
    const fn body<const B: usize>(
        &mut self,
        model: &Model<f64, B, Q, V>,
        i: usize,
        [p, y]: [usize; 2],
        outer: &mut [Option<usize>; CLUSTERS],
    ) -> [usize; 2] {
        let link = &model.links[i];
        let (nq, nv) = link.joint.kind.coordinates();
        if nv == 0 {
            return [p, y];
        }
        let (c, mut k) = (self.cluster[link.idx_v], 0);
        while k < nv {
            assert!(
                self.cluster[link.idx_v + k] == c,
                "a cluster drives a part of a joint's coordinates: it drives all of them or none"
            );
            k += 1;
        }
        if c == NONE {
            k = 0;
            while k < nq {
                self.free_q[link.idx_q + k] = p + k;
                k += 1;
            }
            k = 0;
            while k < nv {
                self.free[link.idx_v + k] = y + k;
                k += 1;
            }
            return [p + nq, y + nv];
        }
        assert!(
            is_scalar(link.joint.kind),
            "a cluster drives a joint whose velocities are not the derivatives of its positions: \
             spherical, planar or free"
        );
        k = 0;
        while k < nv {
            self.position[link.idx_v + k] = link.idx_q + k;
            k += 1;
        }
        self.near[c] &= is_near(link);
        let on_own_cluster = link.parent != BASE && {
            let parent = &model.links[link.parent];
            let (_, count) = parent.joint.kind.coordinates();
            count > 0 && self.cluster[parent.idx_v] == c
        };
        if !on_own_cluster {
            match outer[c] {
                None => outer[c] = Some(link.parent),
                Some(parent) => assert!(
                    parent == link.parent,
                    "the bodies of a cluster are not all on each other or on one body outside it"
                ),
            }
        }
        self.end[c] = i + 1;
        if self.root[c] != NONE {
            return [p, y];
        }
        self.root[c] = i;
        self.first[c] = [p, y];
        [p + self.count[c], y + self.count[c]]
    }
}

/// Whether a joint's velocities are the derivatives of its positions.
const fn is_scalar(kind: JointKind) -> bool {
    use JointKind::*;
    matches!(kind, Revolute | Continuous | Prismatic | Helical | Cylindrical | Universal)
}

/// Whether a joint has limits within ±4π, as the engine takes them for its sines.
const fn is_near(link: &Link<f64>) -> bool {
    link.limits.within_two_turns()
}

/// An entry of a list, or [`NONE`] behind its end: for constants that are evaluated where they are
/// not used, too.
pub(super) const fn at(list: &[usize], i: usize) -> usize {
    if i < list.len() { list[i] } else { NONE }
}

/// An entry of [`Cluster::INDEPENDENT`](super::Cluster::INDEPENDENT), of N independent coordinates.
pub(super) const fn independent<const N: usize>(list: &[Option<usize>], j: usize) -> Option<usize> {
    if j >= list.len() {
        return None;
    }
    if let Some(k) = list[j] {
        assert!(k < N, "`Cluster::INDEPENDENT` names a coordinate that the cluster does not have");
    }
    list[j]
}
