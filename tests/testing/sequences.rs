//! Sessions that nobody planned, against a whole server in this process: every request is answered once, and never with an internal
//! error. `fuzz/fuzz_targets/server_messages.rs` tries more of them, and longer.

use crate::fuzz_seeds::targets::server_messages;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { max_shrink_iters: 500, ..ProptestConfig::default() })]
    #[test]
    fn every_request_of_any_session_is_answered_once(script in prop::collection::vec(any::<u8>(), 0..400)) {
        server_messages::run(&script);
    }
}
