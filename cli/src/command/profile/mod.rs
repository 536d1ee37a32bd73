//! `subsurface profile`: profiles evaluated, judged, fitted and drawn.

mod coefficients;
mod compare;
mod curve;
mod eval;
mod fit;
mod list;
mod model;
mod plot;
mod quantity;
mod theory;
mod truth;

use super::output;
use crate::failure::Failure;
use clap::{Args, Subcommand};

/// Evaluate, judge, fit and draw radial diffusion profiles, in double precision.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile eval --model burley_diffuse --surface-albedo 0.8 --mean-free-path-mm 1.3 --radii 0,0.5,1
  subsurface profile list
  subsurface profile compare
  subsurface profile plot --model burley_searchlight --surface-albedo 0.8 --out burley.svg")]
pub struct ProfileArguments {
    /// What to do with the profile.
    #[command(subcommand)]
    pub command: ProfileCommand,
}

/// What to do with a profile.
#[derive(Debug, Subcommand)]
pub enum ProfileCommand {
    /// List the built-in profiles with their models, lengths and sources; or the models with their coefficients.
    List(list::ListArguments),
    /// Print densities and the distribution at given radii, as CSV.
    ///
    /// After `#` lines with the parameters, `filter_radius_mm` and, where the model ends at a radius, `r_max_mm`:
    /// radius_mm; area_pdf = R(r)/A per unit area (1/mm², may be inf at 0); radial_pdf = 2πr R(r)/A per unit length
    /// (1/mm); radial_cdf = the fraction of the reflected energy that leaves within the radius. Every number is
    /// printed with as many digits as it takes to read the same number back.
    Eval(eval::EvalArguments),
    /// Print the radii within which given fractions of the energy leave, as CSV.
    ///
    /// The true inverse of radial_cdf: uniform random numbers become exit radii of the profile.
    Sample(eval::SampleArguments),
    /// Judge models by Monte Carlo truth: errors for each model and surface albedo.
    ///
    /// Each model is held against the stored truth of its own setting (perpendicular entry or diffuse entry), or
    /// against the table given with --truth. L1 is ∫|p − t| dr of the exit radius' density 2πr R/A: half of it is
    /// the share of the energy that leaves at wrong radii.
    Compare(compare::CompareArguments),
    /// Fit the coefficients of a family of models to tabulated data; print a profile file.
    ///
    /// The text can be saved as materials/profiles/NAME.ron and named in a material. The data are CSV: lines that
    /// begin with # are comments, the first other line names the columns. Needed are radii in mean free paths (r_lo and
    /// r_hi of bins, or r of points) and one of r_reflectance (r·R), reflectance (R) and radial_reflectance (2πr·R);
    /// surface_albedo is needed where there are several, and standard_error is optional and belongs to that column.
    Fit(fit::FitArguments),
    /// Draw profiles and truth as a figure, SVG or PNG.
    ///
    /// Several models or theories make one panel per surface albedo; one model makes one panel with a colour per
    /// surface albedo. Dots are Monte Carlo truth. Lengths are in mean free paths.
    Plot(plot::PlotArguments),
    /// Draw or print what a model's coefficients would best be at each surface albedo, beside the model's own.
    ///
    /// The model is fitted to the truth of each surface albedo alone; the numbers that come out are what the model's
    /// functions of the albedo were made to follow.
    Coefficients(coefficients::CoefficientsArguments),
}

/// Runs the command.
pub fn run(arguments: &ProfileArguments) -> Result<(), Failure> {
    match &arguments.command {
        ProfileCommand::List(arguments) => list::run(arguments),
        ProfileCommand::Eval(arguments) => output::print(&eval::evaluate(arguments)?),
        ProfileCommand::Sample(arguments) => output::print(&eval::sample(arguments)?),
        ProfileCommand::Compare(arguments) => compare::run(arguments),
        ProfileCommand::Fit(arguments) => fit::run(arguments),
        ProfileCommand::Plot(arguments) => plot::run(arguments),
        ProfileCommand::Coefficients(arguments) => coefficients::run(arguments),
    }
}
