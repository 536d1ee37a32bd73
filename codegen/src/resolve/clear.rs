//! The clear materials of a set.

use std::collections::BTreeMap;

use super::{Files, Resolution};
use crate::diagnostics::Diagnostic;
use crate::identifier::screaming_case;
use crate::source::Span;
use crate::suggestion::shortened;

impl Resolution {
    /// Takes the clear materials; reports names that are taken.
    pub(super) fn take_clear(&mut self, files: &Files) {
        let mut names: BTreeMap<String, &Span> = BTreeMap::new();
        let scattering = files.materials.iter().map(|material| &material.name);
        for name in scattering.chain(files.clear.iter().map(|clear| &clear.name)) {
            if let Some(first) = names.get(&screaming_case(&name.value)) {
                // Two materials that scatter are reported elsewhere.
                if files.clear.iter().any(|clear| std::ptr::eq(&clear.name, name)) {
                    self.diagnostics.push(
                        Diagnostic::error(format!(
                            "two materials have the name `{}`",
                            shortened(&name.value)
                        ))
                        .label(name.span.clone(), "this name is taken")
                        .secondary((*first).clone(), "first used here")
                        .help("rename one of the files, or give one a `name: \"…\"` of its own"),
                    );
                }
                continue;
            }
            names.insert(screaming_case(&name.value), &name.span);
        }
        self.clear = files.clear.iter().filter_map(|clear| clear.material.clone()).collect();
        self.clear.sort_by(|a, b| a.name.cmp(&b.name));
    }
}
