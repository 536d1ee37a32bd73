use super::*;

const ROOMS: &[Module] = &[
    Module {
        name: "lib/a",
        text: "// uses: lib/b\n\n// About a.\n\nfn used() -> f32 { return LIMIT; }\n\nfn unused() { used(); }\n",
    },
    Module { name: "lib/b", text: "const LIMIT = 1.0;\n" },
    Module { name: "lib/c", text: "fn never() {}\n" },
];

fn glue(text: &str) -> Glue {
    Glue { text: text.to_owned(), ..Glue::default() }
}

fn module(name: &'static str, text: &'static str) -> Module {
    Module { name, text }
}

/// What is wrong with `rooms` where a pass uses the first of them.
fn refused(rooms: &[Module]) -> String {
    let passes = [module("passes/p", "// uses: lib/one\n\nfn main() { one(); }\n")];
    let files = Files { rooms, passes: &passes, guests: &[] };
    link(files, &glue("const CHOICE = 1;\n"), &["main"], "").expect_err("the rooms do not fit").to_string()
}

#[test]
fn keeps_what_the_root_reaches_and_nothing_else() {
    let files = Files { rooms: ROOMS, ..Files::default() };
    let linked = link(files, &glue("fn root() { used(); }\n"), &["root"], "// head\n").expect("links");
    assert!(linked.text.starts_with("// head\n"));
    assert!(linked.text.contains("// About a.") && linked.text.contains("LIMIT = 1.0"));
    assert!(!linked.text.contains("unused") && !linked.text.contains("never"));
    assert!(!linked.text.contains("uses:"), "headers stay behind");
    assert_eq!(linked.module_at(linked.text.len() - 1), Some("lib/a"));
}

#[test]
fn entry_points_come_first_and_a_file_after_what_it_uses() {
    let passes = [
        module("passes/bound", "// uses: the material set\n\nvar<private> bound: u32 = CHOICE;\n"),
        module(
            "passes/p",
            "// uses: lib/a, lib/d\n// Of p.\n\nconst P = 1;\n\nfn main() { used(); open(); lit(); _ = P; }\n",
        ),
    ];
    let mut rooms = ROOMS.to_vec();
    rooms.push(module(
        "lib/d",
        "// uses: the material set; needs: bound\n\nfn open() { _ = bound; row(); }\n",
    ));
    rooms.push(module("light/l", "fn lit() {}\n"));
    let guests = [module("mine", "// uses: what it likes\nfn guest() { used(); }\n")];
    let files = Files { rooms: &rooms, passes: &passes, guests: &guests };
    let set = glue("const CHOICE = 1;\n\nfn row() { used(); }\n");
    let error = link(files, &set, &["main", "guest"], "").expect_err("light/l is not named");
    assert_eq!(error.to_string(), "passes/p uses lit, which light/l declares: name light/l in its header");
    let passes = [
        passes[0],
        module(
            "passes/p",
            "// uses: lib/a, lib/d, light/l\n\n// Of p.\n\nconst P = 1;\n\nfn main() { used(); open(); lit(); _ = P; }\n",
        ),
    ];
    let files = Files { passes: &passes, ..files };
    let linked = link(files, &set, &["main", "guest"], "").expect("links");
    let names = linked.modules.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>();
    let set_name = "the material set";
    // What entry points alone use comes behind the rest of their file.
    let expected = [
        "passes/p",
        "mine",
        set_name,
        "passes/bound",
        "passes/p",
        "lib/b",
        "lib/a",
        set_name,
        "lib/d",
        "light/l",
    ];
    assert_eq!(names, expected);
    assert_eq!(linked.text.matches("// Of p.").count(), 1);
    let place = |text: &str| linked.text.find(text).unwrap_or_else(|| panic!("{text} in {}", linked.text));
    assert!(place("fn main()") < place("// ── the material set: choices ──"));
    assert!(place("fn used()") < place("// ── the material set: materials ──"));
}

#[test]
fn bindings_stand_above_the_files_that_their_entry_points_use() {
    let passes =
        [module("passes/p", "// uses: lib/one\n\nvar<private> bound: u32;\n\nfn main() { one(); }\n")];
    let rooms = [module("lib/one", "// needs: bound\n\nfn one() { _ = bound; }\n")];
    let files = Files { rooms: &rooms, passes: &passes, guests: &[] };
    let linked = link(files, &glue(""), &["main"], "").expect("links");
    let names = linked.modules.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>();
    assert_eq!(names, ["passes/p", "passes/p", "lib/one"]);
}

