//! Temporary files, of which none is left behind: not by an error, nor by Ctrl-C or the end that the system asks for.

use std::fs::File;
use std::io;
use std::path::Path;
use tempfile::NamedTempFile;

/// A file that goes unless it is renamed.
pub(super) struct Temporary {
    file: NamedTempFile,
    #[cfg(unix)]
    _name: signals::Name,
}

impl Temporary {
    /// A file in this folder. One that is `private` is nobody else's to read; any other gets the usual permissions.
    pub(super) fn in_folder(folder: &Path, private: bool) -> io::Result<Temporary> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".wedm-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::OpenOptionsExt;
            let mode = if private { 0o600 } else { 0o666 };
            let mut name = None;
            let file = builder.make_in(folder, |path| {
                // Known before it is there: at no moment would a signal leave it.
                name = Some(signals::Name::of(path));
                let mut options = File::options();
                options.read(true).write(true).create_new(true).mode(mode);
                options.open(path)
            })?;
            let name = name.unwrap_or_default();
            Ok(Temporary { file, _name: name })
        }
        #[cfg(not(unix))]
        {
            let _ = private;
            let file = builder.tempfile_in(folder)?;
            Ok(Temporary { file })
        }
    }

    pub(super) fn file(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// Gives it its name, in place of a file that has it.
    pub(super) fn persist(self, path: &Path) -> io::Result<()> {
        self.file.persist(path)?;
        Ok(())
    }

    /// Gives it its name where no file has it.
    pub(super) fn persist_new(self, path: &Path) -> io::Result<()> {
        self.file.persist_noclobber(path)?;
        Ok(())
    }
}

/// What a signal removes before it ends the process.
#[cfg(unix)]
mod signals {
    use std::ffi::{CString, c_char, c_int};
    use std::os::unix::ffi::OsStrExt;
    use std::path::Path;
    use std::ptr::null_mut;
    use std::sync::Once;
    use std::sync::atomic::{AtomicPtr, Ordering};

    /// The names of the temporary files that there are. No command writes more at a time.
    static NAMES: [AtomicPtr<c_char>; 8] = [const { AtomicPtr::new(null_mut()) }; 8];

    /// The place of one name among them, while its file is there.
    #[derive(Default)]
    pub(super) struct Name(Option<&'static AtomicPtr<c_char>>);

    impl Name {
        pub(super) fn of(path: &Path) -> Name {
            static LISTENING: Once = Once::new();
            LISTENING.call_once(listen);
            let Ok(name) = CString::new(path.as_os_str().as_bytes()) else {
                return Name(None);
            };
            // Never freed: a signal may be reading it. That is some bytes for each file that is written.
            let name = name.into_raw();
            let is_taken = |place: &&AtomicPtr<c_char>| {
                let taken =
                    place.compare_exchange(null_mut(), name, Ordering::AcqRel, Ordering::Relaxed);
                taken.is_ok()
            };
            Name(NAMES.iter().find(is_taken))
        }
    }

    impl Drop for Name {
        fn drop(&mut self) {
            if let Some(place) = self.0 {
                place.store(null_mut(), Ordering::Release);
            }
        }
    }

    /// Listens to the signals that end the process, unless somebody wants them to be ignored (`nohup`).
    fn listen() {
        for signal in [libc::SIGINT, libc::SIGTERM, libc::SIGHUP] {
            let handler = remove as extern "C" fn(c_int) as libc::sighandler_t;
            // SAFETY: the handler calls only what POSIX allows in one.
            unsafe {
                if libc::signal(signal, handler) == libc::SIG_IGN {
                    libc::signal(signal, libc::SIG_IGN);
                }
            }
        }
    }

    /// Removes the files, and lets the signal do what it does by itself.
    extern "C" fn remove(signal: c_int) {
        for place in &NAMES {
            let name = place.load(Ordering::Acquire);
            if !name.is_null() {
                // SAFETY: a name is a C string that lives as long as the process.
                unsafe { libc::unlink(name) };
            }
        }
        // SAFETY: both are allowed in a handler; the signal is delivered when this returns.
        unsafe {
            libc::signal(signal, libc::SIG_DFL);
            libc::raise(signal);
        }
    }
}
