//! Hashes of texts and pixels, to be written down and compared later, by other programs too.

/// 64 bits of `bytes` as 16 hexadecimal digits. As FNV-1a, but over little-endian words of 8 bytes, folded
/// after each by `hash ^= hash >> 32`. Four such hashes take the words in turn, so that a processor works
/// on all four at once; each has the number of bytes for its first word, and the words are filled up with
/// zeros to a multiple of four. A fifth one has the number of bytes and then those four for its words. A
/// change of any one word changes the hash.
pub fn fingerprint(bytes: &[u8]) -> String {
    let fold = |hash: u64, word: u64| {
        let hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^ (hash >> 32)
    };
    let start = fold(0xcbf2_9ce4_8422_2325, bytes.len() as u64);
    let mut hashes = [start; 4];
    let mut take = |words: &[u8; 32]| {
        for (hash, word) in hashes.iter_mut().zip(words.as_chunks::<8>().0) {
            *hash = fold(*hash, u64::from_le_bytes(*word));
        }
    };
    let (words, rest) = bytes.as_chunks::<32>();
    words.iter().for_each(&mut take);
    if !rest.is_empty() {
        let mut last = [0; 32];
        last[..rest.len()].copy_from_slice(rest);
        take(&last);
    }
    format!("{:016x}", hashes.into_iter().fold(start, fold))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_counts() {
        let bytes: Vec<u8> = (0..77).collect();
        let mut seen = std::collections::BTreeSet::from([fingerprint(&bytes)]);
        for bit in 0..8 * bytes.len() {
            let mut other = bytes.clone();
            other[bit / 8] ^= 1 << (bit % 8);
            assert!(seen.insert(fingerprint(&other)), "bit {bit}");
        }
        let (mut longer, mut neighbours, mut of_one_hash) =
            (bytes.clone(), bytes.clone(), bytes.clone());
        longer.push(0);
        for (changed, second) in [(&mut neighbours, 15), (&mut of_one_hash, 39)] {
            changed[7] ^= 128;
            changed[second] ^= 128;
        }
        for other in [longer, neighbours, of_one_hash] {
            assert_ne!(fingerprint(&other), fingerprint(&bytes), "{other:?}");
        }
    }
}
