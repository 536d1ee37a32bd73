//! What a set becomes.

use super::*;
use subsurface_kernel::Rejected;

const LENGTH_AND_ALBEDO: &str = "mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.8, 0.6, 0.4)";

fn material(profile: &str) -> String {
    format!("Material(profile: {profile}, {LENGTH_AND_ALBEDO})")
}

fn compile(files: &[(&str, String)]) -> Compilation {
    let files = files.iter().map(|(path, text)| (*path, text.as_str()));
    Compiler::from_memory(files).compile().unwrap_or_else(|report| panic!("{report}"))
}

#[test]
fn only_the_models_in_use_are_linked_in() {
    let one = compile(&[("a.ron", material("Burley(parametrization: Diffuse)"))]);
    assert!(one.wgsl().contains("fn burley_radial_cdf"));
    for other in ["polynomial", "gaussian_sum", "exponential_dipole"] {
        assert!(
            !one.wgsl().contains(&format!("fn {other}")) && !one.wgsl().contains(&format!("{other}:")),
            "{other}"
        );
    }
    assert!(!one.wgsl().contains("switch profile.model"), "one model needs no switch");
    let two = compile(&[
        ("a.ron", material("Burley(parametrization: Diffuse)")),
        ("b.ron", material("ExponentialDipole(entry: Searchlight)")),
    ]);
    assert!(
        two.wgsl().contains("switch profile.model")
            && two.wgsl().contains("fn exponential_dipole_radial_cdf")
    );
}

#[test]
fn dead_functions_are_dropped_with_the_pass_that_used_them() {
    let files = [("a.ron", material("Burley(parametrization: Diffuse)"))];
    let whole = compile(&files);
    assert!(whole.wgsl().contains("fn gbuffer_fragment") && whole.wgsl().contains("fn transmitted("));
    let files = files.iter().map(|(path, text)| (*path, text.as_str()));
    let lean = Compiler::from_memory(files).without_gbuffer().compile().unwrap_or_else(|r| panic!("{r}"));
    for name in ["fn gbuffer_fragment", "fn transmitted(", "fn shadow_visibility", "fn specular_reflection"] {
        assert!(!lean.wgsl().contains(name), "{name} is dead without the G-buffer pass");
    }
}

#[test]
fn the_order_of_the_files_changes_no_byte() {
    let names = ["apple.ron", "bone.ron", "cream.ron", "profiles/mine.ron"];
    let text = |name: &str| match name {
        "profiles/mine.ron" => {
            "GaussianSum([(variance_mm2: 0.5, weight: 0.8), (variance_mm2: 2, weight: 0.2)])".to_owned()
        }
        "bone.ron" => material("\"mine\""),
        _ => material("Burley(parametrization: Searchlight)"),
    };
    let compiled = |order: &[usize]| {
        let files: Vec<_> = order.iter().map(|&i| (names[i], text(names[i]))).collect();
        let compilation = compile(&files);
        (compilation.rust, compilation.manifest, compilation.parts)
    };
    let first = compiled(&[0, 1, 2, 3]);
    assert!(first == compiled(&[3, 2, 1, 0]) && first == compiled(&[2, 0, 3, 1]));
}

#[test]
fn provenance_follows_the_inputs() {
    let a = compile(&[("a.ron", material("Burley(parametrization: Diffuse)"))]);
    let same = compile(&[("a.ron", material("Burley(parametrization: Diffuse)"))]);
    let other = compile(&[("a.ron", material("Burley(parametrization: Searchlight)"))]);
    assert_eq!(a.provenance, same.provenance);
    assert_ne!(a.provenance, other.provenance);
    assert!(
        a.wgsl().contains(&a.provenance)
            && a.rust.contains(&a.provenance)
            && a.manifest.contains(&a.provenance)
    );
}

#[test]
fn equal_gaussian_sums_share_their_terms() {
    let skin = || material("\"gaussian_skin\"");
    let compilation = compile(&[("a.ron", skin()), ("b.ron", skin())]);
    // A row for each channel, and one that the six terms begin; then those of the lobe.
    assert_eq!(compilation.parts.curve_size(), [64, 4 + 66]);
    let term = |index: usize| -> Vec<f32> {
        let texel = &compilation.parts.profile_curves()[16 * (3 * 64 + index)..][..16];
        texel.chunks(4).map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four bytes"))).collect()
    };
    assert_eq!(term(0), [0.233, 0.455, 0.649, 0.0064]);
    assert_eq!(term(5), [0.078, 0.0, 0.0, 7.41]);
    assert_eq!(term(6), [0.0; 4], "two materials, six terms");
}

