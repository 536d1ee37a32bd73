//! glTF files, good and bad, made here: what is read, and the exact text of every complaint.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use serde_json::{Value, json};
use std::path::Path;
use subsurface_cli::failure::{Failure, warning};
use subsurface_cli::scene::gltf::{Loaded, load};

/// A triangle in the plane z = 0 that faces +z.
const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const NORMALS: [[f32; 3]; 3] = [[0.0, 0.0, 1.0]; 3];

/// Little-endian bytes.
fn floats<const N: usize>(vectors: &[[f32; N]]) -> Vec<u8> {
    vectors.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// A glTF file under construction: its JSON and its one buffer.
struct File {
    json: Value,
    buffer: Vec<u8>,
}

impl File {
    /// One node with one mesh of one primitive that has no attributes yet.
    fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"name": "face", "primitives": [{"attributes": {}}]}],
            "accessors": [],
            "bufferViews": [],
        });
        Self { json, buffer: Vec::new() }
    }

    /// One triangle with normals and indices: nothing to complain about.
    fn triangle() -> Self {
        let mut file = Self::new();
        file.attribute("POSITION", &TRIANGLE).attribute("NORMAL", &NORMALS).indices(5121, vec![0, 1, 2], 3);
        file
    }

    fn accessor(&mut self, bytes: Vec<u8>, mut accessor: Value) -> usize {
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({"buffer": 0, "byteOffset": self.buffer.len(), "byteLength": bytes.len()}));
        accessor["bufferView"] = json!(views.len() - 1);
        self.buffer.extend(bytes);
        // Accessors start at multiples of four.
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(accessor);
        accessors.len() - 1
    }

    fn attribute<const N: usize>(&mut self, name: &str, vectors: &[[f32; N]]) -> &mut Self {
        let mut accessor = json!({"componentType": 5126, "count": vectors.len(), "type": format!("VEC{N}")});
        if name == "POSITION" {
            // The standard wants bounds; nothing here reads them.
            accessor["min"] = json!([0.0, 0.0, 0.0]);
            accessor["max"] = json!([1.0, 1.0, 1.0]);
        }
        let index = self.accessor(floats(vectors), accessor);
        self.primitive()["attributes"][name] = json!(index);
        self
    }

    /// `component` is glTF's number: 5121 for u8, 5123 for u16, 5125 for u32.
    fn indices(&mut self, component: u32, bytes: Vec<u8>, count: usize) -> &mut Self {
        let index =
            self.accessor(bytes, json!({"componentType": component, "count": count, "type": "SCALAR"}));
        self.primitive()["indices"] = json!(index);
        self
    }

    fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    fn set(&mut self, pointer: &str, value: Value) -> &mut Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        self.json.pointer_mut(parent).unwrap()[key] = value;
        self
    }

    /// The file as a .glb.
    fn bytes(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{"byteLength": self.buffer.len()}]);
        let mut text = serde_json::to_vec(&json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + text.len() + 8 + self.buffer.len();
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &self.buffer)] {
            if kind == b"JSON" {
                bytes.extend((length as u32).to_le_bytes());
            }
            bytes.extend((chunk.len() as u32).to_le_bytes());
            bytes.extend(kind);
            bytes.extend(chunk);
        }
        bytes
    }

    fn load(&self) -> Result<Loaded, String> {
        load_bytes(&self.bytes())
    }
}

/// Loads a file with these bytes; complaints come without the folder's name.
fn load_bytes(bytes: &[u8]) -> Result<Loaded, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("head.glb");
    std::fs::write(&path, bytes).unwrap();
    load(&path, |_| ()).map_err(|error| without_folder(&Failure::from(error).render(), folder.path()))
}

fn without_folder(text: &str, folder: &Path) -> String {
    text.replace(&format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR), "")
}

/// The warnings as they are printed, without the folder's name.
fn warnings(loaded: &Loaded) -> String {
    let texts: Vec<String> = loaded.warnings.iter().map(warning).collect();
    let text = texts.join("\n");
    // The folder is gone; its name ends before the file's.
    text.lines()
        .map(|line| match (line.find(": "), line.find("head.glb")) {
            (Some(colon), Some(file)) => format!("{}: {}\n", &line[..colon], &line[file..]),
            _ => format!("{line}\n"),
        })
        .collect()
}

