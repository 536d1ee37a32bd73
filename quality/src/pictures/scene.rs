//! The pictures that kernels are tried on. Whole numbers are the centres of pixels, and (0, 0) is a pixel of the feature.

/// Which of a material's surface albedos a surface has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Surface {
    /// The material's own.
    Own,
    /// A part of it.
    Other,
    /// The mean of the two, where a block of pixels shows both.
    Both,
}

impl Surface {
    /// Those that are not the material's own, in the order of `place`.
    pub(crate) const OTHERS: [Self; 2] = [Self::Other, Self::Both];

    /// Its place in `OTHERS`; `None` for the material's own.
    pub(crate) fn place(self) -> Option<usize> {
        Self::OTHERS.iter().position(|other| *other == self)
    }
}

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
    /// A plane, white from column 0 on, where the other surface albedo begins too.
    AlbedoEdge,
    /// A plane with one white pixel.
    Pixel,
    /// A small disc that moves over the screen, by up to three pixels along both axes.
    Pan,
    /// A step edge in a frame of `2 * half` columns, beyond which nothing is seen.
    Frame {
        /// Columns on each side of the edge.
        half: i32,
    },
    /// A ball with stripes of light.
    Ball {
        /// Its radius, pixels.
        radius: f64,
        /// Width of a stripe, pixels.
        stripe: f64,
    },
}

/// Radius of the disc that moves, pixels.
const PANNED_RADIUS: f64 = 3.5;

/// Radius of a ball in mean radii: a head in some millimetres of light.
const BALL_RADIUS: f64 = 8.0;

/// Width of a ball's stripes in mean radii.
const BALL_STRIPE: f64 = 3.0;

/// Mean radius at which a ball is tried, pixels: its exact result is a sum over all its pixels for each of them.
const OF_BALL: f64 = 3.0;

/// Mean radius from which light lacks what lies beyond a frame, pixels.
const LEAST_OF_FRAME: f64 = 10.0;

/// Mean radius up to which pictures of small features are tried, pixels: close up, what is lit is large.
const LARGEST_OF_SMALL: f64 = 10.0;

impl Scene {
    /// All of them, as seen where a profile's mean radius spans that many pixels.
    pub(crate) fn all(mean_radius: f64) -> Vec<Self> {
        let mut all = vec![Self::StepEdge];
        if mean_radius <= LARGEST_OF_SMALL {
            let disc = Self::Disc { radius: 1.5 * mean_radius };
            all.extend([Self::Line, disc, Self::Crease, Self::AlbedoEdge, Self::Pixel, Self::Pan]);
        }
        if mean_radius == OF_BALL {
            all.push(Self::Ball { radius: BALL_RADIUS * mean_radius, stripe: BALL_STRIPE * mean_radius });
        }
        if mean_radius >= LEAST_OF_FRAME {
            all.push(Self::Frame { half: mean_radius.ceil() as i32 });
        }
        all
    }

    /// What it is called.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::StepEdge => "step edge",
            Self::Line => "line",
            Self::Disc { .. } => "disc",
            Self::Crease => "crease",
            Self::AlbedoEdge => "albedo edge",
            Self::Pixel => "pixel",
            Self::Pan => "pan",
            Self::Frame { .. } => "frame",
            Self::Ball { .. } => "ball",
        }
    }

    /// Irradiance of a pixel: 1 or 0.
    pub(crate) fn light(self, x: i32, y: i32) -> f64 {
        let within = |radius: f64| f64::from(x * x + y * y) <= radius * radius;
        let lit = match self {
            Self::StepEdge | Self::Crease | Self::AlbedoEdge | Self::Frame { .. } => x >= 0,
            Self::Line => x == 0,
            Self::Disc { radius } => within(radius),
            Self::Pixel => within(0.0),
            Self::Pan => within(PANNED_RADIUS),
            Self::Ball { radius, stripe } => ((f64::from(x) + radius) / stripe).rem_euclid(2.0) < 1.0,
        };
        f64::from(u8::from(lit))
    }

    /// Whether a pixel shows a surface.
    pub(crate) fn covers(self, x: i32, y: i32) -> bool {
        match self {
            Self::Frame { half } => (-half..half).contains(&x),
            Self::Ball { radius, .. } => f64::from(x * x + y * y) <= radius * radius,
            _ => true,
        }
    }

    /// Distance of a pixel that shows a surface from the viewer in pixels, but for a constant.
    pub(crate) fn depth(self, x: i32, y: i32) -> f64 {
        match self {
            Self::Crease => (f64::from(x) + 0.5).abs(),
            Self::Ball { radius, .. } => -(radius * radius - f64::from(x * x + y * y)).max(0.0).sqrt(),
            _ => 0.0,
        }
    }

    /// Which surface the columns from `first` to `last` show.
    pub(crate) fn surface(self, first: i32, last: i32) -> Surface {
        match self {
            Self::AlbedoEdge if first >= 0 => Surface::Other,
            Self::AlbedoEdge if last >= 0 => Surface::Both,
            _ => Surface::Own,
        }
    }

    /// Whether it shows a surface everywhere, and one so even that each square of pixels is one surface.
    pub(crate) fn has_whole_squares(self) -> bool {
        !matches!(self, Self::Frame { .. } | Self::Ball { .. })
    }

    /// Mean irradiance of a square of pixels, from its first one on.
    pub(crate) fn light_of_square(self, [x, y]: [i32; 2], side: i32) -> f64 {
        let columns = f64::from(side);
        match self {
            Self::StepEdge | Self::Crease | Self::AlbedoEdge => {
                f64::from((x + side).clamp(0, side)) / columns
            }
            Self::Line => f64::from(u8::from((x..x + side).contains(&0))) / columns,
            _ => {
                let pixels = (0..side * side).map(|place| self.light(x + place % side, y + place / side));
                pixels.sum::<f64>() / (columns * columns)
            }
        }
    }

    /// Mean distance of the pixels of a square that begins at (x, y) and has whole ones only, as of `depth`.
    pub(crate) fn depth_of_square(self, [x, y]: [i32; 2], side: i32) -> f64 {
        match self {
            Self::Crease => (x..x + side).map(|x| self.depth(x, y)).sum::<f64>() / f64::from(side),
            _ => 0.0,
        }
    }

    /// Whether all rows are alike.
    pub(crate) fn has_equal_rows(self) -> bool {
        matches!(self, Self::StepEdge | Self::Line | Self::Crease | Self::AlbedoEdge | Self::Frame { .. })
    }

    /// Radius of the disc that is lit, if it is one.
    pub(crate) fn lit_disc(self) -> Option<f64> {
        match self {
            Self::Disc { radius } => Some(radius),
            Self::Pixel => Some(0.0),
            Self::Pan => Some(PANNED_RADIUS),
            _ => None,
        }
    }

    /// Half the side of the region in which it is judged, where the mean radius spans that many pixels.
    pub(crate) fn reach(self, mean_radius: f64) -> f64 {
        let beyond = 2.0 * mean_radius + 3.0;
        match self {
            Self::Frame { half } => f64::from(half),
            Self::Ball { radius, .. } => radius,
            _ => self.lit_disc().unwrap_or_default() + beyond,
        }
    }
}
