//! `loop`.

use std::fs;

use crate::{stderr_of_failure, stdout_of};
