//! The commands that pages show do what is shown.

use super::*;

#[test]
fn the_commands_of_the_readme_do_what_it_shows() {
    the_commands_do_what_is_shown("README.md", "C");
}

#[test]
fn the_chinese_readme_shows_the_same_commands_which_answer_in_chinese() {
    let of = |name: &str| -> Vec<(String, i32)> {
        let shown = commands(&read(&root().join(name))).into_iter();
        shown.map(|shown| (shown.command, shown.code)).collect()
    };
    assert_eq!(of("README.md"), of("README.zh-CN.md"));
    the_commands_do_what_is_shown("README.zh-CN.md", "zh_CN.UTF-8");
}

/// The drawings that the pages speak of stand beside the reader, and those of the tests where a checkout has them. Commands of other
/// programs are shown, not run.
#[test]
fn the_commands_of_tutorials_and_how_to_do_what_they_show() {
    the_commands_do_what_is_shown("docs/how-to.md", "C");
    for name in ["librecad", "browser", "vscode", "python"] {
        the_commands_do_what_is_shown(&format!("docs/tutorials/{name}.md"), "C");
    }
}

/// The suppression that the how-to shows, in both languages, suppresses what it speaks of.
#[test]
fn the_suppression_of_the_how_to_suppresses() {
    for name in ["docs/how-to.md", "docs/zh/how-to.md"] {
        let page = read(&root().join(name));
        let mut blocks = page.split("```toml").skip(1);
        let lines = blocks.find(|block| block.contains(".suppress.")).unwrap();
        let lines = lines.split("```").next().unwrap();
        let folder = tempfile::tempdir().unwrap();
        std::fs::copy(
            root().join("docs/pictures/gap.dxf"),
            folder.path().join("gap.dxf"),
        )
        .unwrap();
        std::fs::write(folder.path().join("wedm.toml"), lines).unwrap();
        let output = wedm(folder.path(), &["check", "gap.dxf", "--deny", "warning"]);
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(
            output.status.success() && said.contains("1 suppressed"),
            "{name}: {said}"
        );
    }
}
