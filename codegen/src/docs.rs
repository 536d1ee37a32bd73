//! Doc comments of WGSL declarations.
//!
//! naga can keep them too, but loses those of the first declaration after a plain comment and moves those of a struct's
//! members up past a member that has none. Ours are read from the text that is linked.

use std::collections::BTreeMap;

use crate::item::Item;

/// Doc comments of one declaration, a line of Markdown each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct ItemDocs {
    pub(crate) lines: Vec<String>,
    /// Those of a struct's members, by name.
    pub(crate) members: BTreeMap<String, Vec<String>>,
}

/// Doc comments by declared name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Docs(BTreeMap<String, ItemDocs>);

impl Docs {
    pub(crate) fn add(&mut self, item: &Item<'_>) {
        self.0.insert(item.name.to_owned(), item_docs(item.text));
    }

    /// Lines of the declaration `name`.
    pub(crate) fn of(&self, name: &str) -> Vec<String> {
        self.0.get(name).map(|docs| docs.lines.clone()).unwrap_or_default()
    }

    /// Lines of the member `member` of the struct `name`.
    pub(crate) fn of_member(&self, name: &str, member: &str) -> Vec<String> {
        self.0.get(name).and_then(|docs| docs.members.get(member)).cloned().unwrap_or_default()
    }
}

/// `///` lines above the declaration, and above each `name:` at the start of a line inside it.
fn item_docs(text: &str) -> ItemDocs {
    let mut docs = ItemDocs::default();
    let mut lines = Vec::new();
    let mut inside = false;
    for line in text.lines().map(str::trim) {
        if let Some(doc) = line.strip_prefix("///") {
            lines.push(doc.trim().to_owned());
        } else if line.is_empty() || line.starts_with("//") || (line.starts_with('@') && !line.contains(':'))
        {
            // Blanks, plain comments and attributes on lines of their own stand between a doc and what it describes.
        } else if inside {
            let declared = line.split_once(':').map(|(name, _)| name.rsplit(' ').next().unwrap_or(name));
            if let Some(name) = declared {
                docs.members.insert(name.to_owned(), std::mem::take(&mut lines));
            }
        } else {
            docs.lines = std::mem::take(&mut lines);
            inside = true;
            // Only a struct has members; the body of a function is left alone.
            if !line.contains("struct ") {
                break;
            }
        }
    }
    docs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_member_keeps_its_own_docs() {
        let text = "// Plain.\n/// A pair.\n///\n/// Second line.\nstruct Pair {\n    first: f32,\n    /// The second.\n    \
                    @location(1) second: f32,\n}";
        let docs = item_docs(text);
        assert_eq!(docs.lines, ["A pair.", "", "Second line."]);
        assert_eq!(docs.members["first"], Vec::<String>::new());
        assert_eq!(docs.members["second"], ["The second."]);
    }

    #[test]
    fn bindings_and_functions_have_docs_and_no_members() {
        let docs = item_docs("/// Bound.\n@group(0) @binding(1) var<storage, read> table: array<Row>;");
        assert_eq!((docs.lines.len(), docs.members.len()), (1, 0));
        let docs =
            item_docs("/// Entry.\n@fragment\nfn main() -> @location(0) vec4f {\n    let x: f32 = 1.0;\n}");
        assert_eq!((docs.lines, docs.members.len()), (vec!["Entry.".to_owned()], 0));
    }
}
