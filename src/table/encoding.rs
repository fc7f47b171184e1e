//! Reads text that tools and shells write in UTF-8 or UTF-16, and converts it to UTF-8.

use std::io::{self, BufRead, Read};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Utf8,
    /// Little-endian, in which the less significant byte of each unit comes first.
    Utf16Le,
    Utf16Be,
}

/// A reader that converts its input to UTF-8, without the byte order mark. Invalid UTF-16 becomes a replacement
/// character; UTF-8 passes unchecked.
pub struct Utf8<R> {
    input: R,
    encoding: Option<Encoding>,
    /// Decoded UTF-8, and the number of its bytes that were read.
    decoded: Vec<u8>,
    taken: usize,
    /// First byte of an incomplete unit, and first unit of an incomplete surrogate pair.
    odd: Option<u8>,
    high: Option<u16>,
}

impl<R: BufRead> Utf8<R> {
    /// Reads the text of `input`. Its byte order mark decides the encoding.
    pub fn new(input: R) -> Self {
        Self { input, encoding: None, decoded: Vec::new(), taken: 0, odd: None, high: None }
    }

    /// Reads the byte order mark, if there is one, and returns the encoding.
    fn begin(&mut self) -> io::Result<Encoding> {
        let mut mark = Vec::new();
        (&mut self.input).take(2).read_to_end(&mut mark)?;
        let encoding = match mark[..] {
            [0xFF, 0xFE] => Encoding::Utf16Le,
            [0xFE, 0xFF] => Encoding::Utf16Be,
            _ => {
                if mark == [0xEF, 0xBB] {
                    (&mut self.input).take(1).read_to_end(&mut mark)?;
                }
                if mark != [0xEF, 0xBB, 0xBF] {
                    self.decoded = mark;
                }
                Encoding::Utf8
            }
        };
        self.encoding = Some(encoding);
        Ok(encoding)
    }

    /// Decodes the bytes in the input's buffer. Returns whether there were any bytes.
    fn decode(&mut self, is_little: bool) -> io::Result<bool> {
        let bytes = self.input.fill_buf()?;
        let count = bytes.len();
        let mut odd = self.odd.take();
        for &byte in bytes {
            let Some(first) = odd.take() else {
                odd = Some(byte);
                continue;
            };
            let pair = [first, byte];
            let unit = if is_little { u16::from_le_bytes(pair) } else { u16::from_be_bytes(pair) };
            let units = self.high.take().into_iter().chain([unit]);
            let is_high = (0xD800..0xDC00).contains(&unit);
            if is_high && self.high.is_none() && units.clone().count() == 1 {
                self.high = Some(unit);
                continue;
            }
            for decoded in char::decode_utf16(units) {
                let decoded = decoded.unwrap_or(char::REPLACEMENT_CHARACTER);
                self.decoded.extend_from_slice(decoded.encode_utf8(&mut [0; 4]).as_bytes());
            }
        }
        self.odd = odd;
        self.input.consume(count);
        Ok(count > 0)
    }
}

impl<R: BufRead> BufRead for Utf8<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        let encoding = match self.encoding {
            Some(encoding) => encoding,
            None => self.begin()?,
        };
        if self.taken < self.decoded.len() {
            return Ok(&self.decoded[self.taken..]);
        }
        (self.taken, self.decoded) = (0, Vec::new());
        match encoding {
            Encoding::Utf8 => self.input.fill_buf(),
            Encoding::Utf16Le | Encoding::Utf16Be => {
                while self.decoded.is_empty() && self.decode(encoding == Encoding::Utf16Le)? {}
                Ok(&self.decoded)
            }
        }
    }

    fn consume(&mut self, count: usize) {
        match self.taken < self.decoded.len() {
            true => self.taken += count,
            false => self.input.consume(count),
        }
    }
}

impl<R: BufRead> Read for Utf8<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let at_hand = self.fill_buf()?;
        let count = at_hand.len().min(bytes.len());
        bytes[..count].copy_from_slice(&at_hand[..count]);
        self.consume(count);
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8], at_once: usize) -> String {
        let mut text = Vec::new();
        let input = io::BufReader::with_capacity(at_once, bytes);
        Utf8::new(input).read_to_end(&mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn text_is_the_same_in_every_encoding_and_chunking() {
        let text = "a;b\n1,5;größer als 𝄞\n";
        let units: Vec<u16> = text.encode_utf16().collect();
        let little = units.iter().flat_map(|unit| unit.to_le_bytes());
        let big = units.iter().flat_map(|unit| unit.to_be_bytes());
        let marked = |mark: &[u8], bytes: Vec<u8>| [mark, &bytes].concat();
        for bytes in [
            text.as_bytes().to_vec(),
            marked(&[0xEF, 0xBB, 0xBF], text.as_bytes().to_vec()),
            marked(&[0xFF, 0xFE], little.collect()),
            marked(&[0xFE, 0xFF], big.collect()),
        ] {
            for at_once in [1, 2, 3, 7, 4096] {
                assert_eq!(read(&bytes, at_once), text, "{at_once} bytes at once");
            }
        }
        assert_eq!(read(b"", 4), "");
        assert_eq!(read(b"x", 4), "x");
        assert_eq!(read(&[0xFF, 0xFE, 0x00, 0xD8, 0x41, 0x00], 4), "\u{fffd}A");
    }
}
