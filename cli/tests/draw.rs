//! The commands that need a GPU, run as people run them: pictures, determinism, and what is said without one.
//!
//! None of these tests skips: without a graphics adapter they fail and name the remedy. The golden pictures are written
//! anew by `SUBSURFACE_BLESS=1 cargo test -p subsurface-cli --test draw golden`.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
#![allow(clippy::print_stdout, reason = "measured values, shown with a failure, to set bounds by")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;
use subsurface_cli::picture::exr::{Channels, write_channels};
use subsurface_cli::scene::camera::Size;
use tempfile::TempDir;

/// Materials as the repository has them.
const MATERIALS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../materials");

/// The adapter, asked for once.
static ADAPTER: LazyLock<Result<String, String>> = LazyLock::new(|| {
    let output = command(&["adapter"]).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
    if output.status.success() { Ok(text(&output.stdout)) } else { Err(text(&output.stderr)) }
});

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_subsurface"));
    // A Vulkan loader complains on standard error where there is no such folder.
    command.args(arguments).env("XDG_RUNTIME_DIR", std::env::temp_dir());
    command
}

/// Runs a command that needs a GPU.
fn subsurface(arguments: &[&str]) -> Output {
    if let Err(reason) = &*ADAPTER {
        panic!("this test draws, and there is nothing to draw on:\n{reason}");
    }
    command(arguments).output().unwrap()
}

