//! Names that lead back to themselves.

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// Members of a cycle that a message names.
const MOST_LINKS: usize = 8;

/// The cycles of a graph in which every node has at most one successor; each begins at its smallest name.
pub(super) fn find<'a>(edges: &BTreeMap<&'a str, (&'a str, &Span)>) -> Vec<Vec<&'a str>> {
    let mut done: BTreeSet<&str> = BTreeSet::new();
    let mut cycles = Vec::new();
    for start in edges.keys() {
        let mut path: Vec<&str> = Vec::new();
        let mut on_path: BTreeMap<&str, usize> = BTreeMap::new();
        let mut name: &'a str = start;
        while !done.contains(name) {
            if let Some(&first) = on_path.get(name) {
                let mut cycle = path[first..].to_vec();
                let smallest = (0..cycle.len()).min_by_key(|&index| cycle[index]).unwrap_or(0);
                cycle.rotate_left(smallest);
                cycles.push(cycle);
                break;
            }
            on_path.insert(name, path.len());
            path.push(name);
            let Some((next, _)) = edges.get(name) else { break };
            name = next;
        }
        done.extend(path);
    }
    cycles
}

/// The error for a cycle: `noun` says what goes round, `what` what is wrong with the first of them, and `link` how each
/// leads to the next.
pub(super) fn describe(
    cycle: &[&str],
    edges: &BTreeMap<&str, (&str, &Span)>,
    noun: &str,
    what: &str,
    link: &str,
) -> Diagnostic {
    let mut shown: Vec<String> = cycle.iter().take(MOST_LINKS).map(|name| format!("`{name}`")).collect();
    if cycle.len() > MOST_LINKS {
        shown.push(format!("{} more", cycle.len() - MOST_LINKS));
    }
    let first = cycle.first().copied().unwrap_or_default();
    shown.push(format!("`{first}`"));
    let mut diagnostic = Diagnostic::error(format!("{noun} `{first}` {what}: {}", shown.join(" -> ")));
    for (index, name) in cycle.iter().take(MOST_LINKS).enumerate() {
        if let Some((target, span)) = edges.get(name) {
            let label = format!("`{name}` {link} `{target}`");
            diagnostic = if index == 0 {
                diagnostic.label((*span).clone(), label)
            } else {
                diagnostic.secondary((*span).clone(), label)
            };
        }
    }
    diagnostic
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::SourceMap;

    #[test]
    fn each_cycle_is_found_once_and_begins_at_its_smallest_name() {
        let span = Span::new(SourceMap::new().add("x", ""), 0..0);
        let edge = |from, to| (from, (to, &span));
        let edges = BTreeMap::from([
            edge("a", "d"), // a tail into the cycle d -> b -> c -> d
            edge("b", "c"),
            edge("c", "d"),
            edge("d", "b"),
            edge("e", "e"),
            edge("f", "g"),
        ]);
        assert_eq!(find(&edges), [vec!["b", "c", "d"], vec!["e"]]);
    }
}
