//! Writes a run as one stream, which is an animated picture, or frames for a video encoder.

use std::io::Write;

use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, ImageError, RgbaImage};

use super::drawing::{closing_line, interrupted_after};
use super::error::Error;
use super::interrupt::watch_for_interrupt;
use super::output::Output;
use super::pipeline::{DrawnFrame, Pipeline};
use super::schedule::Schedule;
use super::settings::CaptureSettings;
use super::state_log::StateLog;
use super::terminal::print_status;
use crate::studio::Studio;

/// A stream into which frames are encoded.
pub(super) trait Movie: Send {
    fn push(&mut self, frame: &DrawnFrame) -> Result<(), Error>;
}

/// A stream that has been started, or the reason why it could not be.
pub(super) type Begun<'a> = Result<Box<dyn Movie + 'a>, Error>;

/// A function that starts a stream of one format.
pub(super) type Begin = for<'a> fn(&'a mut Output, &CaptureSettings) -> Begun<'a>;

/// Step between the pixels from which the palette of a GIF is computed. This step is the coarsest one, twice as fast as
/// a medium one, and no worse on flat colours.
const GIF_SPEED: i32 = 30;

/// Draws the run of `studio` into `output`, and reports the result on standard error.
pub(super) fn record(
    studio: Studio,
    capture: CaptureSettings,
    begin: Begin,
    mut output: Output,
) -> Result<(), Error> {
    let mut renderer = capture.renderer()?;
    let Schedule { frames, .. } = capture.schedule;
    let mut movie = begin(&mut output, &capture)?;
    let interrupted = watch_for_interrupt();
    let mut studio = capture.prepare_studio(studio);
    let mut state_log = StateLog::new(u64::MAX, studio.race());
    let run = Pipeline {
        renderer: &mut renderer,
        studio: &mut studio,
        state_log: &mut state_log,
        schedule: capture.schedule,
    };
    let done = run.draw_all(&interrupted, |_, _| (), |drawn, ()| movie.push(drawn))?;
    if done < frames {
        drop(movie);
        let whole = match output.file() {
            None => format!("those on {}", output.name()),
            Some(_) => "none, a stream is whole at its end".into(),
        };
        return Err(interrupted_after(done, frames, &whole));
    }
    drop(movie);
    print_status(&closing_line(&capture, &output.close()?));
    Ok(())
}

/// A GIF, in which each frame has a palette of 256 colours. The encoder writes the last byte when it is dropped, and
/// closing the output reports whether that worked.
struct Gif<'a> {
    encoder: GifEncoder<&'a mut Output>,
    size_px: [u32; 2],
    fps: u32,
}

pub(super) fn gif<'a>(out: &'a mut Output, capture: &CaptureSettings) -> Begun<'a> {
    let mut encoder = GifEncoder::new_with_speed(out, GIF_SPEED);
    encoder.set_repeat(Repeat::Infinite).map_err(of_gif)?;
    Ok(Box::new(Gif { encoder, size_px: capture.size_px, fps: capture.schedule.fps }))
}

impl Movie for Gif<'_> {
    fn push(&mut self, frame: &DrawnFrame) -> Result<(), Error> {
        let [width, height] = self.size_px;
        let picture = RgbaImage::from_raw(width, height, frame.rgba.clone());
        let picture = picture.expect("a frame has as many pixels as it says");
        let shown = Delay::from_numer_denom_ms(10 * shown_cs(frame.frame, self.fps), 1);
        self.encoder.encode_frame(Frame::from_parts(picture, 0, 0, shown)).map_err(of_gif)
    }
}

/// YUV4MPEG2 with 4:4:4 sampling and BT.601 colours in the limited range.
struct Y4m<'a> {
    out: &'a mut Output,
    planes: Vec<u8>,
}

pub(super) fn y4m<'a>(out: &'a mut Output, capture: &CaptureSettings) -> Begun<'a> {
    let ([width, height], Schedule { fps, .. }) = (capture.size_px, capture.schedule);
    writeln!(out, "YUV4MPEG2 W{width} H{height} F{fps}:1 Ip A1:1 C444 XCOLORRANGE=LIMITED")?;
    Ok(Box::new(Y4m { out, planes: Vec::new() }))
}

impl Movie for Y4m<'_> {
    fn push(&mut self, frame: &DrawnFrame) -> Result<(), Error> {
        to_yuv(&frame.rgba, &mut self.planes);
        self.out.write_all(b"FRAME\n")?;
        Ok(self.out.write_all(&self.planes)?)
    }
}

/// Returns the duration of a frame in a GIF, in hundredths of a second. The fraction that remains is carried over to
/// the next frame.
fn shown_cs(frame: u32, fps: u32) -> u32 {
    let ends = |frame: u32| u64::from(frame) * 100 / u64::from(fps);
    (ends(frame + 1) - ends(frame)) as u32
}

fn of_gif(error: ImageError) -> Error {
    match error {
        ImageError::IoError(error) => error.into(),
        error => Error::failed(format!("the GIF cannot be encoded: {error}")),
    }
}

/// Replaces the contents of `planes` by all Y, all Cb and all Cr, as in BT.601. Y is from 16 to 235, and Cb and Cr are
/// from 16 to 240.
fn to_yuv(rgba: &[u8], planes: &mut Vec<u8>) {
    let pixels = rgba.len() / 4;
    planes.resize(3 * pixels, 0);
    let (luma, chroma) = planes.split_at_mut(pixels);
    let (blue, red) = chroma.split_at_mut(pixels);
    for (n, pixel) in rgba.chunks_exact(4).enumerate() {
        let [r, g, b] = [0, 1, 2].map(|channel| i32::from(pixel[channel]));
        luma[n] = (16 + ((66 * r + 129 * g + 25 * b + 128) >> 8)) as u8;
        blue[n] = (128 + ((-38 * r - 74 * g + 112 * b + 128) >> 8)) as u8;
        red[n] = (128 + ((112 * r - 94 * g - 18 * b + 128) >> 8)) as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_follow_bt_601() {
        let mut planes = Vec::new();
        let rgba: Vec<u8> = [[0, 0, 0], [255, 255, 255], [255, 0, 0], [0, 255, 0], [0, 0, 255]]
            .iter()
            .flat_map(|&[r, g, b]| [r, g, b, 255])
            .collect();
        to_yuv(&rgba, &mut planes);
        let expected = [[16, 235, 82, 145, 41], [128, 128, 90, 54, 240], [128, 128, 240, 34, 110]];
        for (plane, expected) in planes.chunks_exact(5).zip(expected) {
            let off = plane.iter().zip(expected).map(|(is, be): (&u8, u8)| is.abs_diff(be));
            assert!(off.max() <= Some(1), "{plane:?}, not {expected:?}");
        }
    }
}
