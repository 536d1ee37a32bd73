//! What a misspelt name may have meant.

/// "did you mean …", or all names.
pub(crate) fn suggest(name: &str, known: &[String]) -> String {
    let nearest = known
        .iter()
        .map(|other| (strsim::damerau_levenshtein(name, other), other))
        .min()
        // Up to a third of the letters wrong is a slip; more is another word.
        .filter(|(distance, _)| *distance <= (name.len() / 3).max(1));
    match nearest {
        Some((_, other)) => format!("did you mean `{other}`?"),
        None => format!("there are: {}", known.join(", ")),
    }
}
