//! The one line at the head of a WGSL file that says what it takes from where.
//!
//! ```wgsl
//! // uses: gather/{input, point}, lib/angle, the material set; needs: input_pixel
//! ```
//!
//! `uses` names files, those of a folder in braces, and may name the material set. `needs` names what the file leaves
//! open: declarations of the pass that links it, or functions of the material set that call the file in turn. A file that
//! takes nothing has no line.

/// What the line says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Header<'a> {
    /// Names of files, folders included.
    pub(super) uses: Vec<String>,
    pub(super) needs: Vec<&'a str>,
}

/// Splits a file into its header and the text below.
///
/// Returns the line if it begins as a header and is none.
pub(super) fn split(text: &str) -> Result<(Header<'_>, &str), &str> {
    let (line, rest) = text.split_once('\n').unwrap_or((text, ""));
    let said =
        line.strip_prefix("// ").filter(|said| said.starts_with("uses:") || said.starts_with("needs:"));
    let Some(said) = said else { return Ok((Header::default(), text)) };
    match parse(said) {
        Some(header) => Ok((header, rest)),
        None => Err(line),
    }
}

/// `uses: …; needs: …`, either of which may be missing.
fn parse(said: &str) -> Option<Header<'_>> {
    let (uses, needs) = match said.strip_prefix("uses:") {
        None => (None, said.strip_prefix("needs:")),
        Some(uses) => match uses.split_once(';') {
            None => (Some(uses), None),
            Some((uses, needs)) => (Some(uses), Some(needs.trim().strip_prefix("needs:")?)),
        },
    };
    let mut header = Header::default();
    if let Some(uses) = uses {
        header.uses = files(uses)?;
    }
    if let Some(needs) = needs {
        header.needs = names(needs)?;
    }
    Some(header)
}

/// `a, folder/b, folder/{c, d}`
fn files(text: &str) -> Option<Vec<String>> {
    let mut files = Vec::new();
    let mut rest = text;
    loop {
        let comma = rest.find(',').unwrap_or(rest.len());
        let after = match rest.find('{').filter(|&open| open < comma) {
            Some(open) => {
                let folder = rest[..open].trim().strip_suffix('/').filter(|folder| is_name(folder))?;
                let (inner, after) = rest[open + 1..].split_once('}')?;
                files.extend(names(inner)?.into_iter().map(|stem| format!("{folder}/{stem}")));
                after.trim()
            }
            None => {
                files.extend(names(&rest[..comma])?.into_iter().map(str::to_owned));
                &rest[comma..]
            }
        };
        if after.is_empty() {
            return Some(files);
        }
        rest = after.strip_prefix(',')?;
    }
}

/// `a, b`
fn names(text: &str) -> Option<Vec<&str>> {
    text.split(',').map(str::trim).map(|name| is_name(name).then_some(name)).collect()
}

fn is_name(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '/' | ' '))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_names_files_and_what_is_left_open() {
        let both =
            "// uses: lib/angle, gather/{ input, tap}, the material set; needs: tiles, bound\n\nfn f() {}\n";
        let (header, rest) = split(both).expect("a header");
        assert_eq!(header.uses, ["lib/angle", "gather/input", "gather/tap", "the material set"]);
        assert_eq!(header.needs, ["tiles", "bound"]);
        assert_eq!(rest, "\nfn f() {}\n");
        let (header, _) = split("// needs: tiles\n").expect("a header");
        assert_eq!((header.uses.len(), header.needs), (0, vec!["tiles"]));
        let (header, _) = split("// uses: kernels/interleaved/{far, near}").expect("a header");
        assert_eq!(header.uses, ["kernels/interleaved/far", "kernels/interleaved/near"]);
        let (header, rest) = split("// Uses nothing.\nfn f() {}").expect("no header");
        assert_eq!((header, rest), (Header::default(), "// Uses nothing.\nfn f() {}"));
    }

    #[test]
    fn a_line_that_says_nothing_is_none() {
        for line in [
            "// uses:",
            "// uses: lib/angle,",
            "// uses: lib/angle; tiles",
            "// uses: lib/angle; needs:",
            "// needs:",
            "// needs: a; uses: b",
            "// uses: a, , b",
            "// uses: lib/{a, b",
            "// uses: lib/{a} b",
            "// uses: lib{a}",
            "// uses: lib/{}",
        ] {
            assert_eq!(split(&format!("{line}\nfn f() {{}}")), Err(line));
        }
    }
}
