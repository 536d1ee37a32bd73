//! The pictures that kernels are tried on. Whole numbers are the centres of pixels, and (0, 0) is a pixel of the feature.

/// What is lit, on which surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scene {
    /// A plane, white from column 0 on.
    StepEdge,
    /// A plane with one white column.
    Line,
    /// A plane with a white disc around the pixel (0, 0).
    Disc {
        /// Its radius, pixels.
        radius: f64,
    },
    /// Two planes at a right angle that meet between the columns -1 and 0, white from column 0 on.
    Crease,
}

impl Scene {
    /// All of them, as seen where a profile's mean radius spans that many pixels.
    pub(crate) fn all(mean_radius: f64) -> [Self; 4] {
        [Self::StepEdge, Self::Line, Self::Disc { radius: 1.5 * mean_radius }, Self::Crease]
    }

    /// What it is called.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::StepEdge => "step edge",
            Self::Line => "line",
            Self::Disc { .. } => "disc",
            Self::Crease => "crease",
        }
    }

    /// Irradiance of a pixel: 1 or 0.
    pub(crate) fn light(self, x: i32, y: i32) -> f64 {
        let lit = match self {
            Self::StepEdge | Self::Crease => x >= 0,
            Self::Line => x == 0,
            Self::Disc { radius } => f64::from(x * x + y * y) <= radius * radius,
        };
        f64::from(u8::from(lit))
    }

    /// Distance of a pixel from the viewer in pixels, but for a constant.
    pub(crate) fn depth(self, x: i32) -> f64 {
        match self {
            Self::Crease => (f64::from(x) + 0.5).abs(),
            _ => 0.0,
        }
    }

    /// Mean irradiance of a square of pixels, from its first one on.
    pub(crate) fn light_of_square(self, [x, y]: [i32; 2], side: i32) -> f64 {
        let columns = f64::from(side);
        match self {
            Self::StepEdge | Self::Crease => f64::from((x + side).clamp(0, side)) / columns,
            Self::Line => f64::from(u8::from((x..x + side).contains(&0))) / columns,
            Self::Disc { .. } => {
                let pixels = (0..side * side).map(|place| self.light(x + place % side, y + place / side));
                pixels.sum::<f64>() / (columns * columns)
            }
        }
    }

    /// Mean distance of the pixels of a square whose first column is `x`, as of `depth`.
    pub(crate) fn depth_of_square(self, x: i32, side: i32) -> f64 {
        (x..x + side).map(|x| self.depth(x)).sum::<f64>() / f64::from(side)
    }

    /// Whether all rows are alike.
    pub(crate) fn has_equal_rows(self) -> bool {
        !matches!(self, Self::Disc { .. })
    }

    /// Half the side of the region in which it is judged, where the mean radius spans that many pixels.
    pub(crate) fn reach(self, mean_radius: f64) -> f64 {
        let beyond = 2.0 * mean_radius + 3.0;
        match self {
            Self::Disc { radius } => radius + beyond,
            _ => beyond,
        }
    }
}
