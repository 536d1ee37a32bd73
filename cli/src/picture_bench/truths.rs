//! The truths of a folder: `truths.txt` names them, an EXR file of that name holds each.

use crate::command::view::{MeshArguments, ViewArguments};
use crate::failure::Failure;
use crate::picture::comparison::Truth;
use crate::scene::camera::Size;
use clap::{Args, Parser};
use std::path::Path;

/// The list's name in the folder.
const LIST: &str = "truths.txt";

/// A scene that a path tracer has rendered.
#[derive(Debug)]
pub struct TruthCase {
    /// Its name, which is also the picture's.
    pub name: String,
    /// Its material.
    pub material: String,
    /// What `subsurface export` was given.
    pub scene: SceneArguments,
    /// What the path tracer saw.
    pub truth: Truth,
}

/// The arguments of `subsurface export` and `subsurface render` that say what a picture shows.
#[derive(Debug, Args)]
pub struct SceneArguments {
    /// What is drawn.
    #[command(flatten)]
    pub mesh: MeshArguments,
    /// Camera and lights.
    #[command(flatten)]
    pub view: ViewArguments,
    /// Size of the picture in pixels.
    #[arg(long)]
    pub size: Size,
}

#[derive(Debug, Parser)]
struct Line {
    #[command(flatten)]
    scene: SceneArguments,
}

/// Reads the truths of a folder; those of `names` alone, if there are some.
pub fn read(folder: &Path, names: &[String]) -> Result<Vec<TruthCase>, Failure> {
    let list = folder.join(LIST);
    let text = std::fs::read_to_string(&list).map_err(|reason| {
        let message = format!("cannot read {}: {reason}", list.display());
        Failure::new(message, "name the folder of the truths with --truths, such as reference/pictures")
    })?;
    let mut cases = Vec::new();
    for (number, line) in text.lines().enumerate() {
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let place = || format!("{}:{}", list.display(), number + 1);
        let form = "write `name material = arguments of subsurface export`";
        let (head, arguments) = line
            .split_once(" = ")
            .ok_or_else(|| Failure::new(format!("{}: no ` = ` in this line", place()), form))?;
        let [name, material] = head.split_whitespace().collect::<Vec<_>>()[..] else {
            return Err(Failure::new(format!("{}: expected two words before ` = `", place()), form));
        };
        if !names.is_empty() && !names.iter().any(|wanted| wanted == name) {
            continue;
        }
        let words = std::iter::once(name).chain(arguments.split_whitespace());
        let Line { scene } = Line::try_parse_from(words).map_err(|error| {
            Failure::new(format!("{}: {error}", place()), "see `subsurface export --help`")
        })?;
        let truth = Truth::read(&folder.join(name).with_extension("exr"))?;
        if truth.picture.size != scene.size {
            let message = format!("{}: its picture has {} pixels", place(), truth.picture.size);
            return Err(Failure::new(message, "render it again with reference/pictures/render.py"));
        }
        cases.push(TruthCase { name: name.to_owned(), material: material.to_owned(), scene, truth });
    }
    if cases.is_empty() {
        return Err(Failure::new(
            format!("{}: no truth has such a name", list.display()),
            "leave --truth out, or name one that the list has",
        ));
    }
    Ok(cases)
}
