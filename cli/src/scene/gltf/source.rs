//! The bytes that a glTF file refers to: buffers and images, in the file, beside it, or as data URIs.

use super::GltfError;
use crate::scene::Image;
use std::fs;
use std::path::Path;

/// Parses the file itself.
pub(super) fn open(path: &Path) -> Result<gltf::Gltf, GltfError> {
    let bytes = fs::read(path).map_err(|reason| GltfError::Unreadable { file: path.to_owned(), reason })?;
    let malformed = |reason: String| GltfError::Malformed { file: path.to_owned(), reason };
    if bytes.is_empty() {
        return Err(malformed("it is empty".into()));
    }
    // A .glb says its own length; naming both lengths says more than the parser's "unexpected end of file".
    if let (true, Some(Ok(length))) = (bytes.starts_with(b"glTF"), bytes.get(8..12).map(<[u8; 4]>::try_from))
    {
        let expected = u32::from_le_bytes(length) as usize;
        if bytes.len() < expected {
            return Err(malformed(format!("it has {} bytes of {expected}", bytes.len())));
        }
    }
    // The parser's own validation follows a primitive's POSITION before it has checked the number.
    let unchecked =
        gltf::Gltf::from_slice_without_validation(&bytes).map_err(|reason| malformed(reason.to_string()))?;
    let root = unchecked.document.as_json();
    for (index, primitive) in root.meshes.iter().flat_map(|mesh| &mesh.primitives).enumerate() {
        let dangling =
            primitive.attributes.values().find(|accessor| accessor.value() >= root.accessors.len());
        if let Some(accessor) = dangling {
            return Err(malformed(format!(
                "primitive {index} of all uses accessor {}, which does not exist",
                accessor.value()
            )));
        }
    }
    let gltf::Gltf { document, blob } =
        gltf::Gltf::from_slice_without_validation(&bytes).map_err(|reason| malformed(reason.to_string()))?;
    let mut root = document.into_json();
    root.extensions_required.retain(|extension| !READ.contains(&extension.as_str()));
    let document = gltf::Document::from_json(root).map_err(|reason| malformed(reason.to_string()))?;
    Ok(gltf::Gltf { document, blob })
}

/// Extensions that are read, and that the library does not know a file may require.
const READ: [&str; 2] = ["KHR_materials_specular", "KHR_materials_volume"];

/// All buffers of one file.
pub(super) struct Sources {
    file: std::path::PathBuf,
    buffers: Vec<Vec<u8>>,
}

impl Sources {
    pub(super) fn load(
        path: &Path,
        document: &gltf::Document,
        blob: Option<&[u8]>,
    ) -> Result<Self, GltfError> {
        let mut buffers = Vec::new();
        for buffer in document.buffers() {
            let unreadable = |reason: String| GltfError::BufferUnreadable {
                file: path.to_owned(),
                buffer: buffer.index(),
                reason,
            };
            let bytes = match buffer.source() {
                gltf::buffer::Source::Bin => {
                    blob.ok_or_else(|| unreadable("the file has no binary part".into()))?.to_vec()
                }
                gltf::buffer::Source::Uri(uri) => fetch(path, uri).map_err(unreadable)?,
            };
            if bytes.len() < buffer.length() {
                return Err(GltfError::BufferTooShort {
                    file: path.to_owned(),
                    buffer: buffer.index(),
                    expected: buffer.length(),
                    found: bytes.len(),
                });
            }
            buffers.push(bytes);
        }
        Ok(Self { file: path.to_owned(), buffers })
    }

    /// The bytes of a view, if it lies inside its buffer.
    pub(super) fn view(&self, view: &gltf::buffer::View<'_>) -> Option<&[u8]> {
        let end = view.offset().checked_add(view.length())?;
        self.buffers.get(view.buffer().index())?.get(view.offset()..end)
    }

    /// Decodes an image.
    pub(super) fn image(&self, source: &gltf::Image<'_>) -> Result<Image, GltfError> {
        let name = source.name().map_or_else(|| format!("#{}", source.index()), |name| format!("`{name}`"));
        let unreadable = |reason: String| GltfError::ImageUnreadable {
            file: self.file.clone(),
            image: name.clone(),
            reason,
        };
        let fetched;
        let bytes = match source.source() {
            gltf::image::Source::View { view, .. } => {
                self.view(&view).ok_or_else(|| unreadable("it reaches beyond its buffer".into()))?
            }
            gltf::image::Source::Uri { uri, .. } => {
                fetched = fetch(&self.file, uri).map_err(unreadable)?;
                &fetched
            }
        };
        Image::decoded(bytes).map_err(|reason| unreadable(reason.to_string()))
    }
}

/// What a URI names: a `data:` URI or a file relative to the folder of `path`.
fn fetch(path: &Path, uri: &str) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (head, body) = data.split_once(',').ok_or("the data URI has no comma")?;
        if !head.ends_with(";base64") {
            return Err("the data URI is not base64".into());
        }
        return base64(body).ok_or_else(|| "the data URI is not valid base64".into());
    }
    if uri.contains("://") {
        return Err(format!("`{uri}` is not a file beside the glTF"));
    }
    let relative = percent_decode(uri).ok_or_else(|| format!("`{uri}` is not a valid URI"))?;
    let file = path.parent().unwrap_or(Path::new("")).join(&relative);
    fs::read(&file).map_err(|reason| format!("cannot read {}: {reason}", file.display()))
}

/// `%20` and the like.
fn percent_decode(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        if byte == b'%' {
            let pair = [rest.next()?, rest.next()?];
            let hex = std::str::from_utf8(&pair).ok()?;
            bytes.push(u8::from_str_radix(hex, 16).ok()?);
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).ok()
}

/// RFC 4648 §4; padding may be missing, as some exporters leave it out.
fn base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut bits, mut count) = (0u32, 0u32);
    for character in text.trim_end_matches('=').bytes() {
        let six = match character {
            b'A'..=b'Z' => character - b'A',
            b'a'..=b'z' => character - b'a' + 26,
            b'0'..=b'9' => character - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        bits = bits << 6 | u32::from(six);
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
            bits &= (1 << count) - 1;
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_rfc_4648() {
        for (text, bytes) in
            [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYmFy", "foobar")]
        {
            assert_eq!(base64(text).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(base64("Z g="), None);
    }

    #[test]
    fn percent_signs_need_two_digits() {
        assert_eq!(percent_decode("a%20b").as_deref(), Some("a b"));
        assert_eq!(percent_decode("a%2"), None);
        assert_eq!(percent_decode("a%zz"), None);
        assert_eq!(percent_decode("%ff"), None);
    }
}
