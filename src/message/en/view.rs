//! The page in the browser, and what its server refuses.

declare! {
    another_host => "this address is for 127.0.0.1 or localhost and the port of this process alone";
    another_page_asks => "another page asks for this";
    another_address => "open the address that wedm view has printed: it has the key to this page";
    another_method => "this is asked for in another way";
    nothing_is_there => "there is nothing at this address";
    a_websocket_is_expected => "expected the beginning of a WebSocket, version 13";
    a_file_uri_is_expected => "expected ?uri= and the file: URI of a file, percent-encoded";
    a_condition_is_expected => "expected If-Match with one revision in quotes, or If-None-Match: *";
    it_has_changed => "it is another file by now: nothing is written";
    there_is_one_already => "it is there already: nothing is written";
    it_took_too_long => "it took too long to come";
    too_much_at_a_time => "too much is under way at a time";
    it_ends_with_the_last_page => "end it with Ctrl-C; it ends by itself a minute after its last page is closed";
    the_port_is_taken(port) => "port {port} is taken by another program: choose another with --port, or none";
    the_port_cannot_be_had(port, reason) => "port {port} of this computer cannot be had: {reason}";
    it_is_nothing_to_show => "it is no drawing, program or wedm.toml that could be shown";
    no_browser_could_be_opened => "no browser could be opened: open the address in one";
}
