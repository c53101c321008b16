//! Which nodes of the syntax are changed, and which are not descended into.

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Expr, Lit, Stmt, UnOp};

use super::{Finder, OPAQUE, is_configured};
use crate::changes::{self, Change};
use crate::site::{Form, Operator};

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
        if !is_configured(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if !is_configured(&item.attrs) {
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
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_angle_bracketed_generic_arguments(
        &mut self,
        _: &'ast syn::AngleBracketedGenericArguments,
    ) {
    }

    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }

    fn visit_macro(&mut self, item: &'ast syn::Macro) {
        let is_opaque = item
            .path
            .segments
            .last()
            .is_some_and(|last| OPAQUE.iter().any(|name| last.ident == name));
        let arguments = syn::punctuated::Punctuated::<Expr, syn::Token![,]>::parse_terminated;
        if !is_opaque && let Ok(arguments) = item.parse_body_with(arguments) {
            // Other macros are given expressions, as a function is; a change that their rules refuse does not compile.
            for argument in &arguments {
                let found = argument.clone();
                Visit::visit_expr(&mut *self, &found);
            }
        }
    }

    fn visit_stmt(&mut self, statement: &'ast Stmt) {
        if let Stmt::Expr(expression, Some(_)) = statement
            && let Expr::Assign(_)
            | Expr::Binary(_)
            | Expr::MethodCall(_)
            | Expr::Call(_)
            | Expr::Try(_) = expression
        {
            let span = statement.span();
            let words = format!("without `{}`", changes::short(self.text(statement)));
            let change = Change {
                text: String::new(),
                words,
            };
            self.add(
                Operator::Statement,
                Form::Delete,
                span.byte_range(),
                span.start().line,
                change,
            );
        }
        visit::visit_stmt(self, statement);
    }

    fn visit_expr_if(&mut self, expression: &'ast syn::ExprIf) {
        self.condition(&expression.cond);
        visit::visit_expr_if(self, expression);
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        self.binary(binary);
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        let inner = self.text(&unary.expr);
        let (operator, sign) = match unary.op {
            UnOp::Neg(_) => (Operator::Arithmetic, "-"),
            UnOp::Not(_) => (Operator::Logic, "!"),
            _ => return visit::visit_expr_unary(self, unary),
        };
        let short = changes::short(inner);
        let words = format!("`{sign}{short}` → `{short}`");
        self.replace(
            operator,
            unary,
            Change {
                text: inner.to_owned(),
                words,
            },
        );
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_lit(&mut self, literal: &'ast syn::ExprLit) {
        let other = match &literal.lit {
            Lit::Int(number) => {
                changes::integer(&number.to_string(), number.base10_digits(), number.suffix())
            }
            Lit::Float(number) => {
                changes::float(&number.to_string(), number.base10_digits(), number.suffix())
            }
            Lit::Bool(is) => Some((!is.value).to_string()),
            _ => None,
        };
        if let Some(other) = other {
            // A number says nothing without what stands around it.
            let line = self
                .source
                .lines()
                .nth(literal.span().start().line - 1)
                .unwrap_or_default();
            let text = self.text(literal);
            let words = format!("`{text}` → `{other}` in `{}`", changes::short(line));
            self.replace(Operator::Literal, literal, Change { text: other, words });
        }
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        let name = call.method.to_string();
        if let Some(other) = changes::method(&name) {
            let all = call.span().byte_range();
            let at = call.method.span().byte_range();
            let text = [
                &self.source[all.start..at.start],
                other,
                &self.source[at.end..all.end],
            ]
            .concat();
            let tail = &self.source[at.end..all.end];
            let head = changes::tail(&self.source[all.start..at.start]);
            let words = format!("`{head}{name}{}` → `{other}`", changes::short(tail));
            self.replace(Operator::Method, call, Change { text, words });
        }
        visit::visit_expr_method_call(self, call);
    }

    fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
        if matches!(&*call.func, Expr::Path(path) if path.path.is_ident("Some")) {
            let words = format!("`{}` → `None`", changes::short(self.text(call)));
            self.replace(
                Operator::Return,
                call,
                Change {
                    text: "None".to_owned(),
                    words,
                },
            );
        }
        visit::visit_expr_call(self, call);
    }
}
