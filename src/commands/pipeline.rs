//! Frames, drawn on this thread and encoded and taken on others: meanwhile the next is drawn and the one
//! after it is simulated.
//!
//! At most two frames are in flight on the device, one waits and each worker has one, whatever the length
//! of the run; they are taken in order.

use std::collections::VecDeque;
use std::num::NonZero;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::{mem, panic, thread};

use super::logbook::Logbook;
use super::voyage::Schedule;
use crate::lab::Lab;
use crate::view::{Artist, Panels, ReadbackError};

/// More gain nothing on a software adapter, and cost memory.
const MOST_IN_FLIGHT: usize = 2;

/// Threads that work on frames: more than these no device keeps busy, and each holds a frame.
const MOST_WORKERS: usize = 4;

/// A frame as it comes from the device.
pub(super) struct Drawn {
    /// Counted from 0.
    pub(super) frame: u32,
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

/// A frame to be worked on.
struct Job<F> {
    drawn: Drawn,
    /// Brings what takes frames, once the frame before this one is taken.
    turn: mpsc::Receiver<F>,
    next_turn: mpsc::SyncSender<F>,
}

impl Run<'_> {
    /// Draws every frame and has `take` take it, with what `make` makes of it; where there are processors
    /// for it several are made at once, and they are taken in order. Returns how many frames were drawn.
    pub(super) fn draw_all<T, E: Send>(
        self,
        make: impl Fn(&Drawn) -> T + Sync,
        take: impl FnMut(&Drawn, T) -> Result<(), E> + Send,
    ) -> Result<u32, Stop<E>> {
        let processors = thread::available_parallelism().map_or(1, NonZero::get);
        // One is left to drawing.
        self.draw_beside((processors - 1).clamp(1, MOST_WORKERS), make, take)
    }

    /// Draws every frame on this thread while `workers` threads make and take.
    fn draw_beside<T, E: Send, F: FnMut(&Drawn, T) -> Result<(), E> + Send>(
        self,
        workers: usize,
        make: impl Fn(&Drawn) -> T + Sync,
        take: F,
    ) -> Result<u32, Stop<E>> {
        let (to_workers, jobs) = mpsc::sync_channel::<Job<F>>(1);
        let jobs = Arc::new(Mutex::new(jobs));
        let (give_back, spare) = mpsc::channel();
        let (first_turn, mut turn) = mpsc::sync_channel(1);
        first_turn.send(take).map_err(drop).expect("its receiver is here");
        thread::scope(|scope| {
            let work = || {
                let (jobs, give_back, make) = (Arc::clone(&jobs), give_back.clone(), &make);
                move || loop {
                    let job = jobs.lock().ok().and_then(|jobs| jobs.recv().ok());
                    let Some(Job { drawn, turn, next_turn }) = job else { return Ok(()) };
                    let made = make(&drawn);
                    // It does not come when a frame before this one could not be taken.
                    let Ok(mut take) = turn.recv() else { return Ok(()) };
                    take(&drawn, made)?;
                    // There may be no next frame, and nobody who wants the room.
                    let _ = (next_turn.send(take), give_back.send(drawn.rgba));
                }
            };
            let workers: Vec<_> = (0..workers).map(|_| scope.spawn(work())).collect();
            // When all workers have stopped, so has the channel.
            drop(jobs);
            let give = |drawn| {
                let (next_turn, following) = mpsc::sync_channel(1);
                let turn = mem::replace(&mut turn, following);
                to_workers.send(Job { drawn, turn, next_turn }).is_ok()
            };
            let result = self.draw(give, &spare);
            drop(to_workers);
            for worker in workers {
                match worker.join() {
                    Ok(taken) => taken.map_err(Stop::Taken)?,
                    Err(panic) => panic::resume_unwind(panic),
                }
            }
            result.map_err(Stop::Readback)
        })
    }

    /// Draws until all is drawn, or `give` says that nobody takes frames any more.
    fn draw(
        self,
        mut give: impl FnMut(Drawn) -> bool,
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
                let frame = drawn;
                drawn += 1;
                if !give(Drawn { frame, tick, alpha, rgba }) {
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
    use std::time::Duration;

    use super::*;
    use crate::lab::{Command, Scene};
    use crate::view::{AdapterPreference, Gpu};

    /// More than there are on the way at once.
    const SCHEDULE: Schedule = Schedule { frames: 30, fps: 10 };

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
        mut take: impl FnMut(&Drawn) -> Result<(), E> + Send,
    ) -> Result<u32, Stop<E>> {
        let mut lab = race();
        let mut logbook = Logbook::new(1, &lab);
        let (lab, logbook) = (&mut lab, &mut logbook);
        let run = Run { artist, lab, logbook, schedule: SCHEDULE, interrupted };
        // The first of every two takes longer than the second.
        let make = |drawn: &Drawn| {
            thread::sleep(Duration::from_millis(if drawn.frame.is_multiple_of(2) { 5 } else { 0 }));
            drawn.frame
        };
        run.draw_beside(3, make, |drawn, made| {
            assert_eq!(made, drawn.frame);
            take(drawn)
        })
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
        assert!(matches!(drawn, Ok(30)));
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