/// Runs a command that must succeed; returns what it printed.
fn succeed(arguments: &[&str]) -> String {
    let output = subsurface(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Runs a command that must fail with 1; returns its complaint without the folder's name.
fn complaint(arguments: &[&str], folder: &TempDir) -> String {
    let output = subsurface(arguments);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}");
    stderr_without(&output, folder)
}

fn stderr_without(output: &Output, folder: &TempDir) -> String {
    let prefix = format!("{}{}", folder.path().display(), std::path::MAIN_SEPARATOR);
    String::from_utf8(output.stderr.clone()).unwrap().replace(&prefix, "").trim_end().to_owned()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

// ---------------------------------------------------------------------------------------------- pictures of the bust

/// The file that somebody edits, with the word in question.
fn skin(profile: &str) -> String {
    let text = fs::read_to_string(format!("{MATERIALS}/skin.ron")).unwrap();
    let (before, rest) = text.split_once("profile: \"").unwrap();
    let (_, after) = rest.split_once('"').unwrap();
    format!("{before}profile: \"{profile}\"{after}")
}

/// Size of the bust's pictures: their face is large enough to judge, their files are small enough for a repository.
const BUST: Size = Size { width: 80, height: 100 };

/// Draws the bust with `profile`; returns the PNG's bytes.
///
/// Four times finer than the picture: at the silhouette another driver may draw a pixel more or less.
fn bust(profile: &str, extra: &[&str]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let (materials, picture) = (folder.path().join("materials"), folder.path().join("bust.png"));
    fs::create_dir_all(materials.join("profiles")).unwrap();
    fs::write(materials.join("skin.ron"), skin(profile)).unwrap();
    for entry in fs::read_dir(format!("{MATERIALS}/profiles")).unwrap() {
        let path = entry.unwrap().path();
        fs::copy(&path, materials.join("profiles").join(path.file_name().unwrap())).unwrap();
    }
    let size = BUST.to_string();
    let arguments = ["render", "--materials", text(&materials), "--size", &size, "--supersample", "4"];
    let stdout = succeed(&[&arguments[..], &["--out", text(&picture)], extra].concat());
    assert!(stdout.starts_with(text(&picture)), "the name of the picture is printed: {stdout}");
    fs::read(picture).unwrap()
}

/// A picture by the name of its profile; `plain` has no subsurface pass.
static BUSTS: LazyLock<Vec<(&str, Vec<u8>)>> = LazyLock::new(|| {
    let stems = ["gaussian_skin", "burley_searchlight", "liang_2023", "two_exponential_dipole_searchlight"];
    let mut busts: Vec<_> = stems.into_iter().map(|stem| (stem, bust(stem, &[]))).collect();
    busts.push(("plain", bust(stems[3], &["--no-subsurface"])));
    busts
});

fn decoded(png: &[u8]) -> image::RgbImage {
    image::load_from_memory(png).unwrap().into_rgb8()
}

/// Root mean square difference in sRGB code values.
fn rmse(a: &[u8], b: &[u8]) -> f64 {
    let (a, b) = (decoded(a), decoded(b));
    assert_eq!(a.dimensions(), b.dimensions());
    let sum: f64 = a.iter().zip(b.iter()).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum();
    (sum / a.len() as f64).sqrt()
}

#[test]
fn one_word_of_the_material_gives_another_picture() {
    for (index, (name, picture)) in BUSTS.iter().enumerate() {
        for (other, other_picture) in &BUSTS[index + 1..] {
            let difference = rmse(picture, other_picture);
            println!("{name} and {other}: {difference:.3}");
            // Rounding to 8 bits moves a value by half a code value at most; the nearest two (Burley and polynomial, both
            // fits to Monte Carlo simulations) are 1 apart, background included.
            assert!(difference > 0.5, "{name} and {other}: {difference}");
        }
    }
}

#[test]
fn pictures_are_the_golden_ones() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for (name, picture) in
        BUSTS.iter().filter(|(name, _)| *name != "burley_searchlight" && *name != "liang_2023")
    {
        let path = folder.join(format!("bust_{name}.png"));
        if std::env::var_os("SUBSURFACE_BLESS").is_some_and(|value| value == "1") {
            fs::write(&path, picture).unwrap();
        }
        let golden = fs::read(&path).unwrap();
        assert!(golden.len() <= 12 * 1024, "{name}: a golden picture of {} bytes is too large", golden.len());
        let difference = rmse(&golden, picture);
        let psnr = 20.0 * (255.0 / difference).log10();
        // Other drivers round and rasterise differently. 45 dB is a root mean square of 1.4 code values: less than what
        // lies between any two of the golden pictures.
        assert!(
            psnr >= 45.0,
            "{name}: {psnr:.1} dB from the golden picture; if this is meant, look at the new one and bless it:\n  \
             SUBSURFACE_BLESS=1 cargo test -p subsurface-cli --test draw golden"
        );
    }
}

#[test]
fn the_same_command_gives_the_same_bytes_and_its_targets() {
    let folder = tempfile::tempdir().unwrap();
    let aov = folder.path().join("buffers");
    let (stem, expected) = &BUSTS[3];
    assert!(bust(stem, &["--aov", text(&aov)]) == *expected, "drawn twice, another picture");

    // Targets stay as they were drawn, four times finer.
    let size = Size { width: 4 * BUST.width, height: 4 * BUST.height };
    let target = |name: &str| {
        let channels = Channels::read(&aov.join(name).with_extension("exr")).unwrap();
        let [r, g, b] = ["R", "G", "B"].map(|name| channels.samples(name, size).unwrap());
        [r, g, b]
    };
    let (irradiance, diffused, material) =
        (target("irradiance"), target("diffused_irradiance"), target("material"));
    for name in ["specular_transmission", "surface_albedo"] {
        assert!(target(name).iter().flatten().all(|value| value.is_finite()), "{name} is not finite");
    }
    // Light spreads over the bust and stays out of the background.
    let (mut covered, mut changed) = (0, 0);
    for pixel in 0..size.pixels() {
        let same = irradiance[0][pixel].to_bits() == diffused[0][pixel].to_bits();
        match material[0][pixel] {
            -1.0 => assert!(same, "background pixel {pixel} has changed"),
            0.0 => {
                covered += 1;
                changed += usize::from(!same);
            }
            other => panic!("material {other} at pixel {pixel}"),
        }
    }
    let part = covered as f64 / size.pixels() as f64;
    assert!((0.2..0.8).contains(&part), "the bust covers {part} of the picture");
    assert!(changed * 10 > covered * 9, "{changed} of {covered} pixels diffused");

    // The targets are what `diffuse` reads.
    let (input, out) = (folder.path().join("in.exr"), folder.path().join("out.exr"));
    let z = material[0].iter().map(|number| if *number < 0.0 { 0.0 } else { 800.0 }).collect();
    let [r, g, b] = irradiance;
    let names = ["irradiance.R", "irradiance.G", "irradiance.B", "Z", "material"];
    let [material, ..] = material;
    write_channels(&input, size, names.into_iter().zip([r, g, b, z, material])).unwrap();
    let common =
        ["diffuse", "--materials", MATERIALS, "--material", "skin", "--taps", "8", "--fov-y-degrees", "24"];
    succeed(&[&common[..], &["--input", text(&input), "--out", text(&out)]].concat());
    assert_eq!(Channels::read(&out).unwrap().size("R").unwrap(), size);
}

#[test]
fn a_contact_sheet_shows_every_tile_and_times_every_pass() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = folder.path().join("sheet.png");
    let arguments = ["contact-sheet", "--materials", MATERIALS, "--size", "24x30", "--supersample", "1"];
    let stdout = succeed(&[&arguments[..], &["--out", text(&sheet)]].concat());
    let lines: Vec<&str> = stdout.lines().collect();
    assert_eq!(lines[0], ADAPTER.as_ref().unwrap());
    let models = subsurface_profile::ModelKind::ALL.iter().filter(|kind| !kind.published().is_empty());
    let captions: Vec<&str> =
        std::iter::once("no subsurface").chain(models.map(|kind| kind.description().caption)).collect();
    assert_eq!(lines.len(), captions.len() + 2, "{stdout}");
    for (line, caption) in lines[1..].iter().zip(&captions) {
        let (found, times) = line.split_once(": ").unwrap();
        assert_eq!(found, *caption);
        for pass in ["shadow", "G-buffer", "subsurface", "composite"] {
            let (_, rest) =
                times.split_once(&format!("{pass} ")).unwrap_or_else(|| panic!("{line} lacks {pass}"));
            let (milliseconds, _) = rest.split_once(" ms").unwrap();
            assert!(milliseconds.parse::<f64>().unwrap() > 0.0, "{line}");
        }
    }
    assert_eq!(lines[captions.len() + 1], text(&sheet));
    let picture = decoded(&fs::read(&sheet).unwrap());
    assert!(picture.width() >= 4 * 24 && picture.height() >= 2 * 30, "{:?}", picture.dimensions());
}

