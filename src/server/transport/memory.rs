//! Returns memory to the system.
//!
//! A message of many megabytes becomes millions of small pieces; some allocators keep them after they are freed. The
//! same holds for thousands of small documents opened and closed again. The memory of a large message, or of as much in
//! small ones, is returned a moment later; so are the pages of the program's own file.

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
    // A debugger's breakpoints would go with the pages.
    if cfg!(not(debug_assertions)) {
        leave_program();
    }
}

/// Lets go of the pages of the program's own file: reading has walked through most of it, a server at rest needs a
/// quarter of that. Each comes back from the file, which the system keeps, when it is used again.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn leave_program() {
    // SAFETY: `leave_object` takes no data and touches nothing of ours.
    unsafe { libc::dl_iterate_phdr(Some(leave_object), std::ptr::null_mut()) };
}

/// Lets go of those parts of a loaded object that nobody can write to. The first object is the program: the search for
/// others ends with it.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
unsafe extern "C" fn leave_object(
    object: *mut libc::dl_phdr_info,
    _: usize,
    _: *mut libc::c_void,
) -> libc::c_int {
    // SAFETY: the loader hands out a description that is whole while this runs, with the number of its headers.
    let (base, headers) = unsafe {
        let object = &*object;
        let count = usize::from(object.dlpi_phnum);
        let headers = std::slice::from_raw_parts(object.dlpi_phdr, count);
        (object.dlpi_addr as usize, headers)
    };
    // SAFETY: asks for a number.
    let page = usize::try_from(unsafe { libc::sysconf(libc::_SC_PAGESIZE) }).unwrap_or(4096);
    for header in headers {
        if header.p_type != libc::PT_LOAD || header.p_flags & libc::PF_W != 0 {
            continue;
        }
        let begin = base + header.p_vaddr as usize;
        let from = begin.next_multiple_of(page);
        let to = (begin + header.p_memsz as usize) / page * page;
        if from < to {
            // SAFETY: whole pages that hold what the file holds, since nothing may be written there.
            unsafe { libc::madvise(from as *mut libc::c_void, to - from, libc::MADV_DONTNEED) };
        }
    }
    1
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

    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[test]
    fn pages_of_the_program_come_back_as_they_were() {
        // Not every kernel says it.
        let of_file = || -> Option<usize> {
            let status = std::fs::read_to_string("/proc/self/status").ok()?;
            let line = status.lines().find(|line| line.starts_with("RssFile"))?;
            line.split_whitespace().nth(1)?.parse().ok()
        };
        let before = of_file();
        leave_program();
        let after = of_file();
        assert!(before.is_none() || after < before, "{before:?} {after:?}");
    }
}
