//! Ctrl-C: the first one asks for an end, the second one is an end.

use crate::failure::{Failure, INTERRUPTED};
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Turns the next Ctrl-C into a flag, and the one after into an immediate exit. Call it once.
///
/// # Errors
/// When the system refuses.
pub(crate) fn on_interrupt() -> Result<Arc<AtomicBool>, Failure> {
    let flag = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&flag);
    ctrlc::set_handler(move || {
        if seen.swap(true, Ordering::Relaxed) {
            process::exit(i32::from(INTERRUPTED));
        }
    })
    .map_err(|e| Failure::new(format!("cannot listen for Ctrl-C: {e}")))?;
    Ok(flag)
}
