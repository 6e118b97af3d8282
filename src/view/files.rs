//! One file, read or written: within the fence, and of a kind that wedm makes or reads.

use super::View;
use super::reply::{Answer, refusal, too_much, with};
use crate::disk::{self, Barred, Seen, ending_of};
use crate::document::FileKind;
use crate::server::path_of;
use crate::settings;
use http_body_util::{BodyExt, LengthLimitError, Limited};
use hyper::body::{Body as _, Bytes, Incoming};
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::{Request, StatusCode};
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, PoisonError};
use std::time::Duration;
use tokio::sync::OwnedSemaphorePermit;

/// The largest file, bytes.
pub(super) const LARGEST: u64 = 128 * 1024 * 1024;

/// A file is sent within this time, or not at all.
const PATIENCE: Duration = Duration::from_secs(60);

const MEBIBYTE: u64 = 1024 * 1024;

/// What the page writes beside drawings and programs.
const WRITTEN: [&str; 7] = ["svg", "png", "pdf", "html", "csv", "json", "txt"];

/// True for the path of a file that wedm reads or writes, behind the folder that is shown: nothing hidden, and only what its
/// name says to be ours.
pub(crate) fn is_of_ours(rest: &Path) -> bool {
    let is_plain = |part: Component| match part {
        Component::Normal(name) => {
            let name = name.to_string_lossy();
            // On Windows a colon names a stream of another file.
            !name.starts_with('.') && !(cfg!(windows) && name.contains(':'))
        }
        _ => false,
    };
    let ending = ending_of(rest);
    let is_named = rest.file_name() == Some(settings::FILE_NAME.as_ref())
        || FileKind::of_ending(&ending).is_some()
        || WRITTEN.contains(&&*ending);
    is_named && rest.components().all(is_plain)
}

/// Bytes that count as long as they are held.
struct Held {
    bytes: Vec<u8>,
    _room: OwnedSemaphorePermit,
}

impl AsRef<[u8]> for Held {
    fn as_ref(&self) -> &[u8] {
        &self.bytes
    }
}

/// Why nothing was read or written.
struct Refused(StatusCode, String);

impl From<Barred> for Refused {
    fn from(barred: Barred) -> Refused {
        let status = match barred {
            Barred::Missing => StatusCode::NOT_FOUND,
            Barred::Outside | Barred::Faulty(_) => StatusCode::FORBIDDEN,
        };
        Refused(status, barred.to_string())
    }
}

/// The file that `?uri=` names.
fn named<T>(request: &Request<T>) -> Option<PathBuf> {
    let query = request.uri().query()?;
    let mut pairs = form_urlencoded::parse(query.as_bytes());
    let (_, uri) = pairs.find(|(key, _)| key == "uri")?;
    path_of(&uri).filter(|path| !path.to_string_lossy().contains('\0'))
}

/// Does work with files, which may wait for a disk.
async fn beside<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Refused> + Send + 'static,
) -> Result<T, Answer> {
    let done = tokio::task::spawn_blocking(work).await;
    let done = done.unwrap_or_else(|error| {
        Err(Refused(
            StatusCode::INTERNAL_SERVER_ERROR,
            error.to_string(),
        ))
    });
    done.map_err(|Refused(status, sentence)| refusal(status, sentence))
}

fn room(view: &View, bytes: u64) -> Option<OwnedSemaphorePermit> {
    let mebibytes = u32::try_from(bytes / MEBIBYTE + 1).ok()?;
    view.room.clone().try_acquire_many_owned(mebibytes).ok()
}

fn tagged(mut answer: Answer, revision: &str) -> Answer {
    let tag = HeaderValue::try_from(format!("\"{revision}\"")).ok();
    answer
        .headers_mut()
        .extend(tag.map(|tag| (header::ETAG, tag)));
    answer
}

pub(super) async fn read<T>(view: &Arc<View>, request: &Request<T>) -> Answer {
    let Some(path) = named(request) else {
        return refusal(StatusCode::BAD_REQUEST, say!(a_file_uri_is_expected));
    };
    let shared = view.clone();
    let opened = beside(move || {
        shared.fence.place(&path, is_of_ours)?;
        let file = shared.fence.open(&path)?;
        let length = file.metadata().map_err(Barred::from)?.len();
        Ok((file, length))
    });
    let (file, length) = match opened.await {
        Ok(opened) => opened,
        Err(refused) => return refused,
    };
    if length > LARGEST {
        let sentence = say!(it_has_too_many_bytes, length, LARGEST);
        return refusal(StatusCode::PAYLOAD_TOO_LARGE, sentence);
    }
    let Some(room) = room(view, length) else {
        return too_much();
    };
    let read = beside(move || {
        let bytes = disk::read_at_most(&file, LARGEST)
            .map_err(|reason| Refused(StatusCode::FORBIDDEN, reason))?;
        let revision = disk::revision(&bytes);
        Ok((Held { bytes, _room: room }, revision))
    });
    match read.await {
        Ok((held, revision)) => {
            let bytes = Bytes::from_owner(held);
            let answer = with(StatusCode::OK, "application/octet-stream", bytes);
            tagged(answer, &revision)
        }
        Err(refused) => refused,
    }
}

