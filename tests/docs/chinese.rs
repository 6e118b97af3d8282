//! The Chinese pages have what the English ones have.

use super::*;

/// What a page is made of: depths of headings; blocks of code, of which TOML without its comments and otherwise how many lines; rows of
/// tables; and where links lead.
fn shape(page: &str) -> (Vec<usize>, Vec<Vec<String>>, usize, Vec<String>) {
    let (mut headings, mut blocks, mut is_code) = (Vec::new(), Vec::new(), false);
    for line in page.lines() {
        if line.starts_with("```") {
            is_code = !is_code;
            if is_code {
                blocks.push(vec![line.to_owned()]);
            }
        } else if let Some(block) = blocks.last_mut().filter(|_| is_code) {
            let is_toml = block[0] == "```toml";
            let code = line.split('#').next().unwrap_or_default().trim_end();
            block.push(if is_toml { code } else { "" }.to_owned());
        } else if line.starts_with('#') {
            headings.push(line.chars().take_while(|mark| *mark == '#').count());
        }
    }
    let rows = page.lines().filter(|line| line.starts_with('|')).count();
    let file = |target: String| target.split('#').next().unwrap_or_default().to_owned();
    let mut targets: Vec<String> = links(page).into_iter().map(file).collect();
    targets.sort_unstable();
    (headings, blocks, rows, targets)
}

#[test]
fn every_page_of_a_rule_has_its_twin_in_chinese() {
    for rule in Rule::ALL {
        let name = rule.name();
        let page = read(&root().join(format!("docs/rules/{name}.md")));
        let twin = read(&root().join(format!("docs/zh/rules/{name}.md")));
        assert!(twin.starts_with(&format!("# {name}\n")), "{name}");
        let twin = twin.replace("](../../", "](../");
        assert_eq!(shape(&page), shape(&twin), "{name}");
        let default = format!("{:?}", rule.default_severity()).to_lowercase();
        assert!(
            twin.contains("默认级别：") && twin.contains(&format!("（{default}）")),
            "{name}: {default} is not said"
        );
    }
}

/// The same list in Chinese: the sentences are those of `wedm explain`, the severities those of the pages.
#[test]
fn the_list_of_rules_in_chinese_is_the_english_one() {
    let path = root().join("docs/zh/rules/README.md");
    let committed = read(&path);
    let head = "|---|---|---|:-:|:-:|:-:|:-:|\n";
    let (before, rest) = committed.split_once(head).expect("a table");
    let (_, behind) = rest.split_once("\n## ").expect("what stands below it");
    let listed = wedm_in("zh_CN.UTF-8", &root(), &["explain"]).stdout;
    let listed = String::from_utf8(listed).unwrap();
    let summary_of = |name: &str| {
        let line = listed
            .lines()
            .find(|line| line.split_whitespace().next() == Some(name));
        let mut words = line.expect(name).splitn(2, char::is_whitespace);
        let rest = words.nth(1).unwrap().trim_start();
        rest.split_once(char::is_whitespace)
            .unwrap()
            .1
            .trim()
            .to_owned()
    };
    let english = read(&root().join("docs/rules/README.md"));
    let row = |rule: Rule| {
        let name = rule.name();
        let severity = rules::severity_on_chinese_page(rule);
        let row = english
            .lines()
            .find(|line| line.starts_with(&format!("| [{name}](")))
            .unwrap_or_else(|| panic!("docs/rules/README.md does not list {name} yet"));
        // After the last bar stands nothing; before it the four kinds of documents.
        let cells: Vec<&str> = row.rsplitn(6, " |").collect();
        let dots: String = cells[1..5]
            .iter()
            .rev()
            .map(|cell| format!("{cell} |"))
            .collect();
        format!(
            "| [{name}]({name}.md) | {} | {severity} |{dots}\n",
            summary_of(name)
        )
    };
    let rows: String = Rule::ALL.into_iter().map(row).collect();
    let reasons_head = "| 规则 | 为什么别处没有 |\n|---|---|\n";
    let (behind, _) = behind
        .split_once(reasons_head)
        .expect("why a cell stays empty");
    let reasons = super::rules::reasons("docs/zh/rules", "为什么别处没有：", "、");
    let list = format!("{before}{head}{rows}\n## {behind}{reasons_head}{reasons}");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &list).unwrap();
    }
    assert!(
        read(&path) == list,
        "docs/zh/rules/README.md is out of date; update it with: UPDATE_EXPECT=1 cargo test --test command_line docs"
    );
}

