//! Levels of textures for surfaces far away: each is the mean of the one before.

use std::sync::OnceLock;

use crate::extent::Extent;

/// How a texture's bytes stand for light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// Red, green and blue as sRGB code values, whose mean is taken of the light that they stand for; alpha as it is.
    Srgb,
    /// All four as they are.
    Linear,
}

/// Levels of a texture down to one pixel.
pub(crate) fn level_count(size: Extent) -> u32 {
    size.width.max(size.height).max(1).ilog2() + 1
}

/// All levels of a texture with four bytes per pixel, the first as it is, one behind the other.
pub(crate) fn levels(size: Extent, texels: &[u8], encoding: Encoding) -> Vec<u8> {
    let mut all = texels.to_vec();
    let (mut from, mut size) = (0, size);
    for _ in 1..level_count(size) {
        let next = Extent::new((size.width / 2).max(1), (size.height / 2).max(1));
        let level = halved(size, next, &all[from..], encoding);
        from = all.len();
        all.extend(level);
        size = next;
    }
    all
}

/// The level of size `to` below one of size `from`: every pixel is the mean over its area, also where sides are odd.
///
/// In whole numbers, so that every machine has the same.
fn halved(from: Extent, to: Extent, texels: &[u8], encoding: Encoding) -> Vec<u8> {
    let light = light();
    let (columns, rows) = (overlaps(from.width, to.width), overlaps(from.height, to.height));
    let area = u64::from(from.width) * u64::from(from.height);
    let mut level = Vec::with_capacity(4 * (to.width * to.height) as usize);
    for row in &rows {
        for column in &columns {
            let mut sums = [0_u64; 4];
            for (y, tall) in row {
                for (x, wide) in column {
                    let at = 4 * (*y as usize * from.width as usize + *x as usize);
                    let share = u64::from(tall * wide);
                    for (channel, sum) in sums.iter_mut().enumerate() {
                        let byte = texels[at + channel];
                        let is_code = encoding == Encoding::Srgb && channel < 3;
                        let value = if is_code { light.of_code[usize::from(byte)] } else { u16::from(byte) };
                        *sum += share * u64::from(value);
                    }
                }
            }
            level.extend(sums.iter().enumerate().map(|(channel, sum)| {
                let mean = ((sum + area / 2) / area) as usize;
                let is_code = encoding == Encoding::Srgb && channel < 3;
                if is_code { light.code_of[mean] } else { mean as u8 }
            }));
        }
    }
    level
}

/// For each of `to` pixels the pixels of `from` that it covers, with how much of each, in 1/`to` of a pixel.
fn overlaps(from: u32, to: u32) -> Vec<Vec<(u32, u32)>> {
    let of_pixel = |pixel: u32| {
        let (start, end) = (pixel * from, (pixel + 1) * from);
        (start / to..end.div_ceil(to)).map(|at| (at, end.min((at + 1) * to) - start.max(at * to))).collect()
    };
    (0..to).map(of_pixel).collect()
}

/// sRGB code values and 16 bits of the light that they stand for.
struct Light {
    of_code: [u16; 256],
    /// The code nearest to each.
    code_of: Vec<u8>,
}

fn light() -> &'static Light {
    static LIGHT: OnceLock<Light> = OnceLock::new();
    LIGHT.get_or_init(|| {
        let linear = |code: f64| {
            let value = code / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        let sixteen_bits = |code: f64| (65535.0 * linear(code)).round() as u16;
        let of_code = std::array::from_fn(|code| sixteen_bits(code as f64));
        let mut code = 0_u8;
        let code_of = (0..=u16::MAX).map(|light| {
            while code < 255 && light > sixteen_bits(f64::from(code) + 0.5) {
                code += 1;
            }
            code
        });
        Light { of_code, code_of: code_of.collect() }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_stays_one_on_every_level() {
        let texel = [37, 128, 255, 9];
        for (width, height) in [(1, 1), (2, 2), (7, 5), (64, 3), (1, 33)] {
            let size = Extent::new(width, height);
            let texels = texel.repeat((width * height) as usize);
            for encoding in [Encoding::Srgb, Encoding::Linear] {
                let all = levels(size, &texels, encoding);
                assert!(all.chunks(4).all(|found| found == texel), "{width}×{height}");
            }
        }
    }

    #[test]
    fn levels_end_at_one_pixel() {
        for (width, height, count, texels) in
            [(1, 1, 1, 1), (4, 4, 3, 21), (5, 3, 3, 15 + 2 + 1), (1, 8, 4, 15)]
        {
            let size = Extent::new(width, height);
            assert_eq!(level_count(size), count);
            let all = levels(size, &vec![0; (4 * width * height) as usize], Encoding::Linear);
            assert_eq!(all.len(), 4 * texels, "{width}×{height}");
        }
    }

    #[test]
    fn means_are_of_light_and_not_of_codes() {
        let texels = [[0, 0, 0, 0], [255, 255, 255, 255]].concat();
        let all = levels(Extent::new(2, 1), &texels, Encoding::Srgb);
        // Half of the light is the code 188; alpha is no light.
        assert_eq!(all[8..], [188, 188, 188, 128]);
        assert_eq!(levels(Extent::new(2, 1), &texels, Encoding::Linear)[8..], [128; 4]);
    }

    #[test]
    fn odd_sides_lose_no_column() {
        // Each of three columns counts alike.
        for bright in 0..3 {
            let texels: Vec<u8> = (0..3).flat_map(|x| [if x == bright { 240 } else { 0 }; 4]).collect();
            assert_eq!(levels(Extent::new(3, 1), &texels, Encoding::Linear)[12..], [80; 4]);
        }
    }

    #[test]
    fn every_code_stands_for_its_own_light() {
        let light = light();
        assert!(
            (0..=255_u8).all(|code| light.code_of[usize::from(light.of_code[usize::from(code)])] == code)
        );
    }
}
