//! Pixels as a PNG file.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

/// The file for `rgba`, straight 8-bit pixels of a picture of `size_px`, top row first. One fixed
/// filter, since choosing one for each row takes twenty times as long: the difference to the pixel at the
/// left, for seas and panels change little along a row.
///
/// # Panics
/// If there are not `4 × width × height` bytes.
pub fn encode([width, height]: [u32; 2], rgba: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Sub)
        .write_image(rgba, width, height, ExtendedColorType::Rgba8)
        .expect("memory takes any picture");
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_survives_to_the_bit() {
        let rgba: Vec<u8> = (0..4 * 5 * 3).map(|byte| byte * 4).collect();
        let picture = image::load_from_memory(&encode([5, 3], &rgba)).unwrap().into_rgba8();
        assert_eq!((picture.dimensions(), picture.into_raw()), ((5, 3), rgba));
    }
}
