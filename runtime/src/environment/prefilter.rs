//! Reflections in rough surfaces: the image, blurred as a lobe would.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::Image;

/// Width and height of the sharpest level.
pub(super) const SIZE: [u32; 2] = [256, 128];

/// Levels: roughness 0, 0.2, … 1. The coarsest has 8×4 texels.
pub(super) const LEVELS: u32 = 6;

/// Directions over which a texel is averaged.
const SAMPLES: u32 = 128;

/// The levels, from a mirror's to that of a roughness of 1: means over GGX lobes whose viewer looks along the normal
/// (Karis 2013, "Real Shading in Unreal Engine 4").
pub(super) fn prefiltered(image: Image<'_>) -> Vec<Vec<[f32; 3]>> {
    let pyramid = Pyramid::of(image);
    let level = |level: u32| {
        let [width, height] = SIZE.map(|edge| edge >> level);
        let roughness = level as f32 / (LEVELS - 1) as f32;
        let lobe = if level == 0 { Vec::new() } else { lobe(roughness) };
        let texel = |index: u32| {
            let place = Vec2::new(
                ((index % width) as f32 + 0.5) / width as f32,
                ((index / width) as f32 + 0.5) / height as f32,
            );
            if lobe.is_empty() {
                pyramid.levels[0].at(place)
            } else {
                pyramid.gather(direction(place), &lobe)
            }
        };
        (0..width * height).map(|index| texel(index).to_array()).collect()
    };
    (0..LEVELS).map(level).collect()
}

/// A direction in which a lobe about +z reflects.
struct Sample {
    direction: Vec3,
    /// Solid angle that it stands for.
    solid_angle: f32,
}

fn lobe(roughness: f32) -> Vec<Sample> {
    let alpha2 = roughness.powi(4);
    let sample = |index: u32| {
        // Hammersley's points.
        let (u, v) = ((index as f32 + 0.5) / SAMPLES as f32, index.reverse_bits() as f32 / 4_294_967_296.0);
        let cosine = ((1.0 - v) / (1.0 + (alpha2 - 1.0) * v)).sqrt();
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let half = Vec3::new(sine * (TAU * u).cos(), sine * (TAU * u).sin(), cosine);
        let direction = 2.0 * cosine * half - Vec3::Z;
        let narrowing = cosine * cosine * (alpha2 - 1.0) + 1.0;
        // D/4: the density of the reflected direction where the viewer looks along the normal.
        let density = alpha2 / (PI * narrowing * narrowing) / 4.0;
        Sample { direction, solid_angle: 1.0 / (SAMPLES as f32 * density.max(1e-6)) }
    };
    (0..SAMPLES).map(sample).filter(|sample| sample.direction.z > 0.0).collect()
}

/// The image at half the size again and again.
struct Pyramid {
    levels: Vec<Level>,
}

struct Level {
    width: u32,
    height: u32,
    pixels: Vec<Vec3>,
}

impl Pyramid {
    fn of(image: Image<'_>) -> Self {
        let mut level = Level {
            width: image.width,
            height: image.height,
            pixels: image.pixels.iter().map(|pixel| Vec3::from(*pixel)).collect(),
        };
        // A larger image than is kept is averaged down to it first.
        while level.width >= 2 * SIZE[0] {
            level = level.halved();
        }
        let mut levels = vec![level];
        while let Some(last) = levels.last().filter(|last| last.height > 1) {
            let next = last.halved();
            levels.push(next);
        }
        Self { levels }
    }

    /// Mean about a direction, weighted by the cosine to it.
    fn gather(&self, normal: Vec3, lobe: &[Sample]) -> Vec3 {
        let (across, along) = normal.any_orthonormal_pair();
        let texel = TAU * PI / (self.levels[0].width * self.levels[0].height) as f32;
        let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
        for sample in lobe {
            let d = sample.direction;
            let direction = across * d.x + along * d.y + normal * d.z;
            // A level on which a texel is as large as what the sample stands for.
            let level = (0.5 * (sample.solid_angle / texel).max(1.0).log2()).round() as usize;
            let level = &self.levels[level.min(self.levels.len() - 1)];
            sum += d.z * level.at(place(direction));
            weights += d.z;
        }
        sum / weights
    }
}

