//! Who may ask: a test for each promise of SECURITY.md.

use super::*;

const PATHS: [&str; 10] = [
    "/",
    "/page.js",
    "/page.css",
    "/icon.svg",
    "/api/start",
    "/api/files",
    "/api/changes",
    "/api/file?uri=file:///tmp/a.dxf",
    "/api/report?uri=file:///tmp/a.dxf",
    "/lsp",
];

/// A request for each path whose head is made by hand.
#[track_caller]
fn refused(view: &View, why: &str, headers: &[(&str, &str)]) {
    for path in PATHS {
        let mut head = format!("GET {path} HTTP/1.1\r\nConnection: close\r\n");
        for (name, value) in headers {
            head += &format!("{name}: {value}\r\n");
        }
        let reply = view.send(format!("{head}\r\n").as_bytes());
        assert_eq!(reply.status, 403, "{why}: {path}");
        assert_eq!(reply.header("set-cookie"), None, "{why}: {path}");
        assert_eq!(reply.header("connection"), Some("close"));
        let text = reply.text();
        assert!(text.len() < 100 && text.ends_with('\n'), "{text}");
    }
}

#[test]
fn nobody_is_let_in_without_the_cookie() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let host = view.host();
    refused(&view, "no cookie", &[("Host", &host)]);
    let (name, value) = view.cookie.split_once('=').unwrap();
    assert_eq!(value.len(), 32);
    let longer = format!("{name}={value}0");
    let shorter = format!("{name}={}", &value[..31]);
    let token = format!("{name}={}", view.token);
    let other_name = format!("wedm_view={value}");
    for cookie in [&*longer, &*shorter, &*token, &*other_name, name, ""] {
        refused(&view, cookie, &[("Host", &host), ("Cookie", cookie)]);
    }
}

#[test]
fn the_cookie_is_given_for_the_token_alone() {
    let (_folder, path) = folder();
    let mut view = View::of(&path);
    assert_eq!(view.token.len(), 32);
    let other = View::of(&path);
    assert_ne!(view.token, other.token);
    let cookie = std::mem::take(&mut view.cookie);
    let value = cookie.split_once('=').unwrap().1;
    let (upper, shorter) = (format!("{}x", view.token), &view.token[..31]);
    for token in [&*upper, shorter, value, &other.token, "", "%30"] {
        let reply = view.get(&format!("/?token={token}"));
        assert_eq!(reply.status, 403, "{token}");
        assert_eq!(reply.header("set-cookie"), None);
    }
    let first = format!("/?token={}", view.token);
    for method in ["POST", "PUT", "HEAD", "DELETE"] {
        let reply = view.ask(method, &first, &[("Origin", &view.origin())], b"");
        assert_eq!(reply.status, 403, "{method}");
    }
    assert_eq!(
        view.get(&format!("/api/start?token={}", view.token)).status,
        403
    );
    // A link in another page may be the first address; what follows is asked by the page itself.
    let reply = view.ask("GET", &first, &[("Sec-Fetch-Site", "cross-site")], b"");
    assert_eq!(reply.status, 303);
    assert_eq!(reply.header("location"), Some("/"));
    let set = reply.header("set-cookie").unwrap();
    assert_eq!(set, format!("{cookie}; HttpOnly; SameSite=Strict; Path=/"));
    assert!(!cookie.contains(&view.token));
}

#[test]
fn a_name_that_was_made_to_lead_here_is_another_host() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let (cookie, port) = (view.cookie.as_str(), view.port);
    let hosts = [
        format!("evil.example:{port}"),
        format!("127.0.0.1.evil.example:{port}"),
        format!("[::1]:{port}"),
        format!("0.0.0.0:{port}"),
        format!("127.0.0.1:{port}.evil.example"),
        format!("127.0.0.1:{}", port ^ 1),
        format!("localhost:0{port}"),
        "127.0.0.1".to_owned(),
        "localhost".to_owned(),
        String::new(),
    ];
    for host in &hosts {
        refused(&view, host, &[("Host", host), ("Cookie", cookie)]);
        refused(
            &view,
            host,
            &[("Host", host), ("Host", &view.host()), ("Cookie", cookie)],
        );
    }
    let proxied = format!(
        "GET http://evil.example/ HTTP/1.1\r\nHost: {}\r\nCookie: {cookie}\r\nConnection: close\r\n\r\n",
        view.host()
    );
    assert_eq!(view.send(proxied.as_bytes()).status, 403);
    let old = format!("GET / HTTP/1.0\r\nCookie: {cookie}\r\n\r\n");
    assert_eq!(view.send(old.as_bytes()).status, 403);
    let local = format!(
        "GET /api/start HTTP/1.1\r\nHost: localhost:{port}\r\nCookie: {cookie}\r\nConnection: close\r\n\r\n"
    );
    assert_eq!(view.send(local.as_bytes()).status, 200);
}

