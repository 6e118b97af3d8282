//! The requests of the page, and what each is answered.

use super::guard::Pass;
use super::places::Place;
use super::reply::{Answer, Body, Refused, json_of, with};
use super::shelf::Change;
use super::{Page, View, files, socket};
use crate::message::{Asker, Language, speak, spoken};
use futures_util::stream;
use http_body_util::{BodyExt, StreamBody};
use hyper::body::{Bytes, Frame, Incoming};
use hyper::header::{self, HeaderValue};
use hyper::{Method, Request, Response, StatusCode};
use serde_json::json;
use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::broadcast::error::RecvError;
use tokio_tungstenite::tungstenite::handshake::server::create_response_with_body;

/// The page, as the repository holds it.
const PAGE: [(&str, &str, &[u8]); 4] = [
    (
        "/",
        "text/html; charset=utf-8",
        include_bytes!("page/index.html"),
    ),
    (
        "/page.js",
        "text/javascript; charset=utf-8",
        include_bytes!("page/page.js"),
    ),
    (
        "/page.css",
        "text/css; charset=utf-8",
        include_bytes!("page/page.css"),
    ),
    (
        "/icon.svg",
        "image/svg+xml",
        include_bytes!("page/icon.svg"),
    ),
];

/// A stream of changes says at least this often that it is still there.
const PULSE: Duration = Duration::from_secs(15);

pub(super) async fn answer(
    view: Arc<View>,
    place: Arc<Place>,
    request: Request<Incoming>,
) -> Result<Answer, Infallible> {
    let answered = match view.guard.check(&request) {
        Err(refused) => Err(refused),
        Ok(_) if !place.is_known() => Err(Refused::too_much()),
        Ok(Pass::New) => Ok(view.guard.welcome()),
        Ok(Pass::Known) => answer_known(&view, request).await,
    };
    let mut answer = answered.unwrap_or_else(Answer::from);
    // What was sent with a request that was not taken is not read, and no stranger keeps a connection.
    if matches!(
        answer.status(),
        StatusCode::FORBIDDEN | StatusCode::PAYLOAD_TOO_LARGE | StatusCode::SERVICE_UNAVAILABLE
    ) {
        let close = HeaderValue::from_static("close");
        answer.headers_mut().insert(header::CONNECTION, close);
    }
    view.guard.seal(&mut answer);
    Ok(answer)
}

async fn answer_known(view: &Arc<View>, request: Request<Incoming>) -> Result<Answer, Refused> {
    let path = request.uri().path();
    let of_page = PAGE.iter().find(|(name, ..)| *name == path);
    match (request.method(), path) {
        (&Method::GET, "/api/start") => start(view, &request).await,
        (&Method::GET, "/api/files") => json_of(&view.shelf.listed()),
        (&Method::GET, "/api/changes") => changes(view),
        (&Method::GET, "/api/file") => files::read(view, &request).await,
        (&Method::GET, "/api/report") => files::report(view, &request).await,
        (&Method::PUT, "/api/file") => files::write(view, request).await,
        (&Method::GET, "/lsp") => lsp(view, request),
        (&Method::GET, _) if let Some((_, kind, bytes)) = of_page => {
            Ok(with(StatusCode::OK, kind, Bytes::from_static(bytes)))
        }
        (
            _,
            "/api/start" | "/api/files" | "/api/changes" | "/api/file" | "/api/report" | "/lsp",
        ) => Err(Refused::new(
            StatusCode::METHOD_NOT_ALLOWED,
            say!(another_method),
        )),
        _ => Err(Refused::new(StatusCode::NOT_FOUND, say!(nothing_is_there))),
    }
}

async fn start(view: &Arc<View>, request: &Request<Incoming>) -> Result<Answer, Refused> {
    // On Windows no environment says a language; the browser does.
    let accepted = request.headers().get(header::ACCEPT_LANGUAGE);
    let first = accepted.and_then(|accepted| accepted.to_str().ok()?.split([',', ';']).next());
    if let Some(language) = first.and_then(Language::of) {
        speak(language, Asker::Client);
    }
    let shared = view.clone();
    let has_settings = tokio::task::spawn_blocking(move || shared.shelf.has_settings());
    json_of(&json!({
        "version": env!("CARGO_PKG_VERSION"),
        "language": spoken().tag(),
        "roots": view.shelf.roots(),
        "opened": view.shelf.opened(),
        "hasSettings": has_settings.await.unwrap_or_default(),
    }))
}

/// Server-sent events. A page that does not read them in time is told to ask for all files again.
fn changes(view: &View) -> Result<Answer, Refused> {
    let page = Page::open(&view.pages).ok_or_else(Refused::too_much)?;
    let events = stream::unfold(
        (view.shelf.subscribe(), page, true),
        |(mut changes, page, is_first)| async move {
            let text = if is_first {
                ": wedm\n\n".to_owned()
            } else {
                match tokio::time::timeout(PULSE, changes.recv()).await {
                    Ok(Ok(change)) => change.as_event(),
                    Ok(Err(RecvError::Lagged(_))) => Change::Files.as_event(),
                    Ok(Err(RecvError::Closed)) => return None,
                    Err(_) => ": wedm\n\n".to_owned(),
                }
            };
            let frame = Ok::<_, Infallible>(Frame::data(Bytes::from(text)));
            Some((frame, (changes, page, false)))
        },
    );
    let mut answer = Response::new(StreamBody::new(events).boxed_unsync());
    let kind = HeaderValue::from_static("text/event-stream");
    answer.headers_mut().insert(header::CONTENT_TYPE, kind);
    Ok(answer)
}

fn lsp(view: &Arc<View>, mut request: Request<Incoming>) -> Result<Answer, Refused> {
    let answer = create_response_with_body(&request, Body::default)
        .map_err(|_| Refused::new(StatusCode::BAD_REQUEST, say!(a_websocket_is_expected)))?;
    let page = Page::open(&view.pages).ok_or_else(Refused::too_much)?;
    let upgrade = hyper::upgrade::on(&mut request);
    tokio::spawn(socket::converse(view.clone(), page, upgrade));
    Ok(answer)
}
