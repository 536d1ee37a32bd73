//! Names with brackets: `Name`, `Name()`, `Name(field: value, …)` and `Name(value, …)`.

use crate::diagnostics::Diagnostic;
use crate::schema::decoder::Decoder;
use crate::syntax::{Entry, Name, Node, Shape};

/// What stands in the brackets after a name.
pub(super) enum Body<'a> {
    Fields(Vec<Entry<'a>>),
    Values(Vec<Node<'a>>),
}

impl<'a> Body<'a> {
    /// The name and its brackets; `None` for a value that does not begin with a name.
    pub(super) fn of(node: &Node<'a>) -> Option<(Name<'a>, Self)> {
        match node.shape() {
            Shape::Struct(Some(name), entries) => Some((name, Self::Fields(entries))),
            Shape::Tuple(Some(name), nodes) => Some((name, Self::Values(nodes))),
            Shape::Name(name) => Some((name, Self::Fields(Vec::new()))),
            _ => None,
        }
    }

    /// The named fields; `example` shows how they are written.
    pub(super) fn fields(
        self,
        decoder: &mut Decoder,
        name: &Name<'_>,
        example: &str,
    ) -> Option<Vec<Entry<'a>>> {
        match self {
            Body::Fields(entries) => Some(entries),
            Body::Values(nodes) if nodes.is_empty() => Some(Vec::new()),
            Body::Values(_) => {
                decoder.report(
                    Diagnostic::error(format!("the fields of `{}` have no names", name.text))
                        .label(name.span.clone(), "expected `name: value` in the brackets")
                        .help(format!("for example `{example}`")),
                );
                None
            }
        }
    }

    /// The one list; `example` shows how it is written.
    pub(super) fn single(self, decoder: &mut Decoder, name: &Name<'_>, example: &str) -> Option<Node<'a>> {
        if let Body::Values(nodes) = self
            && let [node] = nodes.as_slice()
        {
            return Some(*node);
        }
        decoder.report(
            Diagnostic::error(format!("`{}` takes one list", name.text))
                .label(name.span.clone(), "expected `[…]` in the brackets")
                .help(format!("for example `{example}`")),
        );
        None
    }
}
