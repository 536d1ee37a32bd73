//! Which lights matter most.

use std::cmp::Ordering;

use super::Light;
use crate::camera::Bounds;

/// Lights of a frame that have a shadow map, and shine through what is thin: the most important ones.
pub const SHADOW_MAPS: usize = 4;

/// By how much a light must outdo one that has a map to take it: none should flicker between two that are nearly alike.
const HYSTERESIS: f32 = 1.1;

/// The lights of a frame by importance, and who has a shadow map.
///
/// Keep it from frame to frame: a light that has a map keeps it until another one matters a tenth more.
///
/// ```
/// use subsurface_runtime::{Bounds, DirectionalLight, LightRanks, PointLight};
///
/// let far = PointLight { position: [9.0, 0.0, 0.0], ..Default::default() };
/// let mut ranks = LightRanks::default();
/// ranks.update(&[far.into(), DirectionalLight::default().into()], &Bounds::new([0.0; 3], 0.2));
/// assert_eq!(ranks.order(), [1, 0]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct LightRanks {
    importance: Vec<f32>,
    order: Vec<usize>,
    /// Indices of the lights that have a map, by rank: as many as their layers.
    mapped: Vec<usize>,
}

impl LightRanks {
    /// Ranks the lights of the next frame.
    pub fn update(&mut self, lights: &[Light], bounds: &Bounds) {
        let Self { importance, order, mapped } = self;
        importance.clear();
        importance.extend(lights.iter().map(|light| light.importance(bounds)));
        // Who has a map counts for more; ties go to the first.
        let counted =
            |index: usize| importance[index] * if mapped.contains(&index) { HYSTERESIS } else { 1.0 };
        order.clear();
        order.extend(0..lights.len());
        order.sort_unstable_by(|&a, &b| counted(b).total_cmp(&counted(a)).then(a.cmp(&b)));
        mapped.clear();
        mapped.extend(order.iter().copied().filter(|&index| importance[index] > 0.0).take(SHADOW_MAPS));
        // Sums of light depend on their order by a rounding: whatever the list's is, this one is the same.
        let rank = |a: usize, b: usize| {
            let by_importance = importance[b].total_cmp(&importance[a]);
            by_importance.then_with(|| compare(&lights[a], &lights[b])).then(a.cmp(&b))
        };
        order.sort_unstable_by(|&a, &b| rank(a, b));
        mapped.sort_unstable_by(|&a, &b| rank(a, b));
    }

    /// Indices of the lights, the most important first.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// Indices of the lights with a shadow map, [`SHADOW_MAPS`] at most, by rank.
    pub fn mapped(&self) -> impl Iterator<Item = usize> + '_ {
        self.mapped.iter().copied()
    }

    /// Layer of a light's shadow map.
    pub(crate) fn layer(&self, index: usize) -> Option<u32> {
        self.mapped().position(|mapped| mapped == index).map(|layer| layer as u32)
    }
}

/// An order of lights by what they are.
fn compare(a: &Light, b: &Light) -> Ordering {
    key(a)
        .iter()
        .zip(key(b))
        .map(|(a, b)| a.total_cmp(&b))
        .find(|order| order.is_ne())
        .unwrap_or(Ordering::Equal)
}

/// All numbers of a light.
fn key(light: &Light) -> [f32; 13] {
    let of = |kind: f32, one: [f32; 3], other: [f32; 3], light: [f32; 3], last: [f32; 3]| {
        let mut key = [kind; 13];
        key[1..].copy_from_slice([one, other, light, last].as_flattened());
        key
    };
    match light {
        Light::Directional(light) => {
            of(0.0, light.direction, [0.0; 3], light.irradiance, [light.angular_diameter_radians, 0.0, 0.0])
        }
        Light::Point(lamp) => of(1.0, lamp.position, [0.0; 3], lamp.intensity, [lamp.radius_mm, 0.0, 0.0]),
        Light::Spot(lamp) => of(
            2.0,
            lamp.position,
            lamp.direction,
            lamp.intensity,
            [lamp.radius_mm, lamp.inner_angle_radians, lamp.outer_angle_radians],
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{DirectionalLight, PointLight};
    use super::*;

    const BOUNDS: Bounds = Bounds::new([0.0; 3], 0.2);

    fn sun(strength: f32) -> Light {
        DirectionalLight { irradiance: [strength; 3], ..Default::default() }.into()
    }

    #[test]
    fn the_brightest_come_first_and_ties_keep_their_order() {
        let mut ranks = LightRanks::default();
        ranks.update(&[sun(1.0), sun(3.0), sun(0.0), sun(2.0), sun(1.0), sun(0.5)], &BOUNDS);
        assert_eq!(ranks.order(), [1, 3, 0, 4, 5, 2]);
        assert_eq!(ranks.mapped().collect::<Vec<_>>(), [1, 3, 0, 4]);
        assert_eq!((ranks.layer(3), ranks.layer(5), ranks.layer(2)), (Some(1), None, None));
    }

    #[test]
    fn a_light_keeps_its_map_until_another_matters_a_tenth_more() {
        let mut ranks = LightRanks::default();
        let mut lights = [sun(4.0), sun(3.0), sun(2.0), sun(1.0), sun(0.9)];
        ranks.update(&lights, &BOUNDS);
        lights[4] = sun(1.05);
        ranks.update(&lights, &BOUNDS);
        assert_eq!(ranks.layer(4), None, "not a tenth more");
        assert_eq!(ranks.order(), [0, 1, 2, 4, 3]);
        lights[4] = sun(1.2);
        ranks.update(&lights, &BOUNDS);
        assert_eq!((ranks.layer(4), ranks.layer(3)), (Some(3), None));
    }

    #[test]
    fn importance_falls_with_the_distance_and_is_never_negative() {
        let lamp = |x: f32, strength: f32| {
            Light::from(PointLight {
                position: [x, 0.0, 0.0],
                intensity: [strength; 3],
                ..Default::default()
            })
        };
        let ratio = lamp(1.2, 1.0).importance(&BOUNDS) / lamp(2.2, 1.0).importance(&BOUNDS);
        assert!((ratio - 4.0).abs() < 1e-3, "1 and 2 from the bounds: {ratio}");
        assert!(lamp(0.0, 1.0).importance(&BOUNDS).is_finite());
        for strength in [-1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(lamp(1.0, strength).importance(&BOUNDS), 0.0);
        }
    }
}
