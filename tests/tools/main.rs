//! Tests that want more than a compiler of Rust: compilers and interpreters of other languages, readers of pictures
//! and films, a disk to mount, a graphics device.
//!
//! `main` has the table of the tests. One whose tool is missing is reported as ignored.

#[cfg(feature = "desktop")]
mod command_line;
mod compilers;
#[cfg(feature = "desktop")]
mod device;
mod loop_snippets;
#[path = "../needs/mod.rs"]
mod needs;
#[cfg(all(feature = "desktop", target_os = "linux"))]
#[path = "../processor/mod.rs"]
mod processor;
mod rules;
mod source_code;

#[cfg(feature = "desktop")]
use std::process::Command;
use std::process::ExitCode;

use needs::{Need, Tests, has, tests};

const C: Need = Need::new("gcc", || has("cc", "--version"));
const CPP: Need = Need::new("g++", || has("c++", "--version"));
const C_SHARP: Need = Need::new("mono-mcs", || has("mcs", "--version") && has("mono", "--version"));
const JAVASCRIPT: Need = Need::new("nodejs", || has("node", "--version"));
const LUA: Need = Need::new("lua5.4", || has("lua5.4", "-v"));

fn main() -> ExitCode {
    let mut tests = Tests::new();
    // The first take longest, and the others run at the same time.
    #[cfg(feature = "desktop")]
    add_drawn(&mut tests);
    tests! { tests of source_code:
        [] => compiled { generated_rust_matches_the_methods }
        [C] => compiled { generated_c_matches_the_methods }
        [CPP] => compiled { generated_c_is_valid_cpp }
        [C_SHARP] => compiled { generated_c_sharp_matches_the_methods }
        [JAVASCRIPT] => scripts {
            printed_javascript_matches_the_methods,
            printed_javascript_matches_its_rule_at_every_frame_rate,
            words_of_javascript_are_renamed_in_it_and_run,
        }
        [LUA] => scripts {
            printed_lua_matches_the_methods,
            printed_lua_matches_its_rule_at_every_frame_rate,
            words_of_lua_are_renamed_in_it_and_run,
            functions_that_lua_lacks_are_written_out_exactly,
        }
        [] => spin {
            the_lines_of_a_spin_step_like_its_method_to_the_bit,
            printed_steps_of_a_spin_match_the_methods_in_rust,
        }
        [C] => spin { printed_steps_of_a_spin_match_the_methods_in_c }
        [C_SHARP] => spin { printed_steps_of_a_spin_match_the_methods_in_c_sharp }
        [JAVASCRIPT] => spin { printed_steps_of_a_spin_match_the_methods_in_javascript }
        [LUA] => spin { printed_steps_of_a_spin_match_the_methods_in_lua }
        [] => words {
            words_of_rust_are_renamed_in_it_and_compile,
            words_of_gdscript_are_renamed_in_it,
            names_that_a_language_cannot_tell_apart_stay_two,
            no_remark_becomes_code_in_any_language,
        }
        [C] => words { words_of_c_are_renamed_in_it_and_compile }
        [CPP] => words { words_of_cpp_are_renamed_in_it_and_compile }
        [C_SHARP] => words { words_of_c_sharp_are_renamed_in_it_and_compile }
    }
    tests! { tests:
        [] => rules { generated_rust_matches_its_rule_at_every_frame_rate }
        [C] => rules { generated_c_matches_its_rule }
        [CPP] => rules { generated_c_of_a_rule_is_valid_cpp }
        [C_SHARP] => rules { generated_c_sharp_matches_its_rule }
        [] => loop_snippets {
            the_rust_loops_match_the_tables,
            every_loop_is_printed_in_gdscript_with_indented_blocks,
        }
        [C] => loop_snippets { the_c_loops_match_the_tables }
        [CPP] => loop_snippets { the_c_loops_are_valid_cpp }
        [C_SHARP] => loop_snippets { the_c_sharp_loops_match_the_tables }
        [JAVASCRIPT] => loop_snippets { the_javascript_loops_match_the_tables }
        [LUA] => loop_snippets { the_lua_loops_match_the_tables }
    }
    tests.run()
}

