//! Links WGSL files into one text: what the roots reach is kept, as written; the rest is dropped.
//!
//! Entry points come first. Below them a file comes after those that it uses, as its header says; the headers are checked,
//! and are no part of the text.

mod header;
mod order;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use subsurface_shaders::Module;

use crate::docs::Docs;
use crate::item::{Item, Items, items};
use crate::source::Span;

use order::{Declared, Kind, Part, order, split_glue};

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
    /// Ranges of `text` that spell a value of a material file; they are disjoint.
    origins: Vec<(Range<usize>, Span)>,
    /// The range of `text` that spells the format of the compute path's output.
    pub(crate) output_format: Option<Range<usize>>,
    /// Doc comments of what was kept.
    pub(crate) docs: Docs,
    /// Names of the files that contributed, in the order of the text, and where their part starts. One with entry points
    /// may have two parts.
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

/// The files to link. No name may stand in two of them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Files<'a> {
    /// Files of the house that are linked where another uses them.
    pub(crate) rooms: &'a [Module],
    /// Passes of the house, in the order in which the text has them: the first ones declare what later ones' files need.
    pub(crate) passes: &'a [Module],
    /// Passes of the caller's own. They may use any file, and bear no header.
    pub(crate) guests: &'a [Module],
}

/// Why files cannot be linked. All but those of a caller's own pass are defects of the shaders.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum LinkError {
    /// A declaration does not end.
    #[error("a declaration of {module} does not end (byte {offset})")]
    Unfinished {
        /// The file's name.
        module: String,
        /// Where the declaration starts.
        offset: usize,
    },
    /// Two files declare one name.
    #[error("{name} is declared by {first} and by {second}")]
    DeclaredTwice {
        /// The name.
        name: String,
        /// The first file.
        first: String,
        /// The second file.
        second: String,
    },
    /// No file declares a root.
    #[error("no module declares the entry point {name}")]
    NoSuchRoot {
        /// The name.
        name: String,
    },
    /// A first line that begins as a header and is none.
    #[error("{file}: `{line}` is no header; write `// uses: lib/angle, gather/point; needs: input_pixel`")]
    Header {
        /// The file.
        file: String,
        /// Its first line.
        line: String,
    },
    /// A file uses what its header does not name.
    #[error("{file} uses {name}, which {declared_by} declares: name {declared_by} in its header")]
    Unnamed {
        /// The file.
        file: String,
        /// The name.
        name: String,
        /// The file that the header must name.
        declared_by: String,
    },
    /// A header names what the file does not use.
    #[error("{file} uses nothing of {entry}: leave it out of its header")]
    Unneeded {
        /// The file.
        file: String,
        /// What the header names.
        entry: String,
    },
    /// A header names a file that is not there.
    #[error("{file} uses {used}, and there is no such file")]
    NoSuchFile {
        /// The file.
        file: String,
        /// What its header names.
        used: String,
    },
    /// A header says that a name is left open which a file declares.
    #[error(
        "{file} needs {name}, which {declared_by} declares: it is not open, so name {declared_by} under `uses`"
    )]
    NotOpen {
        /// The file.
        file: String,
        /// The name.
        name: String,
        /// The file that declares it.
        declared_by: String,
    },
    /// Neither a pass nor the material set declares what a file leaves open.
    #[error("{file} needs {name}, and no pass declares it")]
    Open {
        /// The file.
        file: String,
        /// The name.
        name: String,
    },
    /// Files use each other.
    #[error("files use each other in a circle: {circle}")]
    Circle {
        /// The files, from one to itself.
        circle: String,
    },
    /// A pass of the caller's declares what a file means a built-in by.
    #[error("the pass {declared_by} declares {name}, which {file} uses as a built-in: rename it")]
    OfAGuest {
        /// The file.
        file: String,
        /// The name.
        name: String,
        /// The caller's pass.
        declared_by: String,
    },
}

/// Name of the part that the emitter wrote.
pub(crate) const GLUE: &str = "the material set";

/// Titles of its two parts: what refers to no file, and what does.
const GLUE_TITLES: [&str; 2] = ["the material set: choices", "the material set: materials"];

