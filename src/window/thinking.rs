//! Thinks beside the window, on a thread of its own: a verdict can take longer than a frame may.

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;

use winit::event_loop::EventLoopProxy;

use super::Event;
use crate::lab::{Question, Thinker};

/// The way to the thread that thinks. It ends when this is dropped.
pub(super) struct ThinkingThread {
    questions: Sender<Question>,
    asked: Question,
}

impl ThinkingThread {
    /// Begins to answer `question`: whatever is found comes as an event.
    pub(super) fn new(question: Question, events: EventLoopProxy<Event>) -> Self {
        let (questions, asked) = channel();
        let thinker = Thinker::new(question.clone());
        thread::spawn(move || think(thinker, &asked, &events));
        Self { questions, asked: question }
    }

    /// Turns to `question`, if it is another.
    pub(super) fn ask(&mut self, question: Question) {
        if question != self.asked {
            self.asked = question.clone();
            // A thread that is gone finds nothing more; the window stays.
            _ = self.questions.send(question);
        }
    }
}

fn think(mut thinker: Thinker, questions: &Receiver<Question>, events: &EventLoopProxy<Event>) {
    loop {
        let more = thinker.go_on();
        if events.send_event(Event::Learnt(thinker.findings())).is_err() {
            return;
        }
        let next = match questions.try_recv() {
            Err(TryRecvError::Empty) if more => continue,
            Err(TryRecvError::Empty) => questions.recv().ok(),
            other => other.ok(),
        };
        let Some(next) = next else { return };
        thinker.ask(questions.try_iter().last().unwrap_or(next));
    }
}
