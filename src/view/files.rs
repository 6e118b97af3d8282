//! One file, read or written: within the fence, and of a kind that wedm makes or reads.

use super::View;
use super::reply::{Answer, Refused, with};
use crate::disk::{self, Barred, Seen, ending_of};
use crate::document::FileKind;
use crate::server::path_of;
use crate::settings;
use http_body_util::{BodyExt, LengthLimitError, Limited};
use hyper::body::{Body as _, Bytes, Incoming};
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::{Request, StatusCode};
use std::fs::File;
use std::io::ErrorKind;
use std::panic::{AssertUnwindSafe, catch_unwind};
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
            let names_a_stream = cfg!(windows) && name.contains(':');
            !name.starts_with('.') && !names_a_stream
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

impl From<Barred> for Refused {
    fn from(barred: Barred) -> Refused {
        let status = match barred {
            Barred::Missing => StatusCode::NOT_FOUND,
            Barred::Outside | Barred::Faulty(_) => StatusCode::FORBIDDEN,
        };
        Refused::new(status, barred)
    }
}

/// The file that `?uri=` names.
fn named<T>(request: &Request<T>) -> Result<PathBuf, Refused> {
    let query = request.uri().query().unwrap_or_default();
    let mut pairs = form_urlencoded::parse(query.as_bytes());
    let uri = pairs.find(|(key, _)| key == "uri");
    let path = uri.and_then(|(_, uri)| path_of(&uri));
    path.filter(|path| !path.to_string_lossy().contains('\0'))
        .ok_or_else(|| Refused::new(StatusCode::BAD_REQUEST, say!(a_file_uri_is_expected)))
}

/// Does work with files, which may wait for a disk.
async fn beside<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Refused> + Send + 'static,
) -> Result<T, Refused> {
    let done = tokio::task::spawn_blocking(work).await;
    done.unwrap_or_else(|error| Err(Refused::new(StatusCode::INTERNAL_SERVER_ERROR, error)))
}

fn room(view: &View, bytes: u64) -> Result<OwnedSemaphorePermit, Refused> {
    let mebibytes = u32::try_from(bytes / MEBIBYTE + 1).unwrap_or(u32::MAX);
    let permit = view.room.clone().try_acquire_many_owned(mebibytes);
    permit.map_err(|_| Refused::too_much())
}

fn tagged(mut answer: Answer, revision: &str) -> Answer {
    let tag = HeaderValue::try_from(format!("\"{revision}\"")).ok();
    answer
        .headers_mut()
        .extend(tag.map(|tag| (header::ETAG, tag)));
    answer
}

/// A file that may be read, and its length.
fn open(view: &View, path: &Path) -> Result<(File, u64), Refused> {
    view.fence.place(path, is_of_ours)?;
    let file = view.fence.open(path)?;
    let length = file.metadata().map_err(Barred::from)?.len();
    match length > LARGEST {
        true => Err(too_large(say!(it_has_too_many_bytes, length, LARGEST))),
        false => Ok((file, length)),
    }
}

fn too_large(sentence: impl ToString) -> Refused {
    Refused::new(StatusCode::PAYLOAD_TOO_LARGE, sentence)
}

pub(super) async fn read<T>(view: &Arc<View>, request: &Request<T>) -> Result<Answer, Refused> {
    let (path, view) = (named(request)?, view.clone());
    let read = move || {
        let (file, length) = open(&view, &path)?;
        let room = room(&view, length)?;
        let bytes = disk::read_at_most(&file, LARGEST).map_err(too_large)?;
        let revision = disk::revision(&bytes);
        Ok((Held { bytes, _room: room }, revision))
    };
    let (held, revision) = beside(read).await?;
    let bytes = Bytes::from_owner(held);
    let answer = with(StatusCode::OK, "application/octet-stream", bytes);
    Ok(tagged(answer, &revision))
}

/// The report of a drawing. As many are made at a time as files of the largest size may be read.
pub(super) async fn report<T>(view: &Arc<View>, request: &Request<T>) -> Result<Answer, Refused> {
    let (path, view) = (named(request)?, view.clone());
    let made = move || {
        open(&view, &path)?;
        if FileKind::of_ending(&ending_of(&path)) != Some(FileKind::Drawing) {
            let sentence = say!(no_drawing_for_a_report);
            return Err(Refused::new(StatusCode::BAD_REQUEST, sentence));
        }
        let _room = room(&view, LARGEST)?;
        let made = catch_unwind(AssertUnwindSafe(|| view.shelf.report(&path)));
        let made = made
            .unwrap_or_else(|_| Err(say!(internal_error_the_document_could_not_be_judged).into()));
        made.map_err(|sentence| Refused(StatusCode::UNPROCESSABLE_ENTITY, sentence))
    };
    let page = beside(made).await?;
    let mut answer = with(StatusCode::OK, "text/html; charset=utf-8", page.into());
    // Its styles are its own: it is kept, and not shown among what is served.
    let kept = HeaderValue::from_static("attachment");
    answer
        .headers_mut()
        .insert(header::CONTENT_DISPOSITION, kept);
    Ok(answer)
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
    let refused = |status| Err(Refused::new(status, say!(a_condition_is_expected)));
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

pub(super) async fn write(view: &Arc<View>, request: Request<Incoming>) -> Result<Answer, Refused> {
    let (path, condition) = (named(&request)?, condition(&request)?);
    let too_large = || too_large(say!(it_holds_too_many_bytes, LARGEST));
    let stated = request.body().size_hint().upper();
    if stated.is_some_and(|length| length > LARGEST) {
        return Err(too_large());
    }
    // Before anything of it is read.
    let (shared, target) = (view.clone(), path.clone());
    beside(move || Ok(shared.fence.place(&target, is_of_ours)?)).await?;
    let room = room(view, stated.unwrap_or(LARGEST))?;
    let limit = usize::try_from(LARGEST).unwrap_or(usize::MAX);
    let body = Limited::new(request.into_body(), limit).collect();
    let body = tokio::time::timeout(PATIENCE, body)
        .await
        .map_err(|_| Refused::new(StatusCode::REQUEST_TIMEOUT, say!(it_took_too_long)))?
        .map_err(|error| match error.is::<LengthLimitError>() {
            true => too_large(),
            false => Refused::new(StatusCode::BAD_REQUEST, error),
        })?;
    let (bytes, shared) = (body.to_bytes(), view.clone());
    let written = move || {
        let _one = shared
            .writing
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let written = put(&shared, &path, &condition, &bytes);
        drop(room);
        written.map(|()| disk::revision(&bytes))
    };
    let revision = beside(written).await?;
    let answer = with(StatusCode::OK, "text/plain; charset=utf-8", Bytes::new());
    Ok(tagged(answer, &revision))
}

/// Writes beside and renames, as `wedm fix` does.
fn put(view: &View, path: &Path, condition: &Condition, bytes: &[u8]) -> Result<(), Refused> {
    let place = view.fence.place(path, is_of_ours)?;
    let failed = |reason: String| Refused(StatusCode::INTERNAL_SERVER_ERROR, reason);
    let changed = || Refused::new(StatusCode::PRECONDITION_FAILED, say!(it_has_changed));
    let Condition::Revision(expected) = condition else {
        return disk::create(&place, bytes).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => {
                Refused::new(StatusCode::PRECONDITION_FAILED, say!(there_is_one_already))
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