/// Links `files` and `glue`: keeps what the `roots` reach. Roots come first, then the rest, each part after those that
/// it uses.
pub(crate) fn link(files: Files<'_>, glue: &Glue, roots: &[&str], header: &str) -> Result<Linked, LinkError> {
    let parts = parts(files, glue)?;
    let mut declared: Declared<'_, '_> = BTreeMap::new();
    for (index, part) in parts.iter().enumerate() {
        for item in &part.items {
            if let Some((first, _)) = declared.insert(item.name, (index, item)) {
                let (first, second) = (parts[first].name.to_owned(), part.name.to_owned());
                return Err(LinkError::DeclaredTwice { name: item.name.to_owned(), first, second });
            }
        }
    }
    let reached = reach(&declared, roots)?;
    // The choices of the set stand above all else. Its second part is where files use it, or last.
    let is_start = |&index: &usize| {
        matches!(parts[index].kind, Kind::Pass | Kind::Guest)
            || parts[index].items.iter().any(|item| roots.contains(&item.name))
    };
    let files = (GLUE_TITLES.len()..parts.len()).filter(is_start);
    let starts: Vec<usize> = std::iter::once(0).chain(files).chain([1]).collect();
    let order = order(&parts, &declared, roots, &starts)?;
    for part in order.iter().map(|&index| &parts[index]) {
        let is_open = |name: &&&str| !declared.contains_key(**name);
        let kept = part.items.iter().filter(|item| reached.contains(item.name));
        let open = |item: &Item<'_>| {
            part.header.needs.iter().filter(is_open).find(|name| item.references.contains(**name)).copied()
        };
        if let Some(name) = kept.into_iter().find_map(open) {
            return Err(LinkError::Open { file: part.name.to_owned(), name: name.to_owned() });
        }
    }

    let mut linked = Linked {
        text: header.to_owned(),
        origins: Vec::new(),
        output_format: None,
        docs: Docs::default(),
        modules: Vec::new(),
        module_of: BTreeMap::new(),
    };
    let mut begun = BTreeSet::new();
    let in_entries = starts.iter().map(|&index| (index, true));
    for (index, is_root) in in_entries.chain(order.iter().map(|&index| (index, false))) {
        let part = &parts[index];
        let is_kept = |item: &&Item<'_>| reached.contains(item.name) && roots.contains(&item.name) == is_root;
        let kept: Vec<_> = part.items.iter().filter(is_kept).collect();
        if !kept.is_empty() {
            linked.append(part, &kept, begun.insert(index), glue);
        }
    }
    Ok(linked)
}

/// All parts: both of the glue, then the files.
fn parts<'a>(files: Files<'a>, glue: &'a Glue) -> Result<Vec<Part<'a>>, LinkError> {
    let mut parts = Vec::new();
    for (kind, modules) in
        [(Kind::Room, files.rooms), (Kind::Pass, files.passes), (Kind::Guest, files.guests)]
    {
        for module in modules {
            parts.push(part(kind, module.name, module.text)?);
        }
    }
    let of_files: BTreeSet<&str> = parts.iter().flat_map(|part| &part.items).map(|item| item.name).collect();
    let Part { items, .. } = part(Kind::MaterialSet, GLUE, &glue.text)?;
    let (choices, materials) = split_glue(items, &of_files);
    let of_set = [choices, materials].into_iter().zip(GLUE_TITLES).map(|(items, title)| {
        let header = header::Header::default();
        Part { kind: Kind::MaterialSet, name: GLUE, title, header, preamble: "", items }
    });
    Ok(of_set.chain(parts).collect())
}

/// Reads one text.
fn part<'a>(kind: Kind, name: &'a str, text: &'a str) -> Result<Part<'a>, LinkError> {
    let (header, below) = match kind {
        Kind::Room | Kind::Pass => header::split(text)
            .map_err(|line| LinkError::Header { file: name.to_owned(), line: line.to_owned() })?,
        Kind::MaterialSet | Kind::Guest => (header::Header::default(), text),
    };
    let Items { preamble, items } = items(below).map_err(|offset| LinkError::Unfinished {
        module: name.to_owned(),
        offset: offset + text.len() - below.len(),
    })?;
    Ok(Part { kind, name, title: name, header, preamble, items })
}

impl Linked {
    /// Adds `items` of `part`, below its comments if it begins with them.
    fn append(&mut self, part: &Part<'_>, items: &[&Item<'_>], begins: bool, glue: &Glue) {
        self.modules.push((self.text.len(), part.name.to_owned()));
        self.text.push_str(&format!("\n// ── {} ──\n", part.title));
        if begins && !part.preamble.is_empty() {
            self.text.push_str(part.preamble);
            self.text.push('\n');
        }
        for item in items {
            self.text.push('\n');
            self.docs.add(item);
            self.module_of.insert(item.name.to_owned(), part.name.to_owned());
            if part.kind == Kind::MaterialSet {
                self.keep_origins(glue, item);
            }
            self.text.push_str(item.text);
            self.text.push('\n');
        }
    }

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
fn reach<'a>(declared: &Declared<'_, 'a>, roots: &[&str]) -> Result<BTreeSet<&'a str>, LinkError> {
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
mod tests;