// --------------------------------------------------------------------------------------------------- what cannot be

/// A glTF file of one triangle: nothing to wait for.
fn triangle(folder: &TempDir) -> PathBuf {
    let positions = [0.0f32, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.1, 0.0];
    let normals = [0.0f32, 0.0, 1.0].repeat(3);
    let bytes: Vec<u8> = positions.iter().chain(&normals).flat_map(|value| value.to_le_bytes()).collect();
    fs::write(folder.path().join("triangle.bin"), bytes).unwrap();
    let accessor = |view: usize| {
        serde_json::json!({"bufferView": view, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 1]})
    };
    let indices: Vec<u8> = vec![0, 1, 2];
    fs::write(folder.path().join("indices.bin"), indices).unwrap();
    let json = serde_json::json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "accessors": [accessor(0), accessor(1),
            {"bufferView": 2, "componentType": 5121, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
            {"buffer": 1, "byteLength": 3}],
        "buffers": [{"uri": "triangle.bin", "byteLength": 72}, {"uri": "indices.bin", "byteLength": 3}],
    });
    let path = folder.path().join("triangle.gltf");
    fs::write(&path, json.to_string()).unwrap();
    path
}

#[test]
fn a_picture_beyond_the_device_is_refused_with_the_limit() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, out) = (triangle(&folder), folder.path().join("wide.png"));
    let arguments = ["render", "--materials", MATERIALS, "--mesh", text(&mesh), "--size", "32768x16"];
    let arguments = [&arguments[..], &["--out", text(&out)]].concat();
    // The largest size that the command line takes: a device without a limit below must draw it.
    if subsurface(&arguments).status.success() {
        assert_eq!(decoded(&fs::read(&out).unwrap()).dimensions(), (32768, 16));
        return;
    }
    let text = complaint(&arguments, &folder);
    let (before, after) = text.split_once(" per side").unwrap();
    let (before, limit) = before.rsplit_once(' ').unwrap();
    // At least what WebGPU promises.
    assert!((8192..32768).contains(&limit.parse::<u32>().unwrap()), "{text}");
    insta::assert_snapshot!(format!("{before} [limit] per side{after}"), @r"
    error: a frame of 32768×16 pixels is beyond this device's limit: give at most [limit] per side
      = help: make the picture smaller: --size times --supersample, or the buffers that are given
    ");
    assert!(!out.exists());
}

