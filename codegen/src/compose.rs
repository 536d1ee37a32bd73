//! Links WGSL modules into one text: what the roots reach is kept, as written; the rest is dropped.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use subsurface_shaders::Module;

use crate::docs::Docs;
use crate::item::{Item, Items, items};
use crate::source::Span;

/// Declarations that the emitter wrote for one material set, and where in the RON they came from.
#[derive(Debug, Default)]
pub(crate) struct Glue {
    /// WGSL text.
    pub(crate) text: String,
    /// Ranges of `text` that spell a value of a material file.
    pub(crate) origins: Vec<(Range<usize>, Span)>,
    /// The range of `text` that spells the format of the compute path's output.
    pub(crate) output_format: Option<Range<usize>>,
}

/// A linked WGSL text that remembers where its parts came from.
#[derive(Debug)]
pub(crate) struct Linked {
    pub(crate) text: String,
    /// Ranges of `text` that spell a value of a material file, sorted and disjoint.
    origins: Vec<(Range<usize>, Span)>,
    /// The range of `text` that spells the format of the compute path's output.
    pub(crate) output_format: Option<Range<usize>>,
    /// Doc comments of what was kept.
    pub(crate) docs: Docs,
    /// Names of the modules that contributed, in the order of the text, and where their part starts.
    pub(crate) modules: Vec<(usize, String)>,
    /// The module that declares each name that was kept.
    pub(crate) module_of: BTreeMap<String, String>,
}

impl Linked {
    /// The module that the byte at `offset` comes from.
    pub(crate) fn module_at(&self, offset: usize) -> Option<&str> {
        self.modules.iter().rev().find(|(start, _)| *start <= offset).map(|(_, name)| name.as_str())
    }

    /// The place in a material file that caused the WGSL at `range`.
    pub(crate) fn origin(&self, range: &Range<usize>) -> Option<&Span> {
        self.origins
            .iter()
            .find(|(spelled, _)| spelled.start < range.end.max(range.start + 1) && range.start < spelled.end)
            .map(|(_, span)| span)
    }
}

/// Why modules cannot be linked. All are defects of the shaders, not of a material.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum LinkError {
    /// A declaration does not end.
    #[error("a declaration of {module} does not end (byte {offset})")]
    Unfinished {
        /// The module's name.
        module: String,
        /// Where the declaration starts.
        offset: usize,
    },
    /// Two modules declare one name.
    #[error("{name} is declared by {first} and by {second}")]
    DeclaredTwice {
        /// The name.
        name: String,
        /// The first module.
        first: String,
        /// The second module.
        second: String,
    },
    /// No module declares a root.
    #[error("no module declares the entry point {name}")]
    NoSuchRoot {
        /// The name.
        name: String,
    },
}

/// Name of the part that the emitter wrote.
pub(crate) const GLUE: &str = "the material set";

