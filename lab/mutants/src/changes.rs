//! The replacements of expressions, as text.

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

/// What binary operators are changed to, by their kinds.
const OPERATORS: [(&str, &str); 3] = [
    (
        "arithmetic",
        "+:- -:+ *:/ *:+ /:* %:* <<:>> >>:<< +=:-= -=:+= *=:/= /=:*=",
    ),
    (
        "comparison",
        "<:<= <:>= <=:< <=:> >:>= >:<= >=:> >=:< ==:!= !=:==",
    ),
    ("logic", "&&:|| ||:&& &:| |:& ^:| &=:|= |=:&="),
];

/// The others that a binary operator is changed to, with their kind.
pub fn operators(op: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let each = OPERATORS.into_iter().flat_map(|(kind, pairs)| {
        let pairs = pairs.split(' ').filter_map(|pair| pair.split_once(':'));
        pairs.map(move |(one, other)| (kind, one, other))
    });
    each.filter_map(move |(kind, one, other)| (one == op).then_some((kind, other)))
}

pub fn is_comparison(op: &str) -> bool {
    operators(op).any(|(kind, _)| kind == "comparison")
}

/// Another operator between the same operands, which keep their precedence, and the change in words.
pub fn operator(left: &str, op: &str, other: &str, right: &str) -> (String, String) {
    let text = match op.ends_with('=') && !is_comparison(op) {
        // The left side of an assignment is no value.
        true => format!("{left} {other} ({right})"),
        false => format!("({left}) {other} ({right})"),
    };
    let (before, after) = (tail(left), short(right));
    let after: String = after.chars().take(LONGEST / 2).collect();
    (text, format!("`{before} {op} {after}` → `{other}`"))
}

/// Another integer: 0 for 1, else one more.
pub fn integer(written: &str, digits: &str, suffix: &str) -> Option<String> {
    if digits == "1" {
        return Some(format!("0{suffix}"));
    }
    // Masks and codes keep their base in the words of the change, so one more is written as a sum.
    let is_decimal = written.trim_end_matches(suffix).replace('_', "") == digits;
    let number = digits.parse::<u128>().ok()?;
    Some(match is_decimal {
        true => format!("{}{suffix}", number + 1),
        false => format!("({written} + 1)"),
    })
}

/// Another real number: 1 for 0, else a tenth more.
pub fn float(written: &str, digits: &str, suffix: &str) -> Option<String> {
    let number: f64 = digits.parse().ok()?;
    Some(match number == 0.0 {
        true => format!("1.0{suffix}"),
        false => format!("({written} * 1.1)"),
    })
}

const METHODS: [[&str; 2]; 8] = [
    ["min", "max"],
    ["all", "any"],
    ["is_some", "is_none"],
    ["is_ok", "is_err"],
    ["wrapping_add", "wrapping_sub"],
    ["saturating_add", "saturating_sub"],
    ["sin", "cos"],
    ["starts_with", "ends_with"],
];

/// The counterpart of a method.
pub fn method(name: &str) -> Option<&'static str> {
    let pair = METHODS.iter().find(|pair| pair.contains(&name))?;
    Some(pair[usize::from(pair[0] == name)])
}

/// The values that a function may return at its beginning, by its type.
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
