//! The expression that machine code evaluates: one node an operation, in the order of execution.

/// An input of a function: a number in memory that an argument points to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Input {
    /// The number of the argument's register.
    pub argument: u8,
    /// Bytes from where it points.
    pub offset: u32,
}

/// An operation on nodes before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node {
    /// An input of the function, which the caller passes.
    Input(Input),
    /// A constant of the code.
    Literal(f32),
    /// a + b, rounded
    Add(usize, usize),
    /// a − b, rounded
    Sub(usize, usize),
    /// a b, rounded
    Mul(usize, usize),
    /// a / b, rounded
    Div(usize, usize),
    /// √a, rounded
    Sqrt(usize),
    /// 1/√a, in so many steps of Newton from a guess
    InverseRoot(usize, Guess),
    /// −a, exact
    Neg(usize),
}

/// A guess of 1/√x, the number whose bits are a magic number less half of those of x, and the steps
/// y + y (½ − ½ x y²) from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Guess {
    /// The constant from which half of the bits are subtracted.
    pub magic: u32,
    /// The number of Newton's steps.
    pub steps: u8,
}

impl Guess {
    /// The reciprocal root of `x` as the code computes it.
    pub fn inverse_root(self, x: f32) -> f32 {
        let mut y = f32::from_bits(self.magic.wrapping_sub(x.to_bits() >> 1));
        let half = 0.5 * x;
        for _ in 0..self.steps {
            y += y * (0.5 - half * y * y);
        }
        y
    }
}

impl Node {
    /// The same operation on nodes at other places.
    #[must_use]
    pub fn moved(self, to: impl Fn(usize) -> usize) -> Self {
        match self {
            Self::Input(_) | Self::Literal(_) => self,
            Self::Add(a, b) => Self::Add(to(a), to(b)),
            Self::Sub(a, b) => Self::Sub(to(a), to(b)),
            Self::Mul(a, b) => Self::Mul(to(a), to(b)),
            Self::Div(a, b) => Self::Div(to(a), to(b)),
            Self::Sqrt(a) => Self::Sqrt(to(a)),
            Self::InverseRoot(a, guess) => Self::InverseRoot(to(a), guess),
            Self::Neg(a) => Self::Neg(to(a)),
        }
    }
}

/// An expression, and the places of its results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// The operations, each after those that it uses.
    pub nodes: Vec<Node>,
    /// The offset of each result from the first, and its node.
    pub outputs: Vec<(u32, usize)>,
}

/// A kind of number in which a graph is evaluated: f32 as the target does, f64 as its reference.
pub trait Number: Copy + std::ops::Neg<Output = Self> {
    /// The number of a literal.
    fn of(literal: f32) -> Self;
    /// a + b
    fn add(self, b: Self) -> Self;
    /// a − b
    fn sub(self, b: Self) -> Self;
    /// a b
    fn mul(self, b: Self) -> Self;
    /// a / b
    fn div(self, b: Self) -> Self;
    /// √a
    fn sqrt(self) -> Self;
    /// 1/√a
    fn inverse_root(self, guess: Guess) -> Self;
}

macro_rules! number {
    ($($type:ty: $inverse_root:expr),*) => {$(
        impl Number for $type {
            fn of(literal: f32) -> Self {
                Self::from(literal)
            }
            fn add(self, b: Self) -> Self {
                self + b
            }
            fn sub(self, b: Self) -> Self {
                self - b
            }
            fn mul(self, b: Self) -> Self {
                self * b
            }
            fn div(self, b: Self) -> Self {
                self / b
            }
            fn sqrt(self) -> Self {
                <$type>::sqrt(self)
            }
            fn inverse_root(self, guess: Guess) -> Self {
                $inverse_root(guess, self)
            }
        }
    )*};
}
number!(f32: Guess::inverse_root, f64: |_, x: f64| 1.0 / x.sqrt());

impl Graph {
    /// Whether a result depends on no input.
    pub fn is_constant(&self, output: usize) -> bool {
        let of_inputs = |node: &Node| matches!(node, Node::Input(_));
        !self.of_output(output).nodes.iter().any(of_inputs)
    }

    /// The value of each node; `values` holds them.
    pub fn evaluate<T: Number>(&self, input: impl Fn(Input) -> T, values: &mut Vec<T>) {
        values.clear();
        for node in &self.nodes {
            let value = match *node {
                Node::Input(at) => input(at),
                Node::Literal(literal) => T::of(literal),
                Node::Add(a, b) => values[a].add(values[b]),
                Node::Sub(a, b) => values[a].sub(values[b]),
                Node::Mul(a, b) => values[a].mul(values[b]),
                Node::Div(a, b) => values[a].div(values[b]),
                Node::Sqrt(a) => values[a].sqrt(),
                Node::InverseRoot(a, guess) => values[a].inverse_root(guess),
                Node::Neg(a) => -values[a],
            };
            values.push(value);
        }
    }

    /// The graph of the difference of two of its nodes.
    pub fn of_difference(&self, a: usize, b: usize) -> Self {
        let mut nodes = self.nodes.clone();
        nodes.push(Node::Sub(a, b));
        let outputs = vec![(0, nodes.len() - 1)];
        Self { nodes, outputs }.of_output(0)
    }

    /// The graph of one output alone, which is its last node.
    pub fn of_output(&self, output: usize) -> Self {
        let (offset, node) = self.outputs[output];
        let mut used = vec![false; node + 1];
        used[node] = true;
        for at in (0..=node).rev() {
            if used[at] {
                operands(self.nodes[at]).into_iter().flatten().for_each(|a| used[a] = true);
            }
        }
        let mut places = vec![usize::MAX; node + 1];
        let mut nodes = Vec::new();
        for at in (0..=node).filter(|at| used[*at]) {
            places[at] = nodes.len();
            nodes.push(self.nodes[at].moved(|a| places[a]));
        }
        let last = nodes.len() - 1;
        Self { nodes, outputs: vec![(offset, last)] }
    }

    /// The number of rounded operations.
    pub fn operations(&self) -> usize {
        let rounds =
            |node: &&Node| !matches!(node, Node::Input(_) | Node::Literal(_) | Node::Neg(_));
        self.nodes.iter().filter(rounds).count()
    }
}

/// The nodes that a node uses.
pub fn operands(node: Node) -> [Option<usize>; 2] {
    match node {
        Node::Input(_) | Node::Literal(_) => [None, None],
        Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) => [Some(a), Some(b)],
        Node::Sqrt(a) | Node::InverseRoot(a, _) | Node::Neg(a) => [Some(a), None],
    }
}