#[test]
fn without_an_adapter_every_command_that_draws_names_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    // The device comes before the scene: that there is no such file is never found out.
    let (mesh, input) = (folder.path().join("missing.glb"), folder.path().join("in.exr"));
    buffers(&input, |_, _| 1.0, |_, _| 500.0, &[]);
    let (png, exr) = (folder.path().join("a.png"), folder.path().join("a.exr"));
    let (mesh, input, png, exr) = (text(&mesh), text(&input), text(&png), text(&exr));
    let commands: [&[&str]; 4] = [
        &["adapter"],
        &["render", "--materials", MATERIALS, "--mesh", mesh, "--out", png],
        &["contact-sheet", "--materials", MATERIALS, "--mesh", mesh, "--out", png],
        &[
            "diffuse",
            "--materials",
            MATERIALS,
            "--material",
            "skin",
            "--input",
            input,
            "--out",
            exr,
            "--mm-per-pixel",
            "1",
        ],
    ];
    for arguments in commands {
        // A Vulkan loader that finds no driver: the same on every machine.
        let blind = [
            ("VK_DRIVER_FILES", "/nonexistent"),
            ("VK_ICD_FILENAMES", "/nonexistent"),
            ("WGPU_BACKEND", "vulkan"),
        ];
        let output = command(arguments).envs(blind).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        insta::allow_duplicates! {
            insta::assert_snapshot!(stderr_without(&output, &folder), @r"
            error: no graphics adapter
              = help: install a Vulkan driver; one in software will do: on Debian and Ubuntu `apt-get install mesa-vulkan-drivers`, in this repository `cargo xtask demo` does it
            ");
        }
    }
    assert!(!Path::new(png).exists() && !Path::new(exr).exists());
}

// ------------------------------------------------------------------------------------------------------- `diffuse`

/// Size of the buffers.
const SIZE: Size = Size { width: 96, height: 64 };

/// Writes buffers of grey irradiance by (x, y), distance by (x, y), and constant further channels.
fn buffers(
    path: &Path,
    irradiance: impl Fn(u32, u32) -> f32,
    z: impl Fn(u32, u32) -> f32,
    further: &[(&str, f32)],
) {
    let plane = |value: &dyn Fn(u32, u32) -> f32| -> Vec<f32> {
        (0..SIZE.height)
            .flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
            .map(|(x, y)| value(x, y))
            .collect()
    };
    let mut channels = vec![("Z", plane(&z))];
    channels.extend(["irradiance.R", "irradiance.G", "irradiance.B"].map(|name| (name, plane(&irradiance))));
    channels.extend(further.iter().map(|(name, value)| (*name, vec![*value; SIZE.pixels()])));
    write_channels(path, SIZE, channels).unwrap();
}

/// What came out of `diffuse`.
struct Diffused {
    bytes: Vec<u8>,
    channels: [Vec<f32>; 3],
}

impl Diffused {
    /// Means of the columns, for the noise of single pixels to vanish.
    fn columns(&self, channel: usize) -> Vec<f64> {
        let (width, height) = (SIZE.width as usize, SIZE.height as usize);
        let mean =
            |x: usize| (0..height).map(|y| f64::from(self.channels[channel][y * width + x])).sum::<f64>();
        (0..width).map(|x| mean(x) / height as f64).collect()
    }
}

fn diffuse(input: &Path, arguments: &[&str]) -> Diffused {
    let out = input.with_extension("out.exr");
    let material: &[&str] = if arguments.contains(&"--material") { &[] } else { &["--material", "skin"] };
    let common = ["diffuse", "--materials", MATERIALS, "--input", text(input), "--out", text(&out)];
    assert_eq!(succeed(&[&common[..], material, arguments].concat()).trim_end(), text(&out));
    let channels = Channels::read(&out).unwrap();
    assert_eq!(channels.names(), ["B", "G", "R"]);
    Diffused {
        bytes: fs::read(&out).unwrap(),
        channels: ["R", "G", "B"].map(|name| channels.samples(name, SIZE).unwrap()),
    }
}

/// A step from 0 to 1 in the middle.
fn step(x: u32, _: u32) -> f32 {
    if x < SIZE.width / 2 { 0.0 } else { 1.0 }
}

/// Distance of a flat sheet (mm).
const SHEET_MM: f32 = 500.0;

fn sheet(_: u32, _: u32) -> f32 {
    SHEET_MM
}

/// Relative error of irradiance that kernels pack: the shared exponent leaves 9 bits, half of a step is 1/512 at worst,
/// and kernels of two stages pack twice.
const PACKING: f32 = 2.0 / 512.0;

