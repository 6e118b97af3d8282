//! What an answer is made of.

use http_body_util::combinators::UnsyncBoxBody;
use http_body_util::{BodyExt, Full};
use hyper::body::Bytes;
use hyper::header::{self, HeaderValue};
use hyper::{Response, StatusCode};
use serde::Serialize;
use std::convert::Infallible;

pub(super) type Body = UnsyncBoxBody<Bytes, Infallible>;
pub(super) type Answer = Response<Body>;

pub(super) fn with(status: StatusCode, kind: &'static str, bytes: Bytes) -> Answer {
    let mut answer = Response::new(Full::new(bytes).boxed_unsync());
    *answer.status_mut() = status;
    let kind = HeaderValue::from_static(kind);
    answer.headers_mut().insert(header::CONTENT_TYPE, kind);
    answer
}

pub(super) fn json_of(value: &impl Serialize) -> Answer {
    match serde_json::to_vec(value) {
        Ok(json) => with(StatusCode::OK, "application/json", json.into()),
        Err(error) => refusal(StatusCode::INTERNAL_SERVER_ERROR, error),
    }
}

/// A plain sentence.
pub(super) fn refusal(status: StatusCode, sentence: impl ToString) -> Answer {
    let text = sentence.to_string() + "\n";
    with(status, "text/plain; charset=utf-8", text.into())
}

pub(super) fn too_much() -> Answer {
    refusal(StatusCode::SERVICE_UNAVAILABLE, say!(too_much_at_a_time))
}
