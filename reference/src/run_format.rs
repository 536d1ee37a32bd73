//! Runs as bytes.
//!
//! ```text
//! magic "SUBSRUN\0", version u32                             little-endian, like all that follows
//! entry u8, anisotropy f64, refractive index f64
//! batch size, followed photons, short limit, long limit, rings, rows     u32 each: what this program was built with
//! number of seeds u32, then per seed: seed u64, number of ranges u32, then per range: begin u64, end u64
//! events, short survivors, long survivors                    u64 each
//! counts                                                     LEB128, row by row; a 0 is followed by how many more zeros
//! CRC-32 of all before                                       u32
//! ```
//!
//! 10⁹ photons take less than 1 MB.

use std::collections::BTreeMap;

use crate::batch_set::BatchSet;
use crate::histogram::Histogram;
use crate::radial_grid::RINGS;
use crate::walk::{BATCH, FOLLOWED};
use crate::{Entry, HalfSpace, HalfSpaceError, Run};

const MAGIC: [u8; 8] = *b"SUBSRUN\0";

/// Goes up when the layout, the rings, the rows, the random numbers or the walk change: photons of different versions must
/// not be mixed.
const VERSION: u32 = 1;

/// No file has more seeds, or more ranges of a seed: one million machines.
const MAXIMUM_ITEMS: u32 = 1 << 20;

/// Why bytes are not a run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RunFormatError {
    /// Some other kind of file.
    #[error(
        "this is not a simulation run (it does not begin with \"SUBSRUN\"): give a file that a simulation wrote"
    )]
    Foreign,
    /// Another version of the format.
    #[error(
        "the run has format version {0}, this program reads version {VERSION}: simulate again, or use the program that wrote it"
    )]
    Version(u32),
    /// The file ends too early.
    #[error(
        "the run ends after {0} bytes, in the middle of its contents: the file was cut off, use an earlier copy"
    )]
    Truncated(usize),
    /// Bytes changed.
    #[error("the checksum of the run does not match its contents: the file is damaged, use an earlier copy")]
    Checksum,
    /// Bytes after the end.
    #[error("{0} bytes follow the end of the run: the file is damaged, use an earlier copy")]
    Trailing(usize),
    /// The medium cannot be.
    #[error("the medium of the run cannot be: {0}")]
    HalfSpace(#[from] HalfSpaceError),
    /// The checksum is right and the contents are not.
    #[error("the run contradicts itself ({0}): it was not written by this program, simulate again")]
    Inconsistent(&'static str),
}

impl Run {
    /// The run as bytes: the same for the same photons, however they came together.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.push(match self.half_space.entry() {
            Entry::Searchlight => 0,
            Entry::Diffuse => 1,
        });
        bytes.extend(self.half_space.anisotropy().to_le_bytes());
        bytes.extend(self.half_space.refractive_index().to_le_bytes());
        for word in self.constants() {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend((self.sources.len() as u32).to_le_bytes());
        for (seed, batches) in &self.sources {
            bytes.extend(seed.to_le_bytes());
            bytes.extend((batches.ranges().len() as u32).to_le_bytes());
            for (begin, end) in batches.ranges() {
                bytes.extend(begin.to_le_bytes());
                bytes.extend(end.to_le_bytes());
            }
        }
        for count in [self.histogram.events, self.histogram.short_survivors, self.histogram.long_survivors] {
            bytes.extend(count.to_le_bytes());
        }
        let mut exits = self.histogram.exits();
        while let Some((&count, rest)) = exits.split_first() {
            push_leb128(&mut bytes, count);
            exits = rest;
            if count == 0 {
                let zeros = rest.iter().take_while(|&&count| count == 0).count();
                push_leb128(&mut bytes, zeros as u64);
                exits = &rest[zeros..];
            }
        }
        let checksum = crc32fast::hash(&bytes);
        bytes.extend(checksum.to_le_bytes());
        bytes
    }

    /// What must be equal for counts to mean the same.
    fn constants(&self) -> [u32; 6] {
        [
            BATCH as u32,
            FOLLOWED as u32,
            self.counts.short(),
            self.counts.long(),
            RINGS as u32,
            self.counts.rows() as u32,
        ]
    }

    /// The run that [`to_bytes`](Run::to_bytes) wrote.
    ///
    /// # Errors
    ///
    /// Anything else than such bytes, complete and unchanged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Run, RunFormatError> {
        Run::parse(bytes).map_err(|error| match error {
            // Damage shows in many ways, and its name is the same.
            RunFormatError::Inconsistent(_) | RunFormatError::HalfSpace(_) if !is_sealed(bytes) => {
                RunFormatError::Checksum
            }
            other => other,
        })
    }

    fn parse(bytes: &[u8]) -> Result<Run, RunFormatError> {
        let mut reader = Reader { all: bytes, rest: bytes };
        if !bytes.starts_with(&MAGIC[..bytes.len().min(MAGIC.len())]) {
            return Err(RunFormatError::Foreign);
        }
        reader.array::<8>()?;
        let version = reader.u32()?;
        if version != VERSION {
            return Err(RunFormatError::Version(version));
        }
        let entry = match reader.array::<1>()? {
            [0] => Entry::Searchlight,
            [1] => Entry::Diffuse,
            _ => return Err(RunFormatError::Inconsistent("unknown kind of entry")),
        };
        let anisotropy = f64::from_bits(reader.u64()?);
        let half_space = HalfSpace::new(entry, anisotropy, f64::from_bits(reader.u64()?))?;
        let mut run = Run::new(half_space, 0);
        for constant in run.constants() {
            if reader.u32()? != constant {
                return Err(RunFormatError::Inconsistent("its rings or limits are not this program's"));
            }
        }
        run.sources = read_sources(&mut reader)?;
        run.histogram.events = reader.u64()?;
        run.histogram.short_survivors = reader.u64()?;
        run.histogram.long_survivors = reader.u64()?;
        read_exits(&mut reader, &mut run.histogram)?;
        let contents = bytes.len() - reader.rest.len();
        if reader.u32()? != crc32fast::hash(&bytes[..contents]) {
            return Err(RunFormatError::Checksum);
        }
        if !reader.rest.is_empty() {
            return Err(RunFormatError::Trailing(reader.rest.len()));
        }
        run.check()?;
        Ok(run)
    }

    /// Every photon that entered left or was given up.
    fn check(&self) -> Result<(), RunFormatError> {
        let batches = self.sources.values().try_fold(0_u64, |sum, batches| sum.checked_add(batches.len()));
        let photons = batches.and_then(|batches| batches.checked_mul(BATCH));
        let photons = photons
            .filter(|&photons| photons <= Run::MOST && self.events() <= Run::MOST)
            .ok_or(RunFormatError::Inconsistent("more photons or scatterings than can be counted"))?;
        let survivors = [self.histogram.short_survivors, self.histogram.long_survivors];
        let accounted: u128 =
            self.histogram.exits().iter().chain(&survivors).map(|&count| u128::from(count)).sum();
        if accounted != u128::from(photons) {
            return Err(RunFormatError::Inconsistent("its counts do not add up to its photons"));
        }
        Ok(())
    }
}

