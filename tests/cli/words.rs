//! Help, manual pages and refusals, in the language that is spoken.

use super::{Desk, Ended, check};

#[test]
fn manual_pages_are_written_for_every_command() {
    let desk = Desk::new();
    check(&desk, "man pages", 0, &[]);
    for page in ["wedm", "wedm-check", "wedm-generate", "wedm-man"] {
        let text = String::from_utf8(desk.read(&format!("pages/{page}.1"))).unwrap();
        assert!(text.contains(".TH ") && text.contains(".SH NAME"), "{text}");
    }
}

/// What the words of a command are refused with, too; not a word of clap's own is left.
#[test]
fn what_is_refused_is_said_in_chinese_where_that_is_spoken() {
    let desk = Desk::new();
    for (arguments, texts) in [
        (
            "check --corection 1",
            [
                "没有 '--corection' 这个选项",
                "是否想写：--correction",
                "用法：wedm check",
            ],
        ),
        (
            "chek",
            ["没有 'chek' 这个命令", "是否想写：check", "用法：wedm"],
        ),
        (
            "check --output foo",
            [
                "'--output <OUTPUT>' 的值 'foo' 无效",
                "可选：text, concise",
                "详见 '--help'。",
            ],
        ),
        (
            "check --select smal-radius",
            [
                "的值 'smal-radius' 无效",
                "是否想写：small-radius",
                "错误：",
            ],
        ),
        (
            "check --correction",
            [
                "'--correction <MM>' 需要一个值",
                "详见 '--help'。",
                "错误：",
            ],
        ),
        (
            "check --correction=x",
            [
                "'--correction <MM>' 的值 'x' 无效：",
                "详见 '--help'。",
                "错误：",
            ],
        ),
        (
            "draw",
            ["缺少必需的参数：", "用法：wedm draw", "详见 '--help'。"],
        ),
        (
            "fix tight.dxf --in-place --diff",
            ["不能与", "同时使用", "用法：wedm fix"],
        ),
        (
            "draw tight.dxf two.dxf",
            ["'two.dxf'", "用法：wedm draw", "详见 '--help'。"],
        ),
    ] {
        let ended = desk.run(&format!("--lang zh {arguments}"));
        assert_eq!(ended.code, Some(2), "{arguments}: {ended:?}");
        for text in texts {
            assert!(
                ended.stderr.contains(text),
                "{arguments}: no {text} in {}",
                ended.stderr
            );
        }
        for english in [
            "error:", "Usage:", "tip:", "For more", "similar", "possible", "{",
        ] {
            assert!(
                !ended.stderr.contains(english),
                "{arguments}: {english} in {}",
                ended.stderr
            );
        }
        check(&desk, arguments, 2, &["!error:"]);
    }
}

/// The help speaks the language that is asked for; what is typed stays.
#[test]
fn the_help_is_in_chinese_where_that_is_spoken() {
    let desk = Desk::new();
    for (arguments, texts) in [
        (
            "--lang zh --help",
            ["用法：wedm", "检查图形和程序有什么问题", "退出码"],
        ),
        (
            "check --help --lang zh",
            ["--statistics", "不列出问题", "设置"],
        ),
        (
            "generate --help --lang zh",
            ["写出图形的程序", "[默认：3.0]", "--layout"],
        ),
        (
            "generate -h --lang=zh",
            ["封闭轮廓的切割方向", "示例：", "wedm generate plate.dxf"],
        ),
    ] {
        check(&desk, arguments, 0, &texts);
    }
    let mut command = desk.command("inspect --help");
    command.env("LC_ALL", "zh_CN.UTF-8");
    assert!(
        Ended::of(command.output().unwrap())
            .stdout
            .contains("列出每一段的半径和判定")
    );
    check(
        &desk,
        "check --help",
        0,
        &["Usage: wedm check", "Settings:"],
    );
    let chinese = desk.run("check --help --lang zh").stdout;
    assert!(
        chinese.contains("- concise: 每个问题一行") && chinese.contains("没有时看内容"),
        "{chinese}"
    );
    assert!(
        !chinese.contains("[default") && !chinese.contains("ossible values"),
        "{chinese}"
    );
    check(
        &desk,
        "init zh --wire 0.2 --gap 0.01 --passes 1 --machine 3b --lang zh",
        2,
        &[],
    );
    desk.write("zh/plate.dxf", "");
    check(
        &desk,
        "init zh --wire 0.2 --gap 0.01 --passes 1 --machine 3b --lang zh",
        0,
        &[],
    );
    let written = String::from_utf8(desk.read("zh/wedm.toml")).unwrap();
    assert!(
        written.contains("# 电极丝直径，mm\nwire-diameter = 0.2"),
        "{written}"
    );
}