/// Compares with the blessed text `out/errors/gltf_NAME.snap`; `INSTA_UPDATE=always cargo test` blesses anew.
fn bless(name: &str, text: &str) {
    let text = text.replace(" (os error 2)", "");
    insta::with_settings!({
        snapshot_path => "out/errors",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, {
        insta::assert_snapshot!(format!("gltf_{name}"), text);
    });
}

fn mesh(loaded: &Loaded) -> &subsurface_cli::scene::Mesh {
    &loaded.scene.objects[0].mesh
}

#[test]
fn a_good_file_comes_without_a_warning() {
    let loaded = File::triangle().load().unwrap();
    assert!(loaded.warnings.is_empty());
    assert_eq!(mesh(&loaded).positions, TRIANGLE);
    assert_eq!(mesh(&loaded).normals, NORMALS);
    assert_eq!(mesh(&loaded).indices, [0, 1, 2]);
    assert_eq!(mesh(&loaded).texture_coordinates, [[0.0; 2]; 3]);
    assert_eq!(loaded.scene.objects[0].name, "face");
}

#[test]
fn every_index_width_reads_the_same() {
    for (component, bytes) in [
        (5121, vec![2, 0, 1]),
        (5123, [2u16, 0, 1].iter().flat_map(|i| i.to_le_bytes()).collect()),
        (5125, [2u32, 0, 1].iter().flat_map(|i| i.to_le_bytes()).collect()),
    ] {
        let mut file = File::new();
        file.attribute("POSITION", &TRIANGLE).attribute("NORMAL", &NORMALS).indices(component, bytes, 3);
        assert_eq!(mesh(&file.load().unwrap()).indices, [2, 0, 1]);
    }
}

#[test]
fn nodes_move_turn_and_mirror() {
    // A parent that moves by (10, 0, 0), a child that mirrors x and stretches z.
    let mut file = File::triangle();
    file.set(
        "/nodes",
        json!([{"children": [1], "translation": [10, 0, 0]}, {"mesh": 0, "scale": [-2, 1, 4]}]),
    );
    file.attribute("NORMAL", &[[0.6, 0.0, 0.8]; 3]);
    let loaded = file.load().unwrap();
    assert_eq!(mesh(&loaded).positions, [[10.0, 0.0, 0.0], [8.0, 0.0, 0.0], [10.0, 1.0, 0.0]]);
    // Mirrored, so turned over; otherwise it would face -z.
    assert_eq!(mesh(&loaded).indices, [0, 2, 1]);
    // Inverse transpose: (0.6 / -2, 0, 0.8 / 4), normalised.
    let length = (0.3f32 * 0.3 + 0.2 * 0.2).sqrt();
    let expected = [-0.3 / length, 0.0, 0.2 / length];
    for (found, expected) in mesh(&loaded).normals[0].iter().zip(expected) {
        // A few roundings of f32.
        assert!((found - expected).abs() < 1e-6);
    }
    assert_eq!(loaded.scene.bounds.minimum, [8.0, 0.0, 0.0]);
    assert_eq!(loaded.scene.bounds.maximum, [10.0, 1.0, 0.0]);
}

#[test]
fn strips_and_fans_become_triangles_that_face_one_way() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let round = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    for (mode, corners) in [(5, square), (6, round)] {
        let mut file = File::new();
        file.attribute("POSITION", &corners).attribute("NORMAL", &[[0.0, 0.0, 1.0]; 4]);
        file.indices(5121, vec![0, 1, 2, 3], 4);
        file.primitive()["mode"] = json!(mode);
        let loaded = file.load().unwrap();
        let triangles: Vec<_> = mesh(&loaded).indices.chunks_exact(3).collect();
        assert_eq!(triangles.len(), 2);
        for t in triangles {
            let [a, b, c] = [0, 1, 2].map(|k| corners[t[k] as usize]);
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            assert_eq!(area, 1.0);
        }
    }
}

