//! The little HTML of a page: everything put in is text, and escaped.

use crate::message::readable;
use crate::picture::escaped;
use std::fmt::Display;

/// Colours of light and dark viewers, and A4.
const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#24292f;--faint:#57606a;--ground:#fff;--line:#d0d7de;--band:#f3f5f7;--error:#b3261e;--warning:#8a5a00;--good:#1a7f37}
@media (prefers-color-scheme:dark){:root{--ink:#e6edf3;--faint:#9da7b3;--ground:#0d1117;--line:#30363d;--band:#161b22;--error:#ff8a82;--warning:#e3b341;--good:#57d364}}
@page{size:A4;margin:14mm;@bottom-right{content:counter(page) ' / ' counter(pages);font:9px system-ui,sans-serif;color:#57606a}}
body{margin:0 auto;max-width:64rem;padding:1.5rem;background:var(--ground);color:var(--ink);font:14px/1.45 system-ui,'Segoe UI',Helvetica,Arial,'Noto Sans CJK SC','Microsoft YaHei',sans-serif}
h1{font-size:1.5rem;margin:0 0 .2rem}h2{font-size:1.1rem;margin:1.6rem 0 .4rem}h3{font-size:1rem;margin:1rem 0 .2rem}
p.under{margin:0 0 1rem;color:var(--faint)}p.fact{margin:.1rem 0}
svg{box-sizing:border-box;max-width:100%;height:auto;border:1px solid var(--line)}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th,td{text-align:left;padding:.2rem .6rem .2rem 0;border-bottom:1px solid var(--line);vertical-align:top}
th{color:var(--faint);font-weight:600}td.number,th.number{text-align:right;white-space:nowrap}td.number+td:not(.number),th.number+th:not(.number){padding-left:1rem}span{white-space:nowrap}
.error{color:var(--error)}.warning{color:var(--warning)}.good{color:var(--good)}.faint{color:var(--faint)}
p.verdict{margin:.2rem 0 .8rem;font-size:1.1rem;font-weight:600}
table.head{margin:.2rem 0 .8rem}table.head th{width:9rem}table.head td{width:calc(50% - 9rem);border-bottom:1px solid var(--line)}
summary{cursor:pointer;color:var(--faint);margin:.3rem 0}
pre{background:var(--band);padding:.6rem;overflow:auto;font-size:12px;white-space:pre-wrap;overflow-wrap:anywhere}
a{color:inherit}tr,h2,h3{break-inside:avoid}h2,h3{break-after:avoid}
@media print{body{max-width:none;padding:0;font-size:11px}.screen,details:not([open])>*:not(summary){display:none}summary{list-style:none}svg{max-height:150mm}a{text-decoration:none}}
";

/// Stands in the head of each page: who wrote it, and so may write it again.
pub(super) const MARK: &str = "<meta name=\"generator\" content=\"wedm ";

/// Escapes text for HTML.
pub(super) fn text(text: impl Display) -> String {
    escaped(&readable(&text.to_string()))
}

/// A whole page.
pub(super) fn page(language: &str, title: &str, body: &str) -> String {
    let title = text(title);
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "<!doctype html>\n<html lang=\"{language}\">\n<head>\n<meta charset=\"utf-8\">\n{MARK}{version}\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n\
         <body>\n{body}</body>\n</html>\n"
    )
}

/// A cell: its class, and its content.
pub(super) type Cell = (&'static str, String);

pub(super) fn cell(content: impl Display) -> Cell {
    ("", text(content))
}

pub(super) fn number(content: impl Display) -> Cell {
    ("number", text(content))
}

/// A table with a heading over each column; empty without rows.
pub(super) fn table(heads: &[&str], rows: impl IntoIterator<Item = Vec<Cell>>) -> String {
    let rows: Vec<Vec<Cell>> = rows.into_iter().collect();
    let Some(first) = rows.first() else {
        return String::new();
    };
    let heads: String = heads
        .iter()
        .zip(first)
        .map(|(head, (class, _))| match *class {
            "number" => format!("<th class=\"number\">{}</th>", text(head)),
            _ => format!("<th>{}</th>", text(head)),
        })
        .collect();
    let row = |cells: &Vec<Cell>| {
        let cells: String = cells
            .iter()
            .map(|(class, content)| format!("<td class=\"{class}\">{content}</td>"))
            .collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = rows.iter().map(row).collect();
    format!("<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n")
}

/// Two fields in a row, each with its name; an empty one is a line to write on.
pub(super) fn fields(fields: &[(&str, String)]) -> String {
    let field =
        |(name, value): &(&str, String)| format!("<th>{}</th><td>{}</td>", text(name), text(value));
    let row = |pair: &[(&str, String)]| {
        let cells: String = pair.iter().map(field).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = fields.chunks(2).map(row).collect();
    format!("<table class=\"head\">\n{rows}</table>\n")
}

/// Content that is unfolded by a click.
pub(super) fn folded(summary: &str, content: &str) -> String {
    match content.is_empty() {
        true => String::new(),
        false => format!(
            "<details><summary>{}</summary>\n{content}</details>\n",
            text(summary)
        ),
    }
}

/// How many more there are than are shown.
pub(super) fn more(count: usize, shown: usize) -> String {
    match count.saturating_sub(shown) {
        0 => String::new(),
        more => format!(
            "<p class=\"faint\">{}</p>\n",
            text(say!(and_more_of_them, more))
        ),
    }
}

/// A part of the page under its heading; empty without content.
pub(super) fn section(title: &str, content: String) -> String {
    match content.is_empty() {
        true => content,
        false => format!("<h2>{}</h2>\n{content}", text(title)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_drawing_are_text() {
        let table = table(&["a"], [vec![cell("<script>alert(1)</script>\u{202e}")]]);
        assert!(
            table.contains("&lt;script&gt;") && !table.contains("<script>"),
            "{table}"
        );
        assert!(!table.contains('\u{202e}'), "{table}");
        assert!(page("en", "</title>", "").contains("&lt;/title&gt;"));
    }
}
