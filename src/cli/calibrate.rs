//! `wedm calibrate`: gap and corrections from what was measured on a cut test piece.

use super::options::{Common, CutWith, Form, positive};
use super::output::{self, push_line, styled};
use super::{Failure, Verdict, files, init};
use crate::calibration::{Kerf, Measurement, Setup, calibrate};
use crate::disk;
use crate::finding::Severity;
use crate::protocol::CalibratedPass;
use crate::settings::{self, Effective, FILE_NAME, Origin};
use crate::text::Writing;
use clap::Args;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm calibrate --outer 20=20.006 --outer 12=12.005 --inner 10=9.994
  wedm calibrate piece.csv --passes 0.215,0.17,0.14 --wire-diameter 0.25
  wedm calibrate piece.csv --uncertainty 0.001 --write")]
pub(super) struct Arguments {
    #[arg(value_name = "CSV", required_unless_present_any = ["outer", "inner"])]
    path: Option<PathBuf>,
    #[arg(long, value_name = "NOMINAL=MEASURED", value_parser = sizes)]
    outer: Vec<[f64; 2]>,
    #[arg(long, value_name = "NOMINAL=MEASURED", value_parser = sizes)]
    inner: Vec<[f64; 2]>,
    #[arg(long, value_name = "N")]
    pass: Option<usize>,
    #[arg(long, value_name = "MM", value_parser = positive, default_value = "0.002")]
    uncertainty: f64,
    #[arg(long)]
    write: bool,
    #[arg(long, value_enum, default_value_t = Form::Text)]
    output: Form,
    #[command(flatten)]
    cut_with: CutWith,
    #[arg(long, value_name = "FILE", help_heading = "Settings")]
    config: Option<PathBuf>,
}

fn sizes(text: &str) -> Result<[f64; 2], String> {
    let Some((nominal, measured)) = text.split_once('=') else {
        return Err(say!(a_nominal_and_a_measured_size).into());
    };
    Ok([positive(nominal)?, positive(measured)?])
}

/// Columns of the table.
const COLUMNS: [&str; 5] = ["feature", "kind", "pass", "nominal", "measured"];
const NEEDED: [&str; 3] = ["kind", "nominal", "measured"];

/// The longest file: nobody measures that often.
const LARGEST: u64 = 1024 * 1024;

/// What begins the comment above a value that was calibrated.
const MARK: &str = "calibrated";

pub(super) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    // Options are of the folder that the command runs in.
    let near = arguments.path.as_deref().unwrap_or(Path::new("./piece"));
    let common = Common {
        config: arguments.config.clone(),
        ..Common::default()
    };
    let (effective, faults) = files::settings_for(near, &common, &arguments.cut_with.0)?;
    faults.iter().for_each(|row| output::say(&row.rendered()));
    if faults.iter().any(|row| row.severity == Severity::Error) {
        return Err(Failure(say!(nothing_is_made_with_such_settings).into()));
    }
    if effective.origins.correction == Origin::Default {
        return Err(Failure(say!(nothing_says_the_correction).into()));
    }
    let setup = Setup {
        corrections: effective.each_correction(),
        wire_radius: effective.wire_diameter.map(|diameter| diameter / 2.0),
        uncertainty: arguments.uncertainty,
    };
    let last = setup.corrections.len();
    let mut measurements = match &arguments.path {
        Some(path) => match table(path, last) {
            Ok(measurements) => measurements,
            Err(faults) => {
                faults.iter().for_each(|fault| output::complain(fault));
                return Ok(Verdict::Failed);
            }
        },
        None => Vec::new(),
    };
    let given = |is_outer: bool| move |sizes: &[f64; 2]| (is_outer, *sizes);
    let of_options = arguments.outer.iter().map(given(true));
    let of_options = of_options.chain(arguments.inner.iter().map(given(false)));
    for (number, (is_outer, [nominal, measured])) in of_options.enumerate() {
        let option = if is_outer { "--outer" } else { "--inner" };
        measurements.push(Measurement {
            feature: format!("{option} {nominal}={measured} ({})", number + 1),
            is_outer,
            pass: arguments.pass.unwrap_or(last),
            nominal,
            measured,
        });
    }
    let kerfs = match calibrate(&measurements, &setup) {
        Ok(kerfs) => kerfs,
        Err(refusals) => {
            refusals.iter().for_each(|one| output::complain(one));
            return Ok(Verdict::Errors);
        }
    };
    if arguments.output == Form::Text {
        let mut text = String::new();
        kerfs.iter().for_each(|kerf| told(&mut text, kerf));
        if setup.wire_radius.is_none() {
            push_line(&mut text, say!(no_gap_without_the_wire));
        }
        output::print(text)?;
    }
    settle(arguments, near, &effective, &kerfs)
}

