//! The expression that machine code evaluates: one node an operation, in the order of execution.

/// A function's input.
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
    /// A function's input.
    Input(Input),
    /// A constant of the code.
    Literal(f32),
    /// a + b, rounded
    Add(usize, usize),
    /// a − b, rounded
    Sub(usize, usize),
    /// a b, rounded
    Mul(usize, usize),
    /// −a, exact
    Neg(usize),
}

/// An expression, and the places of its results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// The operations, each after those that it uses.
    pub nodes: Vec<Node>,
    /// The offset of each result from the first, and its node.
    pub outputs: Vec<(u32, usize)>,
}

/// What evaluates a graph: f32 as the target does, f64 as its reference.
pub trait Number: Copy + std::ops::Neg<Output = Self> {
    /// The number of a literal.
    fn of(literal: f32) -> Self;
    /// a + b
    fn add(self, b: Self) -> Self;
    /// a − b
    fn sub(self, b: Self) -> Self;
    /// a b
    fn mul(self, b: Self) -> Self;
}

macro_rules! number {
    ($($type:ty),*) => {$(
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
        }
    )*};
}
number!(f32, f64);

impl Graph {
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
                Node::Neg(a) => -values[a],
            };
            values.push(value);
        }
    }

    /// The graph of one output alone, which is its last node.
    pub fn of_output(&self, output: usize) -> Self {
        let (offset, node) = self.outputs[output];
        let mut used = vec![false; node + 1];
        used[node] = true;
        for at in (0..=node).rev() {
            if used[at] {
                operands(self.nodes[at])
                    .into_iter()
                    .flatten()
                    .for_each(|a| used[a] = true);
            }
        }
        let mut places = vec![usize::MAX; node + 1];
        let mut nodes = Vec::new();
        for at in (0..=node).filter(|at| used[*at]) {
            places[at] = nodes.len();
            nodes.push(match self.nodes[at] {
                Node::Add(a, b) => Node::Add(places[a], places[b]),
                Node::Sub(a, b) => Node::Sub(places[a], places[b]),
                Node::Mul(a, b) => Node::Mul(places[a], places[b]),
                Node::Neg(a) => Node::Neg(places[a]),
                leaf => leaf,
            });
        }
        let last = nodes.len() - 1;
        Self {
            nodes,
            outputs: vec![(offset, last)],
        }
    }

    /// The number of rounded operations.
    pub fn operations(&self) -> usize {
        let rounds = |node: &&Node| matches!(node, Node::Add(..) | Node::Sub(..) | Node::Mul(..));
        self.nodes.iter().filter(rounds).count()
    }
}

/// The nodes that a node uses.
pub fn operands(node: Node) -> [Option<usize>; 2] {
    match node {
        Node::Input(_) | Node::Literal(_) => [None, None],
        Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) => [Some(a), Some(b)],
        Node::Neg(a) => [Some(a), None],
    }
}
