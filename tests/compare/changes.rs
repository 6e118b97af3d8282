//! Changes of one number or one block in the text of a program.

use std::ops::Range;

/// Where the numbers of a block stand that are lengths, those after it in its line among them.
pub(super) fn lengths(text: &str, block: &Range<usize>) -> Vec<Range<usize>> {
    let line_end = text[block.end..]
        .find('\n')
        .map_or(text.len(), |at| block.end + at);
    let bytes = text.as_bytes();
    let is_number =
        |at: usize| at < line_end && (bytes[at].is_ascii_digit() || b"+-.".contains(&bytes[at]));
    let (mut found, mut letter, mut at) = (Vec::new(), b' ', block.start);
    while at < line_end {
        let end = (at..=line_end).find(|at| !is_number(*at)).unwrap();
        if end == at {
            let is_space = bytes[at].is_ascii_whitespace();
            letter = if is_space { letter } else { bytes[at] };
            at += 1;
            continue;
        }
        let is_of_3b = text[block.start..].trim_start().starts_with(['B', 'N']);
        let letters: &[u8] = if is_of_3b { b"B;," } else { b"XYIJR" };
        if letters.contains(&letter) {
            found.push(at..end);
        }
        at = end;
    }
    found
}

/// The text with one of its numbers changed by this many µm; `None` where it has no such sign.
pub(super) fn with_number(text: &str, number: &Range<usize>, by: i64) -> Option<String> {
    let own = &text[number.clone()];
    let new = match own.split_once('.') {
        Some((_, places)) => {
            let value = own.parse::<f64>().ok()? + by as f64 / 1e3;
            format!("{value:.*}", places.len())
        }
        None => {
            let value = own.parse::<i64>().ok()? + by;
            let is_absolute = text[..number.start].trim_end().ends_with('B');
            (!is_absolute || value >= 0).then_some(value.to_string())?
        }
    };
    let mut text = text.to_owned();
    text.replace_range(number.clone(), &new);
    Some(text)
}

/// The text with one block changed by this many µm in X or Y, with what follows from that; `None` where it has none that is large enough.
pub(super) fn changed(text: &str, block: &Range<usize>, by: i64, axis: usize) -> Option<String> {
    let own = &text[block.clone()];
    let new = if own.trim_start().starts_with(['B', 'b']) {
        let parts: Vec<&str> = own.split(['B', 'b']).map(str::trim).collect();
        let digits = |text: &str| {
            text.chars()
                .take_while(char::is_ascii_digit)
                .collect::<String>()
        };
        let [x, y, j] = [1, 2, 3].map(|index| digits(parts[index]).parse::<i64>().unwrap());
        let rest: String = parts[3..].join("B")[digits(parts[3]).len()..].trim().into();
        match rest.split_once('L') {
            Some((_, quadrant)) => {
                let mut at = [x, y];
                // One that is along an axis has no sign across it, and short ones would be others altogether.
                if at[axis] < 20 {
                    return None;
                }
                at[axis] += by;
                let [x, y] = at;
                let counted = if x > y { 'X' } else { 'Y' };
                format!("B{x}B{y}B{}G{counted}L{quadrant}", x.max(y))
            }
            None => {
                let radius = (x as f64).hypot(y as f64);
                if j < 60 || (j as f64 - 4.0 * radius).abs() < 10.0 {
                    return None;
                }
                format!("B{x}B{y}B{}{rest}", j + by)
            }
        }
    } else {
        let letter = ['X', 'Y'][axis];
        let at = own.find(letter)? + 1;
        let number: String = own[at..]
            .chars()
            .take_while(|letter| letter.is_ascii_digit() || "+-.".contains(*letter))
            .collect();
        let new = match number.parse::<i64>() {
            Ok(whole) => (whole + by).to_string(),
            Err(_) => format!("{:.3}", number.parse::<f64>().ok()? + by as f64 / 1e3),
        };
        format!("{}{new}{}", &own[..at], &own[at + number.len()..])
    };
    let mut text = text.to_owned();
    text.replace_range(block.clone(), &new);
    Some(text)
}

/// The line of a byte, from 0.
pub(super) fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count()
}
