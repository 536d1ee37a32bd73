//! Files of runs: what was written is read, and nothing else.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::ops::ControlFlow;
use std::sync::LazyLock;

use proptest::prelude::*;
use subsurface_reference::{Entry, Goal, HalfSpace, Run, RunFormatError};

static BYTES: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut run = Run::new(HalfSpace::new(Entry::Diffuse, 0.2, 1.3).unwrap(), 42);
    run.simulate(&Goal::photons(1).unwrap(), &mut |_| ControlFlow::Continue(()));
    run.to_bytes()
});

/// With a checksum that fits, so that what is behind it is looked at.
fn sealed(mut contents: Vec<u8>) -> Vec<u8> {
    let checksum = crc32fast::hash(&contents);
    contents.extend(checksum.to_le_bytes());
    contents
}

#[test]
fn what_was_written_is_read() {
    let run = Run::from_bytes(&BYTES).unwrap();
    assert_eq!(run.to_bytes(), *BYTES);
    assert_eq!((run.photons(), run.seed()), (65_536, 42));
    let empty = Run::new(HalfSpace::matched_isotropic(Entry::Searchlight), u64::MAX);
    assert_eq!(Run::from_bytes(&empty.to_bytes()).unwrap(), empty);
    // One number per ring and scattering count, most of them zeros.
    assert!(BYTES.len() < 100_000, "{}", BYTES.len());
}

#[test]
fn each_kind_of_damage_has_its_message() {
    let message = |bytes: &[u8]| Run::from_bytes(bytes).unwrap_err().to_string();
    assert!(message(b"").contains("cut off"));
    assert!(message(b"SUBS").contains("cut off"));
    assert!(message(b"\x89PNG\r\n\x1a\n and more").contains("not a simulation run"));
    let mut newer = BYTES.clone();
    newer[8] = 99;
    assert!(message(&newer).contains("version 99"));
    assert!(message(&BYTES[..BYTES.len() - 1]).contains("cut off"));
    let mut longer = BYTES.clone();
    longer.push(0);
    assert!(matches!(Run::from_bytes(&longer), Err(RunFormatError::Trailing(1))));
    let mut flipped = BYTES.clone();
    // The number of scatterings, which stands for itself.
    flipped[85] ^= 1;
    assert!(message(&flipped).contains("checksum"));
}

#[test]
fn contents_are_checked_behind_a_checksum_that_fits() {
    let contents = &BYTES[..BYTES.len() - 4];
    let changed = |offset: usize, bytes: &[u8]| {
        let mut changed = contents.to_vec();
        changed[offset..offset + bytes.len()].copy_from_slice(bytes);
        Run::from_bytes(&sealed(changed)).unwrap_err()
    };
    assert!(matches!(changed(12, &[7]), RunFormatError::Inconsistent(_)));
    assert!(matches!(changed(13, &1.5_f64.to_le_bytes()), RunFormatError::HalfSpace(_)));
    assert!(matches!(changed(13, &f64::NAN.to_le_bytes()), RunFormatError::HalfSpace(_)));
    // Another anisotropy has other limits.
    assert!(matches!(changed(13, &0.9_f64.to_le_bytes()), RunFormatError::Inconsistent(_)));
    // Numbers of seeds and ranges that are not there.
    assert!(matches!(changed(53, &u32::MAX.to_le_bytes()), RunFormatError::Inconsistent(_)));
    assert!(matches!(
        changed(53, &1_000_000_u32.to_le_bytes()),
        RunFormatError::Inconsistent(_) | RunFormatError::Truncated(_)
    ));
    assert!(matches!(changed(65, &u32::MAX.to_le_bytes()), RunFormatError::Inconsistent(_)));
    // Scatterings that could not be added to.
    assert!(matches!(changed(85, &u64::MAX.to_le_bytes()), RunFormatError::Inconsistent(_)));
    // One more batch than there are photons.
    assert!(matches!(changed(77, &2_u64.to_le_bytes()), RunFormatError::Inconsistent(_)));
    assert!(matches!(changed(77, &u64::MAX.to_le_bytes()), RunFormatError::Inconsistent(_)));
}

proptest! {
    #[test]
    fn no_prefix_is_a_run(length in 0..BYTES.len()) {
        prop_assert!(matches!(
            Run::from_bytes(&BYTES[..length]),
            Err(RunFormatError::Truncated(_) | RunFormatError::Checksum)
        ));
    }

    #[test]
    fn no_flipped_bit_is_missed(bit in 0..BYTES.len() * 8) {
        let mut bytes = BYTES.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        prop_assert!(Run::from_bytes(&bytes).is_err());
    }

    #[test]
    fn no_bytes_make_it_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let _ = Run::from_bytes(&bytes);
        // Behind a good beginning, too.
        for keep in [12, 53, 90] {
            let mut contents = BYTES[..keep].to_vec();
            contents.extend(&bytes);
            prop_assert!(Run::from_bytes(&sealed(contents)).is_err());
        }
    }
}
