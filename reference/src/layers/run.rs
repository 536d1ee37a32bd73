//! One run of an input file.

use super::grid::Grid;
use super::layer::LayerStack;
use super::layer_error::LayerError;

/// MCML's letter for the format of the output. MCML writes text for both, and so does [`LayerResult::to_mco`](super::LayerResult::to_mco).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputFormat {
    /// `A`: text.
    Ascii,
    /// `B`: reserved by MCML for a binary format that never came.
    Binary,
}

/// One run of MCML's input: a stack, a grid, a number of photons, and where the result shall go.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerRun {
    output_name: String,
    output_format: OutputFormat,
    photons: u64,
    grid: Grid,
    stack: LayerStack,
}

impl LayerRun {
    /// A run of `photons` packets.
    ///
    /// # Errors
    ///
    /// [`LayerError::NoPhotons`] for none; [`LayerError::OutputName`] for a name that MCML's files cannot hold.
    pub fn new(
        output_name: impl Into<String>,
        output_format: OutputFormat,
        photons: u64,
        grid: Grid,
        stack: LayerStack,
    ) -> Result<Self, LayerError> {
        if photons == 0 {
            return Err(LayerError::NoPhotons);
        }
        let output_name = output_name.into();
        let breaks_a_line = |c: char| c.is_whitespace() || c.is_control() || c == '#';
        if output_name.is_empty() || output_name.contains(breaks_a_line) {
            return Err(LayerError::OutputName { name: output_name });
        }
        Ok(Self { output_name, output_format, photons, grid, stack })
    }

    /// Output file as the input names it. Nothing here opens it; a caller decides whether to trust the path.
    pub fn output_name(&self) -> &str {
        &self.output_name
    }

    /// Letter of the output's format.
    pub fn output_format(&self) -> OutputFormat {
        self.output_format
    }

    /// Packets to trace.
    pub fn photons(&self) -> u64 {
        self.photons
    }

    /// Cells of the result.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The layers.
    pub fn stack(&self) -> &LayerStack {
        &self.stack
    }
}
