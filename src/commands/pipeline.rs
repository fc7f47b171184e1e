//! Frames, drawn on this thread and taken on another: while one is encoded, the next is drawn and the
//! one after it is simulated.
//!
//! At most two frames are in flight on the device, one waits and one is being taken, whatever the
//! length of the run; they are taken in order.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::thread;

use super::logbook::Logbook;
use super::voyage::Schedule;
use crate::lab::Lab;
use crate::view::{Artist, Panels, ReadbackError};

/// More gain nothing on a software adapter, and cost memory.
const MOST_IN_FLIGHT: usize = 2;

/// A frame as it comes from the device.
pub(super) struct Drawn {
    /// The tick reached.
    pub(super) tick: u64,
    /// The part of the next tick that is drawn, as an exact fraction.
    pub(super) alpha: (u64, u64),
    /// Its pixels, top row first.
    pub(super) rgba: Vec<u8>,
}

/// Why there are not all frames.
pub(super) enum Stop<E> {
    /// The device does not give a frame back.
    Readback(ReadbackError),
    /// A frame could not be taken.
    Taken(E),
}

/// A run on its way.
pub(super) struct Run<'a> {
    pub(super) artist: &'a mut Artist,
    /// Stands at the start.
    pub(super) lab: &'a mut Lab,
    pub(super) logbook: &'a mut Logbook,
    pub(super) schedule: Schedule,
    /// Once it is set, the frames in hand are the last.
    pub(super) interrupted: &'a AtomicBool,
}

impl Run<'_> {
    /// Draws every frame and has `take` take it. Returns how many frames were drawn.
    pub(super) fn draw_all<E: Send>(
        self,
        mut take: impl FnMut(&Drawn) -> Result<(), E> + Send,
    ) -> Result<u32, Stop<E>> {
        let (to_taker, drawn) = mpsc::sync_channel::<Drawn>(1);
        let (give_back, spare) = mpsc::channel();
        thread::scope(|scope| {
            let taker = scope.spawn(move || {
                for frame in drawn {
                    take(&frame)?;
                    // Nobody wants it any more when all is drawn.
                    let _ = give_back.send(frame.rgba);
                }
                Ok(())
            });
            let result = self.draw(&to_taker, &spare);
            drop(to_taker);
            match taker.join() {
                Ok(Ok(())) => result.map_err(Stop::Readback),
                Ok(Err(error)) => Err(Stop::Taken(error)),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        })
    }

    /// Draws until all is drawn, or nobody takes frames any more.
    fn draw(
        self,
        to_taker: &mpsc::SyncSender<Drawn>,
        spare: &mpsc::Receiver<Vec<u8>>,
    ) -> Result<u32, ReadbackError> {
        let Self { artist, lab, logbook, schedule, interrupted } = self;
        let mut moments = VecDeque::new();
        let mut drawn = 0;
        let mut next = 0;
        loop {
            let more = next < schedule.frames && !interrupted.load(Ordering::Relaxed);
            if more {
                schedule.advance(lab, next, |lab| logbook.note(lab));
                know_what_is_shown(lab, artist);
                artist.submit(lab)?;
                moments.push_back((lab.race().tick(), lab.clock().alpha_fraction()));
                next += 1;
            }
            if moments.len() == MOST_IN_FLIGHT || !more {
                let Some((tick, alpha)) = moments.pop_front() else { return Ok(drawn) };
                let mut rgba = spare.try_recv().unwrap_or_default();
                artist.collect(&mut rgba)?;
                drawn += 1;
                if to_taker.send(Drawn { tick, alpha, rgba }).is_err() {
                    return Ok(drawn);
                }
            }
        }
    }
}

/// Has the lab find out what the artist's panels will show of it. In a window verdicts come as they are
/// found; here there is time for all before a frame.
pub(super) fn know_what_is_shown(lab: &mut Lab, artist: &Artist) {
    if artist.panels() == Panels::Shown {
        lab.think();
    }
}

#[cfg(test)]
mod tests {
    use std::io::{self, Write};

    use super::*;
    use crate::lab::{Command, Scene};
    use crate::view::{AdapterPreference, Gpu};

    const SCHEDULE: Schedule = Schedule { frames: 7, fps: 10 };

    fn artist_or_skip(test: &str) -> Option<Artist> {
        let gpu = Gpu::headless(AdapterPreference::CpuOnly)
            .inspect_err(|error| drop(writeln!(io::stderr(), "SKIPPED {test}: {error}")))
            .ok()?;
        Some(Artist::new(gpu, [160, 90], 0.3).unwrap())
    }

    fn race() -> Lab {
        let mut lab = Lab::new(Scene::built_in("harbour").unwrap());
        lab.apply(Command::ToggleRace);
        lab.think();
        lab
    }

    /// Runs the pipeline from frame 0.
    fn piped<E: Send>(
        artist: &mut Artist,
        interrupted: &AtomicBool,
        take: impl FnMut(&Drawn) -> Result<(), E> + Send,
    ) -> Result<u32, Stop<E>> {
        let mut lab = race();
        let mut logbook = Logbook::new(1, &lab);
        let (lab, logbook) = (&mut lab, &mut logbook);
        let run = Run { artist, lab, logbook, schedule: SCHEDULE, interrupted };
        run.draw_all(take)
    }

    #[test]
    fn frames_come_in_order_with_the_same_bytes_as_one_at_a_time() {
        let test = "frames_come_in_order_with_the_same_bytes_as_one_at_a_time";
        let Some(mut artist) = artist_or_skip(test) else { return };
        let (mut lab, mut rgba, mut one_by_one) = (race(), Vec::new(), Vec::new());
        for frame in 0..SCHEDULE.frames {
            SCHEDULE.advance(&mut lab, frame, |_| ());
            artist.draw(&lab, &mut rgba).unwrap();
            one_by_one.push((lab.race().tick(), lab.clock().alpha_fraction(), rgba.clone()));
        }
        let mut frames = Vec::new();
        let drawn = piped(&mut artist, &AtomicBool::new(false), |drawn| {
            frames.push((drawn.tick, drawn.alpha, drawn.rgba.clone()));
            Ok::<_, ()>(())
        });
        assert!(matches!(drawn, Ok(7)));
        assert!(frames == one_by_one);
        assert_eq!(artist.in_flight(), 0);
    }

    #[test]
    fn a_frame_that_cannot_be_taken_ends_the_run_with_its_reason() {
        let test = "a_frame_that_cannot_be_taken_ends_the_run_with_its_reason";
        let Some(mut artist) = artist_or_skip(test) else { return };
        let mut taken = 0;
        let stopped = piped(&mut artist, &AtomicBool::new(false), |_| {
            taken += 1;
            if taken == 3 { Err("full") } else { Ok(()) }
        });
        assert!(matches!(stopped, Err(Stop::Taken("full"))));
        assert_eq!(taken, 3);
    }

    #[test]
    fn an_interrupt_lets_the_frames_in_hand_be_taken() {
        let test = "an_interrupt_lets_the_frames_in_hand_be_taken";
        let Some(mut artist) = artist_or_skip(test) else { return };
        let interrupted = AtomicBool::new(false);
        let mut taken = 0;
        let drawn = piped(&mut artist, &interrupted, |_| {
            taken += 1;
            interrupted.store(true, Ordering::Relaxed);
            Ok::<_, ()>(())
        });
        let Ok(drawn) = drawn else { panic!("nothing failed") };
        assert_eq!(drawn, taken);
        assert!((1..SCHEDULE.frames).contains(&drawn), "{drawn}");
    }
}
