//! The window on a run from a user's own program.

use std::path::Path;
use std::sync::Arc;

use super::{Closed, SceneFiles, WindowError, WindowSettings, run};
use crate::regular_file;
use crate::run::Session;
use crate::scene::{MAX_FILE_BYTES, Scene};
use crate::studio::Studio;

/// The window of the program.
#[derive(Debug)]
pub struct Window;

impl Window {
    /// Opens the window on a run at its current tick, and blocks until it is closed. Returns the run that is open
    /// then: a person can open scene files in it as in the program's window.
    ///
    /// ```no_run
    /// use regatta::prelude::*;
    ///
    /// let scene = Scene::built_in("spring").expect("a built-in scene");
    /// Window::run(Session::racing(scene.into()))?;
    /// # Ok::<(), regatta::window::WindowError>(())
    /// ```
    ///
    /// # Errors
    /// Same as for [`run`].
    pub fn run(session: Session) -> Result<Closed, WindowError> {
        let read = |path: &Path| {
            let name = path.display().to_string();
            let bytes = regular_file::read(path, MAX_FILE_BYTES)
                .map_err(|why| vec![format!("error: cannot read {name}: {why}").into()])?;
            let scene = Scene::from_bytes(&name, &bytes).map_err(Vec::from)?;
            Ok((scene, String::from_utf8_lossy(&bytes).into_owned()))
        };
        let files =
            SceneFiles { read: Arc::new(read), opened: None, methods: Vec::new(), keep: None };
        run(Studio::of_session(session), WindowSettings::default(), files)
    }
}