#[test]
fn constant_irradiance_stays_constant() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.exr");
    // A tilted sheet: the distances differ, the irradiance does not.
    buffers(&input, |_, _| 0.7, |x, y| SHEET_MM + 0.2 * x as f32 + 0.1 * y as f32, &[]);
    for scale in [["--mm-per-pixel", "0.2"], ["--fov-y-degrees", "24"]] {
        for value in diffuse(&input, &scale).channels.iter().flatten() {
            assert!((value / 0.7 - 1.0).abs() < PACKING, "{scale:?}: {value}");
        }
    }
}

#[test]
fn background_passes_through_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.exr");
    // Any number but those below f32's normal range, which a GPU may take as zero.
    let given = |x: u32, y: u32| [0.1, -3.5, 0.0, 1e30, f32::INFINITY, 7.0e-20][((x * 5 + y) % 6) as usize];
    let is_background = |x: u32| !(20..70).contains(&x);
    let irradiance = |x: u32, y: u32| if is_background(x) { given(x, y) } else { 0.5 };
    let z = |x: u32, _: u32| {
        if x < 20 {
            0.0
        } else if x >= 70 {
            f32::INFINITY
        } else {
            SHEET_MM
        }
    };
    buffers(&input, irradiance, z, &[]);
    let diffused = diffuse(&input, &["--mm-per-pixel", "0.2"]);
    for channel in &diffused.channels {
        for (pixel, value) in channel.iter().enumerate() {
            let (x, y) = (pixel as u32 % SIZE.width, pixel as u32 / SIZE.width);
            if is_background(x) {
                assert_eq!(value.to_bits(), given(x, y).to_bits(), "({x}, {y})");
            } else {
                // And nothing of it bleeds into the surface.
                assert!((value / 0.5 - 1.0).abs() < 1e-3, "({x}, {y}): {value}");
            }
        }
    }
}

#[test]
fn a_step_edge_softens_alike_on_both_sides() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.exr");
    buffers(&input, step, sheet, &[]);
    let diffused = diffuse(&input, &["--mm-per-pixel", "0.25", "--taps", "64"]);
    let middle = SIZE.width as usize / 2;
    for channel in 0..3 {
        let columns = diffused.columns(channel);
        let at_edge = columns[middle];
        assert!((0.5..0.9).contains(&at_edge), "channel {channel}: the edge is at {at_edge}");
        let worst = (0..middle - 16).map(|k| (columns[middle + k] + columns[middle - 1 - k] - 1.0).abs());
        let worst = worst.fold(0.0, f64::max);
        println!("channel {channel}: {at_edge:.4} beside the edge, asymmetry {worst:.5}");
        // Twice what was measured. Taps snap to pixels, and 64 rows leave an eighth of a pixel's noise in the mean.
        assert!(worst < 0.01, "channel {channel}: {worst}");
    }
    // Red light goes farthest in skin: it leaves most beyond the edge.
    let beyond: Vec<f64> = (0..3).map(|channel| diffused.columns(channel)[middle - 4]).collect();
    assert!(beyond[0] > beyond[1] && beyond[1] > beyond[2], "{beyond:?}");
}

#[test]
fn another_frame_of_a_sequence_changes_the_noise_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.exr");
    buffers(&input, step, sheet, &[]);
    let arguments = ["--mm-per-pixel", "0.25", "--kernel", "importance-sampled:16", "--frame-index"];
    let with = |index| diffuse(&input, &[&arguments[..], &[index]].concat());
    let (zero, again, seven) = (with("0"), with("0"), with("7"));
    assert!(zero.bytes == again.bytes, "the same frame gave other bytes");
    assert!(zero.channels != seven.channels, "another frame gave the same noise");
    let worst =
        zero.columns(0).into_iter().zip(seven.columns(0)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("columns differ by {worst:.5}");
    // Twice what was measured: 64 rows leave an eighth of a pixel's noise, and two pictures are compared.
    assert!(worst < 0.03, "{worst}");
}

#[test]
fn both_scales_agree_on_a_flat_sheet() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.exr");
    buffers(&input, step, sheet, &[]);
    let fov_y_degrees = 2.0f32;
    let millimetres = 2.0 * (0.5 * fov_y_degrees).to_radians().tan() * SHEET_MM / SIZE.height as f32;
    let flat = diffuse(&input, &["--mm-per-pixel", &millimetres.to_string()]);
    let perspective = diffuse(&input, &["--fov-y-degrees", &fov_y_degrees.to_string()]);
    for channel in 0..3 {
        for (a, b) in flat.columns(channel).into_iter().zip(perspective.columns(channel)) {
            // A rounding of the scale may move a few taps by a pixel.
            assert!((a - b).abs() < 1e-3, "{a} {b}");
        }
    }
}

