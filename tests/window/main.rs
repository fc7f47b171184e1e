//! The window as people meet it: the program on a display of its own, keys and clicks in; title, pictures
//! and exit code out.
#![cfg(all(feature = "desktop", target_os = "linux"))]

// Its name sorts first: it takes longest, and the others run at the same time.
mod at_random;
mod clipboard;
mod copying;
mod desk;
#[path = "../dice/mod.rs"]
mod dice;
mod dropped;
mod inspector;
mod keys;
mod life;
mod mouse;
mod opening;
mod program;
mod shape;
mod time_travel;
mod touch;
mod twin;
mod wayland;
mod widgets;
