//! Simulates and lays out frames on this thread, draws and encodes them on several others, and passes them on in
//! order on one more.
//!
//! A frame that has been passed on gives its buffer back to the first thread. The fixed number of buffers bounds
//! the memory of a run of any length, whichever stage is slow.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::error::Error;
use super::jobs;
use super::schedule::Schedule;
use super::state_log::StateLog;
use super::terminal::progress;
use crate::measure::cloud::CloudWorker;
use crate::studio::{Studio, analyse_bounded, complete_clouds, run_loops};
use crate::view::{OffscreenRenderer, Panels, PreparedFrame, Rasterizer, ReadbackError};

/// Threads that draw and encode. Simulation and layout of a race with panels take a seventh of the time, so that more
/// threads would wait.
const MAX_WORKERS: usize = 8;

/// Memory for the frames of all workers, unless one alone needs more.
const MAX_BYTES: usize = 1 << 30;

/// Memory of a worker for each pixel: a frame, a backdrop and a file.
const BYTES_PER_PIXEL: usize = 12;

/// Buffers beyond one per worker: one frame waits for a worker, and one is being passed on.
const SPARE_BUFFERS: usize = 2;

/// A drawn frame.
pub(super) struct DrawnFrame {
    /// Index of the frame, from 0.
    pub(super) frame: u32,
    /// Tick that the frame has reached.
    pub(super) tick: u64,
    /// Part of the next tick that the frame shows, as an exact fraction.
    pub(super) alpha: (u64, u64),
    /// Pixels of the frame, with the top row first.
    pub(super) rgba: Vec<u8>,
}

/// A frame with the result or the panic of its worker.
type Encoded<T> = (DrawnFrame, thread::Result<T>);

/// A run to be drawn.
pub(super) struct Pipeline<'a> {
    pub(super) renderer: &'a mut OffscreenRenderer,
    /// The studio, which must be at tick 0.
    pub(super) studio: &'a mut Studio,
    pub(super) state_log: &'a mut StateLog,
    pub(super) schedule: Schedule,
}

impl Pipeline<'_> {
    /// Draws the frames and passes each in order to `take` with the result of `encode`. Draws and encodes several
    /// frames at once if there are processors for it. Returns the number of frames drawn. Once `interrupted` is set,
    /// draws no further frame but still passes on those already drawn.
    pub(super) fn draw_all<T: Send>(
        self,
        interrupted: &AtomicBool,
        encode: impl Fn(&DrawnFrame, &PreparedFrame) -> T + Sync,
        mut take: impl FnMut(&DrawnFrame, T) -> Result<(), Error> + Send,
    ) -> Result<u32, Error> {
        let progress = progress(self.schedule.frames, "frames");
        let take = |drawn: &DrawnFrame, encoded| {
            progress.inc(1);
            take(drawn, encoded)
        };
        let processors = thread::available_parallelism().map_or(1, NonZero::get);
        let [width, height] = self.renderer.size_px().map(|side| side as usize);
        let fitting = MAX_BYTES / (BYTES_PER_PIXEL * width * height);
        let workers = processors.min(MAX_WORKERS).min(fitting).max(1);
        let drawn = self.draw_with_workers(workers, interrupted, encode, take);
        progress.finish_and_clear();
        drawn
    }

    /// [`draw_all`](Self::draw_all) with this number of worker threads.
    fn draw_with_workers<T: Send>(
        self,
        workers: usize,
        interrupted: &AtomicBool,
        encode: impl Fn(&DrawnFrame, &PreparedFrame) -> T + Sync,
        take: impl FnMut(&DrawnFrame, T) -> Result<(), Error> + Send,
    ) -> Result<u32, Error> {
        let pool = jobs::pool(workers)?;
        let rasterizers = (0..workers).map(|_| Rasterizer::new(NonZero::<usize>::MIN));
        let rasterizers = Mutex::new(rasterizers.collect());
        let (results, encoded) = mpsc::channel();
        let (emptied, buffers) = mpsc::channel();
        for _ in 0..(workers + SPARE_BUFFERS).min(self.schedule.frames as usize) {
            emptied.send(self.renderer.buffer()?).expect("its receiver is here");
        }
        thread::scope(|threads| {
            let taker = thread::Builder::new()
                .spawn_scoped(threads, move || deliver_in_order(&encoded, &emptied, take))
                .map_err(jobs::no_threads)?;
            let drawn = pool.in_place_scope_fifo(|jobs| {
                self.prepare(&buffers, interrupted, |mut prepared, mut drawn| {
                    let (results, encode, rasterizers) = (results.clone(), &encode, &rasterizers);
                    jobs.spawn_fifo(move |_| {
                        let made = panic::catch_unwind(AssertUnwindSafe(|| {
                            finish(&mut prepared, rasterizers, &mut drawn.rgba);
                            encode(&drawn, &prepared)
                        }));
                        // The receiver is gone once `take` has failed.
                        let _ = results.send((drawn, made));
                    });
                })
            });
            drop(results);
            match taker.join() {
                Ok(taken) => taken?,
                Err(bug) => panic::resume_unwind(bug),
            }
            Ok(drawn?)
        })
    }

    /// Lays out until the last frame, an interrupt, or the end of the thread that returns buffers. Passes each frame
    /// to `hand_on` with a buffer for its pixels.
    fn prepare(
        self,
        buffers: &Receiver<Vec<u8>>,
        interrupted: &AtomicBool,
        mut hand_on: impl FnMut(PreparedFrame, DrawnFrame),
    ) -> Result<u32, ReadbackError> {
        let Self { renderer, studio, state_log, schedule } = self;
        let mut clouds = CloudWorker::default();
        for frame in 0..schedule.frames {
            if interrupted.load(Ordering::Relaxed) {
                return Ok(frame);
            }
            schedule.advance(studio, frame, state_log);
            if !complete_analysis(studio, renderer, &mut clouds, interrupted) {
                return Ok(frame);
            }
            let prepared = renderer.prepare(studio)?;
            let Ok(rgba) = buffers.recv() else { return Ok(frame) };
            let (tick, alpha) = (studio.race().tick(), studio.clock().alpha_fraction());
            hand_on(prepared, DrawnFrame { frame, tick, alpha, rgba });
        }
        Ok(schedule.frames)
    }
}