#[test]
fn the_longest_of_a_set_decides_how_much_is_written_out() {
    let sum =
        |terms: usize| format!("GaussianSum([{}])", "(variance_mm2: 1, weight: (1, 1, 1)), ".repeat(terms));
    // Bins of radius: a table has a knot more.
    let csv = |bins: usize| {
        let rows = (0..bins).map(|bin| format!("{bin},{},0.1\n", bin + 1)).collect::<String>();
        format!("r_lo,r_hi,radial_reflectance\n{rows}")
    };
    let table = |name: &str| material(&format!("Tabulated(file: \"{name}\")"));
    for [first, second] in [[2, 9], [9, 2]] {
        let files = [("a.ron", material(&sum(first))), ("b.ron", material(&sum(second)))];
        let sums = compile(&files).wgsl().to_owned();
        assert_eq!(sums.matches("sum += gaussian_term_area_pdf(").count(), 9, "{first} and {second} terms");
        let files = [
            ("a.ron", table("first.csv")),
            ("b.ron", table("second.csv")),
            ("first.csv", csv(first)),
            ("second.csv", csv(second)),
        ];
        let tables = compile(&files).wgsl().to_owned();
        assert_eq!(tables.matches("start = tabulated_stride(").count(), 4, "{first} and {second} pieces");
    }
}

#[test]
fn a_runtime_path_that_is_none_is_refused() {
    let files = [("a.ron", material("Burley(parametrization: Diffuse)"))];
    let files = files.iter().map(|(path, text)| (*path, text.as_str()));
    let report = Compiler::from_memory(files).runtime_path("not a path").compile().expect_err("no path");
    assert!(report.render(false).contains("`not a path` is no Rust path"));
}

#[test]
fn too_many_materials_are_refused() {
    let files: Vec<_> = (0..=MATERIAL_LIMIT)
        .map(|i| (format!("m{i}.ron"), material("Burley(parametrization: Diffuse)")))
        .collect();
    let report = Compiler::from_memory(files).compile().expect_err("2049 materials");
    assert!(report.render(false).contains("a set holds at most 2048"));
}

#[test]
fn the_parameter_table_is_a_uniform_buffer_where_it_fits() {
    let set = |count: usize| -> Vec<(String, String)> {
        let burley = material("Burley(parametrization: Diffuse)");
        (0..count).map(|index| (format!("m{index}.ron"), burley.clone())).collect()
    };
    let declaration = |count: usize| {
        let files = set(count);
        let compilation = Compiler::from_memory(files.iter().map(|(path, text)| (path, text.as_str())));
        let compilation = compilation.compile().unwrap_or_else(|report| panic!("{report}"));
        let line =
            compilation.wgsl().lines().find(|line| line.contains("> material_table: ")).map(str::to_owned);
        (line.unwrap_or_default(), compilation.parts.material_rows().len())
    };
    let (one, row) = declaration(1);
    assert_eq!(one, "@group(0) @binding(0) var<uniform> material_table: array<SubsurfaceMaterial, 1>;");
    let most = 65536 / row;
    let (all, bytes) = declaration(most);
    assert_eq!(bytes, most * row, "rows have one size");
    assert_eq!(all, one.replace("1>;", &format!("{most}>;")));
    let (more, bytes) = declaration(most + 1);
    assert_eq!(bytes, (most + 1) * row, "rows have one layout in both kinds of buffer");
    assert_eq!(more, "@group(0) @binding(0) var<storage, read> material_table: array<SubsurfaceMaterial>;");
}

#[test]
fn every_kernel_compiles_with_every_profile() {
    let table = "r,r_reflectance\n0,0.1\n1,0.05\n2,0\n";
    let stems = subsurface_profile::Model::PUBLISHED
        .map(|stem| (format!("{stem}.ron"), material(&format!("\"{stem}\""))));
    let tabulated = [
        ("t.csv".to_owned(), table.to_owned()),
        ("u.ron".to_owned(), material("Tabulated(file: \"t.csv\")")),
    ];
    let mixture = subsurface_profile::ModelKind::Mixture.description().example;
    let mixture = ("v.ron".to_owned(), material(mixture));
    let files: Vec<_> = stems.into_iter().chain(tabulated).chain([mixture]).collect();
    for kernel in Estimator::ALL {
        let compiler =
            Compiler::from_memory(files.iter().map(|(path, text)| (path, text.as_str()))).estimator(kernel);
        let compilation = compiler.compile().unwrap_or_else(|report| panic!("{kernel}: {report}"));
        assert!(compilation.wgsl().contains(&format!("// Estimator: {kernel}\n")), "{kernel}");
        let has_edges = matches!(kernel, Estimator::Separable { .. });
        // No two of the published models are equal; a table and a mixture beside them, and a row more for the terms of
        // the Gaussian sum. Behind them all, two for each roughness of the lobe, and two of means.
        let published = subsurface_profile::Model::PUBLISHED.map(|stem| {
            let model = subsurface_profile::Model::published(stem).expect("its own list");
            if model.dependence().on_channel() { 3 } else { 16 }
        });
        let rows = if has_edges { 3 } else { 1 } * (published.iter().sum::<u32>() + 16 + 48) + 1 + 66;
        assert_eq!(compilation.parts.curve_size(), [64, rows], "{kernel}");
    }
}

