//! MCML's input files, good and bad.

use proptest::prelude::*;
use subsurface_reference::layers::{Grid, Layer, LayerError, LayerRun, LayerStack, OutputFormat, parse_mci};

/// A run of two layers; line numbers are those of the messages below.
const GOOD: &str = "\
1.0
1
slab.mco A
1000
0.01 0.02
40 50 30
2
1.0
1.3 20 200 0.70 0.01
1.4 10 200 0.90 1.0E+8
1.0
";

/// `GOOD` with another text in line `number`.
fn with_line(number: usize, text: &str) -> String {
    let lines = GOOD.lines().enumerate();
    lines.map(|(index, line)| if index + 1 == number { text } else { line }.to_owned() + "\n").collect()
}

#[track_caller]
fn message(text: &str) -> String {
    let error = parse_mci(text).unwrap_err();
    // The place is one in the text.
    assert!(text.get(error.span.clone()).is_some(), "{error:?}");
    error.to_string()
}

#[test]
fn a_good_file() {
    let runs = parse_mci(GOOD).unwrap();
    assert_eq!(runs.len(), 1);
    let run = &runs[0];
    assert_eq!(
        (run.output_name(), run.output_format(), run.photons()),
        ("slab.mco", OutputFormat::Ascii, 1000)
    );
    let grid = run.grid();
    assert_eq!((grid.depth_step(), grid.radius_step()), (0.01, 0.02));
    assert_eq!((grid.depth_cells(), grid.radius_cells(), grid.angle_cells()), (40, 50, 30));
    let layers = run.stack().layers();
    assert_eq!(layers[0], Layer::new(1.3, 20.0, 200.0, 0.7, 0.01).unwrap());
    assert_eq!(layers[1], Layer::new(1.4, 10.0, 200.0, 0.9, 1e8).unwrap());
}

#[test]
fn two_runs_with_comments_as_in_the_template_of_mcml() {
    // The form of `template.mci` of the MCML distribution: comment blocks, tabs, `20E-4`, Windows line ends.
    let text = "####\n# Template\n####\n\n1.0\t\t\t# file version\n2\t# number of runs\n\n### run 1\n\
        temp1.mco\tA\t\t# output filename, ASCII/Binary\n10\t# No. of photons\n20E-4\t20E-4\t# dz, dr\n\
        10\t20\t30\t# No. of dz, dr & da.\n\n1\t# No. of layers\n# n\tmua\tmus\tg\td\n1.0\n1.4\t10\t200\t0.7\t1.0E+8\n1\n\
        ### run 2\ntemp2.mco\tb\n20\n.002\t2.\n80\t80\t30\n1\n1.0\n1.4\t10\t200\t0.70\t1.0E+8\n1.0\n";
    let windows = text.replace('\n', "\r\n");
    for text in [text.to_owned(), windows, format!("\u{feff}{text}"), text.trim_end().to_owned()] {
        let runs = parse_mci(&text).unwrap();
        assert_eq!(runs.len(), 2);
        assert_eq!((runs[0].photons(), runs[0].grid().depth_step()), (10, 0.002));
        assert_eq!((runs[1].output_format(), runs[1].grid().radius_step()), (OutputFormat::Binary, 2.0));
    }
}

