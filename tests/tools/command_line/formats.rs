//! One run in every format: the same pixels in each, and other programs can read them.

use std::fs::{self, File};
use std::io::{BufReader, Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use image::codecs::gif::GifDecoder;
use image::{AnimationDecoder, Frame, RgbaImage};
use regatta::manual::chapter;
use tempfile::TempDir;

#[cfg(unix)]
use super::ended_by;
use super::{names, regatta, run_in, stderr};

const FRAMES: usize = 7;
const RUN: &str = "capture --scene harbour --race --frames 7 --fps 12 --size 93x51 --scale 0.5";

/// The frames as numbered pictures, in `clip`.
fn clip() -> (TempDir, Vec<RgbaImage>) {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(folder.path(), &format!("{RUN} --out clip"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let frame = |n| image::open(folder.path().join(format!("clip/frame-{n:06}.png"))).unwrap();
    let frames = (0..FRAMES).map(|n| frame(n).into_rgba8()).collect();
    (folder, frames)
}

/// The run as one file.
fn written(folder: &Path, format: &str) -> Vec<u8> {
    let output = run_in(folder, &format!("{RUN} --format {format} --out run.{format} --force"));
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert_eq!(said, format!("wrote 7 frames, 93x51, 12 fps: run.{format}\n"));
    fs::read(folder.join(format!("run.{format}"))).unwrap()
}

/// A program's output about a file.
fn asked(program: &str, arguments: &[&str], file: &Path) -> String {
    let output = Command::new(program).args(arguments).arg(file).output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    assert!(output.status.success(), "{program}: {out}{err}");
    out + &err
}

pub(crate) fn a_third_party_decoder_reads_single_frames() {
    let (folder, _) = clip();
    for n in 0..FRAMES {
        let path = folder.path().join(format!("clip/frame-{n:06}.png"));
        let said = asked("pngcheck", &[], &path);
        assert!(said.contains("OK: ") && said.contains("(93x51, 32-bit RGB+alpha, "), "{said}");
    }
}

pub(crate) fn a_gif_keeps_its_timing_and_looks_alike() {
    let (folder, frames) = clip();
    written(folder.path(), "gif");
    let path = folder.path().join("run.gif");
    let decoder = GifDecoder::new(BufReader::new(File::open(&path).unwrap())).unwrap();
    let hundredths = |frame: &Frame| frame.delay().numer_denom_ms().0 / 10;
    let decoded: Vec<(u32, Vec<u8>)> = decoder
        .into_frames()
        .map(|frame| frame.unwrap())
        .map(|frame| (hundredths(&frame), frame.into_buffer().into_raw()))
        .collect();
    assert_eq!(decoded.len(), FRAMES);
    // 7 frames at 12 a second are 0.583 s; a GIF counts hundredths.
    let delays: Vec<u32> = decoded.iter().map(|(delay, _)| *delay).collect();
    assert_eq!(delays.iter().sum::<u32>(), 58, "{delays:?}");
    assert!(delays.iter().all(|delay| [8, 9].contains(delay)), "{delays:?}");
    for ((_, decoded), frame) in decoded.iter().zip(&frames) {
        let off = decoded.iter().zip(frame.iter()).map(|(a, b)| u64::from(a.abs_diff(*b)));
        let mean = off.sum::<u64>() as f64 / frame.len() as f64;
        assert!(mean < 6.0, "off by {mean} on average");
    }
}

pub(crate) fn gifsicle_reads_every_frame_of_a_gif() {
    let (folder, _) = clip();
    written(folder.path(), "gif");
    let said = asked("gifsicle", &["--info"], &folder.path().join("run.gif"));
    assert!(said.contains("7 images") && said.contains("logical screen 93x51"), "{said}");
    assert!(said.contains("loop forever"), "{said}");
}

pub(crate) fn y4m_has_a_header_and_three_planes_a_frame() {
    let (folder, frames) = clip();
    let bytes = written(folder.path(), "y4m");
    let header = b"YUV4MPEG2 W93 H51 F12:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
    let mut rest = bytes.strip_prefix(header).expect("the header");
    for frame in &frames {
        rest = rest.strip_prefix(b"FRAME\n").expect("a frame");
        let (planes, after) = rest.split_at(3 * 93 * 51);
        rest = after;
        for (pixel, &luma) in frame.pixels().zip(&planes[..93 * 51]) {
            let [r, g, b, _] = pixel.0.map(f64::from);
            let expected = 16.0 + (65.481 * r + 128.553 * g + 24.966 * b) / 255.0;
            assert!((f64::from(luma) - expected).abs() < 1.5, "{luma}, not {expected}");
        }
    }
    assert!(rest.is_empty());
}

pub(crate) fn ffmpeg_reads_every_film_with_the_drawn_frames() {
    let (folder, frames) = clip();
    let drawn: Vec<u8> = frames.iter().flat_map(|frame| frame.as_raw().clone()).collect();
    // Chroma is rounded to a byte and luma to its range of 219; a GIF has 256 colours.
    for (format, codec, rate, most, mean) in
        [("y4m", "rawvideo", "12/1", 3, 1.0), ("gif", "gif", "143/12", 255, 6.0)]
    {
        written(folder.path(), format);
        let film = folder.path().join(format!("run.{format}"));
        let shown = "stream=codec_name,width,height,r_frame_rate,nb_read_frames";
        let probe = ["-v", "error", "-count_frames", "-show_entries", shown, "-of", "csv=p=0"];
        let said = asked("ffprobe", &probe, &film);
        assert_eq!(said.trim(), format!("{codec},93,51,{rate},7"), "{format}");

        let raw = folder.path().join("raw");
        let film = film.to_str().expect("plain letters");
        let decode = ["-v", "error", "-y", "-i", film, "-fps_mode", "passthrough"];
        let to_rgba = ["-f", "rawvideo", "-pix_fmt", "rgba"];
        asked("ffmpeg", &[&decode[..], &to_rgba].concat(), &raw);
        let read = fs::read(raw).unwrap();
        assert_eq!(read.len(), drawn.len(), "{format}");
        let off = read.iter().zip(&drawn).map(|(a, b)| a.abs_diff(*b));
        let (largest, sum) =
            off.fold((0, 0), |(largest, sum), d| (d.max(largest), sum + u64::from(d)));
        assert!(largest <= most, "{format}: off by {largest}");
        assert!(sum as f64 <= mean * drawn.len() as f64, "{format}: off by {sum} in all");
    }
}

pub(crate) fn the_manuals_pipe_to_ffmpeg_makes_a_film() {
    let text = chapter("commands").unwrap().text.replace("\\\n", " ");
    let (before, after) = text.split_once(" |\n  ffmpeg ").expect("a pipe");
    let ours = before.lines().last().expect("our command");
    let theirs = after.lines().next().expect("the encoder's");
    let folder = tempfile::tempdir().unwrap();
    let smaller = "--frames 12 --size 160x90 --scale 0.5";
    let ours = ours.replace("--seconds 10", smaller).replace("regatta ", "");
    let stream = run_in(folder.path(), &ours);
    assert_eq!(stream.status.code(), Some(0), "{}", stderr(&stream));
    let arguments: Vec<&str> = theirs.split_whitespace().collect();
    let mut ffmpeg = Command::new("ffmpeg");
    ffmpeg.args(["-v", "error"]).args(arguments).current_dir(folder.path());
    let mut ffmpeg = ffmpeg.stdin(Stdio::piped()).spawn().unwrap();
    ffmpeg.stdin.take().expect("a pipe").write_all(&stream.stdout).unwrap();
    assert!(ffmpeg.wait().unwrap().success());
    let probe = [
        "-v",
        "error",
        "-count_frames",
        "-show_entries",
        "stream=width,color_space,color_transfer,color_primaries,nb_read_frames",
    ];
    let of = ["-of", "csv=p=0"];
    let film = folder.path().join("clip.mp4");
    let said = asked("ffprobe", &[&probe[..], &of].concat(), &film);
    // Browsers guess the colours of a film without these three.
    assert_eq!(said.trim(), "160,bt709,bt709,bt709,12");
}

pub(crate) fn standard_output_has_the_same_bytes_as_a_file() {
    let (folder, _) = clip();
    for format in ["y4m", "gif"] {
        let output = run_in(folder.path(), &format!("{RUN} --format {format} --out -"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert!(output.stdout == written(folder.path(), format), "{format}");
    }
}

pub(crate) fn a_sheet_has_time_across_and_lanes_down() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = "capture --scene spring --frames 3 --size 90x50 --out sheet.png";
    let output = run_in(folder.path(), sheet);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let down = "down: explicit-euler, semi-implicit-euler, ";
    assert!(said.starts_with("wrote a sheet of 270x250: sheet.png; 3 moments across; "), "{said}");
    assert!(said.contains(down), "{said}");
    let sheet = image::open(folder.path().join("sheet.png")).unwrap().into_rgba8();
    assert_eq!(sheet.dimensions(), (270, 250));
    let alone = "capture --scene spring --method explicit-euler --frames 3 --fps 1 --panels off \
                 --size 90x50 --out alone";
    assert_eq!(run_in(folder.path(), alone).status.code(), Some(0));
    for column in 0..3 {
        let name = format!("alone/frame-{column:06}.png");
        let frame = image::open(folder.path().join(name)).unwrap().into_rgba8();
        let cell = image::imageops::crop_imm(&sheet, 90 * column, 0, 90, 50).to_image();
        assert!(cell == frame, "column {column}");
    }
}

pub(crate) fn a_pipe_that_closes_ends_a_stream_quietly() {
    let (folder, _) = clip();
    for format in ["y4m", "gif"] {
        let mut child = regatta()
            .current_dir(folder.path())
            .args(RUN.split(' '))
            .args(["--format", format, "--out", "-"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = [0; 10];
        let mut stdout = child.stdout.take().unwrap();
        stdout.read_exact(&mut first).unwrap();
        drop(stdout);
        let output = child.wait_with_output().unwrap();
        assert_eq!((stderr(&output).as_str(), output.status.code()), ("", Some(0)), "{format}");
    }
}

#[cfg(unix)]
pub(crate) fn an_interrupted_stream_leaves_no_file() {
    let (folder, _) = clip();
    let run = RUN.replace("--frames 7", "--frames 100000");
    let child = regatta()
        .current_dir(folder.path())
        .args(run.split(' '))
        .args(["--format", "gif", "--out", "run.gif"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let is_begun = || {
        let mut entries = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap());
        entries.any(|entry| {
            let name = entry.file_name().into_string().unwrap();
            let is_part = name.starts_with("run.gif.") && name.ends_with(".part");
            is_part && entry.metadata().is_ok_and(|file| file.len() > 0)
        })
    };
    while !is_begun() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let output = ended_by("-INT", child);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert_eq!(names(folder.path()), ["clip"]);
}
