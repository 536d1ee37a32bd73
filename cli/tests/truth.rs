//! `export` and `compare`, run as people run them.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use subsurface_cli::picture::exr::{Channels, write_channels};
use subsurface_cli::scene::camera::Size;
use tempfile::TempDir;

const MATERIALS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../reference/pictures/materials");

fn subsurface(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_subsurface"));
    command.args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Exports to `out` of the folder; what was said on standard error.
fn export(folder: &TempDir, arguments: &[&str]) -> String {
    let out = folder.path().join("out");
    let first = ["export", "--to", "mitsuba", "--materials", MATERIALS, "--material", "matched"];
    let output = subsurface(&[&first[..], &["--out", out.to_str().unwrap()], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stderr)
}

/// The one value of this name in a scene.
fn value(xml: &str, name: &str) -> f64 {
    let after = xml.split(&format!("name=\"{name}\" value=\"")).nth(1).unwrap();
    after.split('"').next().unwrap().parse().unwrap()
}

#[test]
fn a_scene_is_exported_in_millimetres_with_the_medium_of_its_material() {
    let folder = tempfile::tempdir().unwrap();
    let light = ["--light=0,-3,-4,0.5", "--camera", "0,0,0.5", "--target", "0,0,0", "--ambient", "0.25"];
    let warnings = export(&folder, &[&["--scene", "ellipsoid"], &light[..]].concat());
    assert_eq!(warnings, "", "nothing is left out of this scene");
    let scene = |name: &str| fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let (red, blue) = (scene("red.xml"), scene("blue.xml"));
    assert!(red.contains("origin=\"0, 0, 500\""), "{red}");
    // Written as f32 and f64 give them.
    assert!(
        (value(&red, "scale") - 1.0 / 1.3).abs() < 1e-9 && (value(&blue, "scale") - 1.0 / 0.67).abs() < 1e-9
    );
    assert!((value(&red, "albedo") - 0.99534).abs() < 1e-3, "that of A = 0.83: {}", value(&red, "albedo"));
    assert!((value(&red, "irradiance") - std::f64::consts::PI / 2.0).abs() < 1e-6);
    assert!((value(&red, "radiance") - 0.25).abs() < 1e-6);
    let ply = fs::read(folder.path().join("out/object_0.ply")).unwrap();
    assert!(ply.starts_with(b"ply\nformat binary_little_endian 1.0\ncomment millimetres\n"));
    // 24 bytes per vertex and 13 per triangle.
    let header = ply.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let count = |element: &str| -> usize {
        let text = String::from_utf8_lossy(&ply[..header]).into_owned();
        text.split(&format!("element {element} ")).nth(1).unwrap().lines().next().unwrap().parse().unwrap()
    };
    assert_eq!(ply.len(), header + 24 * count("vertex") + 13 * count("face"));
}

#[test]
fn an_environment_is_exported_by_channel_with_the_ambient_light() {
    let folder = tempfile::tempdir().unwrap();
    let sky = folder.path().join("sky.exr");
    let size = Size { width: 8, height: 4 };
    let planes =
        [("R", 0.5_f32), ("G", 0.25), ("B", 2.0)].map(|(name, value)| (name, vec![value; size.pixels()]));
    write_channels(&sky, size, planes).unwrap();
    let arguments =
        ["--scene", "sphere", "--light=0,-1,0,0", "--ambient", "0.1", "--environment-intensity", "2"];
    export(&folder, &[&arguments[..], &["--environment", sky.to_str().unwrap()]].concat());
    for (name, expected) in [("red", 1.1), ("green", 0.6), ("blue", 4.1_f32)] {
        let file = folder.path().join("out").join(format!("environment_{name}.exr"));
        let value = Channels::read(&file).unwrap().samples("R", size).unwrap()[0];
        assert!((value - expected).abs() < 1e-6, "{name}: {value}");
        let xml = fs::read_to_string(folder.path().join("out").join(name).with_extension("xml")).unwrap();
        assert!(xml.contains(&format!("environment_{name}.exr")) && !xml.contains("\"constant\""), "{xml}");
    }
}

#[test]
fn what_a_path_tracer_has_otherwise_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let rough = ["--scene", "sphere", "--material", "matched", "--materials"];
    let glossy = folder.path().join("materials");
    fs::create_dir(&glossy).unwrap();
    let skin = "Material(profile: \"burley_searchlight\", mean_free_path_mm: (1, 1, 1), surface_albedo: (0.5, 0.5, 0.5), \
                thin: (thickness_mm: 0.2))";
    fs::write(glossy.join("matched.ron"), skin).unwrap();
    let run = |arguments: &[&str]| {
        let first = ["export", "--to", "mitsuba", "--out", folder.path().to_str().unwrap()];
        let output = subsurface(&[&first[..], &rough, &[glossy.to_str().unwrap()], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    let matched = run(&["--light=0,0,-1"]);
    assert!(matched.contains("without highlights") && matched.contains("is a thin sheet"), "{matched}");
    let dark = run(&["--light=0,0,-1", "--boundary", "rough"]);
    assert!(dark.contains("cannot be sampled through a boundary"), "{dark}");
    let spot = run(&["--spot", "0,0,1,0,0,-1,60"]);
    assert!(spot.contains("falls off by the angle"), "{spot}");
    let sky = run(&["--light=0,0,-1,0", "--ambient", "1"]);
    assert!(!sky.contains("boundary"), "{sky}");
    let xml = fs::read_to_string(folder.path().join("green.xml")).unwrap();
    assert!(xml.contains("roughdielectric") && !xml.contains("directional"));
}

const SIZE: Size = Size { width: 24, height: 16 };

/// A picture of a grey ramp, times a factor.
fn ramp(path: &Path, factor: f32, size: Size) {
    let plane = || (0..size.pixels()).map(|pixel| factor * (0.2 + pixel as f32 * 1e-3)).collect::<Vec<f32>>();
    write_channels(path, size, ["R", "G", "B"].map(|name| (name, plane()))).unwrap();
}

#[test]
fn a_picture_is_compared_with_a_truth() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    ramp(Path::new(&path("truth.exr")), 1.0, SIZE);
    ramp(Path::new(&path("bright.exr")), 1.1, SIZE);
    let output = subsurface(&["compare", &path("bright.exr"), &path("truth.exr"), "--map", &path("map.png")]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let said = text(&output.stdout);
    assert!(
        said.contains("mean ratio") && said.contains("1.1000") && said.contains("384 of 384 pixels"),
        "{said}"
    );
    let map = image::open(path("map.png")).unwrap().to_rgb8();
    assert!(map.pixels().all(|pixel| pixel.0[0] == 255 && pixel.0[1] < 255), "all of it is too bright");

    ramp(Path::new(&path("small.exr")), 1.0, Size { width: 12, height: 8 });
    let output = subsurface(&["compare", &path("small.exr"), &path("truth.exr")]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("help: draw it with --size 24x16"), "{}", text(&output.stderr));

    let broken: Vec<f32> = (0..SIZE.pixels()).map(|pixel| if pixel == 25 { f32::NAN } else { 0.5 }).collect();
    write_channels(Path::new(&path("broken.exr")), SIZE, ["R", "G", "B"].map(|name| (name, broken.clone())))
        .unwrap();
    let output = subsurface(&["compare", &path("broken.exr"), &path("truth.exr")]);
    assert!(text(&output.stderr).contains("pixel (1, 1) is"), "{}", text(&output.stderr));

    write_channels(Path::new(&path("black.exr")), SIZE, ["R", "G", "B"].map(|name| (name, vec![0.0; 384])))
        .unwrap();
    let output = subsurface(&["compare", &path("truth.exr"), &path("black.exr")]);
    assert!(text(&output.stderr).contains("no pixel counts"), "{}", text(&output.stderr));
}
