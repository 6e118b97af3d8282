//! Every contradiction is said by `check`, and by `generate` and `pair`, which make nothing of an error.

use super::Desk;

#[path = "../support/contradictions.rs"]
mod rows;

use rows::CONTRADICTIONS;

#[test]
fn contradictions_are_findings_and_never_a_default() {
    let mut silent = Vec::new();
    for row in CONTRADICTIONS {
        let desk = Desk::new();
        desk.write("wedm.toml", row.settings);
        desk.write("x.dxf", row.dxf());
        let (settings, rule, says) = (row.settings, row.rule, row.says);
        let checked = desk.run("check x.dxf");
        let title = format!("[{rule}]: ");
        let mut lines = checked.stdout.lines();
        let Some(found) = lines.find(|line| line.contains(&title) && line.contains(says)) else {
            silent.push(format!("check {settings:?}: {checked:?}"));
            continue;
        };
        let is_error = found.starts_with("error");
        if checked.code != Some(i32::from(is_error)) && !checked.stdout.contains("error") {
            silent.push(format!(
                "check of {settings:?} ends with {:?}",
                checked.code
            ));
        }
        let format = match settings.contains("milling") {
            true => "milling",
            false => "3b",
        };
        let generated = desk.run(&format!(
            "generate x.dxf --format {format} -o x.out --overwrite"
        ));
        let is_said = generated.stderr.contains(says);
        let is_made = desk.path("x.out").exists();
        if !is_said || is_error && is_made {
            silent.push(format!(
                "generate {settings:?}: made: {is_made}, {generated:?}"
            ));
        }
        let paired = desk.run("pair x.dxf");
        if !paired.stderr.contains(says) && paired.code == Some(0) {
            silent.push(format!("pair {settings:?}: {paired:?}"));
        }
        // Nothing there is cut as a pair.
        if rule == "does-not-fit" && paired.code != Some(1) {
            silent.push(format!("pair {settings:?} makes programs: {paired:?}"));
        }
    }
    assert!(silent.is_empty(), "{}", silent.join("\n\n"));
}
