//! The sites of a source: expressions, statements and beginnings of functions that are evaluated when a test runs.
//!
//! What the compiler evaluates has no switch: `const fn`, constants, lengths, `const` blocks, patterns and types.
//! Neither have tests, and what stands behind another `cfg`.

mod visit;

use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::Visit;
use syn::{BinOp, Expr};

use crate::changes::{self, Change};
use crate::site::{Form, Operator, Site};

/// Macros whose arguments are no code of the function, or that a test asserts with.
const OPAQUE: [&str; 9] = [
    "assert",
    "assert_eq",
    "assert_ne",
    "debug_assert",
    "debug_assert_eq",
    "debug_assert_ne",
    "include_str",
    "matches",
    "unreachable",
];

/// All sites of a source, numbered from 0.
pub fn sites(file: &str, source: &str) -> syn::Result<Vec<Site>> {
    let syntax = syn::parse_file(source)?;
    let mut finder = Finder {
        file,
        source,
        functions: Vec::new(),
        sites: Vec::new(),
    };
    finder.visit_file(&syntax);
    Ok(finder.sites)
}

struct Finder<'a> {
    file: &'a str,
    source: &'a str,
    /// The functions around the present place, outermost first.
    functions: Vec<String>,
    sites: Vec<Site>,
}

impl<'a> Finder<'a> {
    fn text(&self, node: &impl Spanned) -> &'a str {
        &self.source[node.span().byte_range()]
    }

    fn add(
        &mut self,
        operator: Operator,
        form: Form,
        bytes: Range<usize>,
        line: usize,
        change: Change,
    ) {
        let Some(function) = self.functions.last() else {
            return;
        };
        self.sites.push(Site {
            number: self.sites.len() as u32,
            file: self.file.to_owned(),
            function: function.clone(),
            line,
            operator,
            form,
            bytes,
            changed: change.text,
            change: change.words,
        });
    }

    fn replace(&mut self, operator: Operator, node: &impl Spanned, change: Change) {
        let span = node.span();
        self.add(
            operator,
            Form::Replace,
            span.byte_range(),
            span.start().line,
            change,
        );
    }

    /// Visits the body of a function unless the compiler evaluates it, or it is a test.
    fn function(
        &mut self,
        attributes: &[syn::Attribute],
        signature: &syn::Signature,
        body: &syn::Block,
    ) {
        let is_other = attributes
            .iter()
            .any(|attribute| attribute.path().is_ident("test") || attribute.path().is_ident("cfg"));
        if signature.constness.is_some() || is_other {
            return;
        }
        self.functions.push(signature.ident.to_string());
        let open = body.brace_token.span.open();
        for value in changes::returned(&signature.output) {
            let name = &signature.ident;
            let words = match *value {
                "" => format!("`{name}` does nothing"),
                value => format!("`{name}` returns `{value}`"),
            };
            let at = open.byte_range().end;
            let change = Change {
                text: (*value).to_owned(),
                words,
            };
            self.add(
                Operator::Return,
                Form::Return,
                at..at,
                open.start().line,
                change,
            );
        }
        self.visit_block(body);
        self.functions.pop();
    }

    fn binary(&mut self, binary: &syn::ExprBinary) {
        let (left, right) = (self.text(&binary.left), self.text(&binary.right));
        let has_let = |side: &Expr| matches!(side, Expr::Let(_)) || chain_has_let(side);
        if matches!(binary.op, BinOp::And(_)) && (has_let(&binary.left) || has_let(&binary.right)) {
            return;
        }
        let op = self.text(&binary.op);
        for (operator, other) in changes::operators(op) {
            self.replace(operator, binary, changes::operator(left, op, other, right));
        }
    }

    fn condition(&mut self, condition: &Expr) {
        // `if let` and chains with it have no negation; that of a comparison is one of its own changes.
        let is_comparison = matches!(condition, Expr::Binary(binary) if changes::is_comparison(self.text(&binary.op)));
        if matches!(condition, Expr::Let(_)) || chain_has_let(condition) || is_comparison {
            return;
        }
        let text = self.text(condition);
        let words = format!("`if {0}` → `if !({0})`", changes::short(text));
        self.replace(
            Operator::Logic,
            condition,
            Change {
                text: format!("!({text})"),
                words,
            },
        );
    }
}

/// Whether one of the conditions that `&&` joins is a `let`.
fn chain_has_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) if matches!(binary.op, BinOp::And(_)) => {
            chain_has_let(&binary.left) || chain_has_let(&binary.right)
        }
        _ => false,
    }
}

/// Whether an item, or a block behind an attribute, is not compiled in every build.
fn is_configured(attributes: &[syn::Attribute]) -> bool {
    attributes
        .iter()
        .any(|attribute| attribute.path().is_ident("cfg"))
}
