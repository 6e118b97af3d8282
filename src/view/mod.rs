//! `wedm view`: a page in the browser beside any CAD program, served by this process to this computer alone.
//!
//! The page is one more client of the language server; beside that it lists files, is told when they change, and writes
//! them. Nothing is decided here that the server or the command line could decide: which files there are and how many
//! faults each has is asked of whoever opens the bench.
//!
//! - *Guard*: who may ask. *Places*: how many may. *Connections*, *Answers*, *Reply*: the requests, each with its answer.
//! - *Socket*: a session of the server for each page. *Files*: one file read or written, within the fence alone.
//! - *Shelf*: the files that are shown, with their counts. *Watch*: what tells the shelf and the pages of changes.

mod answers;
mod connections;
mod files;
mod guard;
mod places;
mod reply;
mod shelf;
mod socket;
mod watch;

pub(crate) use files::is_of_ours;
pub(crate) use shelf::{Counts, Root, Shown};

use crate::disk::Fence;
use guard::Guard;
use places::Connections;
use shelf::Shelf;
use std::io;
use std::net::Ipv4Addr;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::runtime::{Builder, Runtime};
use tokio::sync::{Semaphore, watch as counted};

/// How long the process stays without a page.
const LINGER: Duration = Duration::from_secs(60);
/// The same in milliseconds, for tests.
const LINGER_OF_TESTS: &str = "WEDM_VIEW_LINGER_MS";

/// The most sockets and streams of changes at a time.
const MOST_PAGES: usize = 32;

/// What is being read and written at a time, in mebibytes.
const ROOM: usize = 512;

/// What all requests share.
struct View {
    guard: Guard,
    connections: Arc<Connections>,
    fence: Fence,
    shelf: Arc<Shelf>,
    /// The number of sockets and streams of changes.
    pages: counted::Sender<usize>,
    room: Arc<Semaphore>,
    /// Held while a file is compared and written: of two that replace one revision, one is too late.
    writing: std::sync::Mutex<()>,
}

/// A socket or a stream of changes: while there is one, the process stays.
struct Page(counted::Sender<usize>);

impl Page {
    /// `None` where there are too many.
    fn open(pages: &counted::Sender<usize>) -> Option<Page> {
        let is_open = pages.send_if_modified(|count| {
            let has_room = *count < MOST_PAGES;
            *count += usize::from(has_room);
            has_room
        });
        is_open.then(|| Page(pages.clone()))
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        self.0.send_modify(|count| *count -= 1);
    }
}

/// A server that has its port.
pub(crate) struct Bench {
    runtime: Runtime,
    listener: TcpListener,
    view: Arc<View>,
}

impl Bench {
    /// Takes a port, or a free one for 0, on the loopback address alone, and begins to look at the files.
    ///
    /// # Errors
    /// The port is taken, or may not be had.
    pub(crate) fn open(port: u16, fence: Fence, shown: Shown) -> io::Result<Bench> {
        let runtime = Builder::new_multi_thread()
            .worker_threads(2)
            .thread_name("wedm-view")
            .enable_all()
            .build()?;
        let listener = runtime.block_on(TcpListener::bind((Ipv4Addr::LOCALHOST, port)))?;
        let guard = Guard::new(listener.local_addr()?.port())?;
        let view = View {
            guard,
            connections: Arc::default(),
            shelf: Arc::new(Shelf::new(shown, fence.clone())),
            fence,
            pages: counted::Sender::new(0),
            room: Arc::new(Semaphore::new(ROOM)),
            writing: std::sync::Mutex::default(),
        };
        let (counting, watching) = (view.shelf.clone(), view.shelf.clone());
        let thread = |name: &str| std::thread::Builder::new().name(name.into());
        thread("wedm-count").spawn(move || counting.count())?;
        thread("wedm-watch").spawn(move || watch::watch(&watching))?;
        Ok(Bench {
            runtime,
            listener,
            view: Arc::new(view),
        })
    }

    /// The address that lets a browser in.
    pub(crate) fn address(&self) -> String {
        self.view.guard.address()
    }

    /// Serves until the last page has been closed for a minute. Before the first one comes it waits as long as that takes.
    pub(crate) fn serve(self) {
        let linger = std::env::var(LINGER_OF_TESTS).ok();
        let linger = linger.and_then(|linger| linger.parse().ok());
        let linger = linger.map_or(LINGER, Duration::from_millis);
        let pages = self.view.pages.subscribe();
        self.runtime.block_on(async {
            tokio::select! {
                () = connections::accept(self.listener, self.view) => {}
                () = until_all_have_gone(pages, linger) => {}
            }
        });
        // A file that is being written is still written.
        self.runtime.shutdown_timeout(Duration::from_secs(5));
    }
}

async fn until_all_have_gone(mut pages: counted::Receiver<usize>, linger: Duration) {
    loop {
        let _ = pages.wait_for(|count| *count > 0).await;
        let _ = pages.wait_for(|count| *count == 0).await;
        let another = pages.wait_for(|count| *count > 0);
        if tokio::time::timeout(linger, another).await.is_err() {
            return;
        }
    }
}
