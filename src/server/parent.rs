//! Watches the process that started us: when it has died without closing our input, the server is
//! no longer needed.

use std::time::Duration;

const INTERVAL: Duration = Duration::from_secs(2);

/// Calls `gone` once the process `pid` has died. Does nothing where that cannot be observed.
pub(super) fn watch(pid: u32, gone: impl FnOnce() + Send + 'static) {
    let watching = std::thread::Builder::new()
        .name("wedm-parent".into())
        .spawn(move || {
            while is_alive(pid) {
                std::thread::sleep(INTERVAL);
            }
            gone();
        });
    if let Err(error) = watching {
        tracing::warn!("the client's process cannot be watched: {error}");
    }
}

/// False only when there is surely no such process: one that we may not signal is alive.
#[cfg(unix)]
fn is_alive(pid: u32) -> bool {
    let Ok(pid) = i32::try_from(pid) else {
        return true;
    };
    // 0 and 1 stand for "our own group" and for the first process, which outlives us.
    if pid <= 1 {
        return true;
    }
    // SAFETY: signal 0 only asks whether the process exists.
    let asked = unsafe { libc::kill(pid, 0) };
    let missing = asked != 0 && std::io::Error::last_os_error().raw_os_error() == Some(libc::ESRCH);
    !missing && !is_zombie(pid)
}

/// A process that has died stays a zombie until its parent asks for its exit code.
#[cfg(target_os = "linux")]
fn is_zombie(pid: i32) -> bool {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    // The name before it is in parentheses and may hold anything.
    stat.rsplit_once(')')
        .is_some_and(|(_, rest)| matches!(rest.trim_start().chars().next(), Some('Z' | 'X')))
}

#[cfg(all(unix, not(target_os = "linux")))]
fn is_zombie(_pid: i32) -> bool {
    false
}

/// Where processes cannot be asked without a library, the end of standard input has to do.
#[cfg(not(unix))]
fn is_alive(_pid: u32) -> bool {
    true
}

#[cfg(all(test, unix))]
mod tests {
    use super::is_alive;

    #[test]
    fn a_dead_process_is_told_from_a_living_one() {
        assert!(is_alive(std::process::id()));
        assert!(is_alive(1));
        assert!(is_alive(u32::MAX));
        let mut child = std::process::Command::new("true").spawn().unwrap();
        let pid = child.id();
        child.wait().unwrap();
        assert!(!is_alive(pid));
    }
}
