//! The squares of pixels that are looked at.

use crate::pictures::scene::Scene;

/// Side of a patch: the period of blocks of two pixels and of lattices of two blocks.
pub(crate) const PATCH_SIDE: i32 = 4;

/// Squares in a row up to which each is looked at in every phase of the feature; more of them are phases enough.
const FEW_SQUARES: i32 = 6;

/// Most squares around a disc.
const MOST_AROUND_DISC: i32 = 16;

/// A square of the screen, and where the scene is on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Patch {
    /// First pixel on the screen, along both axes. Not negative, nor are the blocks around it.
    pub(crate) start: [i32; 2],
    /// The pixel on the screen that is (0, 0) of the scene.
    origin: [i32; 2],
}

impl Patch {
    /// The patches of a scene: squares side by side that cover `reach` pixels from its middle on.
    ///
    /// Where rows are alike one row of squares does. Of the squares around a disc some are taken where there are too many.
    pub(crate) fn all(scene: Scene, reach: f64) -> Vec<Self> {
        let squares = (2.0 * reach / f64::from(PATCH_SIDE)).ceil() as i32;
        let place = |square: i32| PATCH_SIDE * square - PATCH_SIDE * squares / 2;
        let mut patches = Vec::new();
        if scene.has_equal_rows() {
            let phases = if squares <= FEW_SQUARES { PATCH_SIDE } else { 1 };
            for (square, phase) in
                (0..squares).flat_map(|square| (0..phases).map(move |phase| (square, phase)))
            {
                patches.push(Self::new(square + phase, [place(square), 0]));
            }
        } else {
            let count = (squares * squares).min(MOST_AROUND_DISC);
            for number in 0..count {
                let square = if count == squares * squares {
                    [number % squares, number / squares]
                } else {
                    // Columns in turn, rows by the golden ratio: no two of them side by side.
                    let row = (f64::from(number) * 0.618_033_988_749_895 + 0.5).fract();
                    [(2 * number + 1) * squares / (2 * count), (row * f64::from(squares)) as i32]
                };
                patches.push(Self::new(number, square.map(place)));
            }
        }
        patches
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