/// Whole pages in Chinese have the same parts, tables, examples and links.
#[test]
fn whole_pages_have_their_twins_in_chinese() {
    for name in ["settings", "programs", "any-cad", "command-line", "editing"] {
        let [english, chinese] = ["docs", "docs/zh"].map(|folder| {
            let page = read(&root().join(format!("{folder}/{name}.md")));
            let (headings, blocks, rows, targets) = shape(&page);
            let english = |target: &String| {
                let target = target.trim_start_matches("../");
                target.replace("README.zh-CN.md", "README.md")
            };
            let mut targets: Vec<String> = targets.iter().map(english).collect();
            targets.sort_unstable();
            // Each leads to the other.
            targets.retain(|target| !target.ends_with(&format!("{name}.md")));
            (headings, blocks, rows, targets)
        });
        assert_eq!(english, chinese, "{name}");
    }
}

/// The Chinese readme leads everywhere that the English one does, to the page in Chinese where there is one, and has the same tables.
#[test]
fn the_chinese_readme_has_what_the_english_one_has() {
    let [english, chinese] = ["README.md", "README.zh-CN.md"].map(|name| read(&root().join(name)));
    let own = links(&chinese);
    let twin = |link: &String| {
        let page = match link.strip_prefix("docs/") {
            Some("glossary.md") => "docs/zh/words.md".to_owned(),
            Some(page) => format!("docs/zh/{page}"),
            None => link.clone(),
        };
        // Headings have other names there.
        let page = page.split('#').next().unwrap_or_default();
        own.contains(link) || own.iter().any(|own| own.split('#').next() == Some(page))
    };
    let other = |link: &&String| link.as_str() != "README.zh-CN.md";
    let missing: Vec<String> = links(&english)
        .iter()
        .filter(other)
        .filter(|link| !twin(link))
        .cloned()
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
    let rows = |page: &str| page.lines().filter(|line| line.starts_with('|')).count();
    assert!(rows(&chinese) >= rows(&english), "a table lacks rows");
}

/// The how-to in Chinese has the same parts, commands and settings, and its commands answer in Chinese.
#[test]
fn the_how_to_has_its_twin_in_chinese() {
    let [english, chinese] =
        ["docs/how-to.md", "docs/zh/how-to.md"].map(|name| read(&root().join(name)));
    let of = |page: &str| -> Vec<(String, i32)> {
        let shown = commands(page).into_iter();
        shown.map(|shown| (shown.command, shown.code)).collect()
    };
    assert_eq!(of(&english), of(&chinese));
    let parts = |page: &str| page.lines().filter(|line| line.starts_with('#')).count();
    assert_eq!(parts(&english), parts(&chinese));
    let settings = |page: &str| -> Vec<String> {
        let blocks = page.split("```toml").skip(1);
        let lines = blocks.flat_map(|block| block.split("```").next().unwrap().lines());
        // The reason of a suppression is a sentence.
        let keys = lines.map(|line| line.split(" = \"").next().unwrap().to_owned());
        keys.collect()
    };
    assert_eq!(settings(&english), settings(&chinese));
    the_commands_do_what_is_shown("docs/zh/how-to.md", "zh_CN.UTF-8");
}

/// The tutorials in Chinese show the same commands and the same Python.
#[test]
fn the_tutorials_have_their_twins_in_chinese() {
    let python = |page: &str| -> Vec<String> {
        let blocks = page.split("```python").skip(1);
        let code = blocks.flat_map(|block| block.split("```").next().unwrap().lines());
        let calls = code.map(|line| line.split(['#', '"']).next().unwrap().trim().to_owned());
        calls.collect()
    };
    for entry in std::fs::read_dir(root().join("docs/tutorials")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let english = read(&root().join("docs/tutorials").join(&name));
        let twin = format!("docs/zh/tutorials/{name}");
        let chinese = read(&root().join(&twin));
        let of = |page: &str| -> Vec<(String, i32)> {
            let shown = commands(page).into_iter();
            shown.map(|shown| (shown.command, shown.code)).collect()
        };
        assert_eq!(of(&english), of(&chinese), "{twin}");
        assert_eq!(python(&english), python(&chinese), "{twin}");
        the_commands_do_what_is_shown(&twin, "zh_CN.UTF-8");
    }
}
