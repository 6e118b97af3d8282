//! The page of a rule as the program holds it: Markdown that links only to other rules.

use super::Rule;
use crate::message::{Language, spoken};

impl Rule {
    /// The page in the language in force, without pictures. Links to other rules stay, as `NAME.md`; all other links
    /// become plain text.
    pub(crate) fn page(self) -> String {
        self.page_in(spoken())
    }

    fn page_in(self, language: Language) -> String {
        let is_picture = |line: &&str| line.starts_with("![");
        let lines: Vec<&str> = self
            .written(language)
            .lines()
            .filter(|line| !is_picture(line))
            .collect();
        let mut page = unlinked(&lines.join("\n"), |target| {
            target
                .strip_suffix(".md")
                .is_some_and(|name| Rule::named(name).is_some())
        });
        while page.contains("\n\n\n") {
            page = page.replace("\n\n\n", "\n\n");
        }
        page + "\n"
    }

    /// The page as plain text for a terminal: lines, each with its kind.
    pub(crate) fn lines(self) -> Vec<(Line, String)> {
        let mut is_code = false;
        let mut lines = Vec::new();
        for line in unlinked(&self.page(), |_| false).lines() {
            if line.starts_with("```") {
                is_code = !is_code;
            } else if is_code {
                lines.push((Line::Code, line.to_owned()));
            } else if line.starts_with('#') {
                lines.push((
                    Line::Heading,
                    line.trim_start_matches('#').trim().to_owned(),
                ));
            } else {
                lines.push((Line::Text, line.replace("**", "")));
            }
        }
        lines
    }

    /// The rule of a name.
    pub(crate) fn named(name: &str) -> Option<Rule> {
        Rule::ALL.into_iter().find(|rule| rule.name() == name)
    }
}

/// The kind of a line of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Line {
    Heading,
    Text,
    Code,
}

/// The Markdown with every link that is not kept replaced by its text.
fn unlinked(text: &str, keep: impl Fn(&str) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, link)) = rest.split_once("](") {
        let Some(((before, label), (target, behind))) =
            before.rsplit_once('[').zip(link.split_once(')'))
        else {
            break;
        };
        out.push_str(before);
        if keep(target) {
            out.push_str(&format!("[{label}]({target})"));
        } else {
            out.push_str(label);
        }
        rest = behind;
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_page_leads_out_of_the_program() {
        let pages = |rule: Rule| Language::ALL.map(|language| (rule, rule.page_in(language)));
        for (rule, page) in Rule::ALL.into_iter().flat_map(pages) {
            assert!(page.starts_with(&format!("# {}\n", rule.name())), "{page}");
            for link in page.split("](").skip(1) {
                let target = link.split(')').next().unwrap_or_default();
                let name = target.strip_suffix(".md").unwrap_or_default();
                assert!(Rule::named(name).is_some(), "{}: {target}", rule.name());
            }
            let text = rule.lines();
            assert!(text.len() > 10, "{}", rule.name());
            assert!(
                text.iter().all(|(_, line)| !line.contains("](")),
                "{}",
                rule.name()
            );
        }
    }

    #[test]
    fn links_become_their_text() {
        let text = "a [b](c.md) d [`e`](f#g), [h](i";
        assert_eq!(unlinked(text, |_| false), "a b d `e`, [h](i");
        assert_eq!(
            unlinked(text, |target| target == "c.md"),
            "a [b](c.md) d `e`, [h](i"
        );
    }
}
