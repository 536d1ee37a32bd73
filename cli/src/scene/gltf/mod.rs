//! glTF 2.0 files, text (`.gltf`) or binary (`.glb`), as a scene.
//!
//! Node transforms are applied, so everything comes out in world space; metres by the standard. The default scene
//! of the file is read, or its first. Animations, skins, morph targets, cameras and lights are passed over.

mod accessor;
mod clear;
mod error;
mod primitive;
mod source;
mod warning;

pub use error::{GltfError, Place};
pub use warning::GltfWarning;

use super::{Image, MILLIMETRES_PER_METRE, Object, Scene, Surface};
use glam::Mat4;
use source::Sources;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// More triangles than this are refused: their vertices would not fit a GPU buffer of 1 GiB.
pub const LARGEST_TRIANGLE_COUNT: usize = 20_000_000;

/// What came of reading a file.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// What was legal but suspect, in the order of the file.
    pub warnings: Vec<GltfWarning>,
}

/// Reads the file at `path`; `step` is called with what is being read, for a progress bar.
pub fn load(path: &Path, mut step: impl FnMut(&str)) -> Result<Loaded, GltfError> {
    step("file");
    let gltf = source::open(path)?;
    let document = &gltf.document;
    let sources = Sources::load(path, document, gltf.blob.as_deref())?;
    let scene = document
        .default_scene()
        .or_else(|| document.scenes().next())
        .ok_or_else(|| GltfError::Empty { file: path.to_owned(), what: "it has no scene" })?;
    let mut loader = Loader {
        path,
        sources,
        images: HashMap::new(),
        objects: Vec::new(),
        warnings: Vec::new(),
        triangles: 0,
    };
    let mut pending: Vec<(gltf::Node<'_>, Mat4)> = scene.nodes().map(|node| (node, Mat4::IDENTITY)).collect();
    pending.reverse();
    let mut seen = HashSet::new();
    while let Some((node, parent)) = pending.pop() {
        // The standard wants a tree. A cycle would run for ever, a net of shared nodes nearly so.
        if !seen.insert(node.index()) {
            return Err(GltfError::NotATree { file: path.to_owned(), node: node.index() });
        }
        let world_from_node = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        if let Some(mesh) = node.mesh() {
            step(mesh.name().unwrap_or("mesh"));
            loader.mesh(&mesh, world_from_node)?;
        }
        let children: Vec<_> = node.children().collect();
        pending.extend(children.into_iter().rev().map(|child| (child, world_from_node)));
    }
    if loader.objects.is_empty() {
        return Err(GltfError::Empty { file: path.to_owned(), what: "its scene shows no triangle" });
    }
    Ok(Loaded { scene: Scene::new(loader.objects), warnings: loader.warnings })
}

/// What is gathered while the nodes are walked.
struct Loader<'a> {
    path: &'a Path,
    sources: Sources,
    /// Decoded images by their index in the file: several materials may share one.
    images: HashMap<usize, Image>,
    objects: Vec<Object>,
    warnings: Vec<GltfWarning>,
    triangles: usize,
}

impl Loader<'_> {
    fn mesh(&mut self, mesh: &gltf::Mesh<'_>, world_from_node: Mat4) -> Result<(), GltfError> {
        for primitive in mesh.primitives() {
            let place = Place {
                file: self.path.to_owned(),
                mesh: mesh.name().map_or_else(|| format!("#{}", mesh.index()), str::to_owned),
                primitive: primitive.index(),
            };
            let Some(triangles) =
                primitive::read(&primitive, world_from_node, &self.sources, &place, &mut self.warnings)?
            else {
                continue;
            };
            self.triangles += triangles.indices.len() / 3;
            if self.triangles > LARGEST_TRIANGLE_COUNT {
                return Err(GltfError::TooLarge { place, largest: LARGEST_TRIANGLE_COUNT });
            }
            let surface = self.surface(&primitive.material(), &place, world_from_node)?;
            self.objects.push(Object { name: place.mesh, mesh: triangles, surface });
        }
        Ok(())
    }

    fn surface(
        &mut self,
        material: &gltf::Material<'_>,
        place: &Place,
        world_from_node: Mat4,
    ) -> Result<Surface, GltfError> {
        let colour = material.pbr_metallic_roughness();
        let base_colour = match colour.base_color_texture() {
            Some(info) => Some(self.image(&info.texture(), info.tex_coord(), place)?),
            None => None,
        };
        let normal = material.normal_texture();
        let normal_map = match &normal {
            Some(info) => Some(self.image(&info.texture(), info.tex_coord(), place)?),
            None => None,
        };
        // A factor alone is what every exporter writes; the material's own roughness is better founded.
        let roughness = match colour.metallic_roughness_texture() {
            Some(info) => Some(self.image(&info.texture(), info.tex_coord(), place)?),
            None => None,
        };
        let specular = material.specular();
        let specular_strength = match specular.as_ref().and_then(gltf::material::Specular::specular_texture) {
            Some(info) => Some(self.image(&info.texture(), info.tex_coord(), place)?),
            None => None,
        };
        // Without a thickness a volume is a sheet to glTF, and the material says whether it is one.
        let volume = material.volume().filter(|volume| volume.thickness_factor() > 0.0);
        let thickness = match volume.as_ref().and_then(gltf::material::Volume::thickness_texture) {
            Some(info) => Some(self.image(&info.texture(), info.tex_coord(), place)?),
            None => None,
        };
        // In units of the mesh, which the node scales.
        let scale = world_from_node.determinant().abs().cbrt();
        let thickness_mm =
            volume.map_or(0.0, |volume| volume.thickness_factor() * scale * MILLIMETRES_PER_METRE);
        let clear = clear::clear_material(material, place, &mut self.warnings);
        Ok(Surface {
            base_colour_factor: colour.base_color_factor(),
            base_colour,
            normal_map,
            normal_scale: normal.map_or(1.0, |info| info.scale()),
            roughness,
            roughness_factor: colour.roughness_factor(),
            specular_strength,
            specular_strength_factor: specular.map_or(1.0, |specular| specular.specular_factor()),
            thickness,
            thickness_mm,
            clear: clear.map(|(clear, _)| clear),
            clear_coverage: clear.map_or(1.0, |(_, coverage)| coverage),
            material_name: material.name().map(str::to_owned),
            ..Surface::default()
        })
    }

    fn image(&mut self, texture: &gltf::Texture<'_>, set: u32, place: &Place) -> Result<Image, GltfError> {
        if set != 0 {
            return Err(GltfError::TextureCoordinateSet { place: place.clone(), set });
        }
        let source = texture.source();
        if let Some(image) = self.images.get(&source.index()) {
            return Ok(image.clone());
        }
        let image = self.sources.image(&source)?;
        self.images.insert(source.index(), image.clone());
        Ok(image)
    }
}
