//! Regatta.
pub mod lab;
pub mod sim;