#[test]
fn all_policies_of_rejection_compile() {
    let files = [("a.ron", material("Burley(parametrization: Diffuse)"))];
    for choice in 0..16u32 {
        let holds = |bit: u32| choice & (1 << bit) != 0;
        let rejection = Rejection {
            by_material: holds(0),
            by_distance: holds(1),
            by_normal: holds(2),
            rejected: if holds(3) { Rejected::ReturnedToCentre } else { Rejected::Renormalized },
        };
        for kernel in
            [Estimator::default(), Estimator::Separable { taps: 3, rotated: true }, Estimator::Dense]
        {
            let compiler = Compiler::from_memory(files.iter().map(|(path, text)| (path, text.as_str())));
            let compilation = compiler.estimator(kernel).rejection(rejection).compile();
            let compilation = compilation.unwrap_or_else(|report| panic!("{kernel}, {rejection}: {report}"));
            assert!(compilation.wgsl().contains(&format!("// Rejects: {rejection}\n")), "{rejection}");
        }
    }
}

#[test]
fn a_model_without_a_profile_somewhere_is_refused_at_its_place() {
    let narrow = "Burley(parametrization: Fit(length: MeanFreePath, constant: -0.01, slope: 0, amplitude: 1000, \
                  pivot: 0.12888888888888889, exponent: 1))";
    let text = material(narrow);
    let report =
        Compiler::from_memory([("a.ron", text.as_str())]).compile().expect_err("no profile at 29/225");
    let text = report.render(false);
    assert!(
        text.contains("this model has no profile at surface albedo 0.1289") && text.contains("a.ron:1:19"),
        "{text}"
    );
}

#[test]
fn a_material_named_like_a_constant_of_the_shaders_is_refused_at_its_place() {
    let text = material("Burley(parametrization: Diffuse)");
    let report =
        Compiler::from_memory([("bits.ron", text.as_str())]).compile().expect_err("MATERIAL_BITS is taken");
    let text = report.render(false);
    assert!(
        text.contains("the name `bits` is taken by the shaders") && text.contains("bits.ron:1:1"),
        "{text}"
    );
}

#[test]
fn every_model_has_a_shader_and_an_example_that_compiles() {
    for kind in subsurface_profile::ModelKind::ALL {
        let description = kind.description();
        let stem = description.stem;
        let module = format!("profiles/{stem}");
        assert!(subsurface_shaders::PROFILES.iter().any(|file| file.name == module), "{module}");
        let table = "r,r_reflectance\n0,0.1\n1,0.05\n2,0\n".to_owned();
        let compilation = compile(&[("a.ron", material(description.example)), ("my_table.csv", table)]);
        assert!(compilation.wgsl().contains(&format!("MODEL_{}: u32", stem.to_uppercase())), "{stem}");
    }
}

#[test]
fn parts_of_mixtures_are_written_out_and_evaluated_by_their_models() {
    let within = "Mixture([(1, GaussianSum([(variance_mm2: 1, weight: 1)])), (1, Dipole(medium: Skin1))])";
    let nested = format!("Mixture([(0.5, Burley(parametrization: Diffuse)), (0.5, {within})])");
    let compilation = compile(&[
        ("a.ron", material(&nested)),
        ("b.ron", material("Mixture([(1, Burley(parametrization: Diffuse))])")),
        ("c.ron", material("TwoExponentialDipole(entry: Searchlight)")),
    ]);
    let wgsl = compilation.wgsl();
    assert!(wgsl.contains("const MIXTURE_PARTS: u32 = 3u;") && !wgsl.contains("for (var part"), "{wgsl}");
    assert_eq!(wgsl.matches("sum += shape.parts[").count(), 2 * 3, "area_pdf and radial_cdf of three parts");
    // Models of parts have no member in a row, and models of materials none in a part.
    for (structure, has, has_not) in [
        ("struct SubsurfaceMaterial {", "mixture: MixtureModel", "burley: BurleyModel"),
        ("struct MixturePartModel {", "burley: BurleyModel", "two_exponential_dipole:"),
    ] {
        let text = wgsl.split_once(structure).and_then(|(_, rest)| rest.split_once("\n}"));
        let members = text.expect("the struct is there").0;
        assert!(members.contains(has) && !members.contains(has_not), "{members}");
    }
}
