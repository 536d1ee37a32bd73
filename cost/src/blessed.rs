//! Figures that were accepted, and what differs from them.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::Failure;
use crate::figures::Figures;

/// What may change without a word, percent.
const PERCENT: f64 = 5.0;

/// Figures, and the compiler that they are of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Measured {
    /// `Mesa` and its version.
    pub(crate) compiler: String,
    /// A stage on a GPU each.
    pub(crate) figures: Vec<Figures>,
}

impl Measured {
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let file = |why: String| Failure::File { action: "read", path: path.to_owned(), why };
        let text = std::fs::read_to_string(path).map_err(|error| file(error.to_string()))?;
        serde_json::from_str(&text).map_err(|error| file(error.to_string()))
    }

    /// Writes the figures: whole or not at all.
    pub(crate) fn write(&self, path: &Path) -> Result<(), Failure> {
        let file = |why: String| Failure::File { action: "write", path: path.to_owned(), why };
        let json = |figures| serde_json::to_string(figures).map_err(|error| file(error.to_string()));
        // A stage a line: what a reviewer reads.
        let lines = self.figures.iter().map(json).collect::<Result<Vec<_>, _>>()?.join(",\n");
        let text = format!("{{\"compiler\":{:?},\"figures\":[\n{lines}\n]}}\n", self.compiler);
        let fresh = path.with_extension("json.new");
        std::fs::write(&fresh, text).map_err(|error| file(error.to_string()))?;
        std::fs::rename(&fresh, path).map_err(|error| file(error.to_string()))
    }

    /// Compares with the figures in `path`.
    pub(crate) fn check(&self, path: &Path) -> Result<(), Failure> {
        let accepted = Self::read(path)?;
        if accepted.compiler != self.compiler {
            let (theirs, ours) = (accepted.compiler, self.compiler.clone());
            return Err(Failure::OtherVersion { path: path.to_owned(), theirs, ours });
        }
        let differences = differences(&accepted.figures, &self.figures);
        if differences.is_empty() {
            return Ok(());
        }
        let (count, text) = (differences.len(), differences.join("\n"));
        Err(Failure::Stale { count, percent: PERCENT, path: path.to_owned(), text })
    }
}

/// A line for each figure that differs, and for each stage that only one side has.
fn differences(accepted: &[Figures], fresh: &[Figures]) -> Vec<String> {
    let name = |own: &Figures| format!("{} {} {}", own.gpu.name(), own.kernel, own.stage);
    let mut lines = Vec::new();
    for own in fresh {
        let Some(theirs) = accepted.iter().find(|theirs| name(theirs) == name(own)) else {
            lines.push(format!("{}: new", name(own)));
            continue;
        };
        for ((figure, before), (_, now)) in compared(theirs).into_iter().zip(compared(own)) {
            let is_other = match (before, now) {
                (Some(before), Some(now)) => (now - before).abs() > 0.01 * PERCENT * before.abs().max(1.0),
                (None, None) => false,
                _ => true,
            };
            if is_other {
                let shown =
                    |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |value| value.to_string());
                lines.push(format!("{}: {figure} {} → {}", name(own), shown(before), shown(now)));
            }
        }
    }
    let gone = accepted.iter().filter(|theirs| fresh.iter().all(|own| name(own) != name(theirs)));
    lines.extend(gone.map(|theirs| format!("{}: gone", name(theirs))));
    lines
}

fn compared(figures: &Figures) -> [(&'static str, Option<f64>); 9] {
    [
        ("VGPRs", Some(f64::from(figures.vgprs))),
        ("spilled VGPRs", Some(f64::from(figures.spilled_vgprs))),
        ("spilled SGPRs", Some(f64::from(figures.spilled_sgprs))),
        ("waves", Some(f64::from(figures.waves))),
        ("LDS", Some(f64::from(figures.lds_bytes))),
        ("instructions", Some(f64::from(figures.instructions))),
        ("cycles per pixel", figures.cycles_per_pixel),
        ("loads per pixel", figures.loads_per_pixel),
        ("bytes per pixel", figures.bytes_per_pixel),
    ]
}
