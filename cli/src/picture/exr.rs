//! OpenEXR files: channels by name.

use super::file::write_atomically;
use super::{LinearPicture, PictureError};
use crate::scene::camera::Size;
use ::exr::prelude::*;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The channels of a file, all flat, of the largest resolution level.
#[derive(Clone, Debug)]
pub struct Channels {
    file: PathBuf,
    channels: Vec<NamedChannel>,
}

#[derive(Clone, Debug)]
struct NamedChannel {
    /// Name in the file: `R`, `Z`, `irradiance.R`.
    name: String,
    /// The same with the layer's name before it, where the layer has one.
    full_name: String,
    size: (usize, usize),
    samples: FlatSamples,
}

impl Channels {
    /// Reads all channels of all layers.
    pub fn read(path: &Path) -> std::result::Result<Self, PictureError> {
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_file(path)
            .map_err(|reason| PictureError::Unreadable {
                file: path.to_owned(),
                reason: reason.to_string(),
            })?;
        let mut channels = Vec::new();
        for layer in image.layer_data {
            let layer_name = layer.attributes.layer_name.as_ref().map(Text::to_string);
            for channel in layer.channel_data.list {
                let name = channel.name.to_string();
                let full_name = match &layer_name {
                    Some(layer) if !layer.is_empty() => format!("{layer}.{name}"),
                    _ => name.clone(),
                };
                let size =
                    (layer.size.0 / channel.sampling.0.max(1), layer.size.1 / channel.sampling.1.max(1));
                channels.push(NamedChannel { name, full_name, size, samples: channel.sample_data });
            }
        }
        Ok(Self { file: path.to_owned(), channels })
    }

    /// The full names of all channels, sorted.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = self.channels.iter().map(|channel| channel.full_name.clone()).collect();
        names.sort();
        names
    }

    /// Whether there is a channel of this name.
    pub fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }

    /// Size of a channel in pixels.
    pub fn size(&self, name: &str) -> std::result::Result<Size, PictureError> {
        let (width, height) = self.channel(name)?.size;
        let edge = |edge: usize| {
            u32::try_from(edge).ok().filter(|edge| (1..=Size::LARGEST).contains(edge)).ok_or_else(|| {
                PictureError::Unreadable {
                    file: self.file.clone(),
                    reason: format!("{width}x{height} pixels; at most {0}x{0} are read", Size::LARGEST),
                }
            })
        };
        Ok(Size { width: edge(width)?, height: edge(height)? })
    }

    /// The samples of a channel as `f32`, rows from the top; it must have `size`.
    pub fn samples(&self, name: &str, size: Size) -> std::result::Result<Vec<f32>, PictureError> {
        let channel = self.channel(name)?;
        let expected = (size.width as usize, size.height as usize);
        if channel.size != expected || channel.samples.len() != size.pixels() {
            return Err(PictureError::ChannelSize {
                file: self.file.clone(),
                channel: channel.full_name.clone(),
                found: channel.size,
                expected,
            });
        }
        Ok(channel.samples.values_as_f32().collect())
    }

    /// The samples of `PREFIX.R`, `PREFIX.G` and `PREFIX.B` together.
    pub fn colours(&self, prefix: &str, size: Size) -> std::result::Result<Vec<[f32; 3]>, PictureError> {
        let [r, g, b] = ["R", "G", "B"].map(|letter| self.samples(&format!("{prefix}.{letter}"), size));
        let (r, g, b) = (r?, g?, b?);
        Ok(r.into_iter().zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect())
    }

    fn channel(&self, name: &str) -> std::result::Result<&NamedChannel, PictureError> {
        self.find(name).ok_or_else(|| PictureError::MissingChannel {
            file: self.file.clone(),
            channel: name.to_owned(),
            present: self.names(),
        })
    }

    /// By full name first: a file may have `R` in several layers.
    fn find(&self, name: &str) -> Option<&NamedChannel> {
        let by_full_name = self.channels.iter().find(|channel| channel.full_name == name);
        by_full_name.or_else(|| self.channels.iter().find(|channel| channel.name == name))
    }
}

/// Writes `R`, `G`, `B` as 32-bit floats, bit for bit (compression is lossless).
pub fn write_exr(path: &Path, picture: &LinearPicture) -> std::result::Result<(), PictureError> {
    let planes: [Vec<f32>; 3] =
        std::array::from_fn(|channel| picture.pixels.iter().map(|p| p[channel]).collect());
    write_channels(path, picture.size, ["R", "G", "B"].into_iter().zip(planes))
}

