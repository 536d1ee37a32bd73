//! The stored tables: readable, consistent, and in agreement with new photons and with another program's.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "tests may panic, and say what they could not do"
)]

use std::ops::ControlFlow;

use subsurface_reference::{
    Entry, Goal, HalfSpace, RadialBin, RadialTable, Run, TruthTable, TruthTableError, chandrasekhar, truth,
};

fn stored() -> [&'static TruthTable; 4] {
    [truth::searchlight(), truth::diffuse(), truth::searchlight_eta_1_4(), truth::diffuse_eta_1_4()]
}

fn assert_agreement(one: &RadialTable, two: &RadialTable, what: &str) {
    let chi_squared = one.chi_squared(two);
    assert!(chi_squared.degrees_of_freedom > 20, "{what}: {chi_squared:?}");
    // Far too small says that the stated errors are too large.
    assert!(chi_squared.deviation().abs() < 4.0, "{what}: {chi_squared:?}");
}

#[test]
fn tables_say_what_they_are() {
    for (table, (entry, refractive_index)) in stored().into_iter().zip([
        (Entry::Searchlight, 1.0),
        (Entry::Diffuse, 1.0),
        (Entry::Searchlight, 1.4),
        (Entry::Diffuse, 1.4),
    ]) {
        assert_eq!(table.half_space, HalfSpace::new(entry, 0.0, refractive_index).unwrap());
        assert!(table.photons >= 200_000_000);
        for profile in &table.tables {
            assert!(profile.bins.last().unwrap().cdf_at_r_hi > 0.9999);
            if refractive_index == 1.0 {
                let exact = chandrasekhar::single_scattering_albedo(entry, profile.surface_albedo).unwrap();
                // Nine digits are written.
                assert!((profile.single_scattering_albedo - exact).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn writing_is_the_inverse_of_reading() {
    for table in stored() {
        let text = table.to_csv();
        assert_eq!(TruthTable::from_csv(&text).unwrap(), *table);
        // Four such files are to stay small in the repository.
        assert!(text.len() < 115_000);
    }
}

#[test]
fn new_photons_agree() {
    for table in stored() {
        let mut run = Run::new(table.half_space, 987_654_321);
        run.simulate(&Goal::photons(1 << 19).unwrap(), &mut |_| ControlFlow::Continue(()));
        for profile in table.tables.iter().step_by(5) {
            let fresh = run.radial_profile(profile.single_scattering_albedo).unwrap();
            let what = format!("{:?}, A = {}", table.half_space, profile.surface_albedo);
            assert_agreement(profile, &fresh, &what);
        }
    }
}

#[test]
fn another_programs_tables_agree() {
    for (table, name) in [(truth::searchlight(), "searchlight"), (truth::diffuse(), "diffuse")] {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/truth");
        let Ok(text) = std::fs::read_to_string(format!("{folder}/{name}_A.csv")) else {
            eprintln!("not compared: there is no ../shared/truth beside this repository");
            return;
        };
        let mut compared = 0;
        for profile in &table.tables {
            let mut other = Vec::new();
            for row in text.lines().skip(1) {
                let value: Vec<f64> = row.split(',').map(|field| field.parse().unwrap()).collect();
                if value[1] == profile.surface_albedo {
                    other.push(RadialBin {
                        r_lo: value[2],
                        r_hi: value[3],
                        r_reflectance: value[4],
                        standard_error: value[5],
                        cdf_at_r_hi: value[6],
                    });
                }
            }
            if other.is_empty() {
                continue;
            }
            let other = RadialTable { bins: other, ..profile.clone() };
            assert_agreement(profile, &other, &format!("{name}, A = {}", profile.surface_albedo));
            compared += 1;
        }
        assert_eq!(compared, 15);
    }
}

#[test]
fn tables_that_are_not_tables_are_errors() {
    let header =
        "# entry: diffuse\n# anisotropy: 0\n# refractive_index: 1\n# photons: 5\n# seed: 1\n# command: x\n";
    let columns =
        "surface_albedo,single_scattering_albedo,r_lo,r_hi,r_reflectance,standard_error,cdf_at_r_hi\n";
    let read = |rows: &str| TruthTable::from_csv(&format!("{header}{columns}{rows}"));
    let good = "0.1,0.3,0,1,0.5,0.1,0.5\n0.1,0.3,1,2,0.25,0.1,1\n";
    assert_eq!(read(good).unwrap().tables[0].bins.len(), 2);
    let value = |rows: &str| match read(rows) {
        Err(TruthTableError::Value { line, what }) => format!("{line}: {what}"),
        other => panic!("{other:?}"),
    };
    assert!(value("0.1,0.3,1,2,0.5,0.1,0.5\n").contains("from the axis"));
    assert!(value("0.1,0.3,0,1,0.5,0.1,0.5\n0.1,0.3,1.5,2,0.25,0.1,1\n").starts_with("9: rings must follow"));
    assert!(value("0.1,0.3,0,1,-0.5,0.1,0.5\n").contains("negative"));
    assert!(value("0.1,0.3,1,0,0.5,0.1,0.5\n").contains("r_lo < r_hi"));
    assert!(value("1.1,0.3,0,1,0.5,0.1,0.5\n").contains("[0, 1]"));
    assert!(value("0.1,0.3,0,1,0.5,0.1,0.5\n0.1,0.3,1,2,0.25,0.1,0.4\n").contains("must not fall"));
    assert!(value("0.1,0.3,0,1,0.5,0.1,0.5\n0.1,0.4,1,2,0.25,0.1,1\n").contains("one single"));
    assert!(value(&format!("{good}0.05,0.2,0,1,0.5,0.1,0.5\n")).contains("must rise"));
    for row in ["0.1,0.3,0,1,NaN,0.1,0.5\n", "0.1,0.3,0,1,inf,0.1,0.5\n", "0.1,0.3,0,1,0.5,0.1\n", "a,b\n"] {
        assert_eq!(read(row), Err(TruthTableError::Row(8)), "{row}");
    }
    assert_eq!(read("0.1,0.3,0,1,0.5,0.1,0.5\n"), Err(TruthTableError::TooShort(1)));
    assert_eq!(read(""), Err(TruthTableError::TooShort(0)));
    assert_eq!(TruthTable::from_csv(""), Err(TruthTableError::Header("entry")));
    assert!(matches!(TruthTable::from_csv(&format!("{header}{good}")), Err(TruthTableError::Columns(7))));
}
