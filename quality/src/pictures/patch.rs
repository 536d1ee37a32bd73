//! The squares of pixels that are looked at.

use crate::pictures::scene::Scene;

/// Side of a patch: the period of blocks of two pixels and of lattices of two blocks.
pub(crate) const PATCH_SIDE: i32 = 4;

/// Squares in a row up to which each is looked at in every phase of the feature; more of them are phases enough.
const FEW_SQUARES: i32 = 6;

/// Most squares in a row.
const MOST_IN_ROW: i32 = 24;

/// Most squares around a disc.
const MOST_AROUND_DISC: i32 = 16;

/// Squares around a disc that moves.
const PANNED: i32 = 8;

/// Steps of a disc that moves, the first of which is none: each phase of a lattice.
const PAN_STEPS: i32 = PATCH_SIDE;

/// Most squares on a ball.
const MOST_ON_BALL: i32 = 64;

/// 1/φ: numbers times this fill a circle or a row evenly, no two of them side by side.
const GOLDEN_FRACTION: f64 = 0.618_033_988_749_895;

/// A square of the screen, and where the scene is on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Patch {
    /// First pixel on the screen, along both axes. Not negative, nor are the blocks around it.
    pub(crate) start: [i32; 2],
    /// The pixel on the screen that is (0, 0) of the scene.
    origin: [i32; 2],
}

impl Patch {
    /// The patches of a scene, up to `reach` pixels from its middle.
    ///
    /// Where rows are alike one row of squares does; where there are too many squares some are taken.
    pub(crate) fn all(scene: Scene, reach: f64) -> Vec<Self> {
        match scene {
            Scene::Ball { .. } => Self::around(reach, MOST_ON_BALL),
            Scene::Pan => Self::panned(reach),
            _ if scene.has_equal_rows() => Self::in_row(reach),
            _ => Self::around(reach, MOST_AROUND_DISC),
        }
    }

    fn in_row(reach: f64) -> Vec<Self> {
        let squares = squares_across(reach);
        let count = squares.min(MOST_IN_ROW);
        let phases = if squares <= FEW_SQUARES { PATCH_SIDE } else { 1 };
        // Evenly, but for the two in the middle, between which the feature lies.
        let beside_middle = |number: i32| match number - count / 2 {
            from_middle @ (-1 | 0) => squares / 2 + from_middle,
            _ => (2 * number + 1) * squares / (2 * count),
        };
        let places = (0..count).map(|number| (beside_middle(number), number));
        places
            .flat_map(|(square, number)| (0..phases).map(move |phase| (square, number + phase)))
            .map(|(square, phase)| Self::new(phase, [first_of(square, squares), 0]))
            .collect()
    }

    fn around(reach: f64, most: i32) -> Vec<Self> {
        let squares = squares_across(reach);
        let count = (squares * squares).min(most);
        let of_number = |number: i32| {
            let square = if count == squares * squares {
                [number % squares, number / squares]
            } else if number == 0 {
                // The feature itself may be small.
                [squares / 2; 2]
            } else {
                // Columns in turn, rows by the golden ratio.
                let row = (f64::from(number) * GOLDEN_FRACTION + 0.5).fract();
                [(2 * number + 1) * squares / (2 * count), (row * f64::from(squares)) as i32]
            };
            Self::new(number, square.map(|square| first_of(square, squares)))
        };
        (0..count).map(of_number).collect()
    }

    /// Squares of the scene, each at every step of its way over the screen.
    fn panned(reach: f64) -> Vec<Self> {
        let moved = |patch: Self, step: i32| Self {
            start: patch.start.map(|x| x + step),
            origin: patch.origin.map(|x| x + step),
        };
        let squares = Self::around(reach, PANNED).into_iter();
        squares.flat_map(|patch| (0..PAN_STEPS).map(move |step| moved(patch, step))).collect()
    }

    /// Place of a pixel of `panned` before it has moved, in the list of all; `None` where it has not.
    pub(crate) fn before_pan(place: usize) -> Option<usize> {
        let pixels = (PATCH_SIDE * PATCH_SIDE) as usize;
        let steps = PAN_STEPS as usize;
        (!(place / pixels).is_multiple_of(steps))
            .then(|| place / (pixels * steps) * (pixels * steps) + place % pixels)
    }

    /// The square whose first pixel is at `first` of the scene, moved on by a number of phases.
    fn new(phase: i32, first: [i32; 2]) -> Self {
        // More than a period further on each time, as no pixel's noise is that of another.
        let start = [16 + 7 * phase, 16 + 5 * phase];
        Self { start, origin: [start[0] - first[0], start[1] - first[1]] }
    }

    /// Its pixels on the screen, row by row.
    pub(crate) fn pixels(self) -> impl Iterator<Item = [i32; 2]> {
        let [x, y] = self.start;
        (0..PATCH_SIDE * PATCH_SIDE).map(move |place| [x + place % PATCH_SIDE, y + place / PATCH_SIDE])
    }

    /// First pixel in the scene of the square of the screen that is `side` pixels wide and holds a pixel of the scene.
    pub(crate) fn square_around(self, [x, y]: [i32; 2], side: i32) -> [i32; 2] {
        let first = [x + self.origin[0], y + self.origin[1]].map(|place| place.div_euclid(side) * side);
        self.in_scene(first)
    }

    /// Where a pixel of the screen is in the scene.
    pub(crate) fn in_scene(self, [x, y]: [i32; 2]) -> [i32; 2] {
        [x - self.origin[0], y - self.origin[1]]
    }
}

/// Squares side by side that cover `reach` pixels on both sides of the middle.
fn squares_across(reach: f64) -> i32 {
    (2.0 * reach / f64::from(PATCH_SIDE)).ceil() as i32
}

/// First pixel in the scene of square `square` of `squares`.
fn first_of(square: i32, squares: i32) -> i32 {
    PATCH_SIDE * square - PATCH_SIDE * squares / 2
}