#[test]
fn images_come_from_the_file_beside_it_or_a_data_uri() {
    // One red pixel.
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(1, 1, image::Rgba([255, 0, 0, 255]))
        .write_to(&mut png, image::ImageFormat::Png)
        .unwrap();
    let png = png.into_inner();
    let textured = |image: Value| {
        let mut file = File::triangle();
        file.attribute("TEXCOORD_0", &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        file.primitive()["material"] = json!(0);
        file.set("/images", json!([image])).set("/textures", json!([{"source": 0}]));
        let colour = json!({"baseColorTexture": {"index": 0}, "baseColorFactor": [0.5, 1, 1, 1]});
        file.set(
            "/materials",
            json!([{"name": "skin", "pbrMetallicRoughness": colour, "normalTexture": {"index": 0, "scale": 0.5}}]),
        );
        file
    };
    let mut embedded = textured(json!({"bufferView": 0, "mimeType": "image/png"}));
    let offset = embedded.buffer.len();
    embedded.buffer.extend(&png);
    embedded.buffer.resize(embedded.buffer.len().next_multiple_of(4), 0);
    let views = embedded.json["bufferViews"].as_array_mut().unwrap();
    views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": png.len()}));
    let view = views.len() - 1;
    embedded.set("/images/0/bufferView", json!(view));

    let data = textured(json!({"uri": format!("data:image/png;base64,{}", base64(&png))}));
    let beside = textured(json!({"uri": "a%20red.png"}));
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a red.png"), &png).unwrap();
    std::fs::write(folder.path().join("head.glb"), beside.bytes()).unwrap();

    let from_disk = load(&folder.path().join("head.glb"), |_| ()).unwrap();
    for loaded in [embedded.load().unwrap(), data.load().unwrap(), from_disk] {
        let surface = &loaded.scene.objects[0].surface;
        let image = surface.base_colour.as_ref().unwrap();
        assert_eq!((image.width, image.height, &image.rgba[..]), (1, 1, &[255, 0, 0, 255][..]));
        assert_eq!(surface.normal_map.as_ref(), Some(image));
        assert_eq!((surface.normal_scale, surface.base_colour_factor), (0.5, [0.5, 1.0, 1.0, 1.0]));
        assert_eq!(surface.material_name.as_deref(), Some("skin"));
    }

    bless("missing_texture", &textured(json!({"uri": "eyes.png"})).load().unwrap_err());
}

#[test]
fn a_volume_is_as_thick_as_its_node_is_large() {
    let mut file = File::triangle();
    file.set("/nodes/0/scale", json!([2.0, 2.0, 2.0]));
    file.set("/extensionsUsed", json!(["KHR_materials_volume"]));
    let volume = |factor: f64| json!([{"extensions": {"KHR_materials_volume": {"thicknessFactor": factor}}}]);
    file.primitive()["material"] = json!(0);
    // Metres of the mesh: 4 mm, twice as large in the world. Without a thickness it is none.
    for (factor, thickness_mm) in [(0.004, 8.0), (0.0, 0.0)] {
        file.set("/materials", volume(factor));
        let surface = &file.load().unwrap().scene.objects[0].surface;
        assert!((surface.thickness_mm - thickness_mm).abs() < 1e-5, "{}", surface.thickness_mm);
        assert!(surface.thickness.is_none());
    }
}

#[test]
fn triangles_are_wound_as_their_normals_say() {
    let mut file = File::new();
    file.attribute("POSITION", &TRIANGLE).attribute("NORMAL", &NORMALS).indices(5121, vec![0, 2, 1], 3);
    let loaded = file.load().unwrap();
    bless("wound_against_normals", &warnings(&loaded));
    let mesh = mesh(&loaded);
    assert_eq!((&mesh.indices[..], mesh.normals[0]), (&[0, 1, 2][..], [0.0, 0.0, 1.0]));
}

#[test]
fn what_transmits_is_clear() {
    let mut file = File::triangle();
    file.set("/nodes/0/scale", json!([2.0, 2.0, 2.0]));
    file.primitive()["material"] = json!(0);
    let transmission = |factor: f64| json!({"transmissionFactor": factor});
    let volume =
        json!({"thicknessFactor": 0.01, "attenuationColor": [0.5, 1, 1], "attenuationDistance": 0.003});
    // A volume: half of the red after 3 mm of the world, whatever the node's scale.
    file.set(
        "/materials",
        json!([{
            "pbrMetallicRoughness": {"roughnessFactor": 0.25},
            "extensions": {
                "KHR_materials_transmission": transmission(1.0),
                "KHR_materials_volume": volume,
                "KHR_materials_ior": {"ior": 1.33},
            },
        }]),
    );
    let loaded = file.load().unwrap();
    assert_eq!(warnings(&loaded), "");
    let clear = loaded.scene.objects[0].surface.clear.unwrap();
    assert!((clear.absorption_per_mm[0] - 0.5_f32.recip().ln() / 3.0).abs() < 1e-6, "{clear:?}");
    assert_eq!(clear.absorption_per_mm[1..], [0.0; 2]);
    assert_eq!((clear.refractive_index, clear.roughness, clear.shell_thickness_mm), (1.33, 0.25, None));
    // Without a volume a wall, coloured by its base colour.
    file.set(
        "/materials",
        json!([{
            "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 1, 1]},
            "extensions": {"KHR_materials_transmission": transmission(0.75)},
        }]),
    );
    let loaded = file.load().unwrap();
    let clear = loaded.scene.objects[0].surface.clear.unwrap();
    let through =
        clear.absorption_per_mm.map(|absorption| (-absorption * clear.shell_thickness_mm.unwrap()).exp());
    assert!((through[1] - 0.5).abs() < 1e-6 && through[0] == 1.0, "{clear:?}");
    bless("partly_clear", &warnings(&loaded));
    file.set("/materials/0/extensions/KHR_materials_transmission", transmission(0.25));
    let loaded = file.load().unwrap();
    assert!(loaded.scene.objects[0].surface.clear.is_none());
    bless("little_transmission", &warnings(&loaded));
}

fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let bits = (0..3).fold(0u32, |bits, k| bits << 8 | u32::from(*three.get(k).unwrap_or(&0)));
        for k in 0..4 {
            let six = (bits >> (18 - 6 * k) & 63) as usize;
            text.push(if k <= three.len() { char::from(ALPHABET[six]) } else { '=' });
        }
    }
    text
}

