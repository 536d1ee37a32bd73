//! Writer of MCML's output files (`.mco`).
//!
//! Sections, their order, titles and number formats are those of MCML's `A1` files, so that programs made for them read
//! these. What MCML does not know, standard errors above all, stands in comment lines after the section it belongs to.

use std::fmt::Write as _;

use crate::Estimate;

use super::number::{exponential, general};
use super::result::LayerResult;

impl LayerResult {
    /// The result as MCML writes it, in its sections `InParm`, `RAT`, `A_l`, `A_z`, `Rd_r`, `Rd_a`, `Tt_r` and `Tt_a`.
    ///
    /// The number of photons is that of the packets traced. Standard errors follow as comments.
    pub fn to_mco(&self) -> String {
        let mut text = Mco(String::new());
        text.header(self);
        text.input(self);
        text.totals(self);
        text.layers(self);
        text.column("A_z #A[0], [1],..A[nz-1]. [1/cm]", &self.absorbed_by_depth);
        text.section("Rd_r", "Rd_r #Rd[0], [1],..Rd[nr-1]. [1/cm2]", &self.reflectance_by_radius);
        text.section("Rd_a", "Rd_a #Rd[0], [1],..Rd[na-1]. [sr-1]", &self.reflectance_by_angle);
        text.section("Tt_r", "Tt_r #Tt[0], [1],..Tt[nr-1]. [1/cm2]", &self.transmittance_by_radius);
        text.section("Tt_a", "Tt_a #Tt[0], [1],..Tt[na-1]. [sr-1]", &self.transmittance_by_angle);
        text.0
    }
}

struct Mco(String);

impl Mco {
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing into a string cannot fail.
        let _ = self.0.write_fmt(line);
        self.0.push('\n');
    }

    fn header(&mut self, result: &LayerResult) {
        self.line(format_args!("A1 \t# Version number of the file format.\n"));
        self.line(format_args!("####\n# Data categories include: "));
        self.line(format_args!("# InParm, RAT, \n# A_l, A_z, Rd_r, Rd_a, Tt_r, Tt_a \n####\n"));
        self.line(format_args!("# Written by subsurface-reference {}.", env!("CARGO_PKG_VERSION")));
        self.line(format_args!(
            "# Seed {}, {} of {} photons.\n",
            result.seed,
            result.photons,
            result.run.photons()
        ));
    }

    fn input(&mut self, result: &LayerResult) {
        let (run, grid, stack) = (&result.run, result.run.grid(), result.run.stack());
        self.line(format_args!("InParm \t\t\t# Input parameters. cm is used."));
        self.line(format_args!("{} \tA\t\t# output file name, ASCII.", run.output_name()));
        self.line(format_args!("{} \t\t\t# No. of photons", result.photons));
        let (dz, dr) = (general(grid.depth_step(), 6), general(grid.radius_step(), 6));
        self.line(format_args!("{dz}\t{dr}\t\t# dz, dr [cm]"));
        let (nz, nr, na) = (grid.depth_cells(), grid.radius_cells(), grid.angle_cells());
        self.line(format_args!("{nz}\t{nr}\t{na}\t# No. of dz, dr, da.\n"));
        self.line(format_args!("{}\t\t\t\t\t# Number of layers", stack.layers().len()));
        self.line(format_args!("#n\tmua\tmus\tg\td\t# One line for each layer"));
        self.line(format_args!(
            "{}\t\t\t\t\t# n for medium above",
            general(stack.refractive_index_above(), 6)
        ));
        for (index, layer) in stack.layers().iter().enumerate() {
            let numbers = [
                layer.refractive_index(),
                layer.absorption_coefficient(),
                layer.scattering_coefficient(),
                layer.anisotropy(),
                layer.thickness(),
            ];
            let fields = numbers.map(|number| general(number, 6)).join("\t");
            self.line(format_args!("{fields}\t# layer {}", index + 1));
        }
        self.line(format_args!(
            "{}\t\t\t\t\t# n for medium below\n",
            general(stack.refractive_index_below(), 6)
        ));
    }

    fn totals(&mut self, result: &LayerResult) {
        self.line(format_args!("RAT #Reflectance, absorption, transmission. "));
        let rows = [
            (result.specular_reflectance, "Specular reflectance"),
            (result.diffuse_reflectance.mean, "Diffuse reflectance"),
            (result.absorbed.mean, "Absorbed fraction"),
            (result.transmittance.mean, "Transmittance"),
        ];
        for (value, name) in rows {
            self.line(format_args!("{:<14} \t#{name} [-]", general(value, 6)));
        }
        self.line(format_args!("\n# Standard errors of the last three rows of RAT:"));
        for estimate in [result.diffuse_reflectance, result.absorbed, result.transmittance] {
            self.line(format_args!("# {}", exponential(estimate.standard_error, 4)));
        }
        self.line(format_args!(
            "# What roulette took from the sum of RAT (0 on average): {}\n",
            exponential(result.roulette, 4)
        ));
    }

    fn layers(&mut self, result: &LayerResult) {
        self.line(format_args!("A_l #Absorption as a function of layer. [-]"));
        for layer in &result.absorbed_by_layer {
            self.line(format_args!("{:>12}", general(layer.mean, 4)));
        }
        self.0.push('\n');
        self.standard_errors("A_l", &result.absorbed_by_layer);
    }

    fn column(&mut self, title: &str, values: &[f64]) {
        self.line(format_args!("{title}"));
        for value in values {
            self.line(format_args!("{:>12}", exponential(*value, 4)));
        }
        self.0.push('\n');
    }

    fn section(&mut self, name: &str, title: &str, estimates: &[Estimate]) {
        let means: Vec<_> = estimates.iter().map(|estimate| estimate.mean).collect();
        self.column(title, &means);
        self.standard_errors(name, estimates);
    }

    fn standard_errors(&mut self, name: &str, estimates: &[Estimate]) {
        self.line(format_args!("# Standard errors of {name}:"));
        for estimate in estimates {
            self.line(format_args!("# {:>10}", exponential(estimate.standard_error, 4)));
        }
        self.0.push('\n');
    }
}
