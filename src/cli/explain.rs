//! `wedm explain`: the page of a rule, or the list of all rules.

use super::{Failure, Verdict, output};
use crate::rule::{Line, Rule};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::fmt::Write;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm explain
  wedm explain small-radius")]
pub(crate) struct Arguments {
    #[arg(value_name = "RULE", value_parser = rule_name(), hide_possible_values = true)]
    rule: Option<Rule>,
}

/// The name of a rule, corrected if it is nearly one.
pub(crate) fn rule_name() -> impl TypedValueParser<Value = Rule> {
    PossibleValuesParser::new(Rule::ALL.map(Rule::name))
        .try_map(|name| Rule::named(&name).ok_or(""))
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    let mut text = String::new();
    match arguments.rule {
        None => {
            for rule in Rule::ALL {
                let severity = format!("{:?}", rule.default_severity()).to_lowercase();
                let name = output::styled(output::STRONG, format!("{:<20}", rule.name()));
                let _ = writeln!(text, "{name} {severity:<11} {}", rule.summary());
            }
        }
        Some(rule) => {
            for (kind, line) in rule.lines() {
                let _ = match kind {
                    Line::Heading => writeln!(text, "{}", output::styled(output::STRONG, line)),
                    Line::Text => writeln!(text, "{line}"),
                    Line::Code => writeln!(text, "    {}", output::styled(output::NOTE, line)),
                };
            }
        }
    }
    output::print(text)?;
    Ok(Verdict::Clean)
}
