//! The sites of a source: expressions, statements and beginnings of functions that are evaluated when a test runs.
//!
//! What the compiler evaluates has no switch: `const fn`, constants, lengths, `const` blocks, patterns and types.
//! Neither have tests, and what stands behind another `cfg`.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, BinOp, Expr, Lit, Stmt, UnOp};

use crate::changes;
use crate::rooms::is_whole;
use crate::site::{Form, Site};

/// Macros whose arguments are no code of the function, or that a test asserts with.
const OPAQUE: &str = "assert assert_eq assert_ne debug_assert debug_assert_eq debug_assert_ne include_str matches unreachable";

/// Without it a loop does not compile, and the compiler's error is at another place.
const NEEDED: &str = "rest = later";

/// All sites of a source, numbered from 0.
pub fn sites(file: &str, source: &str) -> syn::Result<Vec<Site>> {
    let (functions, sites) = (Vec::new(), Vec::new());
    let mut finder = Finder {
        file,
        source,
        functions,
        sites,
    };
    finder.visit_file(&syn::parse_file(source)?);
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

    fn add(&mut self, operator: &'static str, form: Form, at: Span, text: String, words: String) {
        let Some(function) = self.functions.last() else {
            return;
        };
        let bytes = at.byte_range();
        self.sites.push(Site {
            number: self.sites.len() as u32,
            file: self.file.to_owned(),
            function: function.clone(),
            line: at.start().line,
            operator,
            form,
            bytes: match form {
                Form::Return => bytes.end..bytes.end,
                _ => bytes,
            },
            changed: text,
            change: words,
        });
    }

    fn replace(
        &mut self,
        operator: &'static str,
        node: &impl Spanned,
        text: String,
        words: String,
    ) {
        self.add(operator, Form::Replace, node.span(), text, words);
    }

    /// Visits the body of a function unless the compiler evaluates it, or it is a test.
    fn function(&mut self, attributes: &[Attribute], of: &syn::Signature, body: &syn::Block) {
        if of.constness.is_some() || is_left_out(attributes) {
            return;
        }
        let name = of.ident.to_string();
        self.functions.push(name.clone());
        let inside = self.text(body).trim_matches(['{', '}']).trim();
        let values = changes::returned(&of.output).iter();
        // What has this body already does not change.
        for value in values.filter(|value| **value != inside) {
            let words = match *value {
                "" => format!("`{name}` does nothing"),
                value => format!("`{name}` returns `{value}`"),
            };
            let open = body.brace_token.span.open();
            self.add("return", Form::Return, open, (*value).to_owned(), words);
        }
        if matches!(of.output, syn::ReturnType::Default) {
            self.without_last(body);
        }
        self.visit_block(body);
        self.functions.pop();
    }

    /// Leaves a statement out.
    fn without(&mut self, statement: &impl Spanned) {
        let words = format!("without `{}`", changes::short(self.text(statement)));
        let at = statement.span();
        self.add("statement", Form::Delete, at, String::new(), words);
    }

    /// Leaves out an expression without a value, and those that end its branches, where every statement is changed.
    fn without_value(&mut self, expression: &Expr) {
        if !is_whole(self.file) || self.text(expression) == "{}" {
            return;
        }
        self.without(expression);
        match expression {
            Expr::If(of) => {
                self.without_last(&of.then_branch);
                let otherwise = of.else_branch.iter();
                otherwise.for_each(|(_, branch)| self.without_value(branch));
            }
            Expr::Match(of) => (of.arms.iter()).for_each(|arm| self.without_value(&arm.body)),
            Expr::Block(of) => self.without_last(&of.block),
            Expr::ForLoop(of) => self.without_last(&of.body),
            _ => {}
        }
    }

    fn without_last(&mut self, block: &syn::Block) {
        if let Some(Stmt::Expr(last, None)) = block.stmts.last() {
            self.without_value(last);
        }
    }
}

/// Whether one of the conditions that `&&` joins is a `let`, so that it has no negation and no alternative.
fn has_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) if matches!(binary.op, BinOp::And(_)) => {
            has_let(&binary.left) || has_let(&binary.right)
        }
        _ => false,
    }
}

