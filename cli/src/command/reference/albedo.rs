//! `subsurface reference albedo`.

use super::EntryName;
use super::table::Albedos;
use crate::command::output;
use crate::failure::Failure;
use crate::picture::file;
use crate::plot::{Axis, Colour, Dash, Figure, FigureFile, Mark, Panel, Series};
use crate::table::{Align, Table};
use clap::Args;
use subsurface_profile::single_scattering_albedo::{self, from_surface_albedo};
use subsurface_reference::chandrasekhar::{self, TotalError};

/// Arguments of `reference albedo`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface reference albedo --entry searchlight --surface-albedo 0.2,0.5,0.8
  subsurface reference albedo --entry diffuse --single-scattering-albedo 0.9,0.99,0.999
  subsurface reference albedo --entry searchlight --surface-albedo 0.1,0.5,0.9 --out albedo.svg")]
pub struct AlbedoArguments {
    /// How light enters.
    #[arg(long, value_enum)]
    pub entry: EntryName,
    #[command(flatten)]
    pub albedos: Albedos,
    /// Draw α over A, .svg or .png: lines are the conversions, dots exact values.
    #[arg(long, value_name = "FILE.svg|.png", value_parser = FigureFile::parse)]
    pub out: Option<FigureFile>,
}

/// Runs the command.
pub(super) fn run(arguments: &AlbedoArguments) -> Result<(), Failure> {
    if let Some(out) = &arguments.out {
        file::folder_of(out.path())?;
    }
    let entry = arguments.entry;
    let mut heads = vec!["A exact", "α exact", "α of the profiles", "error"];
    if entry == EntryName::Searchlight {
        heads.extend(["α of Liang et al.", "error"]);
    }
    let mut table = Table::new(heads.into_iter().map(|head| (head, Align::Right)));
    for (surface_albedo, alpha) in pairs(arguments)? {
        let mut row = vec![format!("{surface_albedo:.8}"), format!("{alpha:.8}")];
        let mut push = |converted: f64| {
            row.extend([format!("{converted:.8}"), format!("{:+.1e}", converted - alpha)]);
        };
        push(converted(entry, surface_albedo));
        if entry == EntryName::Searchlight {
            push(liang_2023(surface_albedo));
        }
        table.row(row);
    }
    output::print(&table.to_string())?;
    match &arguments.out {
        Some(out) => Ok(out.write(&figure(entry)?)?),
        None => Ok(()),
    }
}

/// Surface and single-scattering albedos of the media that are asked for.
fn pairs(arguments: &AlbedoArguments) -> Result<Vec<(f64, f64)>, Failure> {
    let entry = arguments.entry.entry();
    let Albedos { surface_albedos, single_scattering_albedos } = &arguments.albedos;
    let by_surface =
        surface_albedos.iter().map(|a| Ok((*a, chandrasekhar::single_scattering_albedo(entry, *a)?)));
    let by_medium = single_scattering_albedos
        .iter()
        .map(|alpha| Ok((chandrasekhar::surface_albedo(entry, *alpha)?, *alpha)));
    by_surface.chain(by_medium).collect::<Result<_, _>>().map_err(|error| failure(&error))
}

fn failure(error: &TotalError) -> Failure {
    Failure::new(error.to_string(), "albedos lie in [0, 1]")
}

/// The conversion of the profile models.
fn converted(entry: EntryName, surface_albedo: f64) -> f64 {
    let entry = match entry {
        EntryName::Searchlight => single_scattering_albedo::Entry::Searchlight,
        EntryName::Diffuse => single_scattering_albedo::Entry::Diffuse,
    };
    from_surface_albedo(entry, surface_albedo)
}

/// Liang et al. 2023, eq. (8). It falls above A = 0.9165, where it should rise to 1.
fn liang_2023(surface_albedo: f64) -> f64 {
    5.67 * surface_albedo / (surface_albedo * surface_albedo + 3.84 * surface_albedo + 0.84)
}

fn figure(entry: EntryName) -> Result<Figure, Failure> {
    let albedos = |steps: u32| (0..=steps).map(move |step| f64::from(step) / f64::from(steps));
    let line = |label: &str, index, conversion: &dyn Fn(f64) -> f64| Series {
        label: label.into(),
        colour: Colour::unordered(index),
        mark: Mark::Line(Dash::nth(index)),
        points: albedos(200).map(|a| (a, conversion(a))).collect(),
    };
    let exact = |steps| -> Result<Vec<(f64, f64)>, Failure> {
        let pair = |a| Ok((a, chandrasekhar::single_scattering_albedo(entry.entry(), a)?));
        albedos(steps).map(pair).collect::<Result<_, _>>().map_err(|error: TotalError| failure(&error))
    };
    let mut series = vec![line("conversion of the profiles", 0, &|a| converted(entry, a))];
    if entry == EntryName::Searchlight {
        series.push(line("Liang et al. 2023, eq. (8)", 1, &liang_2023));
    }
    let dots = Series {
        label: "exact (Chandrasekhar's H functions)".into(),
        colour: Colour::BLACK,
        mark: Mark::Dots,
        points: exact(40)?,
    };
    let fine = exact(200)?;
    let errors = series.iter().map(|line| {
        let points =
            line.points.iter().zip(&fine).map(|(found, exact)| (exact.0, found.1 - exact.1)).collect();
        Series { label: String::new(), points, ..line.clone() }
    });
    let x = Axis::linear("surface albedo A", 0.0, 1.0);
    let right = Panel {
        title: "error of the conversion".into(),
        x: x.clone(),
        y: Axis::linear("α − exact α", -0.006, 0.006),
        series: errors.collect(),
    };
    series.push(dots);
    let left = Panel {
        title: "conversion".into(),
        x,
        y: Axis::linear("single-scattering albedo α", 0.0, 1.0),
        series,
    };
    let name = match entry {
        EntryName::Searchlight => "searchlight",
        EntryName::Diffuse => "diffuse",
    };
    Ok(Figure {
        title: format!("Single-scattering albedo for a surface albedo, {name} entry"),
        panels: vec![left, right],
    })
}
