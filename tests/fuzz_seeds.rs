//! The fuzz targets over their seeds, as plain tests: what fuzzing found once stays mended. `fuzz/run` draws inputs of its own.

#[allow(dead_code, reason = "a target has more than what its seeds need")]
#[path = "../fuzz/src/lib.rs"]
pub(crate) mod targets;

use std::path::Path;

/// Runs a target over its seeds: those of its name, else those of the first word of it. `fuzz/run` chooses them alike.
fn over_seeds(target: &str, run: fn(&[u8])) {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds");
    let word = target.split('_').next().unwrap_or(target);
    let names = [target, word, "server_frames"];
    let folder = names
        .iter()
        .map(|name| seeds.join(name))
        .find(|folder| folder.is_dir())
        .unwrap_or_else(|| panic!("no seeds for {target}"));
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    run(&[]);
    for path in paths {
        println!("{}", path.display());
        run(&std::fs::read(path).unwrap());
    }
}

macro_rules! seeds {
    ($($target:ident)*) => {
        $(#[test]
        fn $target() {
            over_seeds(stringify!($target), targets::$target::run);
        })*

        #[test]
        fn every_target_is_here() {
            let manifest = include_str!("../fuzz/Cargo.toml");
            let here = [$(stringify!($target)),*];
            for line in manifest.lines().filter(|line| line.contains("path = \"fuzz_targets/")) {
                let name = line.split('"').nth(1).unwrap_or_default();
                assert!(here.contains(&name), "{name} is not run over its seeds");
            }
        }
    };
}

seeds! {
    dxf_lexer
    dxf_reader
    incremental_equals_fresh
    iso_reader
    server_frames
    server_messages
    three_b_controller
    three_b_reader
}

/// The targets have a lock file of their own, with which `fuzz/run` builds them.
#[test]
fn the_lock_file_of_the_targets_knows_what_wedm_needs() {
    let manifest: toml::Table = include_str!("../Cargo.toml").parse().unwrap();
    let lock: toml::Table = include_str!("../fuzz/Cargo.lock").parse().unwrap();
    let packages = lock["package"].as_array().unwrap();
    let wedm = packages
        .iter()
        .find(|package| package["name"].as_str() == Some("wedm"));
    let known = wedm.unwrap()["dependencies"].as_array().unwrap();
    for (name, stated) in manifest["dependencies"].as_table().unwrap() {
        let package = stated
            .get("package")
            .and_then(toml::Value::as_str)
            .unwrap_or(name);
        // Where a crate is there in two versions, its version follows.
        let is_it = |known: &toml::Value| {
            known.as_str().and_then(|known| known.split(' ').next()) == Some(package)
        };
        assert!(
            known.iter().any(is_it),
            "fuzz/Cargo.lock lacks {package}: `cargo check` in fuzz/ writes it"
        );
    }
}