#[test]
fn no_normals_is_legal_and_flat() {
    let mut file = File::new();
    // Two triangles that share an edge at a right angle.
    file.attribute("POSITION", &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    file.indices(5121, vec![0, 1, 2, 0, 2, 3], 6);
    let loaded = file.load().unwrap();
    assert_eq!(mesh(&loaded).positions.len(), 6);
    assert_eq!(mesh(&loaded).normals[0], [0.0, 0.0, 1.0]);
    assert_eq!(mesh(&loaded).normals[3], [1.0, 0.0, 0.0]);
    bless("no_normals", &warnings(&loaded));
}

#[test]
fn no_indices_is_legal_and_counts_through() {
    let mut file = File::new();
    file.attribute("POSITION", &TRIANGLE).attribute("NORMAL", &NORMALS);
    let loaded = file.load().unwrap();
    assert_eq!(mesh(&loaded).indices, [0, 1, 2]);
    bless("no_indices", &warnings(&loaded));
}

#[test]
fn triangles_without_area_are_left_out() {
    let mut file = File::new();
    file.attribute("POSITION", &TRIANGLE).attribute("NORMAL", &NORMALS);
    file.indices(5121, vec![0, 1, 2, 0, 0, 1, 2, 1, 2], 9);
    let loaded = file.load().unwrap();
    assert_eq!(mesh(&loaded).indices, [0, 1, 2]);
    bless("degenerate_triangles", &warnings(&loaded));
}

#[test]
fn normals_of_no_length_are_replaced() {
    let mut file = File::triangle();
    file.attribute("NORMAL", &[[0.0, 0.0, 1.0], [0.0; 3], [f32::NAN, 0.0, 0.0]]);
    let loaded = file.load().unwrap();
    assert_eq!(mesh(&loaded).normals, NORMALS);
    bless("normals_of_no_length", &warnings(&loaded));
}

#[test]
fn a_texture_without_coordinates_is_suspect() {
    let mut file = File::triangle();
    file.primitive()["material"] = json!(0);
    let pixel =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==";
    file.set("/images", json!([{"uri": format!("data:image/png;base64,{pixel}")}]));
    file.set("/textures", json!([{"source": 0}]));
    file.set("/materials", json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]));
    bless("no_texture_coordinates", &warnings(&file.load().unwrap()));
}