#[test]
fn values_out_of_range() {
    for (line, text, expected) in [
        (
            1,
            "2.0",
            "line 1: file version `2.0`: expected 1.0, the version of MCML 1.x; inputs of MCML 2 have another form",
        ),
        (2, "0", "line 2: 0 runs: expected 1 to 32767"),
        (4, "0", "line 4: 0 photons: expected at least 1; 1000000 give three digits of most totals"),
        (5, "0 0.02", "line 5: cell size dz = 0: expected 1e-12 to 1e12 cm"),
        (5, "0.01 -1", "line 5: cell size dr = -1: expected 1e-12 to 1e12 cm"),
        (
            6,
            "0 50 30",
            "line 6: nz = 0 cells: expected 1 to 32767; write 1 for a direction that need not be resolved",
        ),
        (
            6,
            "1 4000000000 30",
            "line 6: nr = 4000000000 cells: expected 1 to 32767; write 1 for a direction that need not be resolved",
        ),
        (7, "0", "line 7: 0 layers: expected 1 to 32767"),
        (
            8,
            "0",
            "line 8: refractive index 0: expected a number from 0.01 to 100, such as 1.0 for air or 1.37 for tissue",
        ),
        (
            9,
            "1.3 -20 200 0.70 0.01",
            "line 9: absorption coefficient -20: expected 0 to 1e12 per cm; write 0 for a layer that does not absorb",
        ),
        (
            9,
            "1.3 20 NaN 0.70 0.01",
            "line 9: scattering coefficient NaN: expected 0 to 1e12 per cm; write 0 for a layer that does not scatter",
        ),
        (
            10,
            "1.4 10 200 1.1 1.0E+8",
            "line 10: anisotropy 1.1: expected a mean cosine from -1 to 1; write 0 for isotropic scattering",
        ),
        (
            10,
            "1.4 10 200 0.9 inf",
            "line 10: thickness inf: expected more than 0 and at most 1e12 cm; write 1e8 for a semi-infinite layer, and \
             leave out a layer that has no thickness",
        ),
        (
            10,
            "1.4 0 200 0.9 1e8",
            "line 10: layer 2 scatters a packet about 3.9e10 times before it leaves or is absorbed (the limit is 1e4); \
             give the layer a smaller thickness, a larger absorption coefficient or an index nearer to that outside",
        ),
    ] {
        assert_eq!(message(&with_line(line, text)), expected);
    }
}

#[test]
fn malformed_lines() {
    for (line, text, expected) in [
        (1, "1.0 beta", "line 1: unexpected `beta` after the file version, 1.0; begin a comment with `#`"),
        (
            2,
            "1.0",
            "line 2: `1.0` is not a whole number: expected the number of runs, written in digits alone, such as 1000000",
        ),
        (
            3,
            "slab.mco",
            "line 3: expected an output file and its format, such as `slab.mco A`, found 1 of 2; add what is missing to \
             this line",
        ),
        (3, "slab.mco C", "line 3: output format `C`: expected A (text) or B"),
        (
            4,
            "1E6",
            "line 4: `1E6` is not a whole number: expected the number of photons, written in digits alone, such as 1000000",
        ),
        (
            4,
            "-5",
            "line 4: `-5` is not a whole number: expected the number of photons, written in digits alone, such as 1000000",
        ),
        (
            5,
            "0.01 0,02",
            "line 5: `0,02` is not a number: expected the cell size dr in cm, such as 0.01 or 1E-2",
        ),
        (
            9,
            "1.3 20 200 0.70 # 0.01",
            "line 9: expected the five numbers `n mua mus g d` of layer 1 of 2, found 4 of 5; add what is missing to this \
             line",
        ),
        (
            10,
            "1.4 10 200 0.9 1e8 layer 2",
            "line 10: unexpected `layer` after the five numbers `n mua mus g d` of layer 2 of 2; begin a comment with `#`",
        ),
        (
            11,
            "",
            "line 12: the text ends where the refractive index n below the last layer should follow; add the missing lines",
        ),
        (
            11,
            "1.0\n7",
            "line 12: unexpected `7` after the last of 1 runs; raise the number of runs, or comment it out with `#`",
        ),
        // One layer too many: its five numbers stand where the index below belongs.
        (
            7,
            "1",
            "line 10: unexpected `10` after the refractive index n below the last layer; begin a comment with `#`",
        ),
    ] {
        assert_eq!(message(&with_line(line, text)), expected);
    }
    assert_eq!(
        message(""),
        "line 1: the text ends where the file version, 1.0 should follow; add the missing lines"
    );
    let twice = with_line(2, "2") + &GOOD.lines().skip(2).collect::<Vec<_>>().join("\n");
    assert_eq!(
        message(&twice),
        "line 12: output file `slab.mco` is already that of line 3; give each run a name of its own"
    );
}

#[test]
fn a_place_is_the_text_to_blame() {
    let text = with_line(9, "\t1.3 20 -200 0.70 0.01 # µ");
    let error = parse_mci(&text).unwrap_err();
    assert_eq!((error.line, &text[error.span]), (9, "-200"));
    // Every line missing: the place is the end.
    for lines in 0..11 {
        let text: String = GOOD.lines().take(lines).map(|line| format!("{line}\n")).collect();
        let error = parse_mci(&text).unwrap_err();
        assert_eq!((error.line, error.span), (lines + 1, text.len()..text.len()));
    }
}

