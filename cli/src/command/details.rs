//! `--mean-free-path-scale` and `--thickness-mm`: what the command line says of all surfaces of a scene.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;

use super::number;
use crate::failure::{Explain, Failure, warning};
use crate::scene::{Image, Scene};

/// A factor, and an image that it is the factor on.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    factor: f32,
    image: Option<PathBuf>,
}

impl FromStr for Detail {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (factor, image) = match text.split_once(',') {
            Some((factor, image)) => (factor, Some(image)),
            None => (text, None),
        };
        if image.is_some_and(str::is_empty) {
            return Err("the image has no name".to_owned());
        }
        Ok(Self { factor: number::detail(factor)?, image: image.map(PathBuf::from) })
    }
}

/// What a scene's surfaces have beside colours and normals.
#[derive(Clone, Debug, Default, Args)]
pub struct DetailArguments {
    /// Factor on the mean free path of all objects that scatter; with an image, whose red channel lies over the texture
    /// coordinates, a factor on that, such as 1,density.png.
    #[arg(long, value_name = "FACTOR[,FILE.png]", allow_hyphen_values = true)]
    pub mean_free_path_scale: Option<Detail>,
    /// Thickness of all objects that scatter, in mm; with an image, that where its green channel is 1, such as
    /// 5,thickness.png.
    ///
    /// A sheet is as thick in place of what its material says. Through a solid, light from all around comes so (--ambient,
    /// --environment), and that of lights beyond the four that have shadow maps, and its near side sends back less of that;
    /// what a map sees of a solid it measures.
    #[arg(long, value_name = "MM[,FILE.png]", allow_hyphen_values = true)]
    pub thickness_mm: Option<Detail>,
}

impl DetailArguments {
    /// Puts them on all objects but those that are black; prints warnings.
    pub(super) fn apply(&self, scene: &mut Scene) -> Result<(), Failure> {
        let read = |detail: &Option<Detail>| -> Result<Option<Image>, Failure> {
            detail.as_ref().and_then(|detail| detail.image.as_deref()).map(read_image).transpose()
        };
        let (scale, thickness) = (read(&self.mean_free_path_scale)?, read(&self.thickness_mm)?);
        let has_image = scale.is_some() || thickness.is_some();
        for object in scene.objects.iter_mut().filter(|object| !object.surface.is_black) {
            if has_image && object.mesh.texture_coordinates.iter().all(|place| *place == [0.0; 2]) {
                eprintln!("{}\n", warning(&NoPlace { object: object.name.clone() }));
            }
            let surface = &mut object.surface;
            if let Some(detail) = &self.mean_free_path_scale {
                surface.mean_free_path_scale_factor = detail.factor;
                surface.mean_free_path_scale.clone_from(&scale);
            }
            if let Some(detail) = &self.thickness_mm {
                surface.thickness_mm = detail.factor;
                surface.thickness.clone_from(&thickness);
            }
        }
        Ok(())
    }
}

/// An object on which no image lies.
struct NoPlace {
    object: String,
}

impl fmt::Display for NoPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` has no texture coordinates: it takes the image's upper left pixel everywhere",
            self.object
        )
    }
}

impl Explain for NoPlace {
    fn help(&self) -> Option<String> {
        Some("unwrap the mesh, or give the number alone".to_owned())
    }
}

/// An image of any format that the program reads.
fn read_image(path: &Path) -> Result<Image, Failure> {
    let unreadable = |reason: String| {
        Failure::new(
            format!("cannot read {}: {reason}", path.display()),
            "give a .png or .jpg file of linear values",
        )
    };
    let bytes = std::fs::read(path).map_err(|reason| unreadable(reason.to_string()))?;
    Image::decoded(&bytes).map_err(|reason| unreadable(reason.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_detail_is_a_factor_and_perhaps_an_image() {
        assert_eq!("0.5".parse(), Ok(Detail { factor: 0.5, image: None }));
        assert_eq!("2,a,b.png".parse(), Ok(Detail { factor: 2.0, image: Some("a,b.png".into()) }));
        for bad in ["", "a.png", "1,", "-1", "inf", "NaN,a.png", "0"] {
            assert!(bad.parse::<Detail>().is_err(), "{bad}");
        }
    }
}