/// What a file must be for another to take its place.
enum Condition {
    Missing,
    Revision(String),
}

/// The condition that a request states.
fn condition<T>(request: &Request<T>) -> Result<Condition, Refused> {
    let value = |name: HeaderName| {
        let value = request.headers().get(name)?.to_str().ok()?;
        Some(value.trim())
    };
    let refused = |status| Err(Refused(status, say!(a_condition_is_expected).into()));
    match (value(header::IF_MATCH), value(header::IF_NONE_MATCH)) {
        (None, Some("*")) => Ok(Condition::Missing),
        (Some(tag), None) => {
            let revision = tag.strip_prefix('"').and_then(|tag| tag.strip_suffix('"'));
            match revision {
                Some(revision) => Ok(Condition::Revision(revision.to_owned())),
                None => refused(StatusCode::BAD_REQUEST),
            }
        }
        (None, None) => refused(StatusCode::PRECONDITION_REQUIRED),
        _ => refused(StatusCode::BAD_REQUEST),
    }
}

pub(super) async fn write(view: &Arc<View>, request: Request<Incoming>) -> Answer {
    let Some(path) = named(&request) else {
        return refusal(StatusCode::BAD_REQUEST, say!(a_file_uri_is_expected));
    };
    let condition = match condition(&request) {
        Ok(condition) => condition,
        Err(Refused(status, sentence)) => return refusal(status, sentence),
    };
    let too_large = || {
        let sentence = say!(it_holds_too_many_bytes, LARGEST);
        refusal(StatusCode::PAYLOAD_TOO_LARGE, sentence)
    };
    let stated = request.body().size_hint().upper();
    if stated.is_some_and(|length| length > LARGEST) {
        return too_large();
    }
    // Before anything of it is read.
    let (shared, target) = (view.clone(), path.clone());
    let place = beside(move || Ok(shared.fence.place(&target, is_of_ours)?));
    if let Err(refused) = place.await {
        return refused;
    }
    let Some(room) = room(view, stated.unwrap_or(LARGEST)) else {
        return too_much();
    };
    let limit = usize::try_from(LARGEST).unwrap_or(usize::MAX);
    let body = Limited::new(request.into_body(), limit).collect();
    let bytes = match tokio::time::timeout(PATIENCE, body).await {
        Ok(Ok(body)) => body.to_bytes(),
        Ok(Err(error)) if error.is::<LengthLimitError>() => return too_large(),
        Ok(Err(error)) => return refusal(StatusCode::BAD_REQUEST, error),
        Err(_) => return refusal(StatusCode::REQUEST_TIMEOUT, say!(it_took_too_long)),
    };
    let shared = view.clone();
    let written = beside(move || {
        let _one = shared
            .writing
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let written = put(&shared, &path, &condition, &bytes);
        drop(room);
        written.map(|()| disk::revision(&bytes))
    });
    match written.await {
        Ok(revision) => {
            let answer = with(StatusCode::OK, "text/plain; charset=utf-8", Bytes::new());
            tagged(answer, &revision)
        }
        Err(refused) => refused,
    }
}

/// Writes beside and renames, as `wedm fix` does.
fn put(view: &View, path: &Path, condition: &Condition, bytes: &[u8]) -> Result<(), Refused> {
    let place = view.fence.place(path, is_of_ours)?;
    let failed = |reason: String| Refused(StatusCode::INTERNAL_SERVER_ERROR, reason);
    let changed = || Refused(StatusCode::PRECONDITION_FAILED, say!(it_has_changed).into());
    let Condition::Revision(expected) = condition else {
        return disk::create(&place, bytes).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => {
                let sentence = say!(there_is_one_already);
                Refused(StatusCode::PRECONDITION_FAILED, sentence.into())
            }
            _ => failed(disk::plain(&error)),
        });
    };
    let file = match view.fence.open(path) {
        Err(Barred::Missing) => return Err(changed()),
        opened => opened?,
    };
    let old = disk::read_at_most(&file, LARGEST).map_err(failed)?;
    if disk::revision(&old) != *expected {
        return Err(changed());
    }
    let seen = Seen::of(&file, &old).map_err(failed)?;
    disk::replace(&place, Some(&seen), bytes)
        .map(drop)
        .map_err(failed)
}
