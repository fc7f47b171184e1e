//! Pixels.
mod panels;
