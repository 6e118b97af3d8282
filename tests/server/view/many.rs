//! Too much of anything: it costs whoever sends it, and nobody else.

use super::*;

#[test]
fn connections_of_strangers_push_out_each_other_and_no_page() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let mut page = view.session();
    let silent: Vec<TcpStream> = (0..200).map(|_| view.connect()).collect();
    let half: Vec<TcpStream> = (0..200)
        .map(|_| {
            let mut stream = view.connect();
            // One that was pushed out may have been closed by now.
            let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost: ");
            stream
        })
        .collect();
    assert_eq!(view.get("/api/start").status, 200);
    let started = page.start(json!({ "processId": null, "capabilities": {} }));
    assert_eq!(started["serverInfo"]["name"], "wedm");
    let mut gone = 0;
    for mut stream in silent {
        stream.set_nonblocking(true).unwrap();
        gone += usize::from(matches!(stream.read(&mut [0]), Ok(0)));
    }
    assert!(gone > 100, "{gone} of 200 were closed");
    drop(half);
}

#[test]
fn a_flood_of_requests_without_a_cookie_stops_nothing() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let mut page = view.session();
    page.start(json!({ "processId": null, "capabilities": {} }));
    std::thread::scope(|threads| {
        for _ in 0..4 {
            threads.spawn(|| {
                for _ in 0..200 {
                    if let Ok(mut stream) = TcpStream::connect(view.host()) {
                        let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost: evil\r\n\r\n");
                        let _ = stream.read(&mut [0; 64]);
                    }
                }
            });
        }
        let uri = uri_of(&path.join("tight.dxf"));
        page.open(&uri, "dxf", &drawing());
        assert_eq!(page.diagnostics(&uri)["version"], 1);
    });
    assert_eq!(view.get("/api/start").status, 200);
}

#[test]
fn there_are_so_many_pages_and_no_more() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let mut pages: Vec<Session> = (0..32).map(|_| view.session()).collect();
    let origin = view.origin();
    let headers = [("Cookie", &*view.cookie), ("Origin", &*origin)];
    assert!(view.try_session(&headers).is_err());
    assert_eq!(view.get("/api/changes").status, 503);
    let mut last = pages.pop().unwrap();
    last.socket.close(None).unwrap();
    while last.socket.read().is_ok() {}
    while view.try_session(&headers).is_err() {
        std::thread::yield_now();
    }
}

#[test]
fn a_frame_over_the_limit_ends_its_session_alone() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let (mut page, mut other) = (view.session(), view.session());
    // A frame of text, masked, whose length says 128 MB and a byte.
    let mut frame = vec![0x81, 0xff];
    frame.extend((128_u64 * 1024 * 1024 + 1).to_be_bytes());
    frame.extend([0; 4]);
    page.socket.get_mut().write_all(&frame).unwrap();
    let code = loop {
        match page.socket.read() {
            Ok(Message::Close(frame)) => break frame.map(|frame| u16::from(frame.code)),
            Ok(_) => {}
            Err(_) => break None,
        }
    };
    assert_eq!(code, Some(1009));
    let started = other.start(json!({ "processId": null, "capabilities": {} }));
    assert_eq!(started["serverInfo"]["name"], "wedm");
}

#[test]
fn a_head_over_the_limit_is_refused() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let long = "a".repeat(200_000);
    let mut stream = view.connect();
    let head = format!("GET /{long} HTTP/1.1\r\nHost: {}\r\n\r\n", view.host());
    let _ = stream.write_all(head.as_bytes());
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    let answer = String::from_utf8_lossy(&answer);
    assert!(
        answer.is_empty() || answer.starts_with("HTTP/1.1 4"),
        "{answer}"
    );
    assert_eq!(view.get("/api/start").status, 200);
}

#[test]
fn a_page_that_does_not_read_holds_up_no_other() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let (mut deaf, mut page) = (view.session(), view.session());
    deaf.start(json!({ "processId": null, "capabilities": {} }));
    // Each answer is some kilobytes; whoever writes for ever is stopped by the system's buffers.
    let long = "x".repeat(100_000);
    let flood = json!({ "jsonrpc": "2.0", "id": 1, "method": long, "params": {} }).to_string();
    let stream = deaf.socket.get_mut();
    stream
        .set_write_timeout(Some(std::time::Duration::from_millis(500)))
        .unwrap();
    let mut sent = 0;
    while sent < 3000 && deaf.socket.send(Message::text(&*flood)).is_ok() {
        sent += 1;
    }
    assert!(
        sent < 3000,
        "everything was taken from a page that does not read"
    );
    page.start(json!({ "processId": null, "capabilities": {} }));
    let uri = uri_of(&path.join("tight.dxf"));
    page.open(&uri, "dxf", &drawing());
    assert_eq!(page.diagnostics(&uri)["version"], 1);
    assert_eq!(view.get("/api/start").status, 200);
}
