//! Messages that come and go whole, as over a WebSocket: each is a message of a queue, and none is broken by another.

use super::writer::Output;
use super::{Frame, LostChange, Messages};
use std::io;
use tokio::sync::mpsc::{Receiver, Sender};

/// What a client sends. The queue's bound is all that waits here.
pub(crate) struct FromClient {
    queue: Receiver<Vec<u8>>,
    position: i64,
}

impl FromClient {
    pub(crate) fn new(queue: Receiver<Vec<u8>>) -> FromClient {
        FromClient { queue, position: 0 }
    }
}

impl Messages for FromClient {
    fn step(&mut self) -> Frame {
        let Some(body) = self.queue.blocking_recv() else {
            return Frame::End;
        };
        self.position += body.len() as i64;
        Frame::Body(body)
    }

    fn take_lost(&mut self) -> Option<LostChange> {
        None
    }

    fn was_broken(&mut self, _: &[u8]) {}

    fn position(&self) -> i64 {
        self.position
    }

    fn is_hung_up(&self) -> bool {
        self.queue.sender_strong_count() == 0
    }
}

/// What a client is sent.
pub(crate) struct ToClient(pub(crate) Sender<Vec<u8>>);

impl Output for ToClient {
    fn message(&mut self, body: Vec<u8>) -> io::Result<()> {
        self.0
            .blocking_send(body)
            .map_err(|_| io::ErrorKind::BrokenPipe.into())
    }
}