fn told(text: &mut String, kerf: &Kerf) {
    let Kerf {
        pass,
        correction,
        half,
        uncertainty,
        features,
        ..
    } = kerf;
    let mut line = say!(
        kerf_of_a_pass,
        pass,
        correction,
        half,
        uncertainty,
        say!(features, *features)
    );
    if let [Some(outer), Some(inner)] = kerf.by_kind {
        line += &say!(of_outer_and_inner_features, outer, inner);
    }
    if let Some(gap) = kerf.gap {
        line += &say!(and_the_gap, gap, uncertainty);
    }
    push_line(text, line);
    if kerf.is_single {
        push_line(text, say!(a_single_measurement, pass));
    }
}

/// Says what the measured kerfs set in which file, and sets it where that is wanted.
fn settle(
    arguments: &Arguments,
    near: &Path,
    effective: &Effective,
    kerfs: &[Kerf],
) -> Result<Verdict, Failure> {
    let target = arguments.config.clone();
    let target = target
        .or_else(|| files::project_file(near))
        .unwrap_or_else(|| near.with_file_name(FILE_NAME));
    let is_there = settings::is_there(&target);
    let bytes = match is_there {
        true => settings::read_file(&target).map_err(|reason| Failure::of(&target, reason))?,
        false => Vec::new(),
    };
    let (bytes, writing) = Writing::read(bytes);
    let before =
        String::from_utf8(bytes).map_err(|_| Failure::of(&target, say!(it_is_not_utf_8_text)))?;
    let (own, own_errors) = settings::from_toml(&before);
    let mut values = proposed(effective, kerfs, own.correction.is_some());
    if own.wire_diameter != effective.wire_diameter
        && let Some(diameter) = effective.wire_diameter
    {
        values.insert(0, ("wire-diameter", diameter.to_string()));
    }
    let today = chrono::Utc::now().date_naive();
    let each: Vec<String> = kerfs
        .iter()
        .map(|kerf| {
            say!(
                a_pass_is_calibrated,
                kerf.pass,
                kerf.correction,
                say!(features, kerf.features),
                kerf.uncertainty
            )
        })
        .collect();
    let comment = format!("{today}: {}", each.join(say!(semicolon)));
    let Some(after) = settings::set(&before, &values, MARK, &comment) else {
        return Err(Failure::of(&target, say!(the_file_cannot_take_the_values)));
    };
    let errors = settings::from_toml(&after).1;
    let is_new = |error: &&settings::SettingsError| {
        error.severity == Severity::Error
            && own_errors.iter().all(|own| own.message != error.message)
    };
    if let Some(error) = errors.iter().find(is_new) {
        return Err(Failure(say!(
            not_written_as_it_would_be_refused,
            error.message
        )));
    }
    let name = output::name(&target);
    if arguments.write {
        match is_there {
            true => output::write_over(&target, None, &writing.written(after.as_bytes()))?,
            false => output::write(Some(&target), after.as_bytes(), false)?,
        }
        output::say(&say!(
            file_is_calibrated,
            styled(output::GOOD, say!(written)),
            name
        ));
    } else {
        output::say(&say!(with_write_a_file_gets, name));
    }
    if arguments.output == Form::Json {
        output::print_json(&json(kerfs, &values))?;
        return Ok(Verdict::Clean);
    }
    let lines: String = values
        .iter()
        .map(|(key, value)| format!("  {key} = {value}\n"))
        .collect();
    output::print(lines)?;
    Ok(Verdict::Clean)
}