#[test]
fn stacks_made_without_a_file_are_checked_too() {
    assert_eq!(LayerStack::new(1.0, Vec::new(), 1.0).unwrap_err(), LayerError::LayerCount { count: 0 });
    let layer = Layer::new(1.0, 0.0, 0.0, 0.0, 1.0).unwrap();
    assert!(LayerStack::new(f64::NAN, vec![layer], 1.0).is_err());
    assert!(LayerStack::new(1.0, vec![layer], f64::INFINITY).is_err());
    // Thick without absorption is endless; thick with absorption, or thin without, is not.
    let alone = |layer: Layer| LayerStack::new(1.0, vec![layer], 1.0);
    assert!(matches!(
        alone(Layer::new(1.0, 0.0, 10.0, 0.0, 1e4).unwrap()),
        Err(LayerError::Endless { layer: 1, .. })
    ));
    assert!(alone(Layer::new(1.0, 1e-3, 10.0, 0.0, 1e4).unwrap()).is_ok());
    // Total reflection can be as endless, unless the light is absorbed or there is none to be scattered.
    let trapping = |absorption, scattering| {
        LayerStack::new(0.01, vec![Layer::new(100.0, absorption, scattering, 0.0, 1.0).unwrap()], 0.01)
    };
    assert!(matches!(trapping(0.0, 1e-3), Err(LayerError::Endless { layer: 1, .. })));
    assert!(trapping(1.0, 1.0).is_ok() && trapping(0.0, 0.0).is_ok());
    // A gap of air keeps light in; the way out on the other side does not count its index.
    let stack = |below| {
        let [dense, gap] = [200.0, 1.0].map(|ratio| Layer::new(0.5 * ratio, 0.0, 1.0, 0.0, 1.0).unwrap());
        LayerStack::new(0.5, vec![gap, dense], below)
    };
    assert!(matches!(stack(0.5), Err(LayerError::Endless { layer: 2, .. })));
    assert!(stack(50.0).is_ok());
    assert!(alone(Layer::new(1.0, 0.0, 10.0, 0.0, 1.0).unwrap()).is_ok());
}

#[test]
fn output_names_fit_into_a_file_of_words() {
    let layer = Layer::new(1.0, 1.0, 0.0, 0.0, 1.0).unwrap();
    let named = |name: &str| {
        let stack = LayerStack::new(1.0, vec![layer], 1.0).unwrap();
        LayerRun::new(name, OutputFormat::Ascii, 1, Grid::new(1.0, 1.0, 1, 1, 1).unwrap(), stack)
    };
    assert!(named("café.mco").is_ok());
    for name in ["", "two words", "two\nlines", "a#b", "a\u{0}b"] {
        assert_eq!(named(name).unwrap_err(), LayerError::OutputName { name: name.to_owned() });
    }
}

/// Lines made of what such files hold, so that some get far.
fn almost_input() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        Just("1.0".to_owned()),
        Just("1".to_owned()),
        Just("2".to_owned()),
        Just("A".to_owned()),
        Just("1e8".to_owned()),
        Just("# note".to_owned()),
        Just("\r".to_owned()),
        any::<f64>().prop_map(|number| number.to_string()),
        any::<i64>().prop_map(|number| number.to_string()),
        "\\PC{0,4}",
    ];
    let line = prop::collection::vec(word, 0..6).prop_map(|words| words.join(" "));
    prop::collection::vec(line, 0..8).prop_map(|lines| lines.join("\n"))
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in any::<String>()) {
        let _ = parse_mci(&text);
    }

    #[test]
    fn almost_good_texts_end_in_a_result(tail in almost_input(), lines in 0_usize..11) {
        let head: String = GOOD.lines().take(lines).map(|line| format!("{line}\n")).collect();
        let text = head + &tail;
        if let Err(error) = parse_mci(&text) {
            prop_assert!(text.get(error.span).is_some());
            prop_assert!(error.line >= 1 && error.line <= text.lines().count() + 1);
        }
    }

    #[test]
    fn one_changed_word_is_found_in_its_line(line in 1_usize..=11, word in "[a-z%]{1,5}") {
        prop_assume!(word != "inf" && word != "nan" && word != "a" && word != "b");
        let changed = GOOD.lines().nth(line - 1).unwrap().split(' ').next_back().unwrap().to_owned();
        let good_line = GOOD.lines().nth(line - 1).unwrap();
        let text = with_line(line, &good_line.replacen(&changed, &word, 1));
        let error = parse_mci(&text).unwrap_err();
        prop_assert_eq!(error.line, line);
        prop_assert_eq!(&text[error.span], word);
    }
}
