//! "Did you mean …?"

/// The candidate that `name` was probably meant to be.
pub(crate) fn closest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase();
    // A third of the letters may be wrong, as in rustc's own suggestions; and always one.
    let limit = (name.chars().count() / 3).max(1);
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let lower = candidate.to_lowercase();
        let distance = strsim::damerau_levenshtein(&name, &lower);
        // `albedo` means `surface_albedo`, `specular_roughness` means `roughness`.
        let has_all_words = |long: &str, short: &str| {
            short.len() >= 4 && short.split('_').all(|word| long.split('_').any(|other| other == word))
        };
        let begins = name.len() >= 4 && lower.starts_with(&name);
        let related = begins || has_all_words(&lower, &name) || has_all_words(&name, &lower);
        if (distance <= limit || related) && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// `` `a`, `b` and `c` ``.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => "none".to_owned(),
        [only] => only.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

/// A name as a message shows it: a long one is cut.
pub(crate) fn shortened(name: &str) -> String {
    const LONGEST: usize = 64;
    const KEPT: usize = 24;
    if name.chars().count() <= LONGEST {
        return name.to_owned();
    }
    name.chars().take(KEPT).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typing_errors_are_recognised_and_other_words_are_not() {
        let fields = ["mean_free_path_mm", "surface_albedo", "roughness", "base"];
        assert_eq!(closest("mean_free_pth_mm", fields), Some("mean_free_path_mm"));
        assert_eq!(closest("mean_free_path", fields), Some("mean_free_path_mm"));
        assert_eq!(closest("albedo", fields), Some("surface_albedo"));
        assert_eq!(closest("Roughness", fields), Some("roughness"));
        assert_eq!(closest("colour", fields), None);
        assert_eq!(closest("", fields), None);
    }

    #[test]
    fn names_are_listed_in_words() {
        assert_eq!(list([]), "none");
        assert_eq!(list(["a"]), "`a`");
        assert_eq!(list(["a", "b", "c"]), "`a`, `b` and `c`");
    }
}