/// Whether an item is a test, or not compiled in every build.
fn is_left_out(attributes: &[Attribute]) -> bool {
    let mut paths = attributes.iter().map(Attribute::path);
    paths.any(|path| path.is_ident("test") || path.is_ident("cfg"))
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(body) = &item.default {
            self.function(&item.attrs, &item.sig, body);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_left_out(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if !is_left_out(&item.attrs) {
            visit::visit_item_impl(self, item);
        }
    }

    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_item_enum(&mut self, _: &'ast syn::ItemEnum) {}
    fn visit_item_macro(&mut self, _: &'ast syn::ItemMacro) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_generics(&mut self, _: &'ast syn::Generics) {}
    fn visit_path(&mut self, _: &'ast syn::Path) {}
    fn visit_attribute(&mut self, _: &'ast Attribute) {}
    fn visit_angle_bracketed_generic_arguments(
        &mut self,
        _: &'ast syn::AngleBracketedGenericArguments,
    ) {
    }

    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }

    fn visit_macro(&mut self, item: &'ast syn::Macro) {
        let name = item.path.segments.last();
        let is_opaque = name.is_some_and(|name| OPAQUE.split(' ').any(|one| name.ident == one));
        let arguments = syn::punctuated::Punctuated::<Expr, syn::Token![,]>::parse_terminated;
        if !is_opaque && let Ok(arguments) = item.parse_body_with(arguments) {
            // Other macros are given expressions, as a function is; a change that their rules refuse does not compile.
            for argument in &arguments {
                Visit::visit_expr(&mut *self, &argument.clone());
            }
        }
    }

    fn visit_stmt(&mut self, statement: &'ast Stmt) {
        use Expr::{Assign, Binary, Call, MethodCall, Return, Try};
        match statement {
            Stmt::Expr(Assign(of), _) if self.text(of) == NEEDED => {}
            Stmt::Expr(Assign(_) | Binary(_) | MethodCall(_) | Call(_) | Try(_), Some(_)) => {
                self.without(statement);
            }
            Stmt::Expr(Return(_), Some(_)) if is_whole(self.file) => self.without(statement),
            _ => {}
        }
        visit::visit_stmt(self, statement);
    }

    fn visit_block(&mut self, block: &'ast syn::Block) {
        for statement in block.stmts.iter().rev().skip(1) {
            if let Stmt::Expr(expression, None) = statement {
                self.without_value(expression);
            }
        }
        visit::visit_block(self, block);
    }

    fn visit_expr_assign(&mut self, assign: &'ast syn::ExprAssign) {
        // An assignment of several values that forgets one.
        if let Expr::Tuple(left) = &*assign.left
            && is_whole(self.file)
        {
            let all = self.text(assign);
            for one in &left.elems {
                let one = self.text(one);
                let words = format!("`{one}` keeps its value in `{}`", changes::short(all));
                let text = format!("{{ let kept = {one}; {all}; {one} = kept; }}");
                self.replace("statement", assign, text, words);
            }
        }
        visit::visit_expr_assign(self, assign);
    }

    fn visit_expr_if(&mut self, expression: &'ast syn::ExprIf) {
        let condition = &*expression.cond;
        // The negation of a comparison is one of its own changes.
        let is_comparison = matches!(condition, Expr::Binary(binary) if changes::is_comparison(self.text(&binary.op)));
        if !has_let(condition) && !is_comparison {
            let text = self.text(condition);
            let words = format!("`if {0}` → `if !({0})`", changes::short(text));
            self.replace("logic", condition, format!("!({text})"), words);
        }
        visit::visit_expr_if(self, expression);
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        let is_and = matches!(binary.op, BinOp::And(_));
        if !is_and || !(has_let(&binary.left) || has_let(&binary.right)) {
            let (left, right) = (self.text(&binary.left), self.text(&binary.right));
            let op = self.text(&binary.op);
            for (operator, other) in changes::operators(op) {
                let (text, words) = changes::operator(left, op, other, right);
                self.replace(operator, binary, text, words);
            }
        }
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        let of = match unary.op {
            UnOp::Neg(_) => Some(("arithmetic", "-")),
            UnOp::Not(_) => Some(("logic", "!")),
            _ => None,
        };
        if let Some((operator, sign)) = of {
            let inner = self.text(&unary.expr);
            let words = format!("`{sign}{0}` → `{0}`", changes::short(inner));
            self.replace(operator, unary, inner.to_owned(), words);
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_lit(&mut self, literal: &'ast syn::ExprLit) {
        let text = self.text(literal);
        let other = match &literal.lit {
            Lit::Int(number) => changes::integer(text, number.base10_digits(), number.suffix()),
            Lit::Float(number) => changes::float(text, number.base10_digits(), number.suffix()),
            Lit::Bool(is) => Some((!is.value).to_string()),
            _ => None,
        };
        if let Some(other) = other {
            // A number says nothing without what stands around it.
            let line = self.source.lines().nth(literal.span().start().line - 1);
            let line = changes::short(line.unwrap_or_default());
            let words = format!("`{text}` → `{other}` in `{line}`");
            self.replace("literal", literal, other, words);
        }
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        let name = call.method.to_string();
        if let Some(other) = changes::method(&name) {
            let (all, at) = (call.span().byte_range(), call.method.span().byte_range());
            let (head, tail) = (
                &self.source[all.start..at.start],
                &self.source[at.end..all.end],
            );
            let words = (changes::tail(head), changes::short(tail));
            let words = format!("`{}{name}{}` → `{other}`", words.0, words.1);
            self.replace("method", call, [head, other, tail].concat(), words);
        }
        visit::visit_expr_method_call(self, call);
    }

    fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
        if matches!(&*call.func, Expr::Path(path) if path.path.is_ident("Some")) {
            let words = format!("`{}` → `None`", changes::short(self.text(call)));
            self.replace("return", call, "None".to_owned(), words);
        }
        visit::visit_expr_call(self, call);
    }
}