/// Adds the tests of the program and of its pictures.
#[cfg(feature = "desktop")]
fn add_drawn(tests: &mut Tests) {
    const DEVICE: Need = Need::new("mesa-vulkan-drivers", device::is_there);
    const FILMS: Need =
        Need::new("ffmpeg", || has("ffmpeg", "-version") && has("ffprobe", "-version"));
    const GIFS: Need = Need::new("gifsicle", || has("gifsicle", "--version"));
    const CLIPPY: Need = Need::new("clippy of rustup", || has("clippy-driver", "--version"));
    const MCP: Need = Need::new("mcp 2.3.0 of Python (pip)", || {
        let client = Command::new("python3").args(["-c", "import mcp"]).output();
        client.is_ok_and(|client| client.status.success())
    });
    const PNGS: Need = Need::new("pngcheck", || has("pngcheck", "-h"));
    const PYTHON: Need = Need::new("python3", || has("python3", "--version"));

    tests! { tests:
        [DEVICE] => device {
            processor_and_device_draw_every_scene_almost_alike,
            a_lost_device_does_not_panic_and_a_new_one_draws,
            a_refused_format_is_an_error_of_one_line,
            an_uncaptured_error_does_not_end_the_program,
            pixels_come_back_exactly_at_odd_widths,
            reading_from_a_lost_device_is_an_error,
        }
    }
    tests! { tests of command_line:
        [MCP] => assistant { a_client_of_another_maker_lists_and_calls_the_tools }
        [DEVICE] => verify { frames_from_a_device_verify_within_the_limits }
        [FILMS] => formats {
            ffmpeg_reads_every_film_with_the_drawn_frames,
            the_manuals_pipe_to_ffmpeg_makes_a_film,
        }
        [PNGS] => formats { a_third_party_decoder_reads_single_frames }
        [GIFS] => formats { gifsicle_reads_every_frame_of_a_gif }
        [] => formats {
            a_gif_keeps_its_timing_and_looks_alike,
            y4m_has_a_header_and_three_planes_a_frame,
            standard_output_has_the_same_bytes_as_a_file,
            a_sheet_has_time_across_and_lanes_down,
            a_pipe_that_closes_ends_a_stream_quietly,
        }
        [PYTHON] => fixture { a_good_engine_passes_and_a_bad_one_fails_in_python }
        [CPP] => fixture { a_good_engine_passes_and_a_bad_one_fails_in_cpp }
        [CLIPPY] => fixture { a_fixture_in_rust_passes_the_lints }
        [] => fixture {
            a_good_engine_passes_and_a_bad_one_fails_in_rust,
            a_fixture_has_the_states_of_a_trace_and_the_least_tolerance_of_its_truth,
            names_are_escaped_and_a_fixture_without_later_states_is_refused,
        }
    }
    #[cfg(unix)]
    tests! { tests of command_line:
        [] => formats { an_interrupted_stream_leaves_no_file }
    }
    #[cfg(target_os = "linux")]
    add_linux(tests);
}

/// Adds those of disks and pipes.
#[cfg(all(feature = "desktop", target_os = "linux"))]
fn add_linux(tests: &mut Tests) {
    const DISK: Need = Need::new("mount, by root", || {
        let folder = tempfile::tempdir().expect("a place for files");
        command_line::disks::Disk::mount(&folder.path().join("disk"), "64k").is_some()
    });
    const PIPES: Need = Need::new("coreutils", || has("mkfifo", "--version"));

    tests! { tests of command_line:
        [DISK] => disks {
            an_unwritable_clip_is_a_failed_run,
            a_full_disk_leaves_no_partial_file_and_a_remedy,
            a_full_disk_ends_the_capture_with_whole_frames_only,
        }
        [PIPES] => pipes {
            a_named_pipe_is_written_to_and_not_replaced,
            a_signal_ends_a_command_while_nothing_reads_its_pipe,
        }
    }
}
