//! The window as people meet it: the program on a display of its own, keys and clicks in; title, pictures
//! and exit code out.
//!
//! `main` has the table of the tests. One whose display, driver or tool is missing is reported as ignored.

#[cfg(target_os = "linux")]
mod at_random;
#[cfg(target_os = "linux")]
mod clipboard;
#[cfg(target_os = "linux")]
mod copying;
#[cfg(target_os = "linux")]
mod desk;
#[cfg(target_os = "linux")]
#[path = "../dice/mod.rs"]
mod dice;
#[cfg(target_os = "linux")]
mod dropped;
#[cfg(target_os = "linux")]
mod inspector;
#[cfg(target_os = "linux")]
mod keys;
#[cfg(target_os = "linux")]
mod life;
#[cfg(target_os = "linux")]
mod mouse;
#[cfg(target_os = "linux")]
#[path = "../needs/mod.rs"]
mod needs;
#[cfg(target_os = "linux")]
mod opening;
#[cfg(target_os = "linux")]
#[path = "../processor/mod.rs"]
mod processor;
#[cfg(target_os = "linux")]
mod program;
#[cfg(target_os = "linux")]
mod shape;
#[cfg(target_os = "linux")]
mod time_travel;
#[cfg(target_os = "linux")]
mod touch;
#[cfg(target_os = "linux")]
mod twin;
#[cfg(target_os = "linux")]
mod wayland;
#[cfg(target_os = "linux")]
mod widgets;

#[cfg(not(target_os = "linux"))]
fn main() {}

#[cfg(target_os = "linux")]
fn main() -> std::process::ExitCode {
    use needs::{Need, Tests, has, tests};

    const SCREEN: Need = Need::new("xvfb", || has("Xvfb", "-version"));
    const HANDS: Need = Need::new("xdotool", || has("xdotool", "version"));
    const DISPLAY: [Need; 2] = [SCREEN, HANDS];
    const WAYLAND: Need = Need::new("weston", || has("weston", "--version"));
    const PIPES: Need = Need::new("coreutils", || has("mkfifo", "--version"));
    const VULKAN: Need = Need::new("mesa-vulkan-drivers", || adapter(wgpu::Backends::VULKAN));
    const GL: Need = Need::new("libgl1-mesa-dri", || adapter(wgpu::Backends::GL));

    let mut tests = Tests::new();
    // The first takes longest, and the others run at the same time.
    tests! { tests:
        DISPLAY => at_random {
            random_events_leave_the_program_running_quietly_within_its_memory,
        }
        DISPLAY => copying {
            control_c_on_a_lane_and_its_menu_copy_the_method,
            pasting_a_long_text_repeatedly_uses_no_memory,
            text_is_copied_and_pasted_between_fields_and_other_programs,
            a_short_link_opens_its_scene_paused_at_its_tick,
        }
        DISPLAY => dropped {
            a_dropped_scene_file_is_opened_unless_it_has_mistakes,
            a_dropped_frame_log_opens_the_loop_lab_or_shows_its_mistakes,
        }
        DISPLAY => inspector {
            typing_into_the_inspector_edits_and_triggers_no_other_key,
            time_advances_while_a_parameter_is_swept,
        }
        DISPLAY => keys {
            every_key_performs_its_command_from_the_table,
            keys_work_in_the_loop_lab_and_leaving_it_restores_the_run,
            a_tick_forward_is_one_tick,
            a_held_key_repeats_where_useful_but_never_a_toggle,
            unbound_chords_with_control_or_alt_are_ignored,
            the_guide_opens_a_waiting_stop_and_escape_returns_to_the_run,
            slow_loops_do_not_block_the_window,
        }
        [SCREEN, HANDS, VULKAN] => life { a_window_opens_under_vulkan }
        [SCREEN, HANDS, GL] => life { a_window_opens_under_gl }
        [SCREEN, HANDS, PIPES] => life { a_signal_ends_the_program_while_nothing_reads_its_recording }
        DISPLAY => life {
            a_window_opens_by_the_processor,
            the_program_ends_after_its_seconds_or_with_its_window,
            without_the_requested_adapter_the_program_ends_with_a_message,
            a_display_of_too_few_colours_ends_the_program_in_one_plain_line,
            a_window_opens_in_silence_beside_traces_of_wayland,
            an_unmapped_window_runs_on_in_real_time,
            a_covered_window_runs_on_in_real_time_and_draws_nothing,
            a_hitch_drops_ticks_with_a_notice_and_a_pause_does_not,
            a_paused_window_leaves_the_machine_alone,
            the_last_open_scene_reopens_unless_another_is_given,
            the_window_first_shows_the_stage_alone_and_remembers_the_instruments,
            a_killed_program_leaves_its_recording_for_the_next_start_to_report,
        }
        DISPLAY => mouse {
            the_mouse_works_the_panels_at_every_scale,
            escape_closes_an_open_menu_before_it_ends_the_program,
            a_focused_widget_takes_space_until_escape_releases_it,
        }
        DISPLAY => opening {
            a_typed_path_opens_its_scene_and_keeps_it_on_the_list,
            a_path_is_completed_by_tab,
            a_path_without_a_scene_is_reported_and_the_run_continues,
            a_deleted_file_is_reported_and_a_restored_one_is_reread,
            a_file_changed_on_disk_is_taken_with_its_state_unless_it_is_broken,
            changed_lines_of_a_method_go_on_from_the_state_in_the_window,
        }
        DISPLAY => shape {
            window_and_screenshot_agree_at_every_scale,
            the_window_survives_shrinking_to_one_pixel_and_back,
            the_window_survives_full_screen_and_back,
            escape_leaves_full_screen_and_then_asks_before_it_ends_the_program,
        }
        DISPLAY => time_travel {
            a_paused_window_steps_ticks_and_seconds_back_and_forth,
            control_z_restores_the_future_discarded_by_an_action_in_the_past,
            a_mark_on_the_timeline_has_a_tooltip_with_a_line_for_each_action,
            a_drag_along_the_timeline_seeks_to_the_tick_under_the_mouse,
        }
        DISPLAY => touch {
            a_dragged_mass_is_placed_with_shift_and_escape_cancels,
            a_released_mass_keeps_the_velocity_of_the_drag_except_with_shift,
            time_stops_while_a_body_is_held,
            the_wheel_zooms_a_drag_pans_and_a_double_click_fits,
            dragging_the_tick_rate_holds_time_and_is_undone_in_one_step,
        }
        [WAYLAND, VULKAN] => wayland { a_wayland_compositor_shows_what_a_graphics_card_draws }
        [WAYLAND] => wayland {
            a_wayland_window_without_frame_requests_drops_no_ticks,
            a_wayland_compositor_shows_what_the_processor_draws,
            a_lost_compositor_is_told_of_once,
        }
        DISPLAY => widgets {
            the_mouse_works_the_menus_buttons_and_table,
            the_mouse_works_the_instruments_and_the_inspector,
            the_mouse_works_the_guide_and_the_timeline,
            dragging_the_cross_of_the_stability_map_sets_rate_and_parameter,
            a_typed_spring_is_advised_on_and_remembered,
        }
    }
    tests.run()
}

/// Whether a driver of this kind is installed.
#[cfg(target_os = "linux")]
fn adapter(backend: wgpu::Backends) -> bool {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backend;
    let instance = wgpu::Instance::new(descriptor);
    !pollster::block_on(instance.enumerate_adapters(backend)).is_empty()
}
