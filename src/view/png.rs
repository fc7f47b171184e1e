//! Pixels as a PNG file.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use png::text_metadata::{EncodableTextChunk, ITXtChunk, TEXtChunk};

use crate::studio::picture_note::{RECORDING, SOFTWARE, reported};

/// Length of the signature and the header, after which the note follows.
const HEADER_BYTES: usize = 33;

/// Length of the signature, and the checksum of the last chunk, which is empty.
const SIGNATURE_BYTES: usize = 8;
const IEND_CHECKSUM: [u8; 4] = [0xae, 0x42, 0x60, 0x82];

/// Encodes `rgba`, straight 8-bit pixels of a picture of `size_px`, top row first.
///
/// The filter is fixed: the difference from the pixel at the left, because seas and panels change little along a row.
/// Choosing a filter for each row takes twenty times as long.
///
/// # Panics
/// If there are not `4 × width × height` bytes.
pub fn encode([width, height]: [u32; 2], rgba: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Sub)
        .write_image(rgba, width, height, ExtendedColorType::Rgba8)
        .expect("memory takes any picture");
    file.splice(HEADER_BYTES..HEADER_BYTES, note());
    file
}

/// Encodes a picture as [`encode`] does, with the recording of the run that it shows. It is the report of the run.
///
/// # Panics
/// As [`encode`].
pub fn encode_report(size_px: [u32; 2], rgba: &[u8], recording: &str) -> Vec<u8> {
    let mut file = encode(size_px, rgba);
    let mut chunk = Vec::new();
    let text = ITXtChunk::new(RECORDING, reported(recording));
    text.encode(&mut chunk).expect("memory takes a chunk");
    let place = HEADER_BYTES + note().len();
    file.splice(place..place, chunk);
    file
}

/// Whether a PNG file ends with its last chunk, neither before nor after.
pub fn is_whole(file: &[u8]) -> bool {
    let mut rest = file.get(SIGNATURE_BYTES..).unwrap_or_default();
    // A chunk has a length, a kind, that many bytes and a checksum.
    while let Some((&[a, b, c, d, ref kind @ ..], after)) = rest.split_first_chunk::<8>() {
        let Some(next) = after.get(u32::from_be_bytes([a, b, c, d]) as usize..) else { break };
        let Some((checksum, next)) = next.split_first_chunk::<4>() else { break };
        if kind == b"IEND" {
            return next.is_empty() && *checksum == IEND_CHECKSUM;
        }
        rest = next;
    }
    false
}

/// The text chunk of a file, which `image` does not write.
fn note() -> Vec<u8> {
    let mut chunk = Vec::new();
    let (keyword, text) = SOFTWARE;
    TEXtChunk::new(keyword, text).encode(&mut chunk).expect("memory takes a chunk");
    chunk
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::picture_note::{NOTED_WITHIN, is_encoded_here, recording_in};

    #[test]
    fn a_picture_survives_to_the_bit_with_its_origin() {
        let rgba: Vec<u8> = (0..4 * 5 * 3).map(|byte| byte * 4).collect();
        let file = encode([5, 3], &rgba);
        let picture = image::load_from_memory(&file).unwrap().into_rgba8();
        assert_eq!((picture.dimensions(), picture.into_raw()), ((5, 3), rgba.clone()));
        assert!(is_encoded_here(&file[..NOTED_WITHIN]));
        assert!(is_whole(&file) && !is_whole(b""));
        assert!(!is_whole(&file[..file.len() - 1]) && !is_whole(&[&file[..], b"x"].concat()));
        assert_eq!(recording_in(&file), None);
        let report = encode_report([5, 3], &rgba, "title = \"Föhn\"\n");
        assert_eq!(image::load_from_memory(&report).unwrap().into_rgba8().into_raw(), rgba);
        assert!(is_encoded_here(&report[..NOTED_WITHIN]) && is_whole(&report));
        let (heading, recording) = recording_in(&report).unwrap().split_once('\n').unwrap();
        assert!(heading.starts_with("# A report of regatta 0."), "{heading}");
        assert_eq!(recording, "title = \"Föhn\"\n");
        for end in 0..report.len() - file.len() {
            assert_eq!(recording_in(&report[..end]), None);
        }
        let mut other = std::io::Cursor::new(Vec::new());
        let picture = image::RgbaImage::from_raw(5, 3, rgba).unwrap();
        picture.write_to(&mut other, image::ImageFormat::Png).unwrap();
        assert!(!is_encoded_here(other.get_ref()));
    }
}