#[test]
fn albedo_and_material_may_come_with_the_buffers() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.exr");
    let scale = ["--mm-per-pixel", "0.25", "--material"];
    let with = |material: &str, further: &[(&str, f32)]| {
        buffers(&input, step, sheet, further);
        diffuse(&input, &[&scale[..], &[material]].concat()).channels
    };
    // Numbers count the names of the set in alphabetical order.
    let mut names: Vec<String> = fs::read_dir(MATERIALS)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        // What is clear has no number.
        .filter(|path| fs::read_to_string(path).unwrap().lines().any(|line| line.starts_with("Material(")))
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        // Says how the set is diffused, and is no material.
        .filter(|name| name != "set")
        .collect();
    names.sort();
    let number = |name: &str| names.iter().position(|known| known == name).unwrap() as f32;
    let (skin, marble) = (with("skin", &[]), with("marble", &[]));
    assert!(skin != marble);
    assert!(with("skin", &[("material", number("marble"))]) == marble);
    assert!(with("marble", &[("material", number("skin"))]) == skin);

    let albedo = |[r, g, b]: [f32; 3]| [("albedo.R", r), ("albedo.G", g), ("albedo.B", b)];
    assert!(with("skin", &albedo([0.2, 0.2, 0.2])) != skin);
}

#[test]
fn wrong_buffers_are_refused_by_channel_and_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let (input, out) = (folder.path().join("in.exr"), folder.path().join("out.exr"));
    let materials = folder.path().join("materials");
    fs::create_dir(&materials).unwrap();
    fs::write(materials.join("skin.ron"), skin("burley_diffuse")).unwrap();
    let arguments =
        ["diffuse", "--materials", text(&materials), "--material", "skin", "--mm-per-pixel", "0.25"];
    let arguments = [&arguments[..], &["--input", text(&input), "--out", text(&out)]].concat();
    let mut complaints = String::new();
    let mut refuse = || {
        complaints += &complaint(&arguments, &folder);
        complaints += "\n\n";
    };
    let plane = || vec![1.0; SIZE.pixels()];
    write_channels(&input, SIZE, [("irradiance.R", plane()), ("irradiance.B", plane()), ("Z", plane())])
        .unwrap();
    refuse();
    let names = ["irradiance.R", "irradiance.G", "irradiance.B"];
    write_channels(&input, SIZE, names.map(|name| (name, plane()))).unwrap();
    refuse();
    buffers(&input, |x, y| if (x, y) == (3, 2) { f32::NAN } else { 1.0 }, sheet, &[]);
    refuse();
    buffers(&input, step, |x, y| if (x, y) == (95, 63) { -1.0 } else { 1.0 }, &[]);
    refuse();
    buffers(&input, step, sheet, &[("albedo.R", 0.5), ("albedo.G", 0.5), ("albedo.B", 1.5)]);
    refuse();
    buffers(&input, step, sheet, &[("material", 0.5)]);
    refuse();
    fs::write(&input, b"no picture").unwrap();
    refuse();
    insta::assert_snapshot!(complaints.trim_end(), @r"
    error: in.exr has no channel `irradiance.G`
      = help: the file has: Z, irradiance.B, irradiance.R

    error: in.exr has no channel `Z`
      = help: the file has: irradiance.B, irradiance.G, irradiance.R

    error: in.exr: channel `irradiance` has [NaN, NaN, NaN] at pixel (3, 2)
      = help: repair the renderer that wrote it, or mark the pixel as background with Z = 0

    error: in.exr: channel `Z` has -1 at pixel (95, 63)
      = help: repair the renderer that wrote it, or mark the pixel as background with Z = 0

    error: in.exr: channel `albedo` has [0.5, 0.5, 1.5], outside [0, 1], at pixel (0, 0)
      = help: repair the renderer that wrote it, or mark the pixel as background with Z = 0

    error: in.exr: channel `material` has 0.5, not in 0..1, at pixel (0, 0)
      = help: repair the renderer that wrote it, or mark the pixel as background with Z = 0

    error: cannot read in.exr: invalid: file identifier missing
      = help: check the path; expected an OpenEXR file with flat (not deep) pixels
    ");
    assert!(!out.exists());
}
