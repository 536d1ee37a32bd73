//! The figures as a table for people.

use subsurface_kernel::Estimator;

use crate::family::Family;
use crate::figures::{Figures, Total};

const HEAD: [&str; 12] = [
    "GPU",
    "stage",
    "VGPRs",
    "spilled",
    "SGPRs",
    "waves",
    "LDS",
    "code",
    "instructions",
    "cycles/px",
    "loads/px",
    "bytes/px",
];

/// A table for each kernel: its stages on each GPU, and the sums of both paths.
pub(crate) fn render(figures: &[Figures], gpus: &[Family], estimators: &[Estimator]) -> String {
    let mut text = String::new();
    for &estimator in estimators {
        let kernel = estimator.to_string();
        let mut rows = vec![HEAD.map(str::to_owned)];
        for &gpu in gpus {
            let own = figures.iter().filter(|own| own.gpu == gpu && own.kernel == kernel);
            rows.extend(own.map(row));
            for (suffix, path) in [("_compute", "compute path"), ("_fragment", "fragment path")] {
                rows.push(total(gpu, path, Total::of(figures, gpu, estimator, suffix)));
            }
        }
        text.push_str(&format!("{kernel}\n"));
        text.push_str(&aligned(&rows));
        text.push('\n');
    }
    text
}

fn row(figures: &Figures) -> [String; 12] {
    [
        figures.gpu.name().to_owned(),
        figures.stage.clone(),
        figures.vgprs.to_string(),
        (figures.spilled_vgprs + figures.spilled_sgprs).to_string(),
        figures.sgprs.to_string(),
        figures.waves.to_string(),
        figures.lds_bytes.to_string(),
        figures.code_bytes.to_string(),
        figures.instructions.to_string(),
        number(figures.cycles_per_pixel),
        number(figures.loads_per_pixel),
        number(figures.bytes_per_pixel),
    ]
}

fn total(gpu: Family, path: &str, total: Total) -> [String; 12] {
    let mut row: [String; 12] = Default::default();
    row[0] = gpu.name().to_owned();
    row[1] = path.to_owned();
    row[9] = number(total.cycles);
    row[10] = number(total.loads);
    row[11] = number(total.bytes);
    row
}

/// A dash where the number of taps is the scene's.
fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.1}"))
}

fn aligned(rows: &[[String; 12]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..HEAD.len()).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
            // Words to the left, numbers to the right.
            line.push_str(&if column < 2 {
                format!("{cell:<width$}  ")
            } else {
                format!("{cell:>width$}  ")
            });
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
