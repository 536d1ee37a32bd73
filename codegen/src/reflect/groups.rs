//! Bind groups: which resources are bound together.
//!
//! WGSL lets two globals have one binding if no entry point uses both, so a group number may mean one thing to one pass
//! and another to the next. What a module declares is one group.

use std::collections::{BTreeMap, BTreeSet};

use naga::valid::{GlobalUse, ModuleInfo};
use naga::{GlobalVariable, Handle, Module, ShaderStage};

use crate::compose::Linked;

use super::{Bound, Group, Stage, UnsupportedBinding, resource};

/// The bind groups of a module, by number, then in the order of the text.
pub(super) fn of(
    module: &Module,
    info: &ModuleInfo,
    linked: &Linked,
) -> Result<Vec<Group>, UnsupportedBinding> {
    let mut declared: BTreeMap<u32, Vec<(&str, Group)>> = BTreeMap::new();
    for (handle, global) in module.global_variables.iter() {
        let Some(place) = &global.binding else { continue };
        let name = global.name.clone().unwrap_or_default();
        let file = linked.module_of.get(&name).map_or("", String::as_str);
        let number = place.group;
        let of_number = declared.entry(number).or_default();
        let index = of_number.iter().position(|(known, _)| *known == file).unwrap_or_else(|| {
            let empty = Group { number, module: None, bindings: BTreeMap::new(), entry_points: Vec::new() };
            of_number.push((file, empty));
            of_number.len() - 1
        });
        let group = &mut of_number[index].1;
        let stages = stages(module, info, handle, &mut group.entry_points);
        let resource = resource(module, info, handle, global)?;
        let docs = linked.docs.of(&name);
        group.bindings.insert(place.binding, Bound { name, docs, stages, resource });
    }
    let groups = declared.into_values().flat_map(|of_number| {
        let is_shared = of_number.len() > 1;
        let named =
            move |(file, group): (&str, Group)| Group { module: is_shared.then(|| file.to_owned()), ..group };
        of_number.into_iter().map(named)
    });
    Ok(groups.collect())
}

/// The stages that use `global`; the entry points that do are added to `users`.
fn stages(
    module: &Module,
    info: &ModuleInfo,
    global: Handle<GlobalVariable>,
    users: &mut Vec<String>,
) -> BTreeSet<Stage> {
    let mut stages = BTreeSet::new();
    for (index, entry) in module.entry_points.iter().enumerate() {
        if info.get_entry_point(index)[global] == GlobalUse::empty() {
            continue;
        }
        if !users.contains(&entry.name) {
            users.push(entry.name.clone());
        }
        stages.extend(match entry.stage {
            ShaderStage::Vertex => Some(Stage::Vertex),
            ShaderStage::Fragment => Some(Stage::Fragment),
            ShaderStage::Compute => Some(Stage::Compute),
            _ => None,
        });
    }
    stages
}

#[cfg(test)]
mod tests;
