//! Regatta.
pub mod lab;
pub mod sim;
#[cfg(feature = "desktop")]
pub mod view;
