//! Hashes of texts and pixels, to be written down and compared later, by other programs too.

/// 64 bits of `bytes` as 16 hexadecimal digits. As FNV-1a, but over little-endian words of 8 bytes, the
/// last one filled up with zeros, and folded after each by `hash ^= hash >> 32`; the number of bytes is
/// the first word. A change of any one word changes the hash.
pub fn fingerprint(bytes: &[u8]) -> String {
    let fold = |hash: u64, word: u64| {
        let hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^ (hash >> 32)
    };
    let (words, rest) = bytes.as_chunks::<8>();
    let mut last = [0; 8];
    last[..rest.len()].copy_from_slice(rest);
    let start = fold(0xcbf2_9ce4_8422_2325, bytes.len() as u64);
    let hash = words.iter().fold(start, |hash, word| fold(hash, u64::from_le_bytes(*word)));
    let hash = if rest.is_empty() { hash } else { fold(hash, u64::from_le_bytes(last)) };
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_counts() {
        let bytes: Vec<u8> = (0..37).collect();
        let mut seen = std::collections::BTreeSet::from([fingerprint(&bytes)]);
        for bit in 0..8 * bytes.len() {
            let mut other = bytes.clone();
            other[bit / 8] ^= 1 << (bit % 8);
            assert!(seen.insert(fingerprint(&other)), "bit {bit}");
        }
        let (mut longer, mut twice) = (bytes.clone(), bytes.clone());
        longer.push(0);
        twice[7] ^= 128;
        twice[15] ^= 128;
        for other in [longer, twice] {
            assert_ne!(fingerprint(&other), fingerprint(&bytes), "{other:?}");
        }
    }
}
