//! Kernels, debug views and their benchmark, run as people run them.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
#![allow(clippy::print_stdout, reason = "measured values, shown with a failure, to set bounds by")]

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use subsurface_cli::picture::exr::{Channels, write_channels};
use subsurface_cli::scene::camera::Size;
use tempfile::TempDir;

/// Materials as the repository has them.
const MATERIALS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../materials");

/// Size of the buffers.
const SIZE: Size = Size { width: 32, height: 32 };

fn subsurface(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_subsurface"));
    // A Vulkan loader complains on standard error where there is no such folder.
    command.args(arguments).env("XDG_RUNTIME_DIR", std::env::temp_dir()).output().unwrap()
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
    let prefix = format!("{}{}", folder.path().display(), std::path::MAIN_SEPARATOR);
    String::from_utf8(output.stderr).unwrap().replace(&prefix, "").trim_end().to_owned()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A grey step in the middle of a flat sheet, with a frame of background.
fn step(folder: &TempDir) -> PathBuf {
    let path = folder.path().join("step.exr");
    let plane = |value: fn(u32, u32) -> f32| -> Vec<f32> {
        (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| value(x, y))).collect()
    };
    let light = |x, _| if x < SIZE.width / 2 { 0.1 } else { 1.0 };
    let z = |x, y| if (2..30).contains(&x) && (2..30).contains(&y) { 500.0 } else { 0.0 };
    let names = ["irradiance.R", "irradiance.G", "irradiance.B"];
    let channels = names.map(|name| (name, plane(light)));
    write_channels(&path, SIZE, channels.into_iter().chain([("Z", plane(z))])).unwrap();
    path
}

// ----------------------------------------------------------------------------------------------------- `bench kernels`

/// Cells of a CSV text, by line.
fn cells(csv: &str) -> Vec<Vec<&str>> {
    csv.lines().map(|line| line.splitn(20, ',').collect()).collect()
}

#[test]
fn every_kernel_has_a_line_of_finite_figures() {
    let folder = tempfile::tempdir().unwrap();
    let (input, plot) = (step(&folder), folder.path().join("plot.svg"));
    let arguments = ["bench", "kernels", "--materials", MATERIALS, "--input", text(&input), "--repeats", "1"];
    let scale = ["--mm-per-pixel", "0.4"];
    let profile = ["--profile", "burley_searchlight"];
    let files = ["--csv", "-", "--plot", text(&plot)];
    let printed = succeed(&[&arguments[..], &scale, &profile, &files].concat());
    let (csv, plots) = printed.split_at(printed.find(text(&plot)).unwrap_or(printed.len()));
    let lines = cells(csv);
    let head = [
        "case",
        "profile",
        "kernel",
        "taps",
        "path",
        "width",
        "height",
        "translucent_pixels",
        "mean_radius_mm",
        "mean_radius_pixels",
        "white",
        "rmse",
        "rmse_red",
        "rmse_green",
        "rmse_blue",
        "psnr_db",
        "witness_psnr_db",
        "milliseconds",
        "time_ratio",
        "adapter",
    ];
    assert_eq!(lines[0], head);
    let column = |name: &str| head.iter().position(|known| *known == name).unwrap();
    let kernels = |profile: &str| -> Vec<String> {
        let own = lines[1..].iter().filter(|line| line[column("profile")] == profile);
        own.map(|line| format!("{}:{}", line[column("kernel")], line[column("taps")])).collect()
    };
    let mut expected: Vec<String> =
        [17, 9, 33, 65].iter().map(|taps| format!("importance-sampled:{taps}")).collect();
    expected.extend([1, 2, 3, 4, 6, 8, 16].map(|taps| format!("interleaved:{taps}")));
    expected.extend([11, 17, 25].map(|taps| format!("separable:{taps}")));
    for profile in ["two_exponential_dipole_searchlight", "burley_searchlight"] {
        assert_eq!(kernels(profile), expected);
    }
    for line in &lines[1..] {
        assert_eq!(line[column("translucent_pixels")], (28 * 28).to_string());
        for name in &head[5..19] {
            let value: f64 = line[column(name)].parse().unwrap();
            assert!(value.is_finite() && value > 0.0, "{name} is {value} in {line:?}");
        }
        // What they approximate is the same: no kernel is farther off than a tenth of the step.
        assert!(line[column("rmse")].parse::<f64>().unwrap() < 0.09, "{line:?}");
        if line[column("kernel")] == "importance-sampled" && line[column("taps")] == "17" {
            assert_eq!(line[column("time_ratio")], "1", "the yardstick is its own measure");
        }
    }
    let second = folder.path().join("plot-burley_searchlight.svg");
    assert_eq!(plots.lines().collect::<Vec<_>>(), [text(&plot), text(&second)]);
    for path in [&plot, &second] {
        let svg = fs::read_to_string(path).unwrap();
        assert!(svg.contains("interleaved") && svg.contains("separable") && svg.contains("step"), "{svg}");
    }
}

