//! Hashes of texts and pixels, to be written down and compared later, by other programs too.

use xxhash_rust::xxh3::xxh3_64;

/// XXH3 of `bytes`, 64 bits with the seed 0, as 16 hexadecimal digits.
pub fn fingerprint(bytes: &[u8]) -> String {
    format!("{:016x}", xxh3_64(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fingerprint_is_that_of_other_programs() {
        // From the reference implementation's own test vectors.
        assert_eq!(fingerprint(b""), "2d06800538d394c2");
    }
}
