//! The process's own pipes, without the line buffering of the standard library.

use std::fs::File;
use std::io;

/// Standard input and output as plain files, with as much room between us and the client as the system gives.
pub(crate) fn pipes() -> io::Result<(File, File)> {
    #[cfg(unix)]
    {
        use std::os::fd::AsFd;
        let (input, output) = (
            io::stdin().as_fd().try_clone_to_owned()?,
            io::stdout().as_fd().try_clone_to_owned()?,
        );
        widen(&input);
        widen(&output);
        Ok((input.into(), output.into()))
    }
    #[cfg(windows)]
    {
        use std::os::windows::io::AsHandle;
        Ok((
            io::stdin().as_handle().try_clone_to_owned()?.into(),
            io::stdout().as_handle().try_clone_to_owned()?.into(),
        ))
    }
}

/// A pipe of this many bytes holds all diagnostics of a document, so that the two ends need not
/// take turns. Any process may ask for this size.
#[cfg(target_os = "linux")]
const ROOM: libc::c_int = 1024 * 1024;

#[cfg(target_os = "linux")]
fn widen(pipe: &std::os::fd::OwnedFd) {
    use std::os::fd::AsRawFd;
    // SAFETY: the descriptor is open. Anything that is not a pipe, or may not grow, stays as it is.
    unsafe { libc::fcntl(pipe.as_raw_fd(), libc::F_SETPIPE_SZ, ROOM) };
}

#[cfg(all(unix, not(target_os = "linux")))]
fn widen(_: &std::os::fd::OwnedFd) {}

/// True when the client has closed our standard input, although unread bytes may still lie in it.
#[cfg(unix)]
pub(super) fn is_hung_up() -> bool {
    let mut poll = libc::pollfd {
        fd: libc::STDIN_FILENO,
        events: 0,
        revents: 0,
    };
    // SAFETY: `poll` is one valid entry, and a time-out of 0 returns at once.
    let ready = unsafe { libc::poll(&mut poll, 1, 0) };
    ready > 0 && poll.revents & (libc::POLLHUP | libc::POLLERR | libc::POLLNVAL) != 0
}

/// On this system only the end of the stream shows it.
#[cfg(not(unix))]
pub(super) fn is_hung_up() -> bool {
    false
}