#[test]
fn positions_must_be_finite() {
    for (value, name) in [(f32::NAN, "nan"), (f32::INFINITY, "inf")] {
        let mut file = File::triangle();
        file.attribute("POSITION", &[TRIANGLE[0], [1.0, value, 0.0], TRIANGLE[2]]);
        bless(&format!("position_{name}"), &file.load().unwrap_err());
    }
}

#[test]
fn indices_must_name_vertices() {
    let mut file = File::triangle();
    file.indices(5121, vec![0, 1, 3], 3);
    bless("index_out_of_range", &file.load().unwrap_err());
    let mut file = File::triangle();
    file.indices(5121, vec![0, 1, 2, 0], 4);
    bless("incomplete_triangle", &file.load().unwrap_err());
}

#[test]
fn points_and_lines_are_no_surface() {
    for (mode, name) in [(0, "points"), (1, "lines")] {
        let mut file = File::triangle();
        file.primitive()["mode"] = json!(mode);
        bless(&format!("made_of_{name}"), &file.load().unwrap_err());
    }
}

#[test]
fn an_accessor_must_lie_in_its_buffer() {
    let mut file = File::triangle();
    file.set("/accessors/0/count", json!(300));
    bless("accessor_out_of_range", &file.load().unwrap_err());
    let mut file = File::triangle();
    file.set("/accessors/1/count", json!(2));
    bless("accessor_count", &file.load().unwrap_err());
    let mut file = File::triangle();
    file.set("/accessors/1/type", json!("VEC2"));
    bless("accessor_type", &file.load().unwrap_err());
}

#[test]
fn nodes_must_be_a_tree() {
    let mut file = File::triangle();
    file.set("/nodes", json!([{"children": [1]}, {"children": [0], "mesh": 0}]));
    bless("not_a_tree", &file.load().unwrap_err());
}

#[test]
fn there_must_be_something_to_draw() {
    let mut file = File::triangle();
    file.set("/scenes/0/nodes", json!([]));
    bless("empty_scene", &file.load().unwrap_err());
    let mut file = File::new();
    file.attribute("NORMAL", &NORMALS);
    bless("no_positions", &file.load().unwrap_err());
    let mut file = File::triangle();
    file.attribute("POSITION", &[[0.0; 3]; 3]);
    bless("all_degenerate", &file.load().unwrap_err());
}

#[test]
fn a_damaged_file_is_named() {
    let bytes = File::triangle().bytes();
    bless(
        "truncated",
        &load_bytes(&bytes[..bytes.len() / 2])
            .unwrap_err()
            .replace(&bytes.len().to_string(), "ALL")
            .replace(&(bytes.len() / 2).to_string(), "HALF"),
    );
    bless("empty_file", &load_bytes(b"").unwrap_err());
    bless("not_gltf", &load_bytes(b"solid STL").unwrap_err());
}

#[test]
fn a_missing_buffer_is_named() {
    let mut file = File::triangle();
    let buffer = json!([{"byteLength": 84, "uri": "head.bin"}]);
    file.set("/buffers", buffer);
    let text = serde_json::to_vec(&file.json).unwrap();
    bless("missing_buffer", &load_bytes(&text).unwrap_err());
}

#[test]
fn no_cut_and_no_flipped_byte_makes_it_panic() {
    let bytes = File::triangle().bytes();
    for end in 0..bytes.len() {
        assert!(load_bytes(&bytes[..end]).is_err());
    }
    for index in 0..bytes.len() {
        for flip in [0x01, 0x10, 0x80, 0xff] {
            let mut damaged = bytes.clone();
            damaged[index] ^= flip;
            // A flipped digit may be as good as the one before; it must only not panic.
            let _ = load_bytes(&damaged);
        }
    }
}

#[test]
fn the_binary_says_it_and_exits_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("head.glb");
    std::fs::write(&path, b"solid STL").unwrap();
    std::fs::write(folder.path().join("skin.ron"), SKIN).unwrap();
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_subsurface"))
        .args(["render", "--materials", ".", "--mesh", "head.glb", "--out", "a.png"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    // A graphics driver may have said something before.
    assert!(
        stderr.lines().any(|line| line.starts_with("error: head.glb is not a valid glTF file: ")),
        "{stderr}"
    );
    assert!(stderr.contains("\n  = help: "), "{stderr}");
}

const SKIN: &str = "Material(profile: \"burley_searchlight\", mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.83, 0.64, 0.55))";
