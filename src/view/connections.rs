//! Takes connections, and has their requests answered.

use super::places::Place;
use super::{View, answers};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::oneshot;

/// For the head of a request, and between two requests.
const PATIENCE: Duration = Duration::from_secs(20);
/// The longest head of a request: a `file:` URI that is encoded twice takes a few kilobytes.
const LONGEST_HEAD: usize = 64 * 1024;

/// Takes connections for ever.
pub(super) async fn accept(listener: TcpListener, view: Arc<View>) {
    loop {
        match listener.accept().await {
            Ok((stream, _)) => {
                let (place, told) = view.connections.admit();
                tokio::spawn(serve(stream, view.clone(), place, told));
            }
            // No more files may be open: some are closed soon.
            Err(_) => tokio::time::sleep(Duration::from_millis(50)).await,
        }
    }
}

async fn serve(stream: TcpStream, view: Arc<View>, place: Place, told: oneshot::Receiver<()>) {
    // What a page is told is short, and not worth waiting for more.
    let _ = stream.set_nodelay(true);
    let place = Arc::new(place);
    let answer = service_fn(move |request| answers::answer(view.clone(), place.clone(), request));
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(PATIENCE)
        .max_buf_size(LONGEST_HEAD)
        .serve_connection(TokioIo::new(stream), answer)
        .with_upgrades();
    tokio::select! {
        _ = connection => {}
        Ok(()) = told => {}
    }
}