/// Draws a frame with a rasterizer that no other thread uses.
fn finish(prepared: &mut PreparedFrame, free: &Mutex<Vec<Rasterizer>>, rgba: &mut Vec<u8>) {
    let free = || free.lock().unwrap_or_else(PoisonError::into_inner);
    let mut rasterizer = free().pop().expect("each worker has one");
    prepared.finish(&mut rasterizer, rgba);
    free().push(rasterizer);
}

/// Passes encoded frames to `take` in order, from frame 0, and returns their buffers. Stops at the first
/// error of `take`. Resumes the panic of a worker.
fn deliver_in_order<T>(
    encoded: &Receiver<Encoded<T>>,
    emptied: &Sender<Vec<u8>>,
    mut take: impl FnMut(&DrawnFrame, T) -> Result<(), Error>,
) -> Result<(), Error> {
    let (mut next, mut early) = (0, BTreeMap::new());
    for (drawn, made) in encoded {
        early.insert(drawn.frame, (drawn, made));
        while let Some((drawn, made)) = early.remove(&next) {
            next += 1;
            take(&drawn, made.unwrap_or_else(|bug| panic::resume_unwind(bug)))?;
            // The receiver no longer exists after the last frame.
            let _ = emptied.send(drawn.rgba);
        }
    }
    Ok(())
}

