//! The real server over its pipes: everything that a client may do to it, and what it must survive.

#[path = "support/mod.rs"]
mod support;

#[path = "server/actions.rs"]
mod actions;
#[path = "server/beside.rs"]
mod beside;
#[path = "server/bombs.rs"]
mod bombs;
#[path = "server/contradictions.rs"]
mod contradictions;
#[path = "server/drawings.rs"]
mod drawings;
#[path = "server/end.rs"]
mod end;
#[path = "server/fits.rs"]
mod fits;
#[path = "server/flood.rs"]
mod flood;
#[cfg(feature = "testing")]
mod fuzz_seeds;
#[path = "server/handshake.rs"]
mod handshake;
#[path = "server/language.rs"]
mod language;
#[path = "server/locate.rs"]
mod locate;
#[path = "server/program_text/mod.rs"]
mod program_text;
#[path = "server/programs.rs"]
mod programs;
#[path = "server/settings.rs"]
mod settings;
#[path = "support/size.rs"]
mod size;
#[path = "soak.rs"]
mod soak;
#[cfg(feature = "testing")]
#[path = "testing.rs"]
mod testing;
#[path = "server/texts.rs"]
mod texts;
#[path = "server/token_deltas.rs"]
mod token_deltas;
#[path = "server/view/mod.rs"]
mod view;
#[path = "server/wire.rs"]
mod wire;
