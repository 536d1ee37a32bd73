//! Which names a material may have: it becomes an identifier in WGSL and in Rust.

use naga::keywords::wgsl;

/// Longest name, in characters. WGSL sets no limit below 255; a longer one is hard to read in any language.
pub(crate) const LONGEST_NAME: usize = 64;

/// Keywords of Rust 2024, reserved ones included (The Rust Reference, "Keywords").
const RUST_KEYWORDS: [&str; 53] = [
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do",
    "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "union", "unsafe", "unsized", "use",
    "virtual", "where", "while", "yield",
];

/// Why a name cannot be used, in words that complete "the name …".
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct BadName {
    pub(crate) reason: String,
    pub(crate) suggestion: String,
}

/// Checks the name of a material.
pub(crate) fn check(name: &str) -> Result<(), BadName> {
    let length = name.chars().count();
    let reason = if name.is_empty() {
        "is empty".to_owned()
    } else if length > LONGEST_NAME {
        format!("has {length} characters, more than {LONGEST_NAME}")
    } else if name == "_" {
        "is a placeholder in both Rust and WGSL".to_owned()
    } else if name.starts_with("__") {
        "begins with two underscores, which WGSL reserves".to_owned()
    } else if name.starts_with('_') {
        "begins with an underscore, which marks what is unused".to_owned()
    } else if name.starts_with(|c: char| c.is_ascii_digit()) {
        "begins with a digit".to_owned()
    } else if let Some(c) = name.chars().find(|c| !(c.is_ascii_alphanumeric() || *c == '_')) {
        format!("contains {c:?}")
    } else if let Some(language) = keyword_of(name) {
        format!("is {language}")
    } else {
        return Ok(());
    };
    Err(BadName { reason, suggestion: suggestion(name) })
}

/// What the name already means.
fn keyword_of(name: &str) -> Option<&'static str> {
    let camel = camel_case(name);
    if RUST_KEYWORDS.contains(&name) || RUST_KEYWORDS.contains(&camel.as_str()) {
        Some("a keyword of Rust")
    } else if wgsl::RESERVED.contains(&name) {
        Some("a keyword or reserved word of WGSL")
    } else if wgsl::BUILTIN_IDENTIFIERS.contains(&name) || is_short_type(name) {
        Some("predeclared in WGSL")
    } else {
        None
    }
}

/// The predeclared aliases `vec3f`, `mat4x4h` and so on (WGSL §6.9).
fn is_short_type(name: &str) -> bool {
    let size = |c: &u8| matches!(c, b'2'..=b'4');
    match name.as_bytes() {
        [b'v', b'e', b'c', rows, scalar] => size(rows) && b"fihu".contains(scalar),
        [b'm', b'a', b't', columns, b'x', rows, scalar] => {
            size(columns) && size(rows) && b"fh".contains(scalar)
        }
        _ => false,
    }
}

/// A name near `name` that passes [`check`].
fn suggestion(name: &str) -> String {
    let mut legal = String::new();
    for c in name.chars().take(LONGEST_NAME) {
        let c = if c.is_ascii_alphanumeric() { c } else { '_' };
        if c != '_' || !(legal.is_empty() || legal.ends_with('_')) {
            legal.push(c);
        }
    }
    let legal = legal.trim_end_matches('_');
    let name = if legal.starts_with(|c: char| c.is_ascii_alphabetic()) {
        legal.to_owned()
    } else {
        format!("material_{legal}").trim_end_matches('_').to_owned()
    };
    if keyword_of(&name).is_some() { format!("{name}_material") } else { name }
}

/// `skin_pale` as the name of a Rust enum variant: `SkinPale`.
#[must_use]
pub(crate) fn camel_case(name: &str) -> String {
    let capitalised = |word: &str| {
        let mut letters = word.chars();
        letters
            .next()
            .map(|first| first.to_ascii_uppercase().to_string() + letters.as_str())
            .unwrap_or_default()
    };
    name.split('_').map(capitalised).collect()
}

/// `skin_pale` as the name of a constant: `SKIN_PALE`.
#[must_use]
pub(crate) fn screaming_case(name: &str) -> String {
    name.to_ascii_uppercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinary_names_pass() {
        for name in ["skin", "skin_pale", "Jade", "a", "x2", "wax_2b", &"a".repeat(LONGEST_NAME)] {
            assert_eq!(check(name), Ok(()), "{name}");
        }
    }

    #[test]
    fn what_is_no_identifier_in_either_language_is_refused() {
        let long = "a".repeat(300);
        let names = [
            "", "_", "__x", "_x", "2skin", "häut", "皮肤", "a-b", "a b", "fn", "match", "self", "self_",
            "loop", "discard", "filter", "vec3f", "mat4x4h", "max", "sampler", "f32", "gen", "union", &long,
        ];
        for name in names {
            assert!(check(name).is_err(), "{name}");
        }
    }

    #[test]
    fn every_suggestion_is_legal() {
        let long = "é".repeat(300);
        for name in
            ["", "_", "__x", "2skin", "häut", "皮肤", "a-b", "fn", "self_", "vec3f", "9", "material_", &long]
        {
            if let Err(bad) = check(name) {
                assert_eq!(check(&bad.suggestion), Ok(()), "{name} -> {}", bad.suggestion);
            }
        }
    }

    #[test]
    fn cases() {
        assert_eq!(camel_case("skin_pale_2"), "SkinPale2");
        assert_eq!(camel_case("skin2"), camel_case("skin_2"));
        assert_eq!(screaming_case("skin_pale"), "SKIN_PALE");
    }
}
