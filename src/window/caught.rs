//! A bug in work on the side becomes a sentence, and the window goes on.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `work`. If it panics, returns a sentence for the person in front of the window.
pub(super) fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason");
        format!("this met a bug of regatta, please report it: {text}")
    })
}

#[cfg(test)]
mod tests {
    use super::caught;

    #[test]
    fn a_panic_of_work_becomes_a_sentence() {
        assert_eq!(caught(|| 7), Ok(7));
        for fail in [|| panic!("index {}", 9), || panic!("index 9")] {
            let sentence = caught::<()>(fail).unwrap_err();
            assert_eq!(sentence, "this met a bug of regatta, please report it: index 9");
        }
    }
}
