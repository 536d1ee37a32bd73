//! Several pictures on one sheet, each with a caption.

use super::{DisplayPicture, label};
use crate::scene::camera::Size;

/// One picture of a sheet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tile {
    /// The picture; all of a sheet have one size.
    pub picture: DisplayPicture,
    /// What it shows, one line.
    pub caption: String,
}

const BACKGROUND: [u8; 3] = [24, 24, 27];
const TITLE: [u8; 3] = [244, 244, 245];
const CAPTION: [u8; 3] = [212, 212, 216];

/// Space between tiles and around them (pixels).
const MARGIN: u32 = 16;

/// Lays the tiles out under a title, `columns` in a row. `None` without tiles.
pub fn compose(title: &str, tiles: &[Tile], columns: u32) -> Option<DisplayPicture> {
    let size = tiles.first()?.picture.size;
    let columns = columns.clamp(1, tiles.len() as u32);
    let rows = (tiles.len() as u32).div_ceil(columns);
    // Captions are enlarged on large tiles, as long as the longest fits.
    let longest = tiles.iter().map(|tile| label::width(&tile.caption)).max().unwrap_or(1).max(1);
    let scale = (size.width / longest).clamp(1, (size.width / 400).max(1));
    let (caption_height, title_height) = (label::LINE_HEIGHT * scale + MARGIN / 2, label::LINE_HEIGHT * 2);
    let sheet = Size {
        width: MARGIN + columns * (size.width + MARGIN),
        height: MARGIN + title_height + MARGIN + rows * (size.height + caption_height + MARGIN),
    };
    let mut picture = DisplayPicture::filled(sheet, BACKGROUND);
    let title_scale = if 2 * label::width(title) + 2 * MARGIN <= sheet.width { 2 } else { 1 };
    label::draw(&mut picture, title, MARGIN, MARGIN, title_scale, TITLE);
    for (index, tile) in (0..).zip(tiles) {
        let left = MARGIN + index % columns * (size.width + MARGIN);
        let top = 2 * MARGIN + title_height + index / columns * (size.height + caption_height + MARGIN);
        picture.paste(&tile.picture, left, top);
        label::draw(&mut picture, &tile.caption, left, top + size.height + MARGIN / 2, scale, CAPTION);
    }
    Some(picture)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn every_tile_is_on_the_sheet_once_and_whole() {
        let size = Size { width: 40, height: 30 };
        let tiles: Vec<Tile> = (1..=5u8)
            .map(|k| Tile { picture: DisplayPicture::filled(size, [k, 0, 0]), caption: format!("tile {k}") })
            .collect();
        let sheet = compose("title", &tiles, 3).unwrap();
        for k in 1..=5u8 {
            assert_eq!(sheet.pixels.iter().filter(|pixel| **pixel == [k, 0, 0]).count(), size.pixels());
        }
        assert_eq!(compose("title", &[], 3), None);
    }
}
