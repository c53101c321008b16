//! Published and counted operations of the ancestors as polynomials of the number of joints, and
//! term by term why they differ. A test counts, and holds each term.
//!
//! The published polynomials are sums of whole products of matrices, and the reasons are inferred
//! from that, not quoted. A term that fits no operation of the equations is called so.

pub use crate::polynomial::Polynomial;
use crate::polynomial::{NONE, poly};

/// Products and sums.
pub type Both = [Polynomial; 2];

/// A difference, counted less published, and its reason.
#[derive(Clone, Copy, Debug)]
pub struct Term(pub &'static str, pub Both);

#[derive(Clone, Copy, Debug)]
pub struct Counts {
    /// Its name in the firmware.
    pub key: &'static str,
    pub year: u32,
    pub authors: &'static str,
    pub form: &'static str,
    /// The counts as the publication prints them.
    pub published: Option<Both>,
    /// The printed totals at six joints, where they are another figure than the polynomials'.
    pub printed_at_6: Option<[i64; 2]>,
    /// The counts of this implementation.
    pub counted: Both,
    pub terms: &'static [Term],
}

impl Counts {
    /// Whether what was counted is what was published and all terms.
    pub fn is_explained(&self) -> bool {
        self.published.is_none_or(|published| {
            let add = |sum: Both, term: &Term| [sum[0].plus(&term.1[0]), sum[1].plus(&term.1[1])];
            self.terms.iter().fold(published, add) == self.counted
        })
    }
}

const FORM_A_4: Term = Term("forming the matrices A_i", [poly(0, 6, 0), NONE]);
const FORM_A_3: Term = Term("forming the matrices A_i", [poly(0, 4, 0), NONE]);

/// The ancestors, oldest first.
#[rustfmt::skip]
pub const ANCESTORS: [Counts; 10] = [
    Counts {
        key: "uicker_kahn", year: 1965, authors: "Uicker; Kahn (1969)", form: "Lagrange, 4 × 4 matrices, O(n⁴)",
        published: Some([Polynomial([390, 1037, 2055, 640, -1536]), Polynomial([300, 796, 1554, 508, -1152])]), printed_at_6: Some([66_271, 51_548]),
        counted: [Polynomial([390, 1036, 2064, 2246, -2304]), Polynomial([300, 800, 1578, 1630, -1728])],
        terms: &[
            FORM_A_4,
            Term("the matrices W_i, which the published count does not seem to have", [poly(0, 64, 0), poly(0, 48, 0)]),
            Term("one further product for each link that the published count does not seem to have", [poly(0, 64, 0), poly(0, 48, 0)]),
            Term("the first link needs three products of matrices fewer, not two", [poly(0, 0, -64), poly(0, 0, -48)]),
            Term("products with q̈: n²; the published count has half a one for each of n (n + 1) (n + 2) / 6 traces", [Polynomial([0, -1, 9, -2, 0]), NONE]),
            Term("two sums more for each of these traces", [NONE, Polynomial([0, 4, 12, 8, 0])]),
            Term("fits no operation; the published polynomial is no integer at n = 1", [NONE, Polynomial([0, 0, 12, -38, 0])]),
        ],
    },
    Counts {
        key: "waters", year: 1979, authors: "Waters", form: "Lagrange, 4 × 4, motion by recursion, O(n²)",
        published: Some([Polynomial([0, 0, 1278, 7446, -6144]), Polynomial([0, 0, 984, 6168, -4608])]), printed_at_6: Some([7_051, 5_652]),
        counted: [Polynomial([0, 0, 1278, 7518, -6348]), Polynomial([0, 0, 984, 5772, -5184])],
        terms: &[
            FORM_A_4,
            Term("two sums of matrices for each link beyond those of the equations of Ẇ and Ẅ, in the published count", [NONE, poly(0, -32, 0)]),
            Term("the first term of each τ_i is no sum", [NONE, poly(0, -1, 0)]),
            Term("the first link has no term with 2 Ẇ_0, and three sums of matrices fewer", [poly(0, 0, -17), poly(0, 0, -48)]),
        ],
    },
    Counts {
        key: "hollerbach_4", year: 1980, authors: "Hollerbach", form: "Lagrange, 4 × 4, recursions in both directions, O(n)",
        published: Some([poly(0, 830, -592), poly(0, 675, -464)]), printed_at_6: None, counted: [poly(0, 812, -609), poly(0, 643, -512)],
        terms: &[
            FORM_A_4,
            Term("4² + 8 products for each link that fit no operation", [poly(0, -24, 0), NONE]),
            Term("two sums of matrices for each link beyond those of the equations, as Waters", [NONE, poly(0, -32, 0)]),
            Term("the first link has no term with 2 Ẇ_0, and three sums of matrices fewer", [poly(0, 0, -17), poly(0, 0, -48)]),
        ],
    },
    Counts {
        key: "hollerbach_3", year: 1980, authors: "Hollerbach", form: "Lagrange, 3 × 3, recursions in both directions, O(n)",
        published: Some([poly(0, 412, -277), poly(0, 320, -201)]), printed_at_6: None, counted: [poly(0, 399, -262), poly(0, 302, -213)],
        terms: &[
            FORM_A_3,
            Term("3² + 8 products for each link that fit no operation", [poly(0, -17, 0), NONE]),
            Term("two sums of matrices for each link beyond those of the equations, as Waters", [NONE, poly(0, -18, 0)]),
            Term("the first link has no term with 2 Ẇ_0, and three sums of matrices fewer", [poly(0, 0, -10), poly(0, 0, -27)]),
            Term("p* e of the last link, which Hollerbach's frames do not have", [poly(0, 0, 9), poly(0, 0, 9)]),
            Term("Ẅ p* of the first link, whose origin is at rest in Hollerbach's frames", [poly(0, 0, 9), poly(0, 0, 6)]),
            Term("seven products that fit no operation", [poly(0, 0, 7), NONE]),
        ],
    },
    Counts {
        key: "luh_walker_paul", year: 1980, authors: "Luh, Walker & Paul", form: "Newton-Euler in link coordinates, O(n)",
        published: Some([poly(0, 150, -48), poly(0, 131, -48)]), printed_at_6: None, counted: [poly(0, 138, -47), poly(0, 108, -46)],
        terms: &[
            FORM_A_3,
            Term("viscous friction, left out here", [poly(0, -1, 0), poly(0, -1, 0)]),
            Term("z q̇, z q̈ and ω × z q̇ without the zeros of z", [poly(0, -4, 0), poly(0, -8, 0)]),
            Term("p* + s is a constant here", [NONE, poly(0, -3, 0)]), Term( "eleven products and sums for each link that fit no operation", [poly(0, -11, 0), poly(0, -11, 0)]),
            Term("the first link: ω_0 = ω̇_0 = 0", [poly(0, 0, 1), poly(0, 0, 2)]),
        ],
    },
    Counts {
        key: "balafoutis_patel", year: 1988, authors: "Balafoutis, Patel & Misra", form: "Newton-Euler, Cartesian tensors, augmented links, O(n)",
        published: Some([poly(0, 93, -69), poly(0, 81, -66)]), printed_at_6: None, counted: [poly(0, 93, -43), poly(0, 81, -40)],
        terms: &[Term("zeros of the first link's motion, and components of its moment that no torque needs", [poly(0, 0, 26), poly(0, 0, 26)])],
    },
    Counts {
        key: "method_1", year: 1982, authors: "Walker & Orin", form: "M, method 1: Newton-Euler for each column, O(n²)",
        published: None, printed_at_6: None, counted: [poly(84, -44, 0), poly(69, -46, 0)],
        terms: &[],
    },
    Counts {
        key: "method_2", year: 1982, authors: "Walker & Orin", form: "M, method 2: one triangle of it, O(n²)",
        published: None, printed_at_6: None, counted: [poly(42, -2, 0), Polynomial([0, 0, 414, -138, 0])],
        terms: &[],
    },
    Counts {
        key: "method_3", year: 1982, authors: "Walker & Orin", form: "M, method 3: composite rigid bodies, O(n²)",
        published: Some([poly(12, 56, -27), poly(7, 67, -56)]), printed_at_6: None, counted: [poly(11, 67, -24), poly(7, 57, -33)],
        terms: &[
            Term("two products for each pair of links: turned in two planes, f and n take 16", [poly(-1, 1, 0), NONE]),
            Term("ten products more and ten sums fewer for each link: A_i E A_iᵀ takes 40 and 20 here", [poly(0, 10, 0), poly(0, -10, 0)]),
            Term("the last link, which needs no shift here", [poly(0, 0, 3), poly(0, 0, 23)]),
        ],
    },
    Counts {
        key: "method_4", year: 1982, authors: "Walker & Orin", form: "q̈ without M, method 4: conjugate gradients, n steps, O(n²)",
        published: None, printed_at_6: None, counted: [poly(89, -43, 2), poly(74, -47, -1)],
        terms: &[],
    },
];
