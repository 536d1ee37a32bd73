//! Top-level declarations of a WGSL text, sliced out as they are written.
//!
//! naga could list them too, but only as IR: the text that people read, with its comments and names, is ours to keep.

use std::collections::BTreeSet;

/// A top-level declaration with its doc comment and attributes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Item<'a> {
    /// The declared name.
    pub(crate) name: &'a str,
    /// The declaration from its first comment to its last character, without the final line break.
    pub(crate) text: &'a str,
    /// The names that it refers to: built-in ones and those of other declarations. Its own name, members, parameters and
    /// locals are none.
    pub(crate) references: BTreeSet<&'a str>,
}

/// The comments at the head of a file (before its first blank line) and its declarations, in order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Items<'a> {
    pub(crate) preamble: &'a str,
    pub(crate) items: Vec<Item<'a>>,
}

/// Slices a WGSL text into its declarations.
///
/// Returns the byte offset of the declaration that does not end, or that has no name.
pub(crate) fn items(text: &str) -> Result<Items<'_>, usize> {
    let mut scanner = Scanner { text, position: 0 };
    let mut preamble = "";
    let mut items = Vec::new();
    let mut first = true;
    while let Some(start) = scanner.skip_to_declaration(&mut preamble, first) {
        first = false;
        let item = scanner.declaration(start).ok_or(start)?;
        items.push(item);
    }
    Ok(Items { preamble, items })
}

struct Scanner<'a> {
    text: &'a str,
    position: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Token<'a> {
    Word(&'a str),
    Symbol(u8),
    Comment,
}

impl<'a> Scanner<'a> {
    /// Moves past blanks and detached comments; returns where the next declaration (its comments included) starts.
    fn skip_to_declaration(&mut self, preamble: &mut &'a str, first: bool) -> Option<usize> {
        let mut attached = None;
        let head = self.position;
        loop {
            let blank = self.skip_blanks();
            if blank >= 2 {
                if let (Some(start), true, true) = (attached, first, preamble.is_empty()) {
                    *preamble = self.text[start..self.position].trim_end();
                }
                attached = None;
            }
            debug_assert!(self.position >= head);
            let start = self.position;
            match self.next_token()? {
                Token::Comment => attached = attached.or(Some(start)),
                Token::Word(_) | Token::Symbol(_) => {
                    self.position = start;
                    return Some(attached.unwrap_or(start));
                }
            }
        }
    }

    /// Skips white space; returns the number of line breaks in it.
    fn skip_blanks(&mut self) -> usize {
        let rest = &self.text[self.position..];
        let trimmed = rest.trim_start();
        let blanks = &rest[..rest.len() - trimmed.len()];
        self.position += blanks.len();
        // A comment's own line break is not part of it, so one break separates neighbours and two leave a blank line.
        blanks.bytes().filter(|&byte| byte == b'\n').count()
    }

    /// The token at the position, which is moved past it. Blanks must have been skipped.
    fn next_token(&mut self) -> Option<Token<'a>> {
        let rest = &self.text[self.position..];
        let first = rest.chars().next()?;
        if rest.starts_with("//") {
            self.position += rest.find('\n').unwrap_or(rest.len());
            return Some(Token::Comment);
        }
        if rest.starts_with("/*") {
            self.position += block_comment_length(rest);
            return Some(Token::Comment);
        }
        if first.is_alphanumeric() || first == '_' {
            let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            self.position += length;
            return Some(Token::Word(&rest[..length]));
        }
        self.position += first.len_utf8();
        Some(Token::Symbol(if first.is_ascii() { first as u8 } else { b'?' }))
    }

    /// Reads one declaration whose comments start at `start`.
    fn declaration(&mut self, start: usize) -> Option<Item<'a>> {
        let mut keyword = None;
        let mut name = None;
        let mut names = Names::default();
        let mut before = Token::Comment;
        let mut parentheses = 0usize;
        let mut angles = 0usize;
        let mut braces = 0usize;
        loop {
            self.skip_blanks();
            let token = self.next_token()?;
            match token {
                Token::Comment => continue,
                Token::Word(word) => {
                    if keyword.is_none() && parentheses == 0 {
                        if before != Token::Symbol(b'@') {
                            keyword = Some(word);
                        }
                    } else if keyword.is_some() && name.is_none() && parentheses == 0 && angles == 0 {
                        name = Some(word);
                    } else {
                        let is_member = keyword == Some("struct") && braces == 1;
                        let is_parameter = keyword == Some("fn") && braces == 0 && name.is_some();
                        names.word(word, before, self.next_symbol(), is_member || is_parameter);
                    }
                }
                Token::Symbol(b'(') => parentheses += 1,
                Token::Symbol(b')') => parentheses = parentheses.saturating_sub(1),
                // `var<storage, read> name`: the only angle brackets before a name.
                Token::Symbol(b'<') if name.is_none() => angles += 1,
                Token::Symbol(b'>') if name.is_none() => angles = angles.saturating_sub(1),
                Token::Symbol(b'{') => {
                    braces += 1;
                    names.open();
                }
                Token::Symbol(b'}') => {
                    braces = braces.checked_sub(1)?;
                    names.close();
                    if braces == 0 {
                        break;
                    }
                }
                Token::Symbol(b';') if braces == 0 => break,
                Token::Symbol(b';') => names.end_statement(),
                Token::Symbol(_) => {}
            }
            before = token;
        }
        let name = name?;
        let mut references = names.references;
        references.remove(name);
        Some(Item { name, text: &self.text[start..self.position], references })
    }

    /// The symbol at the position, past blanks.
    fn next_symbol(&self) -> Option<u8> {
        self.text[self.position..].trim_start().bytes().next()
    }
}

