//! Looks at a scene without a GPU: `cargo run --release -p subsurface-cli --example preview -- OUT.png [FILE.glb]`.
//!
//! A z-buffer with the default camera and the first default light, three views side by side. Triangles seen from
//! inside are red: a closed mesh with the right winding shows none.

use glam::{Mat3, Vec3};
use std::error::Error;
use std::path::Path;
use subsurface_cli::picture::{DisplayPicture, write_png};
use subsurface_cli::scene::camera::{Camera, Size};
use subsurface_cli::scene::light::Light;
use subsurface_cli::scene::{Object, Scene, bust, gltf};

const VIEW: Size = Size { width: 480, height: 600 };

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let out = arguments.next().ok_or("usage: preview OUT.png [FILE.glb]")?;
    let scene = match arguments.next() {
        Some(file) => gltf::load(Path::new(&file), |_| ())?.scene,
        None => bust::scene(bust::CELL_MM),
    };
    let camera = Camera::framing(&scene, VIEW.aspect(), 24.0);
    let mut sheet = DisplayPicture::filled(Size { width: 3 * VIEW.width, ..VIEW }, [0; 3]);
    for (index, turn) in [-35f32, 0.0, 55.0].into_iter().enumerate() {
        let offset = Vec3::from(camera.position) - Vec3::from(camera.target);
        let turned = Mat3::from_rotation_y(turn.to_radians()) * offset;
        let position = (Vec3::from(camera.target) + turned).to_array();
        sheet.paste(&view(&scene, &Camera { position, ..camera }), index as u32 * VIEW.width, 0);
    }
    write_png(Path::new(&out), &sheet)?;
    Ok(())
}

fn view(scene: &Scene, camera: &Camera) -> DisplayPicture {
    let eye = Vec3::from(camera.position);
    let forward = (Vec3::from(camera.target) - eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let view_from_world = Mat3::from_cols(right, right.cross(forward), forward).transpose();
    let focal = 0.5 * VIEW.height as f32 / (0.5 * camera.fov_y_degrees.to_radians()).tan();
    let mut picture = DisplayPicture::filled(VIEW, [60; 3]);
    let mut depth = vec![f32::INFINITY; VIEW.pixels()];
    for object in &scene.objects {
        for triangle in object.mesh.indices.chunks_exact(3) {
            // Pixel coordinates and depth of the corners.
            let corners = [0, 1, 2].map(|k| {
                let p = view_from_world * (Vec3::from(object.mesh.positions[triangle[k] as usize]) - eye);
                let (x, y) = (p.x / p.z * focal, -p.y / p.z * focal);
                Vec3::new(x + 0.5 * VIEW.width as f32, y + 0.5 * VIEW.height as f32, p.z)
            });
            raster(corners, |x, y, weights| {
                let z = weights.dot(Vec3::from(corners.map(|corner| corner.z)));
                let pixel = y * VIEW.width as usize + x;
                if z < depth[pixel] {
                    depth[pixel] = z;
                    picture.pixels[pixel] = shade(object, triangle, weights, signed_area(corners) > 0.0);
                }
            });
        }
    }
    picture
}

/// Twice the area, positive if the corners run clockwise on the screen, whose y points down: seen from inside.
fn signed_area([a, b, c]: [Vec3; 3]) -> f32 {
    (b.truncate() - a.truncate()).perp_dot(c.truncate() - a.truncate())
}

fn raster(corners: [Vec3; 3], mut pixel: impl FnMut(usize, usize, Vec3)) {
    let area = signed_area(corners);
    let range = |low: f32, high: f32, limit: u32| {
        low.max(0.0) as usize..(high.max(0.0) as usize + 1).min(limit as usize)
    };
    let low = corners[0].min(corners[1]).min(corners[2]);
    let high = corners[0].max(corners[1]).max(corners[2]);
    for y in range(low.y, high.y, VIEW.height) {
        for x in range(low.x, high.x, VIEW.width) {
            let p = Vec3::new(x as f32 + 0.5, y as f32 + 0.5, 0.0);
            let [a, b, c] = corners;
            let weights =
                Vec3::new(signed_area([p, b, c]), signed_area([a, p, c]), signed_area([a, b, p])) / area;
            if weights.min_element() >= 0.0 {
                pixel(x, y, weights);
            }
        }
    }
}

fn shade(object: &Object, triangle: &[u32], weights: Vec3, inside: bool) -> [u8; 3] {
    if inside {
        return [255, 0, 0];
    }
    let mesh = &object.mesh;
    let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(mesh.normals[triangle[k] as usize]));
    let normal = (a * weights.x + b * weights.y + c * weights.z).normalize_or_zero();
    let light = match Light::DEFAULT[0] {
        Light::Directional(light) => Vec3::from(light.direction),
        Light::Point(_) | Light::Spot(_) => Vec3::NEG_Y,
    };
    let grey = (0.15 + 0.1 * normal.y + 0.75 * normal.dot(-light).max(0.0)).clamp(0.0, 1.0).powf(1.0 / 2.2);
    let colour = object.surface.base_colour.as_ref().map_or([230; 3], |image| {
        let uv = (0..3).map(|k| mesh.texture_coordinates[triangle[k] as usize]).zip(weights.to_array());
        let [u, v] = uv.fold([0.0, 0.0], |[u, v], ([s, t], w)| [u + s * w, v + t * w]);
        let texel = |t: f32, edge: u32| ((t.rem_euclid(1.0) * edge as f32) as u32).min(edge - 1) as usize;
        let index = 4 * (texel(v, image.height) * image.width as usize + texel(u, image.width));
        [0, 1, 2].map(|k| image.rgba[index + k])
    });
    colour.map(|value| (f32::from(value) * grey) as u8)
}
