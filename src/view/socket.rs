//! `/lsp`: the server of `wedm serve` behind a WebSocket, one message a text frame. Each socket is a client of its own.

use super::{Page, View};
use crate::server;
use futures_util::{SinkExt, StreamExt};
use hyper::body::Bytes;
use hyper::upgrade::OnUpgrade;
use hyper_util::rt::TokioIo;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::mpsc;
use tokio::time::timeout;
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::protocol::frame::coding::CloseCode;
use tokio_tungstenite::tungstenite::protocol::{CloseFrame, Message, Role, WebSocketConfig};
use tokio_tungstenite::tungstenite::{Error, Utf8Bytes};

/// The longest message of a page, bytes.
const LONGEST: usize = 128 * 1024 * 1024;

/// How long the last messages of one side are waited for when the other has ended.
const LAST_WORDS: Duration = Duration::from_secs(3);

/// Serves one page until it or its session ends.
pub(super) async fn converse(view: Arc<View>, page: Page, upgrade: OnUpgrade) {
    let Ok(stream) = upgrade.await else { return };
    let config = WebSocketConfig::default()
        .max_message_size(Some(LONGEST))
        .max_frame_size(Some(LONGEST));
    let stream = TokioIo::new(stream);
    let socket = WebSocketStream::from_raw_socket(stream, Role::Server, Some(config)).await;
    let (mut to_page, mut from_page) = socket.split();
    // One message each way: whatever else waits does so in the server, which counts it, or in the page.
    let (to_server, from_client) = mpsc::channel(1);
    let (to_client, mut from_server) = mpsc::channel::<Vec<u8>>(1);
    let fence = view.fence.clone();
    let session = std::thread::Builder::new()
        .name("wedm-page".into())
        .spawn(move || server::serve_messages(from_client, to_client, fence));
    if let Err(error) = session {
        tracing::error!("a session cannot be started: {error}");
        return;
    }
    // The two directions do not wait for each other: the server takes no more while the page does not read.
    let code = {
        let reading = async {
            let to_server = to_server;
            loop {
                match from_page.next().await {
                    Some(Ok(Message::Text(text))) => {
                        if to_server.send(Bytes::from(text).into()).await.is_err() {
                            return CloseCode::Normal;
                        }
                    }
                    Some(Ok(Message::Binary(_))) => return CloseCode::Unsupported,
                    Some(Ok(_)) => {}
                    Some(Err(Error::Capacity(_))) => return CloseCode::Size,
                    Some(Err(Error::Utf8(_))) => return CloseCode::Invalid,
                    Some(Err(_)) | None => return CloseCode::Normal,
                }
            }
        };
        let writing = async {
            while let Some(body) = from_server.recv().await
                && let Ok(text) = Bytes::from(body).try_into()
                && to_page.send(Message::Text(text)).await.is_ok()
            {}
        };
        tokio::pin!(writing);
        tokio::select! {
            code = reading => {
                let _ = timeout(LAST_WORDS, writing).await;
                code
            }
            () = &mut writing => CloseCode::Normal,
        }
    };
    drop(from_server);
    let close = Message::Close(Some(CloseFrame {
        code,
        reason: Utf8Bytes::default(),
    }));
    let farewell = async {
        let _ = to_page.send(close).await;
        while let Some(Ok(_)) = from_page.next().await {}
    };
    let _ = timeout(LAST_WORDS, farewell).await;
    drop(page);
}