/// Names inside a declaration: those of its own, scope by scope, and those of other declarations.
#[derive(Default)]
struct Names<'a> {
    references: BTreeSet<&'a str>,
    /// Parameters, then the local names of each open block.
    scopes: Vec<Vec<&'a str>>,
    /// A local whose statement has not ended: its own value does not see it.
    declared: Option<&'a str>,
    /// Whether the next word names a local.
    declares: bool,
}

impl<'a> Names<'a> {
    /// Takes `word` in, which stands between `before` and `after`. In front of a colon it may be the name of a member or
    /// of a parameter.
    fn word(&mut self, word: &'a str, before: Token<'_>, after: Option<u8>, may_be_declared: bool) {
        if matches!(before, Token::Symbol(b'.' | b'@'))
            || !word.starts_with(|c: char| c.is_alphabetic() || c == '_')
        {
            return;
        }
        if may_be_declared && after == Some(b':') {
            self.declare(word);
        } else if matches!(word, "let" | "var" | "const") {
            self.declares = true;
        } else if std::mem::take(&mut self.declares) {
            self.declared = Some(word);
        } else if after == Some(b'(') || !self.scopes.iter().flatten().any(|local| *local == word) {
            // What is called is no local.
            self.references.insert(word);
        }
    }

    fn declare(&mut self, name: &'a str) {
        if self.scopes.is_empty() {
            self.scopes.push(Vec::new());
        }
        self.scopes.last_mut().into_iter().for_each(|scope| scope.push(name));
    }

    fn open(&mut self) {
        self.scopes.push(Vec::new());
    }

    fn close(&mut self) {
        self.scopes.pop();
    }

    /// The head of a `for` counts as a statement of the block around it: its variable hides a name a little longer than
    /// in WGSL.
    fn end_statement(&mut self) {
        if let Some(name) = self.declared.take() {
            self.declare(name);
        }
    }
}

/// Length of the block comment (they nest in WGSL) that `text` starts with; all of it if it does not end.
fn block_comment_length(text: &str) -> usize {
    let mut depth = 0usize;
    let mut position = 0;
    while position < text.len() {
        let rest = &text[position..];
        if rest.starts_with("/*") {
            depth += 1;
            position += 2;
        } else if rest.starts_with("*/") {
            depth -= 1;
            position += 2;
            if depth == 0 {
                return position;
            }
        } else {
            position += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// What this file is.\n// [A] A paper.\n\n/// Twice x.\n@must_use\nfn twice(x: f32) -> f32 {\n    \
        if x > 1.0 { return other(x) * LIMIT; } // not { this }\n    return vector.field;\n}\n\n\
        const LIMIT: f32 = 2.0;\n\n/* block { /* nested */ */\nstruct Pair { a: f32, b: Inner, }\n\
        @group(0) @binding(1) var<storage, read> table: array<Pair>;\n";

    #[test]
    fn slices_declarations_with_their_comments() {
        let Items { preamble, items } = items(TEXT).expect("the text is whole");
        assert_eq!(preamble, "// What this file is.\n// [A] A paper.");
        let names: Vec<_> = items.iter().map(|item| item.name).collect();
        assert_eq!(names, ["twice", "LIMIT", "Pair", "table"]);
        assert!(items[0].text.starts_with("/// Twice x.\n@must_use\nfn twice"));
        assert!(items[0].text.ends_with("return vector.field;\n}"));
        assert!(items[2].text.starts_with("/* block"));
    }

    #[test]
    fn references_leave_out_members_and_comments() {
        let items = items(TEXT).expect("the text is whole").items;
        assert!(items[0].references.contains("other") && items[0].references.contains("LIMIT"));
        assert!(!items[0].references.contains("field") && !items[0].references.contains("this"));
        assert!(items[2].references.contains("Inner"));
        assert!(items[3].references.contains("Pair"));
    }

    #[test]
    fn references_leave_out_what_a_declaration_names_itself() {
        let text = "struct Row { width: f32, @align(SIDE) @builtin(position) height: Length, }\n\
                    fn sum(count: u32, row: Row) -> f32 {\n    let width = width(row);\n    \
                    for (var place = first; place < count; place += 1u) {\n        let inner = CASE;\n        \
                    switch inner { case FIRST: { return width; } default: {} }\n    }\n    return inner + width;\n}\n";
        let items = items(text).expect("the text is whole").items;
        let known = |item: &Item<'_>, names: &[&'static str]| -> Vec<&'static str> {
            names.iter().copied().filter(|name| item.references.contains(name)).collect()
        };
        assert_eq!(known(&items[0], &["width", "height", "SIDE", "Length", "align"]), ["SIDE", "Length"]);
        // `width` is called before a local has its name; `inner` is none of the block it is read in.
        let names = ["count", "row", "place", "first", "CASE", "FIRST", "width", "inner", "Row", "sum"];
        assert_eq!(known(&items[1], &names), ["first", "CASE", "FIRST", "width", "inner", "Row"]);
    }

    #[test]
    fn a_declaration_that_does_not_end_is_an_error() {
        assert_eq!(items("const a = 1;\nfn open() {"), Err(13));
    }

    #[test]
    fn every_shader_of_the_house_is_read_whole() {
        for module in subsurface_shaders::modules() {
            let found = items(module.text).unwrap_or_else(|at| panic!("{}: {at}", module.name));
            // Every line that starts a declaration at column 0 must have become an item.
            let starts = module
                .text
                .lines()
                .filter(|line| {
                    ["fn ", "struct ", "const ", "alias ", "override ", "var<"]
                        .iter()
                        .any(|word| line.starts_with(word))
                        || line.contains(" var")
                })
                .filter(|line| !line.starts_with(' ') && !line.starts_with('/'))
                .count();
            assert_eq!(found.items.len(), starts, "{}", module.name);
        }
    }
}