impl Level {
    /// Straight between texels; around the horizon it goes on.
    fn at(&self, place: Vec2) -> Vec3 {
        let x = place.x * self.width as f32 - 0.5;
        let y = (place.y * self.height as f32 - 0.5).clamp(0.0, (self.height - 1) as f32);
        let (left, top) = (x.floor(), y.floor());
        let column = |offset: f32| (left + offset).rem_euclid(self.width as f32) as u32 % self.width;
        let row = |offset: u32| (top as u32 + offset).min(self.height - 1);
        let pixel = |x: u32, y: u32| self.pixels[(y * self.width + x) as usize];
        let [upper, lower] = [0, 1]
            .map(|offset| pixel(column(0.0), row(offset)).lerp(pixel(column(1.0), row(offset)), x - left));
        upper.lerp(lower, y - top)
    }

    fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let mean = |index: u32| {
            let (x, y) = (2 * (index % width), 2 * (index / width));
            let pixel = |x: u32, y: u32| {
                self.pixels[(y.min(self.height - 1) * self.width + x.min(self.width - 1)) as usize]
            };
            0.25 * (pixel(x, y) + pixel(x + 1, y) + pixel(x, y + 1) + pixel(x + 1, y + 1))
        };
        Self { width, height, pixels: (0..width * height).map(mean).collect() }
    }
}

/// Direction of a texture coordinate, and back.
fn direction(place: Vec2) -> Vec3 {
    let (longitude, latitude) = (TAU * (place.x - 0.5), PI * place.y);
    Vec3::new(latitude.sin() * longitude.sin(), latitude.cos(), -latitude.sin() * longitude.cos())
}

fn place(direction: Vec3) -> Vec2 {
    let longitude = direction.x.atan2(-direction.z);
    Vec2::new(longitude / TAU + 0.5, direction.y.clamp(-1.0, 1.0).acos() / PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_the_same_everywhere_stays_so() {
        for [width, height] in [[2, 1], [64, 32], [600, 300], [1024, 512]] {
            let pixels = vec![[0.25, 0.5, 3.0]; (width * height) as usize];
            for level in prefiltered(Image { width, height, pixels: &pixels }) {
                for texel in level {
                    // Weights that add up to 1, in f32.
                    assert!((Vec3::from(texel) - Vec3::new(0.25, 0.5, 3.0)).abs().max_element() < 1e-4);
                }
            }
        }
    }

    #[test]
    fn a_lamp_widens_with_the_roughness_and_keeps_its_light() {
        // A disc of 10° straight ahead.
        let lit = |index: u32| {
            let place =
                Vec2::new((index % 256) as f32 + 0.5, (index / 256) as f32 + 0.5) / Vec2::new(256.0, 128.0);
            if direction(place).z < -(10_f32.to_radians().cos()) { [1.0; 3] } else { [0.0; 3] }
        };
        let pixels: Vec<[f32; 3]> = (0..256 * 128).map(lit).collect();
        let levels = prefiltered(Image { width: 256, height: 128, pixels: &pixels });
        let ahead = |level: usize| {
            let [width, height] = SIZE.map(|edge| edge >> level);
            levels[level][(height / 2 * width + width / 2) as usize][0]
        };
        let brightness: Vec<f32> = (0..LEVELS as usize).map(ahead).collect();
        assert!(
            (brightness[0] - 1.0).abs() < 1e-6 && brightness.windows(2).all(|pair| pair[1] < pair[0] + 1e-6)
        );
        assert!(brightness[5] < 0.2, "{brightness:?}");
    }

    #[test]
    fn a_direction_has_one_place() {
        for place_ in [Vec2::new(0.1, 0.2), Vec2::new(0.5, 0.5), Vec2::new(0.9, 0.75)] {
            assert!(place(direction(place_)).abs_diff_eq(place_, 1e-5));
        }
        assert!(direction(Vec2::new(0.5, 0.5)).abs_diff_eq(Vec3::NEG_Z, 1e-6));
        assert!(direction(Vec2::new(0.75, 0.5)).abs_diff_eq(Vec3::X, 1e-6));
    }
}
