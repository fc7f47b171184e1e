//! A frame goes from commands to ticks, to a picture, and onto the canvas. Work is done between frames.

use regatta::studio::{Command, DriverRequest, ToDo, ViewCommand, picture_file_name};
use regatta::view::{clipboard_text, egui, spoken};
use web_sys::Document;

use crate::driver::{Driver, now_ns};
use crate::{clipboard, files, questions};

/// Maximum time by which work may delay a frame, in nanoseconds.
const SLICE_NS: u64 = 5_000_000;
/// Maximum wait that is requested from the browser, in milliseconds.
const MAX_WAIT_MS: u128 = 60_000;

impl Driver {
    pub(crate) fn frame(&mut self) {
        let now_ns = self.now_ns();
        self.frame_is_due = false;
        if !self.is_in_sight {
            return;
        }
        self.simulate(now_ns);
        self.input.time = Some(now_ns as f64 / 1e9);
        let next = egui::RawInput { focused: true, ..egui::RawInput::default() };
        let input = std::mem::replace(&mut self.input, next);
        let scale = self.window.device_pixel_ratio();
        let Some((commands, output)) = self.canvas.draw(scale, input, &self.frames.studio) else {
            self.frames.not_drawn();
            return self.run_after_ms(100, Self::request_frame);
        };
        if std::mem::take(&mut self.saves_picture) {
            let name = format!("{}.png", picture_file_name(&self.frames.studio));
            files::save_picture(&self.canvas.element, name);
        }
        let due_ns = self.frames.end(now_ns, self.now_ns(), commands);
        self.drawn += 1;
        self.show(&output.platform);
        self.request_work();
        if due_ns == 0 || self.saves_picture {
            return self.request_frame();
        }
        let due_ms = u128::from(due_ns.div_ceil(1_000_000));
        let wait_ms = output.repaint_delay.as_millis().min(due_ms);
        if wait_ms <= MAX_WAIT_MS {
            self.run_after_ms(wait_ms as i32, Self::request_frame);
        }
    }

    /// Executes the commands and advances time.
    fn simulate(&mut self, began_ns: u64) {
        while let Some(to_do) = self.frames.begin() {
            match to_do {
                ToDo::Own(Command::View(ViewCommand::AskForPath)) => files::pick_file(),
                ToDo::Own(_) => {
                    let notice = "a page cannot compare recordings; `regatta diff` can";
                    self.frames.studio.viewer.set_notice(notice);
                }
                ToDo::Request(DriverRequest::Screenshot) => self.saves_picture = true,
                ToDo::Request(DriverRequest::Record) => self.save_recording(),
                ToDo::Request(DriverRequest::Report) => {
                    self.saves_picture = true;
                    self.save_recording();
                }
                ToDo::Request(DriverRequest::ExportInstrument) => self.save_instrument(),
                ToDo::Request(request) => self.copy(request),
            }
        }
        self.workers.set_requests(&self.frames.studio);
        let window = self.window.clone();
        self.frames.advance(began_ns, u64::MAX, &|| now_ns(&window));
    }

    /// Copies the requested text to the clipboard, if the request asks for one.
    fn copy(&mut self, request: DriverRequest) {
        let copied = match clipboard_text(&self.frames.studio, request) {
            Some(Ok(copied)) => copied,
            Some(Err(refused)) => return self.frames.studio.viewer.set_notice(refused),
            None => return,
        };
        let mut text = copied.text.clone();
        let is_link = request == DriverRequest::CopyLink;
        if is_link {
            text = self.put_into_address().unwrap_or(text);
        }
        clipboard::write(&self.window, &text, move |driver, taken| {
            let notice = match taken {
                Err(_) if is_link => "the address of this page is the run now; copy it".into(),
                taken => copied.notice(taken),
            };
            driver.frames.studio.viewer.set_notice(notice);
            driver.request_frame();
        });
    }

    /// Updates the title, the state and the pointer of the page, and copies any text that the panels ask to copy.
    fn show(&mut self, output: &egui::PlatformOutput) {
        if let Some(document) = self.window.document() {
            let title = self.frames.studio.title();
            if document.title() != title {
                document.set_title(&title);
            }
            self.show_state(&document);
        }
        for command in &output.commands {
            if let egui::OutputCommand::CopyText(text) = command {
                clipboard::write(&self.window, text, |_, _| {});
            }
        }
        let pointer = match output.cursor_icon {
            egui::CursorIcon::Crosshair => "crosshair",
            egui::CursorIcon::Grab => "grab",
            egui::CursorIcon::Grabbing => "grabbing",
            egui::CursorIcon::Move => "move",
            egui::CursorIcon::PointingHand => "pointer",
            egui::CursorIcon::ResizeHorizontal => "ew-resize",
            egui::CursorIcon::ResizeVertical => "ns-resize",
            egui::CursorIcon::Text => "text",
            _ => "default",
        };
        _ = self.canvas.element.style().set_property("cursor", pointer);
    }

    /// Updates the page's play state, the link to an explanation, and the text for a screen reader.
    fn show_state(&mut self, document: &Document) {
        let studio = &self.frames.studio;
        let (is_running, is_alone) = (studio.running(), !studio.display().measure);
        let classes = [
            ("running", is_running),
            // A paused stage that has no bar shows a button over it.
            ("still", !is_running && is_alone),
            ("entered", self.is_entered),
        ];
        let classes: Vec<&str> =
            classes.into_iter().filter(|(_, is)| *is).map(|(class, _)| class).collect();
        let class = classes.join(" ");
        if let Some(body) = document.body().filter(|body| body.class_name() != class) {
            body.set_class_name(&class);
            let label = if is_running { "Pause" } else { "Play" };
            if let Some(button) = document.get_element_by_id("pause") {
                _ = button.set_attribute("aria-label", label);
            }
        }
        let spoken = spoken(studio);
        let state = document.get_element_by_id("state").filter(|_| spoken != self.spoken);
        if let Some(state) = state {
            state.set_text_content(Some(&spoken));
            self.spoken = spoken;
        }
        let stage = (studio.deck.openings(), studio.active(), studio.loop_lab().is_some());
        if self.explained.replace(stage) != Some(stage)
            && let Some(link) = document.get_element_by_id("what")
        {
            _ = link.set_attribute("href", &questions::page_of(studio));
        }
    }

    /// Works for a slice of time, and schedules the remaining work between the next frames.
    pub(crate) fn work(&mut self) {
        self.work_is_due = false;
        let end_ns = self.now_ns() + SLICE_NS;
        let mut has_found = false;
        while self.now_ns() < end_ns && (self.workers.have_more() || self.arrival.is_some()) {
            has_found |= self.workers.step(&mut self.frames.studio);
            if let Some(replay) = &mut self.arrival
                && let Some(notice) = crate::work::replay_notice(replay)
            {
                self.arrival = None;
                self.frames.studio.viewer.set_notice(notice);
                has_found = true;
            }
        }
        if has_found {
            self.request_frame();
        }
        self.request_work();
    }
}
