//! Pixels of a figure.

use crate::picture::DisplayPicture;
use crate::scene::camera::Size;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};
use std::sync::Arc;

/// Pixels per unit of the SVG: sharp on a screen of today.
const PIXELS_PER_UNIT: f32 = 2.0;

/// Rasterises an SVG text, its letters from a font in the program: the system's would differ from machine to machine.
pub(super) fn rasterise(svg: &str) -> Result<DisplayPicture, String> {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|reason| reason.to_string())?;
    let side = |length: f32| (length * PIXELS_PER_UNIT).ceil() as u32;
    let size = Size { width: side(tree.size().width()), height: side(tree.size().height()) };
    let mut pixels = Pixmap::new(size.width, size.height).ok_or("it has no pixels")?;
    pixels.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(PIXELS_PER_UNIT, PIXELS_PER_UNIT), &mut pixels.as_mut());
    let pixels = pixels.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
    Ok(DisplayPicture { size, pixels })
}