/// The passes as `wedm/calibrate` answers, and the keys that they set.
fn json(kerfs: &[Kerf], values: &[(&'static str, String)]) -> Value {
    let numbers = |text: &String| serde_json::from_str(text).unwrap_or(Value::Null);
    let settings = values
        .iter()
        .map(|(key, text)| ((*key).to_owned(), numbers(text)));
    json!({
        "passes": kerfs.iter().map(CalibratedPass::from).collect::<Vec<_>>(),
        "settings": settings.collect::<serde_json::Map<_, _>>(),
    })
}

/// What the kerfs set. The last pass leaves the part to size; one before it leaves as much stock as it was meant to, where
/// its gap was stated, else its correction stays.
fn proposed(
    effective: &Effective,
    kerfs: &[Kerf],
    states_correction: bool,
) -> Vec<(&'static str, String)> {
    let mut corrections = effective.each_correction();
    let stated = effective.passes.gaps.clone();
    let radius = effective.wire_diameter.map(|diameter| diameter / 2.0);
    let last = corrections.len();
    let mut gaps: Vec<Option<f64>> = (0..last)
        .map(|pass| match &stated {
            Some(gaps) => gaps.get(pass).copied(),
            None => effective.gap,
        })
        .collect();
    for kerf in kerfs {
        let index = kerf.pass - 1;
        let meant = radius.zip(gaps[index]).map(|(radius, gap)| radius + gap);
        corrections[index] = match meant {
            _ if kerf.pass == last => kerf.half,
            Some(meant) => kerf.half + (corrections[index] - meant).max(0.0),
            None => corrections[index],
        };
        gaps[index] = kerf.gap;
    }
    let all_gaps: Option<Vec<f64>> = gaps.into_iter().collect();
    let all_gaps = all_gaps.filter(|_| radius.is_some());
    let mut values = Vec::new();
    if effective.passes.corrections.is_some() {
        values.push(("passes.corrections", init::list(&corrections)));
        values.extend(all_gaps.map(|gaps| ("passes.gaps", init::list(&gaps))));
        return values;
    }
    let one = |key, all: &[f64]| Some((key, format!("{:.4}", all.first()?)));
    let gap = all_gaps.and_then(|gaps| one("gap", &gaps));
    if gap.is_none() || states_correction {
        values.extend(one("correction", &corrections));
    }
    values.extend(gap);
    values
}

/// A row of the table that is read: its cells by the names of their columns, and what is wrong with them.
struct Row<'a> {
    file: &'a str,
    line: usize,
    columns: &'a [String],
    cells: Vec<String>,
    has_decimal_commas: bool,
    faults: &'a mut Vec<String>,
}

impl Row<'_> {
    fn cell(&self, column: &str) -> Option<&str> {
        let at = self.columns.iter().position(|own| own == column)?;
        let cell = self.cells.get(at)?;
        (!cell.is_empty()).then_some(cell)
    }

    fn wrong<T>(&mut self, column: &str, expected: &str) -> Option<T> {
        let found = self.cell(column).unwrap_or_default();
        let (file, line) = (self.file, self.line);
        let fault = say!(a_cell_is_wrong, file, line, column, found, expected);
        self.faults.push(fault);
        None
    }

    fn length(&mut self, column: &str) -> Option<f64> {
        let text = self.cell(column).unwrap_or_default();
        let length = match self.has_decimal_commas {
            true => positive(&text.replace(',', ".")),
            false => positive(text),
        };
        match length {
            Ok(length) => Some(length),
            Err(expected) => self.wrong(column, &expected),
        }
    }

    /// The measurement; `last` is the pass where none is said.
    fn measurement(&mut self, last: usize) -> Option<Measurement> {
        let is_outer = match self.cell("kind") {
            Some("outer") => Some(true),
            Some("inner") => Some(false),
            _ => self.wrong("kind", &say!(expected, ["outer", "inner"].join(", "))),
        };
        let pass = match self.cell("pass").map(str::parse::<usize>) {
            None => Some(last),
            Some(Ok(pass)) if (1..=last).contains(&pass) => Some(pass),
            Some(_) => self.wrong(
                "pass",
                &say!(expected, say!(a_whole_number_from_to, 1, last)),
            ),
        };
        let (nominal, measured) = (self.length("nominal"), self.length("measured"));
        let feature = self.cell("feature").map(str::to_owned);
        Some(Measurement {
            feature: feature.unwrap_or_else(|| say!(line_number, self.line)),
            is_outer: is_outer?,
            pass: pass?,
            nominal: nominal?,
            measured: measured?,
        })
    }
}

