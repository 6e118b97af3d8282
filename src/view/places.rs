//! The connections that are open, and who gives way where there are too many.
//!
//! A *stranger* is a connection on which no request has had the cookie yet: any program on this computer can open one, and
//! any page of the browser. So many of them, or such as say nothing, push each other out, and never a page of ours.

use rustc_hash::FxHashSet;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::oneshot;

/// Browsers open six at a time.
const MOST_STRANGERS: usize = 32;
/// Pages have two or three each while nothing is loaded.
const MOST_KNOWN: usize = 128;

#[derive(Default)]
pub(super) struct Connections {
    open: Mutex<Open>,
}

#[derive(Default)]
struct Open {
    next: u64,
    /// The oldest first, each with what tells it to go.
    strangers: VecDeque<(u64, oneshot::Sender<()>)>,
    known: FxHashSet<u64>,
}

/// The place of one connection among them.
pub(super) struct Place {
    number: u64,
    connections: Arc<Connections>,
}

impl Connections {
    fn lock(&self) -> MutexGuard<'_, Open> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A place for a stranger, and what tells it to go.
    pub(super) fn admit(self: &Arc<Self>) -> (Place, oneshot::Receiver<()>) {
        let mut open = self.lock();
        open.next += 1;
        if open.strangers.len() >= MOST_STRANGERS
            && let Some((_, oldest)) = open.strangers.pop_front()
        {
            let _ = oldest.send(());
        }
        let (go, told) = oneshot::channel();
        let number = open.next;
        open.strangers.push_back((number, go));
        let connections = self.clone();
        (
            Place {
                number,
                connections,
            },
            told,
        )
    }
}

impl Place {
    /// It is one of ours from now on; false where there are too many of them.
    pub(super) fn is_known(&self) -> bool {
        let mut open = self.connections.lock();
        let is_known = open.known.contains(&self.number);
        if !is_known && open.known.len() < MOST_KNOWN {
            open.strangers.retain(|(number, _)| *number != self.number);
            return open.known.insert(self.number);
        }
        is_known
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let mut open = self.connections.lock();
        open.known.remove(&self.number);
        open.strangers.retain(|(number, _)| *number != self.number);
    }
}