#[test]
fn a_name_declared_twice_is_an_error() {
    let files = Files { rooms: ROOMS, ..Files::default() };
    let error = link(files, &glue("const LIMIT = 2.0;"), &["LIMIT"], "").expect_err("LIMIT stands twice");
    assert_eq!(error.to_string(), "LIMIT is declared by the material set and by lib/b");
}

#[test]
fn a_file_that_moves_must_be_named_anew() {
    let one = "// uses: lib/two\n\nfn one() { two(); }\n";
    assert_eq!(
        refused(&[module("lib/one", "fn one() { two(); }\n"), module("lib/two", "fn two() {}\n")]),
        "lib/one uses two, which lib/two declares: name lib/two in its header"
    );
    assert_eq!(
        refused(&[module("lib/one", one), module("lib/moved", "fn two() {}\n")]),
        "lib/one uses two, which lib/moved declares: name lib/moved in its header"
    );
    assert_eq!(
        refused(&[module("lib/one", "// uses: lib/two\n\nfn one() {}\n")]),
        "lib/one uses lib/two, and there is no such file"
    );
    assert_eq!(
        refused(&[module("lib/one", "fn one() { let x = CHOICE; }\n")]),
        "lib/one uses CHOICE, which the material set declares: name the material set in its header"
    );
}

#[test]
fn a_header_names_nothing_in_vain() {
    let two = module("lib/two", "fn two() {}\n");
    assert_eq!(
        refused(&[module("lib/one", "// uses: lib/two\n\nfn one() { let two = 1; _ = two; }\n"), two]),
        "lib/one uses nothing of lib/two: leave it out of its header"
    );
    assert_eq!(
        refused(&[module("lib/one", "// uses: the material set\n\nfn one() {}\n")]),
        "lib/one uses nothing of the material set: leave it out of its header"
    );
    assert_eq!(
        refused(&[module("lib/one", "// needs: bound\n\nfn one() {}\n")]),
        "lib/one uses nothing of bound: leave it out of its header"
    );
}

#[test]
fn what_is_open_is_declared_by_a_pass() {
    assert_eq!(
        refused(&[module("lib/one", "// needs: bound\n\nfn one() { bound(); }\n")]),
        "lib/one needs bound, and no pass declares it"
    );
    assert_eq!(
        refused(&[
            module("lib/one", "// needs: two\n\nfn one() { two(); }\n"),
            module("lib/two", "fn two() {}\n")
        ]),
        "lib/one needs two, which lib/two declares: it is not open, so name lib/two under `uses`"
    );
}

#[test]
fn a_circle_is_spelled_out() {
    assert_eq!(
        refused(&[
            module("lib/one", "// uses: lib/two\n\nfn one() { two(); }\n"),
            module("lib/two", "// uses: lib/three\n\nfn two() { three(); }\n"),
            module("lib/three", "// uses: lib/two\n\nfn three() { other(); }\nfn other() { two(); }\n"),
        ]),
        "files use each other in a circle: lib/two → lib/three → lib/two"
    );
}

#[test]
fn a_line_that_is_no_header_is_refused() {
    assert_eq!(
        refused(&[module("lib/one", "// uses: lib/two; three\n\nfn one() {}\n")]),
        "lib/one: `// uses: lib/two; three` is no header; write `// uses: lib/angle, gather/point; needs: input_pixel`"
    );
}

#[test]
fn a_callers_pass_takes_no_built_in_away() {
    let rooms = [module("lib/one", "fn one() { _ = min(1, 2); }\n")];
    let guests = [module("mine", "fn main() { one(); }\nfn min(a: i32, b: i32) -> i32 { return a; }\n")];
    let files = Files { rooms: &rooms, passes: &[], guests: &guests };
    let error = link(files, &glue(""), &["main"], "").expect_err("min is taken");
    assert_eq!(error.to_string(), "the pass mine declares min, which lib/one uses as a built-in: rename it");
}

#[test]
fn origins_follow_their_text() {
    let mut sources = crate::source::SourceMap::new();
    let file = sources.add("m.ron", "value");
    let text = "fn dropped() {}\n\nconst KEPT = 42.0;\n";
    let at = text.find("42.0").expect("it is there");
    let origins = vec![(at..at + 4, Span::new(file, 0..5))];
    let glue = Glue { text: text.to_owned(), origins, ..Glue::default() };
    let linked = link(Files::default(), &glue, &["KEPT"], "// head\n").expect("links");
    let moved = linked.text.find("42.0").expect("it is there");
    assert_eq!(linked.origin(&(moved + 1..moved + 2)), Some(&Span::new(file, 0..5)));
    assert_eq!(linked.origin(&(0..1)), None);
}

mod house;