/// The measurements of a table.
///
/// # Errors
/// Each of its faults, with its line.
fn table(path: &Path, last: usize) -> Result<Vec<Measurement>, Vec<String>> {
    let file = &*output::name(path);
    let failed = |reason: String| vec![say!(says, file, reason)];
    let bytes = disk::read_path_at_most(path, LARGEST).map_err(failed)?;
    let text = String::from_utf8(Writing::read(bytes).0)
        .map_err(|_| failed(say!(it_is_not_utf_8_text).into()))?;
    let rows = text.trim_start_matches('\u{feff}').lines().enumerate();
    let mut rows = rows.filter(|(_, row)| !row.trim().is_empty() && !row.starts_with('#'));
    let (index, head) = rows.next().unwrap_or_default();
    let between = [';', '\t'].into_iter().find(|sign| head.contains(*sign));
    let between = between.unwrap_or(',');
    let cells = |row: &str| -> Vec<String> {
        let cells = row.split(between).map(str::trim);
        cells
            .map(|cell| cell.trim_matches('"').to_owned())
            .collect()
    };
    let columns = cells(&head.to_ascii_lowercase());
    let is_there = |name: &&str| columns.iter().any(|own| own == name);
    let is_known = |name: &String| COLUMNS.contains(&name.as_str());
    if !columns.iter().all(is_known) || !NEEDED.iter().all(is_there) {
        let (all, needed) = (COLUMNS.join(", "), NEEDED.join(", "));
        return Err(vec![say!(
            a_head_of_other_columns,
            file,
            index + 1,
            head,
            all,
            needed
        )]);
    }
    let (mut measurements, mut faults) = (Vec::new(), Vec::new());
    let mut lines: BTreeMap<String, (bool, f64, usize)> = BTreeMap::new();
    for (index, row) in rows {
        let (line, cells) = (index + 1, cells(row));
        if cells.len() != columns.len() {
            let (found, expected) = (cells.len(), columns.len());
            faults.push(say!(a_row_of_other_cells, file, line, found, expected));
            continue;
        }
        let read = Row {
            file,
            line,
            columns: &columns,
            cells,
            has_decimal_commas: between == ';',
            faults: &mut faults,
        }
        .measurement(last);
        let Some(one) = read else { continue };
        let own = (one.is_outer, one.nominal, line);
        let (is_outer, nominal, first) = *lines.entry(one.feature.clone()).or_insert(own);
        match (is_outer, nominal) == (one.is_outer, one.nominal) {
            true => measurements.push(one),
            false => faults.push(say!(a_feature_is_another, file, line, one.feature, first)),
        }
    }
    if measurements.is_empty() && faults.is_empty() {
        faults = failed(say!(nothing_is_measured).into());
    }
    match faults.is_empty() {
        true => Ok(measurements),
        false => Err(faults),
    }
}