/// Completes the loops on the stage, and the analysis and the clouds that the panels show. A window shows results as
/// they arrive. A recording does a fixed amount of work on verdicts before each frame, so that its frames are
/// reproducible. Returns `false` after an interrupt. It does not wait for the work then, because the process is about
/// to end.
pub(super) fn complete_analysis(
    studio: &mut Studio,
    renderer: &OffscreenRenderer,
    clouds: &mut CloudWorker,
    interrupted: &AtomicBool,
) -> bool {
    run_loops(studio);
    if renderer.panels() == Panels::Shown {
        analyse_bounded(studio, |worker| jobs::result(interrupted, move || worker.finish()));
        complete_clouds(studio, clouds, || interrupted.load(Ordering::Relaxed));
    }
    !interrupted.load(Ordering::Relaxed)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;
    use std::time::Duration;

    use super::*;
    use crate::scene::Scene;
    use crate::studio::StageCommand;

    /// The schedule has more frames than there are buffers.
    const SCHEDULE: Schedule = Schedule { frames: 30, fps: 10 };

    fn renderer() -> OffscreenRenderer {
        OffscreenRenderer::new([160, 90], 0.3).unwrap()
    }

    fn race() -> Studio {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::ToggleRace);
        studio.analyse();
        studio
    }

    /// Runs the pipeline from frame 0.
    fn piped<T: Send>(
        renderer: &mut OffscreenRenderer,
        interrupted: &AtomicBool,
        encode: impl Fn(&DrawnFrame) -> T + Sync,
        take: impl FnMut(&DrawnFrame, T) -> Result<(), Error> + Send,
    ) -> Result<u32, Error> {
        let mut studio = race();
        let mut state_log = StateLog::new(1, studio.race());
        let (studio, state_log) = (&mut studio, &mut state_log);
        let run = Pipeline { renderer, studio, state_log, schedule: SCHEDULE };
        run.draw_with_workers(3, interrupted, |drawn, _| encode(drawn), take)
    }

    /// Takes longer for every other frame, beginning with the first.
    fn unsteady(drawn: &DrawnFrame) -> u32 {
        thread::sleep(Duration::from_millis(if drawn.frame.is_multiple_of(2) { 5 } else { 0 }));
        drawn.frame
    }

    #[test]
    fn an_encoder_that_panics_ends_the_run_with_its_panic() {
        let mut renderer = renderer();
        let encode = |drawn: &DrawnFrame| assert_ne!(drawn.frame, 4, "a bug");
        let run = || piped(&mut renderer, &AtomicBool::new(false), encode, |_, ()| Ok(()));
        assert!(panic::catch_unwind(AssertUnwindSafe(run)).is_err());
    }

    #[test]
    fn frames_in_flight_never_exceed_the_buffers() {
        let [on_their_way, most] = [0, 0].map(AtomicUsize::new);
        let encode = |drawn: &DrawnFrame| {
            most.fetch_max(on_their_way.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
            // The first frame is delayed until all buffers are in use, and a little longer.
            while drawn.frame == 0 && most.load(Ordering::SeqCst) < 3 + SPARE_BUFFERS {
                thread::yield_now();
            }
            thread::sleep(Duration::from_millis(if drawn.frame == 0 { 100 } else { 0 }));
        };
        let done = piped(&mut renderer(), &AtomicBool::new(false), encode, |_, ()| {
            on_their_way.fetch_sub(1, Ordering::SeqCst);
            Ok(())
        });
        assert!(matches!(done, Ok(30)));
        assert_eq!(most.into_inner(), 3 + SPARE_BUFFERS);
    }

    #[test]
    fn pipelined_frames_keep_their_order_and_bytes() {
        let mut renderer = renderer();
        let (mut studio, mut rgba, mut one_by_one) = (race(), Vec::new(), Vec::new());
        for frame in 0..SCHEDULE.frames {
            SCHEDULE.advance(&mut studio, frame, &mut ());
            renderer.draw(&studio, &mut rgba).unwrap();
            one_by_one.push((studio.race().tick(), studio.clock().alpha_fraction(), rgba.clone()));
        }
        let mut frames = Vec::new();
        let drawn = piped(&mut renderer, &AtomicBool::new(false), unsteady, |drawn, encoded| {
            assert_eq!(encoded, drawn.frame);
            frames.push((drawn.tick, drawn.alpha, drawn.rgba.clone()));
            Ok(())
        });
        assert!(matches!(drawn, Ok(30)));
        assert!(frames == one_by_one);
    }

    #[test]
    fn a_refused_frame_ends_the_run_with_its_reason() {
        let mut taken = 0;
        let stopped = piped(&mut renderer(), &AtomicBool::new(false), unsteady, |_, _| {
            taken += 1;
            if taken == 3 { Err(Error::failed("full")) } else { Ok(()) }
        });
        assert_eq!(stopped.unwrap_err().to_string(), "full");
        assert_eq!(taken, 3);
    }

    #[test]
    fn an_interrupt_still_delivers_the_frames_in_flight() {
        let interrupted = AtomicBool::new(false);
        let mut taken = 0;
        let drawn = piped(&mut renderer(), &interrupted, unsteady, |_, _| {
            taken += 1;
            interrupted.store(true, Ordering::Relaxed);
            Ok(())
        });
        let Ok(drawn) = drawn else { panic!("nothing failed") };
        assert_eq!(drawn, taken);
        assert!((1..SCHEDULE.frames).contains(&drawn), "{drawn}");
    }
}