/// The last four bytes are the checksum of the others.
fn is_sealed(bytes: &[u8]) -> bool {
    bytes
        .split_last_chunk()
        .is_some_and(|(contents, checksum)| crc32fast::hash(contents) == u32::from_le_bytes(*checksum))
}

fn read_sources(reader: &mut Reader<'_>) -> Result<BTreeMap<u64, BatchSet>, RunFormatError> {
    let count = reader.u32()?;
    if count == 0 || count > MAXIMUM_ITEMS {
        return Err(RunFormatError::Inconsistent("its number of seeds"));
    }
    let mut sources: BTreeMap<u64, BatchSet> = BTreeMap::new();
    for _ in 0..count {
        let seed = reader.u64()?;
        if sources.last_key_value().is_some_and(|(&last, _)| last >= seed) {
            return Err(RunFormatError::Inconsistent("its seeds do not rise"));
        }
        let count = reader.u32()?;
        if count > MAXIMUM_ITEMS {
            return Err(RunFormatError::Inconsistent("its number of ranges"));
        }
        let mut ranges = Vec::new();
        for _ in 0..count {
            ranges.push((reader.u64()?, reader.u64()?));
        }
        let batches =
            BatchSet::from_ranges(ranges).ok_or(RunFormatError::Inconsistent("its ranges overlap"))?;
        sources.insert(seed, batches);
    }
    Ok(sources)
}

fn read_exits(reader: &mut Reader<'_>, histogram: &mut Histogram) -> Result<(), RunFormatError> {
    let mut exits = histogram.exits_mut();
    while let Some((count, rest)) = exits.split_first_mut() {
        *count = reader.leb128()?;
        exits = rest;
        if *count == 0 {
            let zeros = usize::try_from(reader.leb128()?).unwrap_or(usize::MAX);
            if zeros > exits.len() {
                return Err(RunFormatError::Inconsistent("more counts than rings"));
            }
            exits = &mut exits[zeros..];
        }
    }
    Ok(())
}

fn push_leb128(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

/// Takes numbers off the front.
struct Reader<'bytes> {
    all: &'bytes [u8],
    rest: &'bytes [u8],
}

impl Reader<'_> {
    fn array<const N: usize>(&mut self) -> Result<[u8; N], RunFormatError> {
        let (array, rest) = self.rest.split_first_chunk().ok_or(RunFormatError::Truncated(self.all.len()))?;
        self.rest = rest;
        Ok(*array)
    }

    fn u32(&mut self) -> Result<u32, RunFormatError> {
        self.array().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Result<u64, RunFormatError> {
        self.array().map(u64::from_le_bytes)
    }

    fn leb128(&mut self) -> Result<u64, RunFormatError> {
        let mut value = 0_u64;
        for shift in (0..64).step_by(7) {
            let [byte] = self.array()?;
            let bits = u64::from(byte & 0x7f);
            if shift == 63 && bits > 1 {
                break;
            }
            value |= bits << shift;
            if byte & 0x80 == 0 {
                return Ok(value);
            }
        }
        Err(RunFormatError::Inconsistent("a count of more than 64 bits"))
    }
}
