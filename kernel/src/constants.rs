//! Numbers that stand in Rust and in WGSL.
//!
//! Each is written once, here. [`ALL`] lists them with name, value and comment: the compiler declares those that a
//! module uses, so no `.wgsl` file spells one.

/// A number that the compiler declares in WGSL.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Constant {
    /// Name in Rust and in WGSL.
    pub name: &'static str,
    /// Value, with its WGSL type.
    pub value: ConstantValue,
    /// Lines of its comment.
    pub docs: &'static [&'static str],
}

/// A value with its WGSL type. Rust computes in `f64`; WGSL gets the nearest `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ConstantValue {
    /// `f32`.
    F32(f64),
    /// `i32`.
    I32(i32),
    /// `u32`.
    U32(u32),
    /// `vec2f`.
    Vec2([f64; 2]),
    /// `vec3f`.
    Vec3([f64; 3]),
}

macro_rules! constants {
    ($($(#[doc = $docs:literal])+ $name:ident: $variant:ident($ty:ty) = $value:expr;)+) => {
        $($(#[doc = $docs])+ pub const $name: $ty = $value;)+

        /// Every number of this module that a shader may use.
        pub const ALL: &[Constant] = &[$(Constant {
            name: stringify!($name),
            value: ConstantValue::$variant($name),
            docs: &[$($docs),+],
        }),+];
    };
}

constants! {
    /// Smallest roughness of a specular lobe: narrower ones fall between pixels.
    LEAST_ROUGHNESS: F32(f64) = 0.02;

    /// Smallest cosine between a normal and the viewer: interpolated normals may face away by a hair.
    LEAST_VIEW_COSINE: F32(f64) = 1e-3;

    /// `coupling` of a surface whose diffuse light does not know of its specular lobe.
    COUPLING_NONE: U32(u32) = 0;

    /// `coupling` of a surface that lets in what a mirror of its reflectance does not send back.
    COUPLING_ENTRY: U32(u32) = 1;

    /// `coupling` of a surface that lets in, and out again, what its lobe does not send back.
    COUPLING_FULL: U32(u32) = 2;

    /// `diffuse` of a surface that takes light and gives it as Lambert's does.
    DIFFUSE_LAMBERT: U32(u32) = 0;

    /// `diffuse` of a half-space whose profile is for perpendicular entry.
    DIFFUSE_SEARCHLIGHT: U32(u32) = 1;

    /// `diffuse` of a half-space whose profile is for diffuse entry.
    DIFFUSE_EVERYWHERE: U32(u32) = 2;

    /// `diffuse` of a lobe of Shirley's; those from here on do not depend on how a profile's light entered.
    DIFFUSE_SHIRLEY: U32(u32) = 3;

    /// `diffuse` of a lobe of Lommel's and Seeliger's.
    DIFFUSE_LOMMEL_SEELIGER: U32(u32) = 4;

    /// `diffuse` of a lobe of Hapke's.
    DIFFUSE_HAPKE: U32(u32) = 5;

    /// `diffuse` of a lobe of Oren's and Nayar's.
    DIFFUSE_OREN_NAYAR: U32(u32) = 6;

    /// `diffuse` of a lobe of Burley's, as Disney has it.
    DIFFUSE_DISNEY: U32(u32) = 7;

    /// `diffuse` of a layer below a boundary that scatters light once.
    DIFFUSE_HANRAHAN_KRUEGER: U32(u32) = 8;

    /// Share of the light that counts as all of it where the reach of a profile is asked for.
    FILTER_QUANTILE: F32(f64) = 0.997;

    /// Bound of every loop over taps.
    LARGEST_TAP_COUNT: U32(u32) = 4096;

    /// Largest filter radius that counts taps, pixels.
    LARGEST_FILTER_RADIUS: F32(f64) = 4096.0;

    /// Taps farther than this many pixels count as this far: outside of any target, and exact as i32.
    LARGEST_TAP_DISTANCE: F32(f64) = 32768.0;

    /// cos and sin of the golden angle π(3 − √5): a step from tap to tap without a transcendental.
    GOLDEN_TURN: Vec2([f64; 2]) = [-0.737_368_878_078_319_8, 0.675_490_294_261_524_1];

    /// Interleaved gradient noise: weights of the column and the row, and the factor on their fraction.
    GRADIENT_NOISE: Vec3([f64; 3]) = [0.067_110_56, 0.005_837_15, 52.982_918_9];

    /// Smallest √(1 − u): u = 1 − 2^-24, the f32 before 1.
    SMALLEST_ROOT: F32(f64) = 2.441_406_25e-4;

    /// Texels of a row of the profile curves: steps of a curve.
    CURVE_STEPS: U32(u32) = 64;

    /// Rows of a column of curves: what the smallest texture limit of WebGPU holds.
    CURVE_ROWS: U32(u32) = 8192;

    /// Side of a block, pixels: the pixels of a block share one far field.
    BLOCK_SIDE: I32(i32) = 2;

    /// Depth difference, in pixels, up to which pixels of one material belong to one block, and to one far field
    /// where the filter is small.
    BLOCK_DEPTH_PIXELS: F32(f64) = 6.0;

    /// Depth, in its side, over which a square is one surface.
    STEEPEST_SQUARE: F32(f64) = 2.0;

    /// Radii are drawn from the widest profile made wider by this factor: the other channels' tails and depth
    /// differences need more of the far taps than the profile itself has.
    FAR_STRETCH: F32(f64) = 1.2;

    /// Taps of a block that the sum over the blocks around stands for, at most: that costs about as much.
    RING_TAPS: U32(u32) = 2;

    /// Square of a filter radius, pixels, by taps of the lattice, from which taps read squares of 4×4 pixels: there
    /// they lie about nine pixels apart.
    SPARSE_TAP_AREA: F32(f64) = 24.0;

    /// cos and sin of the step from tap to tap of a slice: the larger part of a quarter turn in the golden section,
    /// and a quarter turn. Slices repeat each direction after every quarter turn, so it is a quarter turn that is to
    /// be filled evenly.
    LATTICE_TURN: Vec2([f64; 2]) = [-0.825_340_805_389_046_5, 0.564_634_886_417_550_4];

    /// Direction of a slice's first tap, turns: here the taps of all slices cross an edge along rows or columns most
    /// evenly, of twenty directions that were tried (step edges at mean radii of 4 to 26 pixels, 2 to 16 taps).
    LATTICE_START: F32(f64) = 0.1625;

    /// Share of the stretched profile that is sampled; what lies beyond is renormalized.
    FAR_QUANTILE: F32(f64) = 0.98;

    /// Slices of the common lattice: one for each block of any 2×2 blocks.
    LATTICE_SLICES: U32(u32) = 4;

    /// Shares of a window in the blocks along an axis: in the block on the pixel's farther side, in its own, and on
    /// its nearer side. The pixel lies a quarter of a block off the middle of its own.
    ///
    /// This window is as wide as two blocks: wherever the pixel lies, every slice has a quarter of it.
    EVEN_WINDOW: Vec3([f64; 3]) = [0.125, 0.5, 0.375];

    /// Linear between the middles of the blocks: less blur, but the slices count unevenly.
    LINEAR_WINDOW: Vec3([f64; 3]) = [0.0, 0.75, 0.25];

    /// Taps per pixel up to which the window is the even one. With more of them a slice alone has less noise.
    EVEN_WINDOW_TAPS: F32(f64) = 4.0;

    /// Radius of the disc with the area of a pixel, pixels: 1 / √π, to the digits of an f32.
    NEAR_RADIUS_PIXELS: F32(f64) = 0.564_189_58;

    /// Radius of the disc with the area of nine pixels, pixels: 3 / √π.
    RING_RADIUS_PIXELS: F32(f64) = 3.0 * NEAR_RADIUS_PIXELS;

    /// Pixels of the four blocks beside a block, less the disc of nine pixels.
    PIXELS_BESIDE: F32(f64) = 11.0;

    /// Pixels of the four blocks across its corners.
    PIXELS_ACROSS: F32(f64) = 16.0;

    /// Middle of the shell around the disc of nine pixels that has the area of PIXELS_BESIDE, pixels: half way from
    /// 3/√π to √(20/π).
    BESIDE_RADIUS_PIXELS: F32(f64) = 2.107_850_64;

    /// Middle of the shell from there that has the area of PIXELS_ACROSS, pixels: half way from √(20/π) to 6/√π.
    ACROSS_RADIUS_PIXELS: F32(f64) = 2.954_135_01;

    /// Radius of the disc with the area of 36 pixels, pixels: those of a block and of the eight around it.
    FAR_RADIUS_PIXELS: F32(f64) = 6.0 * NEAR_RADIUS_PIXELS;

    /// ½ log₃ 2
    HALF_LOG_3_OF_2: F32(f64) = 0.315_464_876_785_728_7;

    /// Places of the two lines that stand for a strip, in its width: 1/2 ± 1/√12, so that they have the mean square
    /// distance of light that lands evenly.
    EVEN_LINES: Vec2([f64; 2]) = [0.211_324_87, 0.788_675_13];

    /// The same in a strip without end, whose middle halves its light: of six pairs of places that were tried with the
    /// presets' edge spreads, that with the least error at a step edge; it has about the mean square distance of all light.
    OPEN_LINES: Vec2([f64; 2]) = [0.25, 1.0];

    /// Least energy that stands for all of it. Where taps found less than this share, the centre's own light fills it
    /// up: what little comes from a surface far behind must not be raised to a whole.
    SMALLEST_ENERGY: F32(f64) = 1e-3;

    /// Largest share of the ring of pixels: what a form with an exponent below that of 1 holds.
    LARGEST_RING: F32(f64) = 0.998;

    /// A weight below this divides nothing.
    SMALLEST_WEIGHT: F32(f64) = 1e-12;

    /// Largest weight of a tap: radii are drawn from one profile, and where another has far more light there, one tap
    /// must not outshine all others.
    LARGEST_WEIGHT: F32(f64) = 1e4;

    /// Materials that fit a set: targets keep the number as a half float, exact up to here.
    MOST_MATERIALS: U32(u32) = 2048;

    /// `layer` of a light without a shadow map.
    NO_SHADOW_MAP: U32(u32) = 0xffff;
}

/// Pixels of a block.
pub const PIXELS_OF_BLOCK: u32 = (BLOCK_SIDE * BLOCK_SIDE) as u32;

/// Knots of an edge curve lie at this power of even steps: the edge spread is steepest at the edge. The shaders take
/// the root by two square roots.
pub const EDGE_POWER: i32 = 4;

/// Bytes of a texel of the profile curves: four f32.
pub const CURVE_TEXEL_BYTES: usize = 16;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_have_the_areas_that_they_stand_for() {
        let area = |radius: f64| std::f64::consts::PI * radius * radius;
        // Eight digits, whose error counts twice.
        assert!((area(NEAR_RADIUS_PIXELS) - 1.0).abs() < 2e-8);
        assert!((area(RING_RADIUS_PIXELS) - 9.0).abs() < 9.0 * 2e-8);
        assert!((area(FAR_RADIUS_PIXELS) - 36.0).abs() < 36.0 * 2e-8);
        let radius = |area: f64| (area / std::f64::consts::PI).sqrt();
        let [inner, middle, outer] =
            [9.0, 9.0 + PIXELS_BESIDE, 9.0 + PIXELS_BESIDE + PIXELS_ACROSS].map(radius);
        assert!((outer - FAR_RADIUS_PIXELS).abs() < 1e-6);
        assert!((BESIDE_RADIUS_PIXELS - 0.5 * (inner + middle)).abs() < 1e-6);
        assert!((ACROSS_RADIUS_PIXELS - 0.5 * (middle + outer)).abs() < 1e-6);
        assert!((HALF_LOG_3_OF_2 - 0.5 * 2f64.ln() / 3f64.ln()).abs() < 1e-15);
    }

    #[test]
    fn windows_are_whole() {
        for window in [EVEN_WINDOW, LINEAR_WINDOW] {
            assert_eq!(window.iter().sum::<f64>(), 1.0);
        }
    }

    #[test]
    fn names_are_told_apart() {
        for (index, constant) in ALL.iter().enumerate() {
            assert!(ALL[..index].iter().all(|other| other.name != constant.name), "{}", constant.name);
        }
    }
}
