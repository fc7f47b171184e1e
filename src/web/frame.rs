//! A frame: commands → ticks → picture → canvas; and the work between frames.

use regatta::view::egui;

use crate::driver::Driver;
use crate::{clipboard, files};

/// The longest time that work takes of the page before a frame may be drawn, in nanoseconds.
const SLICE_NS: u64 = 5_000_000;
/// The longest wait that is asked of the browser, in milliseconds.
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
        let Some((commands, output)) = self.canvas.draw(scale, input, &self.studio) else {
            return self.after(100, Self::request_frame);
        };
        if std::mem::take(&mut self.saves_picture) {
            let name = format!("{}.png", self.studio.picture_file_name());
            files::save_picture(&self.canvas.element, name);
        }
        if std::mem::take(&mut self.has_opened) {
            // The first frame of a scene takes longer than others, which is not time in its run.
            self.last_frame_ns = self.last_frame_ns.map(|_| self.now_ns());
        }
        self.meter.frame(now_ns, &self.studio);
        self.frames += 1;
        self.show(&output.platform);
        let is_next = self.studio.running() || !commands.is_empty() || self.saves_picture;
        self.asked.extend(commands);
        self.request_work();
        if is_next {
            return self.request_frame();
        }
        let notice = self.studio.viewer().notice.as_ref().map(|notice| notice.left_ns());
        let notice_ms = notice.map_or(u128::MAX, |left_ns| left_ns.unsigned_abs().into());
        let wait_ms = output.repaint_delay.as_millis().min(notice_ms.div_ceil(1_000_000));
        if wait_ms <= MAX_WAIT_MS {
            self.after(wait_ms as i32, Self::request_frame);
        }
    }

    /// Has the page show the title and the pointer, and copies what was copied in the panels.
    fn show(&self, output: &egui::PlatformOutput) {
        if let Some(document) = self.window.document() {
            let title = self.studio.title();
            if document.title() != title {
                document.set_title(&title);
            }
            // Without a keyboard and a bar of buttons a stage that stands still has some of the page's own.
            let is_still = !self.studio.running() && !self.studio.display().measure;
            let class = match is_still {
                true if self.is_embedded => "still",
                true => "still sharing",
                false => "",
            };
            if let Some(body) = document.body().filter(|body| body.class_name() != class) {
                body.set_class_name(class);
            }
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

    /// Works for a slice of time, and goes on between the next frames.
    pub(crate) fn work(&mut self) {
        self.work_is_due = false;
        let end_ns = self.now_ns() + SLICE_NS;
        let mut has_found = false;
        while self.now_ns() < end_ns && (self.workers.have_more() || self.arrival.is_some()) {
            has_found |= self.workers.step(&mut self.studio);
            if let Some(replay) = &mut self.arrival
                && let Some(told) = crate::arrival::told_after_slice(replay)
            {
                self.arrival = None;
                self.studio.viewer_mut().set_notice(told);
                has_found = true;
            }
        }
        if has_found {
            self.request_frame();
        }
        self.request_work();
    }
}
