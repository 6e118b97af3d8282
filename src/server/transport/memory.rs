//! Returns memory to the system.
//!
//! A message of many megabytes becomes millions of small pieces; some allocators keep them after they are freed. The
//! same holds for thousands of small documents opened and closed again. The memory of a large message, or of as much in
//! small ones, is returned a moment later.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// Messages of less than this together leave little behind.
const LARGE: usize = 1024 * 1024;
/// Long enough for most work that the message set off; what reads a whole document gives memory back at its end, too.
const DELAY: Duration = Duration::from_millis(400);

#[derive(Clone, Default)]
pub(super) struct Memory {
    is_due: Arc<AtomicBool>,
    /// Bytes of the messages since memory was last returned.
    length: Arc<AtomicUsize>,
}

impl Memory {
    /// Returns the memory that a message of `length` bytes leaves behind.
    pub(crate) fn after_message(&self, length: usize, runtime: &tokio::runtime::Runtime) {
        if self
            .length
            .fetch_add(length, Ordering::AcqRel)
            .saturating_add(length)
            < LARGE
            || self.is_due.swap(true, Ordering::AcqRel)
        {
            return;
        }
        self.length.store(0, Ordering::Release);
        let is_due = self.is_due.clone();
        runtime.spawn(async move {
            tokio::time::sleep(DELAY).await;
            is_due.store(false, Ordering::Release);
            give_back();
        });
    }
}

#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub(crate) fn give_back() {
    // SAFETY: the allocator locks what it trims; memory in use is not touched.
    unsafe { libc::malloc_trim(0) };
}

/// Other allocators return memory by themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub(crate) fn give_back() {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_given_back_behind_large_messages_and_behind_many_small_ones() {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_time()
            .build()
            .unwrap();
        let memory = Memory::default();
        let is_due = |memory: &Memory| memory.is_due.load(Ordering::Acquire);
        memory.after_message(LARGE / 2, &runtime);
        assert!(!is_due(&memory));
        memory.after_message(LARGE / 2, &runtime);
        assert!(is_due(&memory));
        let memory = Memory::default();
        memory.after_message(10 * LARGE, &runtime);
        assert!(is_due(&memory));
    }
}
