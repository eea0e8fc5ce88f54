//! Ctrl-C, or what a scheduler sends before it kills: the first one asks for an end, the second one is an
//! end.

use crate::failure::{Failure, INTERRUPTED};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

/// Turns the next Ctrl-C, SIGTERM or SIGHUP into a flag, and the one after into an immediate exit. Every call returns the same
/// flag.
///
/// # Errors
/// When the system refuses.
pub(crate) fn on_interrupt() -> Result<Arc<AtomicBool>, Failure> {
    static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    if let Some(flag) = FLAG.get() {
        return Ok(Arc::clone(flag));
    }
    let flag = Arc::clone(FLAG.get_or_init(Arc::default));
    let seen = Arc::clone(&flag);
    ctrlc::set_handler(move || {
        if seen.swap(true, Ordering::Relaxed) {
            process::exit(i32::from(INTERRUPTED));
        }
    })
    .map_err(|e| Failure::new(format!("cannot listen for Ctrl-C: {e}")))?;
    Ok(flag)
}
