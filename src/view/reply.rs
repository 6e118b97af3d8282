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

pub(super) fn json_of(value: &impl Serialize) -> Result<Answer, Refused> {
    let json = serde_json::to_vec(value)
        .map_err(|error| Refused::new(StatusCode::INTERNAL_SERVER_ERROR, error))?;
    Ok(with(StatusCode::OK, "application/json", json.into()))
}

/// Why a request is not answered otherwise: the status, and a plain sentence.
#[derive(Debug)]
pub(super) struct Refused(pub(super) StatusCode, pub(super) String);

impl Refused {
    pub(super) fn new(status: StatusCode, sentence: impl ToString) -> Refused {
        Refused(status, sentence.to_string())
    }

    pub(super) fn too_much() -> Refused {
        Refused::new(StatusCode::SERVICE_UNAVAILABLE, say!(too_much_at_a_time))
    }
}

impl From<Refused> for Answer {
    fn from(Refused(status, sentence): Refused) -> Answer {
        with(
            status,
            "text/plain; charset=utf-8",
            (sentence + "\n").into(),
        )
    }
}
