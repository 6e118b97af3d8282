//! The process's own pipes, without the line buffering of the standard library.

use std::fs::File;
use std::io;

/// Standard input and output as plain files.
pub(crate) fn pipes() -> io::Result<(File, File)> {
    #[cfg(unix)]
    {
        use std::os::fd::AsFd;
        Ok((
            io::stdin().as_fd().try_clone_to_owned()?.into(),
            io::stdout().as_fd().try_clone_to_owned()?.into(),
        ))
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

/// Only the stream's own end tells here.
#[cfg(not(unix))]
pub(super) fn is_hung_up() -> bool {
    false
}
