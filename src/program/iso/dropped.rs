//! What no program that is written anew takes over: words of the machine, comments, the choice to skip a block.

use super::block::{Note, read_line};
use super::document::Document;
use super::plain::{text_of, words_in};
use super::unfollowed::{UnfollowedWord, unfollowed};
use super::word::Token;
use crate::text::says_anything;
use std::collections::BTreeSet;

/// What stands in a program beside its moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Dropped {
    /// Words of the machine, each once, with their lines from 0.
    pub(crate) words: Vec<(usize, String)>,
    /// What changes the way of the wire, and is not followed.
    pub(crate) unfollowed: Vec<UnfollowedWord>,
    /// Lines that the operator may skip, from 0.
    pub(crate) optional: Vec<usize>,
    pub(crate) comments: bool,
}

/// What stands in the program beside its moves. Without `taper` the words that tilt the wire are left out: they are
/// told of elsewhere.
pub(in crate::program) fn dropped(document: &Document, taper: bool) -> Dropped {
    let mut found = Dropped {
        unfollowed: unfollowed(document),
        comments: document.leader() > 0,
        ..Dropped::default()
    };
    let mut seen = BTreeSet::new();
    for line in 0..document.text().line_count() {
        let bytes = document.line_bytes(line);
        let mut of_machine = Vec::new();
        let block = read_line(bytes, 0, |note| {
            if let Note::Foreign { code, range } = note
                && (taper || !code.is_of_taper() && !code.tilts())
            {
                of_machine.push(range.start);
            }
        });
        words_in(bytes, |token, range| {
            let text = text_of(bytes, &range);
            match token {
                Token::Comment => found.comments |= says_anything(text.as_bytes()),
                Token::Skip if !block.empty => found.optional.push(line),
                Token::Skip => {}
                _ if of_machine.contains(&range.start) || is_of_process(&token) => {
                    let key = match &token {
                        Token::Word { letter: b'F', .. } => "F".to_owned(),
                        _ => text.clone(),
                    };
                    if seen.insert(key) {
                        found.words.push((line, text));
                    }
                }
                _ => {}
            }
        });
    }
    found
}

/// F, and the wait of G04: neither changes where the wire goes.
fn is_of_process(token: &Token) -> bool {
    match token {
        Token::Word { letter, number } => match letter {
            b'F' => true,
            b'G' => number.whole() == Some(4),
            _ => false,
        },
        _ => false,
    }
}