/// Links `modules` and `glue`: keeps what the `roots` reach, module by module in the given order, glue first.
pub(crate) fn link(
    modules: &[Module],
    glue: &Glue,
    roots: &[&str],
    header: &str,
) -> Result<Linked, LinkError> {
    let mut parts: Vec<(&str, Items<'_>)> = Vec::with_capacity(modules.len() + 1);
    let sources = std::iter::once((GLUE, glue.text.as_str())).chain(modules.iter().map(|m| (m.name, m.text)));
    for (name, text) in sources {
        let items =
            items(text).map_err(|offset| LinkError::Unfinished { module: name.to_owned(), offset })?;
        parts.push((name, items));
    }

    let mut declared: BTreeMap<&str, (&str, &Item<'_>)> = BTreeMap::new();
    for (module, part) in &parts {
        for item in &part.items {
            if let Some((first, _)) = declared.insert(item.name, (module, item)) {
                let (name, first, second) = (item.name.to_owned(), first.to_owned(), (*module).to_owned());
                return Err(LinkError::DeclaredTwice { name, first, second });
            }
        }
    }
    let reached = reach(&declared, roots)?;

    let mut linked = Linked {
        text: header.to_owned(),
        origins: Vec::new(),
        output_format: None,
        docs: Docs::default(),
        modules: Vec::new(),
        module_of: BTreeMap::new(),
    };
    for (module, part) in &parts {
        let kept: Vec<_> = part.items.iter().filter(|item| reached.contains(item.name)).collect();
        if kept.is_empty() {
            continue;
        }
        linked.modules.push((linked.text.len(), (*module).to_owned()));
        linked.text.push_str(&format!("\n// ── {module} ──\n"));
        if !part.preamble.is_empty() {
            linked.text.push_str(part.preamble);
            linked.text.push('\n');
        }
        for item in kept {
            linked.text.push('\n');
            linked.docs.add(item);
            linked.module_of.insert(item.name.to_owned(), (*module).to_owned());
            if *module == GLUE {
                linked.keep_origins(glue, item);
            }
            linked.text.push_str(item.text);
            linked.text.push('\n');
        }
    }
    Ok(linked)
}

impl Linked {
    /// Moves the origins inside `item` to where its text is about to stand.
    fn keep_origins(&mut self, glue: &Glue, item: &Item<'_>) {
        let start = item.text.as_ptr() as usize - glue.text.as_ptr() as usize;
        let end = start + item.text.len();
        let here = self.text.len();
        let moved = |range: &Range<usize>| {
            let is_inside = range.start >= start && range.end <= end;
            is_inside.then(|| range.start - start + here..range.end - start + here)
        };
        for (range, span) in &glue.origins {
            self.origins.extend(moved(range).map(|range| (range, span.clone())));
        }
        if let Some(place) = glue.output_format.as_ref().and_then(moved) {
            self.output_format = Some(place);
        }
    }
}

/// Names of all declarations that the roots reach.
fn reach<'a>(
    declared: &BTreeMap<&'a str, (&str, &Item<'a>)>,
    roots: &[&str],
) -> Result<BTreeSet<&'a str>, LinkError> {
    let mut reached = BTreeSet::new();
    let mut open = Vec::new();
    for root in roots {
        let (_, item) =
            declared.get(root).ok_or_else(|| LinkError::NoSuchRoot { name: (*root).to_owned() })?;
        open.push(*item);
    }
    while let Some(item) = open.pop() {
        if reached.insert(item.name) {
            open.extend(item.references.iter().filter_map(|name| declared.get(name)).map(|(_, item)| *item));
        }
    }
    Ok(reached)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIBRARY: &[Module] = &[
        Module {
            name: "a",
            text: "// About a.\n\nfn used() -> f32 { return LIMIT; }\n\nfn unused() { used(); }\n",
        },
        Module { name: "b", text: "const LIMIT = 1.0;\n" },
        Module { name: "c", text: "fn never() {}\n" },
    ];

    #[test]
    fn keeps_what_the_root_reaches_and_nothing_else() {
        let glue = Glue { text: "fn root() { used(); }\n".to_owned(), ..Default::default() };
        let linked = link(LIBRARY, &glue, &["root"], "// head\n").expect("links");
        assert!(linked.text.starts_with("// head\n"));
        assert!(linked.text.contains("// About a.") && linked.text.contains("LIMIT = 1.0"));
        assert!(!linked.text.contains("unused") && !linked.text.contains("never"));
        assert_eq!(
            linked.modules.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>(),
            ["the material set", "a", "b"]
        );
        assert_eq!(linked.module_at(linked.text.len() - 1), Some("b"));
    }

    #[test]
    fn a_name_declared_twice_is_an_error() {
        let glue = Glue { text: "const LIMIT = 2.0;".to_owned(), ..Default::default() };
        let error = link(LIBRARY, &glue, &["LIMIT"], "").expect_err("LIMIT stands twice");
        assert_eq!(error.to_string(), "LIMIT is declared by the material set and by b");
    }

    #[test]
    fn origins_follow_their_text() {
        let mut sources = crate::source::SourceMap::new();
        let file = sources.add("m.ron", "value");
        let text = "fn dropped() {}\n\nconst KEPT = 42.0;\n";
        let at = text.find("42.0").expect("it is there");
        let glue = Glue {
            text: text.to_owned(),
            origins: vec![(at..at + 4, Span::new(file, 0..5))],
            ..Default::default()
        };
        let linked = link(&[], &glue, &["KEPT"], "// head\n").expect("links");
        let moved = linked.text.find("42.0").expect("it is there");
        assert_eq!(linked.origin(&(moved + 1..moved + 2)), Some(&Span::new(file, 0..5)));
        assert_eq!(linked.origin(&(0..1)), None);
    }
}