#[test]
fn a_scene_is_seen_at_the_footprint_that_is_asked_for() {
    let arguments = ["bench", "kernels", "--materials", MATERIALS, "--size", "32x32", "--repeats", "1"];
    let kernels = ["--kernel", "interleaved:2", "--kernel", "separable:3"];
    let printed = succeed(&[&arguments[..], &kernels, &["--footprints", "1.5,6"]].concat());
    for footprint in [1.5, 6.0] {
        let title = printed.lines().find(|line| line.starts_with(&format!("bust {footprint} px, "))).unwrap();
        let (_, rest) = title.split_once(" mm or ").unwrap();
        let measured: f64 = rest.split_once(" pixels").unwrap().0.parse().unwrap();
        println!("{measured} of {footprint}");
        // The camera is moved until the median pixel has that footprint; its surface is still another one afterwards.
        assert!((measured / footprint - 1.0).abs() < 0.05, "{title}");
    }
    for kernel in ["importance-sampled", "interleaved", "separable"] {
        let count = printed.lines().filter(|line| line.split_whitespace().next() == Some(kernel)).count();
        // A line in each table, and the heading of the goals.
        assert!(count >= 2, "{kernel}: {printed}");
    }
    assert!(printed.contains("importance-sampled 17"), "the yardstick is a rival: {printed}");
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("empty.exr");
    let names = ["irradiance.R", "irradiance.G", "irradiance.B", "Z"];
    write_channels(&input, SIZE, names.map(|name| (name, vec![0.0; SIZE.pixels()]))).unwrap();
    let arguments = ["bench", "kernels", "--materials", MATERIALS, "--input", text(&input)];
    let with = |more: &[&str]| complaint(&[&arguments[..], &["--mm-per-pixel", "1"], more].concat(), &folder);
    insta::assert_snapshot!(with(&[]), @r"
    error: empty.exr: no pixel scatters, Z is 0 everywhere
      = help: give distances in mm where there is a surface
    ");
    assert!(with(&["--profile", "no_such_profile"]).contains("no_such_profile"));
    let nowhere = folder.path().join("no/such/kernels.csv");
    assert!(with(&["--csv", text(&nowhere)]).contains("does not exist"));
}

// ------------------------------------------------------------------------------------------------- kernels and views

/// What comes of diffusing the step.
fn diffused(folder: &TempDir, arguments: &[&str]) -> Vec<[f32; 3]> {
    let (input, out) = (step(folder), folder.path().join("out.exr"));
    let common = ["diffuse", "--materials", MATERIALS, "--material", "skin", "--mm-per-pixel", "0.4"];
    succeed(&[&common[..], &["--input", text(&input), "--out", text(&out)], arguments].concat());
    let channels = Channels::read(&out).unwrap();
    let [r, g, b] = ["R", "G", "B"].map(|name| channels.samples(name, SIZE).unwrap());
    r.into_iter().zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect()
}

/// Root mean square difference.
fn rmse(a: &[[f32; 3]], b: &[[f32; 3]]) -> f64 {
    let squares = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| f64::from(a - b).powi(2));
    (squares.sum::<f64>() / (3 * a.len()) as f64).sqrt()
}

#[test]
fn every_kernel_comes_near_the_dense_one_on_both_paths() {
    let folder = tempfile::tempdir().unwrap();
    let dense = diffused(&folder, &["--kernel", "dense"]);
    let sharp = diffused(&folder, &["--mean-free-path-scale", text(&scale(&folder, 0.0))]);
    let blur = rmse(&dense, &sharp);
    for kernel in ["interleaved", "interleaved:16", "importance-sampled:64", "separable", "separable-rotated"]
    {
        let [compute, fragment] =
            ["compute", "fragment"].map(|path| diffused(&folder, &["--kernel", kernel, "--path", path]));
        let (error, between) = (rmse(&dense, &compute), rmse(&compute, &fragment));
        println!("{kernel}: {error:.5} from dense, of {blur:.5}; the paths differ by {between:.2e}");
        // The picture that is not diffused at all is a `blur` away: half of it is what a kernel must have done at least.
        // Separable kernels come to a third, at the corners of the sheet.
        assert!(error < 0.5 * blur, "{kernel}: {error} of {blur}");
        assert!(compute != sharp);
        // 60 dB below the step.
        assert!(between < 1e-3, "{kernel}: {between}");
    }
}

