//! The memory held by laboratory, panels and renderer after hundreds of random events, without a window. A counting
//! allocator sees every byte of their thread, which the memory of a process does not show.
#![cfg(feature = "desktop")]

use std::alloc::{GlobalAlloc, Layout, System as SystemAllocator};
use std::cell::Cell;
use std::num::NonZero;

use egui::{
    Event, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, RawInput, TouchPhase, pos2,
    vec2,
};
use regatta::scene::Scene;
use regatta::studio::{KEYS, Studio, ViewCommand, open_file};
use regatta::view::{CpuExecutor, FrameRenderer};

use crate::dice::Dice;

thread_local! {
    /// The bytes that were allocated and not yet given back, by thread: other tests allocate at the same time.
    static HELD: Cell<isize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: everything is passed on unchanged; the count needs no allocation.
#[expect(unsafe_code, reason = "a global allocator that counts can only be written so")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        HELD.set(HELD.get() + layout.size() as isize);
        unsafe { SystemAllocator.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        HELD.set(HELD.get() - layout.size() as isize);
        unsafe { SystemAllocator.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        HELD.set(HELD.get() + size as isize - layout.size() as isize);
        unsafe { SystemAllocator.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The panels of a window of 1280 by 720 points, with a quarter of its pixels to draw.
const SIZE_PX: [u32; 2] = [640, 360];
const SCALE: f32 = 0.5;
const EVENTS: usize = 600;
/// The memory for rewinding, in MB: small enough to be full at each rest.
const REWIND_MB: usize = 1;
/// The most that the program may hold more after the second half of the events than after the first, in MB, and the least
/// that it holds at all.
const MAX_GROWTH_MB: f64 = 5.0;
const MIN_MB: f64 = 1.0;

struct Program {
    studio: Studio,
    renderer: FrameRenderer,
    executor: CpuExecutor,
    rows: Vec<u8>,
    time_s: f64,
}

impl Program {
    /// Shows a frame with these events in it, and performs its commands.
    fn frame(&mut self, events: Vec<Event>) {
        let Self { studio, renderer, executor, rows, time_s } = self;
        *time_s += 1.0 / 60.0;
        studio.advance(16_666_667);
        let input = RawInput { time: Some(*time_s), events, ..RawInput::default() };
        let (commands, output) = renderer.draw(SIZE_PX, SCALE, input, studio);
        executor.execute(&output.drawing, rows);
        for command in commands {
            studio.apply(command);
        }
    }

    /// Opens a scene of one body, so that everything from earlier runs can be freed, and returns the memory still
    /// held, in MB.
    fn at_rest(&mut self) -> f64 {
        self.studio.apply(ViewCommand::CloseDialog);
        let scene = Scene::built_in("spring").expect("a built-in scene");
        open_file(&mut self.studio, "rest.toml".as_ref(), scene);
        (0..30).for_each(|_| self.frame(vec![Event::PointerGone]));
        HELD.get() as f64 / f64::from(1 << 20)
    }

    fn random_event(&mut self, dice: &mut Dice) {
        let mut place = || pos2(dice.between(0.0, 1280.0) as f32, dice.between(0.0, 720.0) as f32);
        let [from, to] = [place(), place()];
        let button = |pos, button, pressed| Event::PointerButton {
            pos,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        };
        let click = |at, with| {
            vec![Event::PointerMoved(at), button(at, with, true), button(at, with, false)]
        };
        match (10.0 * dice.part()) as u32 {
            0 => self.frame(click(from, PointerButton::Secondary)),
            1..=2 => self.frame(click(from, PointerButton::Primary)),
            3 => {
                self.frame(vec![
                    Event::PointerMoved(from),
                    button(from, PointerButton::Primary, true),
                ]);
                self.frame(vec![Event::PointerMoved(to)]);
                self.frame(vec![button(to, PointerButton::Primary, false)]);
            }
            4 => {
                let (unit, delta, phase) = (
                    MouseWheelUnit::Line,
                    vec2(0.0, dice.between(-2.0, 2.0) as f32),
                    TouchPhase::Move,
                );
                let (source, modifiers) = (MouseWheelSource::Wheel, Modifiers::NONE);
                let wheel = Event::MouseWheel { unit, source, delta, phase, modifiers };
                self.frame(vec![Event::PointerMoved(from), wheel]);
            }
            _ => {
                let bound = &KEYS[dice.below(KEYS.len())].keys;
                let (_, command) = &bound[dice.below(bound.len())];
                self.studio.apply(command.clone());
                self.frame(Vec::new());
            }
        }
    }
}

#[test]
fn hundreds_of_random_events_leak_at_most_a_few_megabytes() {
    let mut studio = Studio::new(Scene::built_in("harbour").expect("a built-in scene"));
    studio.deck.set_rewind_bytes(REWIND_MB << 20);
    let renderer = FrameRenderer::new(4096);
    let executor = CpuExecutor::new(NonZero::<usize>::MIN);
    let mut program = Program { studio, renderer, executor, rows: Vec::new(), time_s: 0.0 };
    let mut dice = Dice::new(12);
    let mut held = Vec::new();
    for event in 1..=EVENTS {
        program.random_event(&mut dice);
        if event % (EVENTS / 6) == 0 {
            held.push(program.at_rest());
        }
    }
    println!("held at rest: {held:.2?} MB");
    let [first, second] =
        [&held[..3], &held[3..]].map(|half| half.iter().copied().fold(f64::INFINITY, f64::min));
    assert!(first > MIN_MB && second > MIN_MB, "{held:?}");
    assert!(second - first < MAX_GROWTH_MB, "{held:?}");
}
