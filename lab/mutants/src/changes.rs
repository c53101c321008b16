//! What is changed to what, as text.

use crate::site::Operator;

/// What stands instead of an expression, and the change in words.
pub struct Change {
    pub text: String,
    pub words: String,
}

/// The longest piece of source in the words of a change.
const LONGEST: usize = 60;

/// A piece of source on one line, its end left out if it is long.
pub fn short(text: &str) -> String {
    let text = on_one_line(text);
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} …", text[..end].trim_end()),
        None => text,
    }
}

/// The same, its beginning left out if it is long.
pub fn tail(text: &str) -> String {
    let text = on_one_line(text);
    let more = text.chars().count().saturating_sub(LONGEST / 2);
    match text.char_indices().nth(more) {
        Some((begin, _)) if more > 0 => format!("… {}", text[begin..].trim_start()),
        _ => text,
    }
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether a binary operator compares.
pub fn is_comparison(op: &str) -> bool {
    matches!(op, "<" | "<=" | ">" | ">=" | "==" | "!=")
}

/// What a binary operator is changed to.
pub fn operators(op: &str) -> Vec<(Operator, &'static str)> {
    use Operator::{Arithmetic, Comparison, Logic};
    let (operator, others): (_, &[&'static str]) = match op {
        "+" => (Arithmetic, &["-"]),
        "-" => (Arithmetic, &["+"]),
        "*" => (Arithmetic, &["/", "+"]),
        "/" => (Arithmetic, &["*"]),
        "%" => (Arithmetic, &["*"]),
        "<<" => (Arithmetic, &[">>"]),
        ">>" => (Arithmetic, &["<<"]),
        "+=" => (Arithmetic, &["-="]),
        "-=" => (Arithmetic, &["+="]),
        "*=" => (Arithmetic, &["/="]),
        "/=" => (Arithmetic, &["*="]),
        "<" => (Comparison, &["<=", ">="]),
        "<=" => (Comparison, &["<", ">"]),
        ">" => (Comparison, &[">=", "<="]),
        ">=" => (Comparison, &[">", "<"]),
        "==" => (Comparison, &["!="]),
        "!=" => (Comparison, &["=="]),
        "&&" => (Logic, &["||"]),
        "||" => (Logic, &["&&"]),
        "&" => (Logic, &["|"]),
        "|" => (Logic, &["&"]),
        "^" => (Logic, &["|"]),
        "&=" => (Logic, &["|="]),
        "|=" => (Logic, &["&="]),
        _ => (Logic, &[]),
    };
    others.iter().map(|other| (operator, *other)).collect()
}

/// Another operator between the same operands, which keep their precedence.
pub fn operator(left: &str, op: &str, other: &str, right: &str) -> Change {
    let text = match op.ends_with('=') && !is_comparison(op) {
        // What is assigned to is no value.
        true => format!("{left} {other} ({right})"),
        false => format!("({left}) {other} ({right})"),
    };
    let (before, after) = (tail(left), short(right));
    let after: String = after.chars().take(LONGEST / 2).collect();
    let words = format!("`{before} {op} {after}` → `{other}`");
    Change { text, words }
}

/// Another integer: 0 for 1, else one more.
pub fn integer(written: &str, digits: &str, suffix: &str) -> Option<String> {
    if digits == "1" {
        return Some(format!("0{suffix}"));
    }
    // Masks and codes keep their base in the words of the change, so one more is written as a sum.
    let is_decimal = written.trim_end_matches(suffix).replace('_', "") == digits;
    match digits.parse::<u128>() {
        Ok(number) if is_decimal => Some(format!("{}{suffix}", number + 1)),
        Ok(_) => Some(format!("({written} + 1)")),
        Err(_) => None,
    }
}

/// Another real number: 1 for 0, else a tenth more.
pub fn float(written: &str, digits: &str, suffix: &str) -> Option<String> {
    let number: f64 = digits.parse().ok()?;
    if number == 0.0 {
        return Some(format!("1.0{suffix}"));
    }
    Some(format!("({written} * 1.1)"))
}

/// The counterpart of a method.
pub fn method(name: &str) -> Option<&'static str> {
    Some(match name {
        "min" => "max",
        "max" => "min",
        "all" => "any",
        "any" => "all",
        "is_some" => "is_none",
        "is_none" => "is_some",
        "is_ok" => "is_err",
        "is_err" => "is_ok",
        "wrapping_add" => "wrapping_sub",
        "wrapping_sub" => "wrapping_add",
        "saturating_add" => "saturating_sub",
        "saturating_sub" => "saturating_add",
        "sin" => "cos",
        "cos" => "sin",
        "starts_with" => "ends_with",
        "ends_with" => "starts_with",
        _ => return None,
    })
}

/// What a function may return at its beginning, by its type.
pub fn returned(output: &syn::ReturnType) -> &'static [&'static str] {
    let syn::ReturnType::Type(_, of) = output else {
        return &[""];
    };
    let syn::Type::Path(path) = &**of else {
        return &[];
    };
    let Some(last) = path.path.segments.last() else {
        return &[];
    };
    match &*last.ident.to_string() {
        "bool" => &["true", "false"],
        "Option" => &["None"],
        "Result" if is_of_nothing(&last.arguments) => &["Ok(())"],
        "String" => &["String::new()"],
        "Vec" => &["Vec::new()"],
        _ => &[],
    }
}

/// Whether the first argument of a type is `()`.
fn is_of_nothing(arguments: &syn::PathArguments) -> bool {
    let syn::PathArguments::AngleBracketed(arguments) = arguments else {
        return false;
    };
    let first = arguments.args.first();
    matches!(first, Some(syn::GenericArgument::Type(syn::Type::Tuple(of))) if of.elems.is_empty())
}