#[test]
fn taps_override_the_kernel_s_own_number() {
    let folder = tempfile::tempdir().unwrap();
    let with = |arguments: &[&str]| diffused(&folder, arguments);
    assert!(with(&["--kernel", "interleaved:2", "--taps", "9"]) == with(&["--kernel", "interleaved:9"]));
    assert!(with(&["--kernel", "interleaved:2"]) != with(&["--kernel", "interleaved:9"]));
    // Without --kernel, the number goes to that of the material set.
    assert!(with(&["--taps", "9"]) == with(&["--kernel", "interleaved:9"]));
    let arguments = ["diffuse", "--materials", MATERIALS, "--material", "skin", "--mm-per-pixel", "1"];
    let (input, out) = (step(&folder), folder.path().join("out.exr"));
    let files = ["--input", text(&input), "--out", text(&out)];
    let refused = |more: &[&str]| complaint(&[&arguments[..], &files, more].concat(), &folder);
    insta::assert_snapshot!(refused(&["--kernel", "separable", "--taps", "8"]), @r"
    error: --taps 8: separable has an odd number of taps from 3 to 65, not 8
      = help: choose another number, or another --kernel
    ");
    insta::assert_snapshot!(refused(&["--kernel", "dense", "--taps", "8"]), @r"
    error: --taps 8: dense reads every pixel in reach: it has no number of taps
      = help: choose another number, or another --kernel
    ");
}

#[test]
fn a_shape_is_chosen_where_there_are_two() {
    let folder = tempfile::tempdir().unwrap();
    let [hardware, software] =
        ["hardware", "software"].map(|shape| diffused(&folder, &["--path", "compute", "--shape", shape]));
    let between = rmse(&hardware, &software);
    println!("between the shapes: {between:.1e}");
    // 100 dB below the step.
    assert!(between < 1e-5, "{between}");
    let arguments = ["diffuse", "--materials", MATERIALS, "--material", "skin", "--mm-per-pixel", "1"];
    let (input, out) = (step(&folder), folder.path().join("out.exr"));
    let files = ["--input", text(&input), "--out", text(&out), "--shape", "hardware"];
    let refused = |more: &[&str]| complaint(&[&arguments[..], &files, more].concat(), &folder);
    insta::assert_snapshot!(refused(&["--kernel", "separable"]), @r"
    error: --shape: this kernel shares its work in one way on every device
      = help: leave out --shape, or take --path compute and a kernel `interleaved`
    ");
    insta::assert_snapshot!(refused(&["--path", "fragment"]), @r"
    error: --shape: fragment shaders share their work in one way
      = help: leave out --shape, or take --path compute and a kernel `interleaved`
    ");
}

/// A file with the factor `scale` everywhere.
fn scale(folder: &TempDir, scale: f32) -> PathBuf {
    let path = folder.path().join("scale.exr");
    write_channels(&path, SIZE, [("Y", vec![scale; SIZE.pixels()])]).unwrap();
    path
}

#[test]
fn the_mean_free_path_scales_the_blur() {
    let folder = tempfile::tempdir().unwrap();
    let with = |factor| diffused(&folder, &["--mean-free-path-scale", text(&scale(&folder, factor))]);
    let none = diffused(&folder, &[]);
    assert!(with(1.0) == none, "a factor of 1 changes nothing");
    // Light that goes nowhere leaves the step, to 9 bits of a shared exponent.
    let step: Vec<[f32; 3]> =
        (0..SIZE.pixels()).map(|pixel| [if pixel % 32 < 16 { 0.1 } else { 1.0 }; 3]).collect();
    let [still, half, twice] = [0.0, 0.5, 2.0].map(|factor| rmse(&with(factor), &step));
    let full = rmse(&none, &step);
    println!("away from the step: {still:.5} {half:.5} {full:.5} {twice:.5}");
    assert!(still < 1e-3 && still < half && half < full && full < twice);
}

#[test]
fn a_wrong_scale_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (input, out) = (step(&folder), folder.path().join("out.exr"));
    let common = ["diffuse", "--materials", MATERIALS, "--material", "skin", "--mm-per-pixel", "0.4"];
    let files = ["--input", text(&input), "--out", text(&out), "--mean-free-path-scale"];
    let refused = |path: &Path| complaint(&[&common[..], &files, &[text(path)]].concat(), &folder);
    insta::assert_snapshot!(refused(&scale(&folder, -1.0)), @r"
    error: scale.exr: channel `Y` has -1 at pixel (0, 0)
      = help: repair the renderer that wrote it, or mark the pixel as background with Z = 0
    ");
    let small = folder.path().join("small.exr");
    write_channels(&small, Size { width: 2, height: 2 }, [("R", vec![1.0; 4])]).unwrap();
    insta::assert_snapshot!(refused(&small), @r"
    error: small.exr: channel `R` is 2x2 pixels, expected 32x32
      = help: all channels must cover the same pixels, without subsampling
    ");
}

#[test]
fn every_debug_view_shows_something() {
    let folder = tempfile::tempdir().unwrap();
    let views = ["taps", "filter-radius", "rejected-energy", "near-share", "variance", "tiles"];
    let mut pictures = HashSet::new();
    for view in views {
        let out = folder.path().join(view).with_extension("png");
        let arguments = ["render", "--materials", MATERIALS, "--size", "64x80", "--debug", view];
        succeed(&[&arguments[..], &["--out", text(&out)]].concat());
        let bytes = fs::read(&out).unwrap();
        let picture = image::load_from_memory(&bytes).unwrap().into_rgb8();
        let colours: HashSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
        println!("{view}: {} colours", colours.len());
        assert!(colours.len() > 1, "{view} is all one colour");
        assert!(pictures.insert(bytes), "{view} is the same picture as another view");
    }
}
