//! Who may ask: the browser that was opened with the address of this process, and no page but ours.
//!
//! *Token*: in the first address, which a person opens. *Cookie*: what the browser gets for it, and sends from then on.
//! *Host* is what the browser believes to speak to: a name of another that was made to lead here (DNS rebinding) differs.
//! *Origin* is the page that asks.

use super::reply::{Answer, Body, Refused};
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::{Method, Request, Response, StatusCode};

/// 128 bits that nobody can guess, as hexadecimal digits.
struct Secret(String);

impl Secret {
    fn new() -> std::io::Result<Secret> {
        let mut bits = [0; 16];
        getrandom::fill(&mut bits).map_err(std::io::Error::other)?;
        Ok(Secret(format!("{:032x}", u128::from_be_bytes(bits))))
    }

    /// Compares all of it, whatever differs: the time that an answer takes tells nothing.
    fn is(&self, other: &str) -> bool {
        let pairs = self.0.bytes().zip(other.bytes());
        let differing = pairs.fold(0, |differing, (one, other)| differing | (one ^ other));
        self.0.len() == other.len() && differing == 0
    }
}

pub(super) struct Guard {
    token: Secret,
    cookie: Secret,
    port: u16,
}

/// What a request may do.
pub(super) enum Pass {
    /// It has the cookie.
    Known,
    /// It has the token, and is to be answered with the cookie.
    New,
}

impl Guard {
    pub(super) fn new(port: u16) -> std::io::Result<Guard> {
        Ok(Guard {
            token: Secret::new()?,
            cookie: Secret::new()?,
            port,
        })
    }

    /// The first address.
    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.port, self.token.0)
    }

    /// The name of the cookie has the port: to browsers all ports of a computer are one.
    fn cookie_name(&self) -> String {
        format!("wedm_view_{}", self.port)
    }

    /// The host that a request is for, if it is ours.
    fn host<'a, T>(&self, request: &'a Request<T>) -> Option<&'a str> {
        let host = one(request, &header::HOST)?;
        let (name, port) = host.rsplit_once(':')?;
        let is_ours = ["127.0.0.1", "localhost"].contains(&name) && port == self.port.to_string();
        // An address with a host in the first line is one for a proxy.
        (is_ours && request.uri().host().is_none()).then_some(host)
    }

    pub(super) fn check<T>(&self, request: &Request<T>) -> Result<Pass, Refused> {
        let Some(host) = self.host(request) else {
            return Err(Refused::new(StatusCode::FORBIDDEN, say!(another_host)));
        };
        let path = request.uri().path();
        let is_own = match request.headers().contains_key(header::ORIGIN) {
            true => one(request, &header::ORIGIN)
                .and_then(|origin| origin.strip_prefix("http://"))
                .is_some_and(|origin| origin == host),
            false => {
                // Newer browsers say where a request comes from; the first address may be a link in another page.
                let site = request.headers().get("sec-fetch-site");
                let is_of_others = site.is_some_and(|site| site != "same-origin" && site != "none");
                *request.method() == Method::GET && path != "/lsp" && (!is_of_others || path == "/")
            }
        };
        if !is_own {
            return Err(Refused::new(StatusCode::FORBIDDEN, say!(another_page_asks)));
        }
        if let Some(token) = self.token(request) {
            if self.token.is(token) {
                return Ok(Pass::New);
            }
        } else if self.has_cookie(request) {
            return Ok(Pass::Known);
        }
        Err(Refused::new(StatusCode::FORBIDDEN, say!(another_address)))
    }

    fn token<'a, T>(&self, request: &'a Request<T>) -> Option<&'a str> {
        let is_first = *request.method() == Method::GET && request.uri().path() == "/";
        let query = request.uri().query().filter(|_| is_first)?;
        query.strip_prefix("token=")
    }

    fn has_cookie<T>(&self, request: &Request<T>) -> bool {
        let name = self.cookie_name();
        let headers = request.headers().get_all(header::COOKIE).iter();
        let cookies = headers.filter_map(|header| header.to_str().ok());
        cookies
            .flat_map(|cookies| cookies.split(';'))
            .filter_map(|cookie| cookie.trim().split_once('='))
            .any(|(own, value)| own == name && self.cookie.is(value))
    }

    /// The cookie, and the way to the page.
    pub(super) fn welcome(&self) -> Answer {
        let cookie = format!(
            "{}={}; HttpOnly; SameSite=Strict; Path=/",
            self.cookie_name(),
            self.cookie.0
        );
        let mut answer = Response::new(Body::default());
        *answer.status_mut() = StatusCode::SEE_OTHER;
        let headers = answer.headers_mut();
        headers.insert(header::LOCATION, HeaderValue::from_static("/"));
        headers.extend(
            HeaderValue::try_from(cookie)
                .ok()
                .map(|cookie| (header::SET_COOKIE, cookie)),
        );
        answer
    }

    /// What every answer says to the browser: nothing is kept, guessed, shown in other pages, or taken from elsewhere.
    pub(super) fn seal(&self, answer: &mut Answer) {
        let sockets = format!(
            "connect-src 'self' ws://127.0.0.1:{0} ws://localhost:{0}",
            self.port
        );
        let policy = [
            "default-src 'none'",
            "script-src 'self'",
            "style-src 'self'",
            "img-src data: 'self' blob:",
            &sockets,
            "font-src 'self'",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
        ];
        let policy = policy.join("; ");
        let headers = answer.headers_mut();
        headers.extend(
            HeaderValue::try_from(policy)
                .ok()
                .map(|policy| (header::CONTENT_SECURITY_POLICY, policy)),
        );
        for (name, value) in [
            (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
            (header::REFERRER_POLICY, "no-referrer"),
            (header::CACHE_CONTROL, "no-store"),
            (
                HeaderName::from_static("cross-origin-resource-policy"),
                "same-origin",
            ),
            (
                HeaderName::from_static("cross-origin-opener-policy"),
                "same-origin",
            ),
        ] {
            headers.insert(name, HeaderValue::from_static(value));
        }
    }
}

/// The value of a header that stands there once.
fn one<'a, T>(request: &'a Request<T>, name: &HeaderName) -> Option<&'a str> {
    let mut values = request.headers().get_all(name).iter();
    let value = values.next()?.to_str().ok()?;
    values.next().is_none().then_some(value)
}
