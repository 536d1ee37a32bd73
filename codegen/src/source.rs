//! The text of every file that was read, and places in it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use codespan_reporting::files::{self, Files};

/// One file of a [`SourceMap`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(u32);

/// A range of bytes in one file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// Byte offsets into the file's text; both ends lie on character boundaries.
    pub range: Range<usize>,
}

impl Span {
    /// The span of `range` in `file`.
    #[must_use]
    pub fn new(file: FileId, range: Range<usize>) -> Self {
        Self { file, range }
    }
}

/// A value and the place where it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Where it is written.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// `value`, written at `span`.
    pub fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }
}

/// A place as a person reads it: lines and columns count from 1, columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters (not bytes), from 1.
    pub column: usize,
}

#[derive(Clone, Debug)]
struct SourceFile {
    path: String,
    text: Arc<str>,
    /// Byte offset of the first character of every line.
    line_starts: Arc<[usize]>,
}

/// The text of every file that was read, with its path as shown to the reader.
///
/// The files may come from disk or from memory (tests, editors, emitted WGSL): the map does not care. Paths are
/// shown with `/` on every system, so that a diagnostic reads the same everywhere.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    files: Vec<SourceFile>,
    by_path: BTreeMap<String, FileId>,
}

impl SourceMap {
    /// An empty map.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file, or replaces the text of the file already known by this path.
    pub fn add(&mut self, path: impl AsRef<Path>, text: impl Into<Arc<str>>) -> FileId {
        let path = displayed(path.as_ref());
        let text = text.into();
        let line_starts = files::line_starts(&text).collect();
        let file = SourceFile { path: path.clone(), text, line_starts };
        if let Some(&id) = self.by_path.get(&path) {
            self.files[id.0 as usize] = file;
            return id;
        }
        let id = FileId(u32::try_from(self.files.len()).expect("fewer than 2^32 files fit in memory"));
        self.files.push(file);
        self.by_path.insert(path, id);
        id
    }

    /// The file known by this path.
    #[must_use]
    pub fn find(&self, path: impl AsRef<Path>) -> Option<FileId> {
        self.by_path.get(&displayed(path.as_ref())).copied()
    }

    /// The path as displayed.
    ///
    /// # Panics
    /// When `file` comes from another map.
    #[must_use]
    pub fn path(&self, file: FileId) -> &str {
        &self.files[file.0 as usize].path
    }

    /// The whole text.
    ///
    /// # Panics
    /// When `file` comes from another map.
    #[must_use]
    pub fn text(&self, file: FileId) -> &Arc<str> {
        &self.files[file.0 as usize].text
    }

    /// Every file, in the order in which they were added.
    pub fn files(&self) -> impl Iterator<Item = FileId> + use<> {
        (0..self.files.len()).map(|index| FileId(u32::try_from(index).expect("ids were made from u32")))
    }

    /// Line and column of a byte offset; offsets past the end count as the end.
    ///
    /// # Panics
    /// When `file` comes from another map.
    #[must_use]
    pub fn position(&self, file: FileId, offset: usize) -> Position {
        let source = &self.files[file.0 as usize];
        let offset = offset.min(source.text.len());
        let line = source.line_starts.partition_point(|&start| start <= offset).saturating_sub(1);
        let column = source.text[source.line_starts[line]..]
            .char_indices()
            .take_while(|(index, _)| source.line_starts[line] + index < offset)
            .count();
        Position { line: line + 1, column: column + 1 }
    }

    /// `path:line:column` of the first character of `span`.
    ///
    /// # Panics
    /// When the span's file comes from another map.
    #[must_use]
    pub fn location(&self, span: &Span) -> String {
        let Position { line, column } = self.position(span.file, span.range.start);
        format!("{}:{line}:{column}", self.path(span.file))
    }
}

/// The path as shown: with `/` on every system.
fn displayed(path: &Path) -> String {
    let path = path.to_string_lossy();
    if std::path::MAIN_SEPARATOR == '/' { path.into_owned() } else { path.replace('\\', "/") }
}

impl<'a> Files<'a> for SourceMap {
    type FileId = FileId;
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, id: FileId) -> Result<&'a str, files::Error> {
        self.files.get(id.0 as usize).map(|file| file.path.as_str()).ok_or(files::Error::FileMissing)
    }

    fn source(&'a self, id: FileId) -> Result<&'a str, files::Error> {
        self.files.get(id.0 as usize).map(|file| &*file.text).ok_or(files::Error::FileMissing)
    }

    fn line_index(&'a self, id: FileId, byte_index: usize) -> Result<usize, files::Error> {
        let file = self.files.get(id.0 as usize).ok_or(files::Error::FileMissing)?;
        Ok(file.line_starts.partition_point(|&start| start <= byte_index).saturating_sub(1))
    }

    fn line_range(&'a self, id: FileId, line_index: usize) -> Result<Range<usize>, files::Error> {
        let file = self.files.get(id.0 as usize).ok_or(files::Error::FileMissing)?;
        let start = *file.line_starts.get(line_index).ok_or(files::Error::LineTooLarge {
            given: line_index,
            max: file.line_starts.len().saturating_sub(1),
        })?;
        let end = file.line_starts.get(line_index + 1).copied().unwrap_or(file.text.len());
        Ok(start..end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_and_lines_end_with_lf_or_crlf() {
        let mut sources = SourceMap::new();
        let file = sources.add("a.ron", "é: 1\r\nüü x");
        assert_eq!(sources.position(file, 0), Position { line: 1, column: 1 });
        assert_eq!(sources.position(file, 2), Position { line: 1, column: 2 }); // after é, two bytes
        let x = "é: 1\r\nüü ".len();
        assert_eq!(sources.position(file, x), Position { line: 2, column: 4 });
        assert_eq!(sources.position(file, 1000), Position { line: 2, column: 5 });
        assert_eq!(sources.location(&Span::new(file, x..x + 1)), "a.ron:2:4");
    }

    #[test]
    fn a_path_read_again_keeps_its_id_and_takes_the_new_text() {
        let mut sources = SourceMap::new();
        let first = sources.add("a.ron", "old");
        let other = sources.add("b.ron", "other");
        assert_eq!(sources.add("a.ron", "new"), first);
        assert_eq!(&**sources.text(first), "new");
        assert_eq!(sources.find("b.ron"), Some(other));
        assert_eq!(sources.files().count(), 2);
    }
}
