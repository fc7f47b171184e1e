//! Engines: their cards against logs of the engines themselves, and which engine a log came from.

mod bounces;
mod cards;
mod identified;
mod log;
mod oracles;
mod reproduced;
mod spin_maps;
mod tumble;

pub(crate) use log::Body;