/// Writes channels of any names as 32-bit floats; each must have `size.pixels()` samples.
pub fn write_channels<'a>(
    path: &Path,
    size: Size,
    channels: impl IntoIterator<Item = (&'a str, Vec<f32>)>,
) -> std::result::Result<(), PictureError> {
    let unencodable = |reason: String| PictureError::Unencodable { file: path.to_owned(), reason };
    let mut list = SmallVec::<[AnyChannel<FlatSamples>; 4]>::new();
    for (name, samples) in channels {
        let name = Text::new_or_none(name).ok_or_else(|| unencodable(format!("`{name}` is not ASCII")))?;
        list.push(AnyChannel::new(name, FlatSamples::F32(samples)));
    }
    let layer = Layer::new(
        (size.width as usize, size.height as usize),
        LayerAttributes::default(),
        // Blocks in order: else they lie in the file as the threads that pack them get done, other bytes every time.
        Encoding { line_order: LineOrder::Increasing, ..Encoding::FAST_LOSSLESS },
        AnyChannels::sort(list),
    );
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .to_buffered(&mut bytes)
        .map_err(|reason| unencodable(reason.to_string()))?;
    write_atomically(path, bytes.get_ref())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    const SIZE: Size = Size { width: 3, height: 2 };

    #[test]
    fn what_is_written_is_read_bit_for_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let values = [0.0, -0.0, 1e-38, 1e38, f32::INFINITY, 0.1];
        let pixels: Vec<[f32; 3]> = values.iter().map(|v| [*v, v * 0.5, -v]).collect();
        let picture = LinearPicture { size: SIZE, pixels };
        write_exr(&path, &picture).unwrap();
        let channels = Channels::read(&path).unwrap();
        assert_eq!(channels.names(), ["B", "G", "R"]);
        for (index, name) in ["R", "G", "B"].iter().enumerate() {
            let samples = channels.samples(name, channels.size(name).unwrap()).unwrap();
            let expected: Vec<u32> = picture.pixels.iter().map(|p| p[index].to_bits()).collect();
            assert_eq!(samples.iter().map(|v| v.to_bits()).collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn the_same_picture_gives_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        // Several blocks of lines, to be packed by several threads, and not all as fast.
        let size = Size { width: 256, height: 512 };
        let noise = |i: usize| if i < size.pixels() / 2 { 0.5 } else { (i * 7919 % 1013) as f32 };
        let bytes = || {
            write_channels(&path, size, [("Z", (0..size.pixels()).map(noise).collect())]).unwrap();
            std::fs::read(&path).unwrap()
        };
        let first = bytes();
        assert!((0..20).all(|_| bytes() == first));
    }

    #[test]
    fn layers_and_dotted_names_are_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let (flat, layered) = (folder.path().join("flat.exr"), folder.path().join("layered.exr"));
        let plane = |k: f32| (0..6).map(|i| k + i as f32).collect::<Vec<f32>>();
        let names = ["irradiance.R", "irradiance.G", "irradiance.B"];
        write_channels(&flat, SIZE, names.into_iter().zip([plane(0.0), plane(10.0), plane(20.0)])).unwrap();

        let half = |k: f32| FlatSamples::F16(plane(k).into_iter().map(f16::from_f32).collect());
        let irradiance = AnyChannels::sort(SmallVec::from_vec(vec![
            AnyChannel::new("R", half(0.0)),
            AnyChannel::new("G", half(10.0)),
            AnyChannel::new("B", half(20.0)),
        ]));
        let ids = AnyChannels::sort(SmallVec::from_vec(vec![AnyChannel::new(
            "material",
            FlatSamples::U32(vec![7; 6]),
        )]));
        let layer = |name, channels| {
            Layer::new((3, 2), LayerAttributes::named(name), Encoding::UNCOMPRESSED, channels)
        };
        Image::from_layers(
            ImageAttributes::new(IntegerBounds::from_dimensions((3, 2))),
            vec![layer("irradiance", irradiance), layer("ids", ids)],
        )
        .write()
        .to_file(&layered)
        .unwrap();

        let (flat, layered) = (Channels::read(&flat).unwrap(), Channels::read(&layered).unwrap());
        assert_eq!(flat.colours("irradiance", SIZE).unwrap(), layered.colours("irradiance", SIZE).unwrap());
        assert_eq!(layered.samples("material", SIZE).unwrap(), [7.0; 6]);
    }

    #[test]
    fn a_missing_channel_is_named_with_those_present() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        write_channels(&path, SIZE, [("Z", vec![1.0; 6])]).unwrap();
        let error = Channels::read(&path).unwrap().colours("irradiance", SIZE).unwrap_err();
        assert!(
            matches!(&error, PictureError::MissingChannel { channel, present, .. } if channel == "irradiance.R" && present == &["Z"])
        );
        std::fs::write(&path, b"no exr").unwrap();
        assert!(matches!(Channels::read(&path), Err(PictureError::Unreadable { .. })));
    }
}
