//! Which file uses which, and the order that follows: a file comes after those that it uses.

use std::collections::{BTreeMap, BTreeSet};

use crate::item::Item;

use super::LinkError;
use super::header::Header;

/// What a part is, which says how it is held to its header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Glue: uses what it names.
    MaterialSet,
    /// A file of the house that is linked where another uses it.
    Room,
    /// A pass of the house.
    Pass,
    /// A pass of the caller's own: uses what it names, and bears no header.
    Guest,
}

/// A file, or what the glue declares.
#[derive(Debug)]
pub(super) struct Part<'a> {
    pub(super) kind: Kind,
    pub(super) name: &'a str,
    /// What stands above its part of the text.
    pub(super) title: &'a str,
    pub(super) header: Header<'a>,
    pub(super) preamble: &'a str,
    pub(super) items: Vec<Item<'a>>,
}

/// The part that declares each name, and the declaration.
pub(super) type Declared<'p, 'a> = BTreeMap<&'a str, (usize, &'p Item<'a>)>;

/// The parts that are linked, each after those that it uses: first what `starts` use, one after the other.
///
/// The `roots` stand above all parts, so what they alone use may follow the rest of their file: bindings come before the
/// functions that need them. Checks the headers of all parts.
pub(super) fn order(
    parts: &[Part<'_>],
    declared: &Declared<'_, '_>,
    roots: &[&str],
    starts: &[usize],
) -> Result<Vec<usize>, LinkError> {
    let mut walk = Walk { parts, declared, roots, path: Vec::new(), uses: BTreeMap::new() };
    for &start in starts {
        walk.visit(start)?;
    }
    let mut order = Vec::with_capacity(walk.uses.len());
    let mut placed = BTreeSet::new();
    for &start in starts {
        place(start, &walk.uses, &mut placed, &mut order);
    }
    Ok(order)
}

/// Puts a part behind those that it uses. There is no circle.
fn place(
    index: usize,
    uses: &BTreeMap<usize, Vec<Use>>,
    placed: &mut BTreeSet<usize>,
    order: &mut Vec<usize>,
) {
    if !placed.insert(index) {
        return;
    }
    let used = uses.get(&index).map_or(&[][..], Vec::as_slice);
    for used in used.iter().filter(|used| !used.by_roots_alone) {
        place(used.part, uses, placed, order);
    }
    order.push(index);
    for used in used.iter().filter(|used| used.by_roots_alone) {
        place(used.part, uses, placed, order);
    }
}

/// That one part uses another.
#[derive(Clone, Copy, Debug)]
struct Use {
    part: usize,
    by_roots_alone: bool,
}

struct Walk<'w, 'a> {
    parts: &'w [Part<'a>],
    declared: &'w Declared<'w, 'a>,
    roots: &'w [&'w str],
    /// From the start to the part that is visited.
    path: Vec<usize>,
    /// Of the parts that were visited.
    uses: BTreeMap<usize, Vec<Use>>,
}

impl Walk<'_, '_> {
    fn visit(&mut self, index: usize) -> Result<(), LinkError> {
        if self.uses.contains_key(&index) {
            return Ok(());
        }
        if let Some(begin) = self.path.iter().position(|&open| open == index) {
            let circle = self.path[begin..].iter().chain([&index]);
            let circle = circle.map(|&part| self.parts[part].name).collect::<Vec<_>>().join(" → ");
            return Err(LinkError::Circle { circle });
        }
        self.path.push(index);
        let uses = self.used_by(index)?;
        for used in &uses {
            self.visit(used.part)?;
        }
        self.path.pop();
        self.uses.insert(index, uses);
        Ok(())
    }

    /// The parts that one uses, in the order in which it names them.
    fn used_by(&self, index: usize) -> Result<Vec<Use>, LinkError> {
        let part = &self.parts[index];
        let mut taken: BTreeMap<usize, Use> = BTreeMap::new();
        let mut needed: BTreeSet<&str> = BTreeSet::new();
        for item in &part.items {
            let by_root = self.roots.contains(&item.name);
            for &name in &item.references {
                if part.header.needs.contains(&name) {
                    needed.insert(name);
                    continue;
                }
                let Some(&(from, _)) = self.declared.get(name) else { continue };
                if from != index {
                    self.check_named(part, name, from)?;
                    taken.entry(from).or_insert(Use { part: from, by_roots_alone: true }).by_roots_alone &=
                        by_root;
                }
            }
        }
        if matches!(part.kind, Kind::MaterialSet | Kind::Guest) {
            return Ok(taken.into_values().collect());
        }
        for &name in &part.header.needs {
            self.check_need(part, name, needed.contains(name))?;
        }
        let mut used = Vec::new();
        for file in &part.header.uses {
            if !self.parts.iter().any(|part| part.name == file) {
                return Err(LinkError::NoSuchFile { file: part.name.to_owned(), used: file.clone() });
            }
            let before = used.len();
            used.extend(taken.values().copied().filter(|used| self.parts[used.part].name == file));
            if used.len() == before {
                return Err(LinkError::Unneeded { file: part.name.to_owned(), entry: file.clone() });
            }
        }
        Ok(used)
    }

    /// Whether `part` says that it uses the part `from`, which declares `name`.
    fn check_named(&self, part: &Part<'_>, name: &str, from: usize) -> Result<(), LinkError> {
        let from = &self.parts[from];
        let is_free = matches!(part.kind, Kind::MaterialSet | Kind::Guest);
        if is_free || part.header.uses.iter().any(|file| file == from.name) {
            return Ok(());
        }
        let (file, name, declared_by) = (part.name.to_owned(), name.to_owned(), from.name.to_owned());
        Err(match from.kind {
            Kind::Guest => LinkError::OfAGuest { file, name, declared_by },
            _ => LinkError::Unnamed { file, name, declared_by },
        })
    }

    /// Whether a name that `part` leaves open is open, and used.
    fn check_need(&self, part: &Part<'_>, name: &str, is_used: bool) -> Result<(), LinkError> {
        let file = part.name.to_owned();
        if !is_used {
            return Err(LinkError::Unneeded { file, entry: name.to_owned() });
        }
        match self.declared.get(name).map(|&(from, _)| &self.parts[from]) {
            Some(from) if from.kind == Kind::Room => {
                Err(LinkError::NotOpen { file, name: name.to_owned(), declared_by: from.name.to_owned() })
            }
            _ => Ok(()),
        }
    }
}

/// Splits the items of the glue: first those that refer to no file, then those that do, or to such an item.
pub(super) fn split_glue<'a>(
    items: Vec<Item<'a>>,
    of_files: &BTreeSet<&'a str>,
) -> (Vec<Item<'a>>, Vec<Item<'a>>) {
    let mut late: BTreeSet<&str> = BTreeSet::new();
    loop {
        let before = late.len();
        for item in &items {
            if item.references.iter().any(|name| of_files.contains(name) || late.contains(name)) {
                late.insert(item.name);
            }
        }
        if late.len() == before {
            break;
        }
    }
    items.into_iter().partition(|item| !late.contains(item.name))
}
