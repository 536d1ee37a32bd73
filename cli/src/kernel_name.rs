//! Kernels as people write them: `interleaved:8`.

use crate::suggestion::suggest;
use std::fmt;
use std::str::FromStr;
use subsurface_codegen::Kernel;

/// A kernel's name, with a number of taps where one was given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelName {
    /// Which kernel.
    pub family: Family,
    /// Taps per pixel (of the separable kernels: per pass); `None` for the kernel's usual number.
    pub taps: Option<u32>,
}

/// Kernels that differ in their taps alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// [`Kernel::Interleaved`].
    Interleaved,
    /// [`Kernel::ImportanceSampled`].
    ImportanceSampled,
    /// [`Kernel::Separable`], the same axes everywhere.
    Separable,
    /// [`Kernel::Separable`], axes turned per pixel.
    SeparableRotated,
    /// [`Kernel::Dense`].
    Dense,
}

impl Family {
    /// All of them, the default first.
    pub const ALL: [Self; 5] =
        [Self::Interleaved, Self::ImportanceSampled, Self::Separable, Self::SeparableRotated, Self::Dense];

    /// The name on the command line and in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Interleaved => "interleaved",
            Self::ImportanceSampled => "importance-sampled",
            Self::Separable => "separable",
            Self::SeparableRotated => "separable-rotated",
            Self::Dense => "dense",
        }
    }

    /// The kernel with so many taps; an error says which numbers it may have.
    fn kernel(self, taps: u32) -> Result<Kernel, String> {
        let (kernel, most) = match self {
            Self::Interleaved => (Kernel::Interleaved { taps }, 64),
            Self::ImportanceSampled => (Kernel::ImportanceSampled { taps }, 4096),
            Self::Separable => (Kernel::Separable { taps, rotated: false }, 65),
            Self::SeparableRotated => (Kernel::Separable { taps, rotated: true }, 65),
            Self::Dense => return Err("dense reads every pixel in reach: it has no number of taps".into()),
        };
        match kernel {
            Kernel::Separable { .. } if taps.is_multiple_of(2) || !(3..=most).contains(&taps) => {
                Err(format!("{} has an odd number of taps from 3 to {most}, not {taps}", self.name()))
            }
            _ if !(1..=most).contains(&taps) => {
                Err(format!("{} has 1 to {most} taps, not {taps}", self.name()))
            }
            _ => Ok(kernel),
        }
    }

    /// Taps where none are given.
    fn usual_taps(self) -> u32 {
        match self {
            Self::Interleaved => Kernel::default().taps(),
            // What the literature uses: Liang et al. 2023 and Jimenez et al. 2015.
            _ => 17,
        }
    }
}

impl KernelName {
    /// The name of a kernel; `None` for one that has no name here yet.
    pub fn of(kernel: Kernel) -> Option<Self> {
        let family = match kernel {
            Kernel::Interleaved { .. } => Family::Interleaved,
            Kernel::ImportanceSampled { .. } => Family::ImportanceSampled,
            Kernel::Separable { rotated: false, .. } => Family::Separable,
            Kernel::Separable { rotated: true, .. } => Family::SeparableRotated,
            Kernel::Dense => return Some(Self { family: Family::Dense, taps: None }),
            _ => return None,
        };
        Some(Self { family, taps: Some(kernel.taps()) })
    }

    /// The kernel of this name.
    ///
    /// # Errors
    /// A number of taps that it cannot have, in words.
    pub fn kernel(self) -> Result<Kernel, String> {
        match (self.family, self.taps) {
            (Family::Dense, None) => Ok(Kernel::Dense),
            (family, taps) => family.kernel(taps.unwrap_or(family.usual_taps())),
        }
    }
}

impl fmt::Display for KernelName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.family.name())?;
        self.taps.map_or(Ok(()), |taps| write!(f, ":{taps}"))
    }
}

impl FromStr for KernelName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, taps) = match text.split_once(':') {
            Some((name, taps)) => (name, Some(taps)),
            None => (text, None),
        };
        let family = Family::ALL.into_iter().find(|family| family.name() == name).ok_or_else(|| {
            let names = Family::ALL.map(|family| family.name().to_owned());
            format!("no kernel is called `{name}`; {}", suggest(name, &names))
        })?;
        let number = |taps: &str| {
            taps.parse().map_err(|_| format!("`{taps}` is no number of taps; write for example {name}:8"))
        };
        Ok(Self { family, taps: taps.map(number).transpose()? })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use subsurface_codegen::Compiler;

    fn kernel(text: &str) -> Result<Kernel, String> {
        text.parse::<KernelName>()?.kernel()
    }

    #[test]
    fn a_name_is_read_as_it_is_written() {
        for text in ["interleaved:8", "importance-sampled:33", "separable:17", "separable-rotated:5", "dense"]
        {
            assert_eq!(KernelName::of(kernel(text).unwrap()).unwrap().to_string(), text);
        }
        assert_eq!(kernel("interleaved"), Ok(Kernel::default()));
        assert_eq!(kernel("separable"), Ok(Kernel::Separable { taps: 17, rotated: false }));
    }

    #[test]
    fn a_wrong_name_or_number_says_what_is_right() {
        for (text, says) in [
            ("interleafed", "did you mean `interleaved`?"),
            ("gauss", "there are: interleaved, importance-sampled"),
            ("interleaved:", "`` is no number of taps; write for example interleaved:8"),
            ("interleaved:0", "interleaved has 1 to 64 taps, not 0"),
            ("interleaved:65", "1 to 64"),
            ("importance-sampled:4097", "1 to 4096"),
            ("separable:16", "an odd number of taps from 3 to 65, not 16"),
            ("separable:1", "an odd number"),
            ("dense:3", "no number of taps"),
        ] {
            let error = kernel(text).unwrap_err();
            assert!(error.contains(says), "{text}: {error}");
        }
    }

    #[test]
    fn the_compiler_takes_the_same_numbers() {
        let skin = "Material(profile: Burley(parametrization: Searchlight), mean_free_path_mm: (1.3, 0.95, 0.67), \
                    surface_albedo: (0.83, 0.64, 0.55))";
        let compiles = |kernel| Compiler::from_memory([("skin.ron", skin)]).kernel(kernel).compile().is_ok();
        type WithTaps = fn(u32) -> Kernel;
        let families: [(Family, WithTaps); 3] = [
            (Family::Interleaved, |taps| Kernel::Interleaved { taps }),
            (Family::ImportanceSampled, |taps| Kernel::ImportanceSampled { taps }),
            (Family::Separable, |taps| Kernel::Separable { taps, rotated: false }),
        ];
        for (family, with_taps) in families {
            for taps in [0, 1, 2, 3, 4, 63, 64, 65, 66, 67, 4096, 4097] {
                let named = KernelName { family, taps: Some(taps) }.kernel().is_ok();
                assert_eq!(named, compiles(with_taps(taps)), "{} with {taps} taps", family.name());
            }
        }
    }
}