#[test]
fn no_other_page_asks_whatever_cookie_comes_with_it() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let (host, port) = (view.host(), view.port);
    let origins = [
        "http://evil.example".to_owned(),
        format!("https://127.0.0.1:{port}"),
        format!("http://localhost:{port}"),
        format!("http://127.0.0.1:{}", port ^ 1),
        format!("http://127.0.0.1:{port}/"),
        "null".to_owned(),
        "file://".to_owned(),
        String::new(),
    ];
    let cookie = ("Cookie", &*view.cookie);
    for origin in &origins {
        let all = [("Host", &*host), cookie, ("Origin", &**origin)];
        refused(&view, origin, &all);
        let socket = view.try_session(&[cookie, ("Origin", origin)]);
        assert!(socket.is_err(), "{origin}");
    }
    for site in ["cross-site", "same-site"] {
        let reply = view.ask("GET", "/api/files", &[("Sec-Fetch-Site", site)], b"");
        assert_eq!(reply.status, 403, "{site}");
    }
    for site in ["same-origin", "none"] {
        let reply = view.ask("GET", "/api/files", &[("Sec-Fetch-Site", site)], b"");
        assert_eq!(reply.status, 200, "{site}");
    }
    // What changes something says by which page it is asked.
    for method in ["PUT", "POST", "DELETE", "OPTIONS"] {
        let reply = view.ask(method, "/api/file?uri=a", &[], b"");
        assert_eq!(reply.status, 403, "{method}");
    }
    assert!(view.try_session(&[cookie]).is_err());
    assert!(view.try_session(&[("Origin", &view.origin())]).is_err());
}

#[test]
fn every_answer_keeps_the_browser_to_this_page() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    for path in [
        "/",
        "/page.js",
        "/api/start",
        "/api/files",
        "/nothing",
        "/api/file?uri=a",
        "/lsp",
    ] {
        let reply = view.get(path);
        let policy = reply.header("content-security-policy").unwrap();
        assert!(
            policy.starts_with("default-src 'none'; script-src 'self'; "),
            "{policy}"
        );
        assert!(!policy.contains("unsafe"), "{policy}");
        assert!(policy.contains(&format!("connect-src 'self' ws://127.0.0.1:{}", view.port)));
        assert!(policy.ends_with("frame-ancestors 'none'"), "{policy}");
        for (name, value) in [
            ("x-content-type-options", "nosniff"),
            ("referrer-policy", "no-referrer"),
            ("cache-control", "no-store"),
            ("cross-origin-resource-policy", "same-origin"),
        ] {
            assert_eq!(reply.header(name), Some(value), "{path}");
        }
        assert_eq!(reply.header("access-control-allow-origin"), None);
    }
    assert_eq!(view.get("/nothing").status, 404);
    assert_eq!(view.get("/../Cargo.toml").status, 404);
    let origin = view.origin();
    assert_eq!(
        view.ask("POST", "/api/files", &[("Origin", &origin)], b"")
            .status,
        405
    );
    assert_eq!(
        view.get("/").header("content-type"),
        Some("text/html; charset=utf-8")
    );
}

#[test]
fn only_this_computer_reaches_the_port() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let sockets = std::fs::read_to_string("/proc/net/tcp").unwrap_or_default();
    let port = format!(":{:04X}", view.port);
    let mut own = sockets
        .lines()
        .filter_map(|line| line.split_whitespace().nth(1));
    if let Some(address) = own.find(|address| address.ends_with(&port)) {
        assert_eq!(address, format!("0100007F{port}"));
    }
}
