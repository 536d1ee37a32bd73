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
/// Checks the headers of all of them.
pub(super) fn order(
    parts: &[Part<'_>],
    declared: &Declared<'_, '_>,
    starts: &[usize],
) -> Result<Vec<usize>, LinkError> {
    let mut walk = Walk { parts, declared, path: Vec::new(), done: BTreeSet::new(), order: Vec::new() };
    for &start in starts {
        walk.visit(start)?;
    }
    Ok(walk.order)
}

struct Walk<'w, 'a> {
    parts: &'w [Part<'a>],
    declared: &'w Declared<'w, 'a>,
    /// From the start to the part that is visited.
    path: Vec<usize>,
    done: BTreeSet<usize>,
    order: Vec<usize>,
}

impl Walk<'_, '_> {
    fn visit(&mut self, index: usize) -> Result<(), LinkError> {
        if self.done.contains(&index) {
            return Ok(());
        }
        if let Some(begin) = self.path.iter().position(|&open| open == index) {
            let circle = self.path[begin..].iter().chain([&index]);
            let circle = circle.map(|&part| self.parts[part].name).collect::<Vec<_>>().join(" → ");
            return Err(LinkError::Circle { circle });
        }
        self.path.push(index);
        for used in self.used_by(index)? {
            self.visit(used)?;
        }
        self.path.pop();
        self.done.insert(index);
        self.order.push(index);
        Ok(())
    }

    /// The parts that one uses, in the order in which it names them.
    fn used_by(&self, index: usize) -> Result<Vec<usize>, LinkError> {
        let part = &self.parts[index];
        let mut taken: BTreeSet<usize> = BTreeSet::new();
        let mut needed: BTreeSet<&str> = BTreeSet::new();
        for name in part.items.iter().flat_map(|item| &item.references).copied() {
            if part.header.needs.contains(&name) {
                needed.insert(name);
            }
            let Some(&(from, _)) = self.declared.get(name) else { continue };
            if from != index && !part.header.needs.contains(&name) {
                taken.insert(from);
                self.check_named(part, name, from)?;
            }
        }
        if matches!(part.kind, Kind::MaterialSet | Kind::Guest) {
            return Ok(taken.into_iter().collect());
        }
        for &name in &part.header.needs {
            self.check_need(part, name, needed.contains(name))?;
        }
        let mut used = Vec::new();
        for file in &part.header.uses {
            let named = |&place: &usize| self.parts[place].name == file;
            if !(0..self.parts.len()).any(|place| named(&place)) {
                return Err(LinkError::NoSuchFile { file: part.name.to_owned(), used: file.clone() });
            }
            let before = used.len();
            used.extend(taken.iter().copied().filter(named));
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
