//! Random numbers: xoshiro128++ (Blackman and Vigna 2021, "Scrambled Linear Pseudorandom Number Generators", ACM TOMS
//! 47(4)), seeded by SplitMix64 as its authors ask.
//!
//! It needs no multiplication, so a generator per lane costs a few vector instructions even on plain SSE2. The
//! 65 generators of a batch are seeded one after the other from a key of 64 bits: among a million batches, two meet in
//! one of their states with a chance of about 10⁻⁵, and then share a few lanes out of 65 million.

/// Words of state of one generator.
pub(crate) type State = [u32; 4];

/// What SplitMix64 adds to its state in a step: 2⁶⁴ over the golden ratio, made odd.
const GOLDEN_GAMMA: u64 = 0x9e37_79b9_7f4a_7c15;

/// One step of SplitMix64, a bijection (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators").
pub(crate) fn mix(value: u64) -> u64 {
    let z = value.wrapping_add(GOLDEN_GAMMA);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// States of generators that belong to (`seed`, `batch`), one after the other.
pub(crate) struct States(u64);

impl States {
    pub(crate) fn new(seed: u64, batch: u64) -> States {
        // Two rounds of mixing between them: seeds and batches are small numbers, and (1, 2) is not (2, 1).
        let mut seeds = States(seed);
        let key = seeds.next_word();
        let mut batches = States(key ^ batch);
        batches.next_word();
        States(batches.next_word())
    }

    fn next_word(&mut self) -> u64 {
        let word = mix(self.0);
        self.0 = self.0.wrapping_add(GOLDEN_GAMMA);
        word
    }

    pub(crate) fn next_state(&mut self) -> State {
        let (low, high) = (self.next_word(), self.next_word());
        [low as u32, (low >> 32) as u32, high as u32, (high >> 32) as u32]
    }
}

/// One step of xoshiro128++.
#[inline(always)]
pub(crate) fn advance(s: State) -> (State, u32) {
    let [mut s0, mut s1, mut s2, mut s3] = s;
    let result = s0.wrapping_add(s3).rotate_left(7).wrapping_add(s0);
    let t = s1 << 9;
    s2 ^= s0;
    s3 ^= s1;
    s1 ^= s2;
    s0 ^= s3;
    s2 ^= t;
    s3 = s3.rotate_left(11);
    ([s0, s1, s2, s3], result)
}

/// A generator for what happens to one photon at a time.
pub(crate) struct Random(State);

impl Random {
    pub(crate) fn new(state: State) -> Random {
        Random(state)
    }

    #[inline]
    pub(crate) fn bits(&mut self) -> u32 {
        let (state, bits) = advance(self.0);
        self.0 = state;
        bits
    }

    /// In (0, 1), never either.
    #[inline]
    pub(crate) fn uniform(&mut self) -> f32 {
        crate::elementary::unit(self.bits())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generator_is_the_published_one() {
        // The first outputs of the authors' xoshiro128plusplus.c for the state {1, 2, 3, 4}, as rand_xoshiro tests them.
        let mut random = Random::new([1, 2, 3, 4]);
        let outputs: Vec<u32> = (0..10).map(|_| random.bits()).collect();
        assert_eq!(
            outputs,
            [
                641,
                1_573_767,
                3_222_811_527,
                3_517_856_514,
                836_907_274,
                4_247_214_768,
                3_867_114_732,
                1_355_841_295,
                495_546_011,
                621_204_420
            ]
        );
    }

    #[test]
    fn seeds_and_batches_do_not_mix_up() {
        let first = |seed, batch| States::new(seed, batch).next_state();
        assert_ne!(first(1, 2), first(2, 1));
        assert_ne!(first(0, 0), first(0, 1));
        assert_eq!(first(7, 9), first(7, 9));
    }
}
