//! Drawings of programs, opened by others.

use super::*;

/// A drawing that is made is opened and printed by LibreCAD. Skipped where that is not installed.
#[test]
fn what_is_drawn_is_opened_by_librecad() {
    let folder = tempfile::tempdir().unwrap();
    // Asked for its version it opens a window and waits.
    let is_installed = std::env::var_os("PATH").is_some_and(|path| {
        std::env::split_paths(&path).any(|folder| folder.join("librecad").is_file())
    });
    if !is_installed {
        eprintln!("skipped: LibreCAD is not installed");
        return;
    }
    std::fs::write(
        folder.path().join("hole.3b"),
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
    )
    .unwrap();
    let (code, _, stderr) = wedm(folder.path(), "convert hole.3b -o hole.dxf");
    assert_eq!(code, 0, "{stderr}");
    let printed = Command::new("timeout")
        .args(["60", "librecad", "dxf2pdf", "hole.dxf"])
        .current_dir(folder.path())
        .env("QT_QPA_PLATFORM", "offscreen")
        .env("HOME", folder.path())
        .stdin(std::process::Stdio::null())
        .output()
        .unwrap();
    let pdf = std::fs::read(folder.path().join("hole.pdf")).unwrap_or_default();
    assert!(
        pdf.starts_with(b"%PDF") && pdf.len() > 800,
        "{}",
        String::from_utf8_lossy(&printed.stderr)
    );
    // The sheet is A4 on its long side, 297 by 210 mm in points of 1/72 inch, not a few millimetres.
    let text = String::from_utf8_lossy(&pdf);
    let sheet = text
        .split("/MediaBox [")
        .nth(1)
        .and_then(|rest| rest.split(']').next())
        .unwrap_or_default();
    let lengths: Vec<f64> = sheet
        .split_whitespace()
        .filter_map(|length| length.parse().ok())
        .collect();
    assert!(
        matches!(lengths[..], [_, _, width, height] if (width - 842.0).abs() < 3.0 && (height - 595.0).abs() < 3.0),
        "{sheet}"
    );
}

/// An interpreter that has ezdxf: that of the environment which `tests/run` and the benchmark of reading use, else the machine's own.
fn python_with_ezdxf() -> Option<PathBuf> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/ezdxf/bin/python");
    let has_it = |python: &PathBuf| {
        Command::new(python)
            .args(["-c", "import ezdxf"])
            .output()
            .is_ok_and(|output| output.status.success())
    };
    [own, PathBuf::from("python3")].into_iter().find(has_it)
}

/// A drawing that is made is read by another program without a fault. Skipped where no Python has ezdxf.
#[test]
fn what_is_drawn_passes_the_audit_of_ezdxf() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("hole.3b"),
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
    )
    .unwrap();
    let Some(python) = python_with_ezdxf() else {
        assert!(
            std::env::var_os("CI").is_none(),
            "no Python has ezdxf: `tests/run tests` installs it into target/ezdxf"
        );
        eprintln!("skipped: no Python has ezdxf; `tests/run tests` installs it into target/ezdxf");
        return;
    };
    let (code, _, stderr) = wedm(folder.path(), "convert hole.3b -o hole.dxf");
    assert_eq!(code, 0, "{stderr}");
    let script = "
import ezdxf, math, sys
document = ezdxf.readfile(sys.argv[1])
auditor = document.audit()
print(document.dxfversion, len(auditor.errors), len(auditor.fixes))
for entity in document.modelspace():
    if entity.dxftype() == 'LWPOLYLINE':
        points = entity.get_points('xyb')
        print('LWPOLYLINE', entity.closed, ' '.join('%.6f,%.6f,%.9f' % tuple(point) for point in points))
    else:
        print(entity.dxftype(), entity.dxf.layer)
";
    let output = Command::new(python)
        .args(["-c", script])
        .arg(folder.path().join("hole.dxf"))
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(
        text,
        "AC1015 0 0\nLINE LEAD\nLWPOLYLINE True 9.900000,0.000000,1.000000000 -9.900000,0.000000,1.000000000\nLINE LEAD\n",
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// Contours of a 4B program that are entered from different sides lie as far from each other as they are drawn.
#[test]
fn contours_of_four_b_lie_where_the_part_has_them() {
    let folder = tempfile::tempdir().unwrap();
    let rectangle = |handle: &str, [left, low, right, high]: [f64; 4]| {
        let vertices = [
            (left + 2.0, low, 0.0),
            (right - 2.0, low, 0.41421356237),
            (right, low + 2.0, 0.0),
            (right, high - 2.0, 0.41421356237),
            (right - 2.0, high, 0.0),
            (left + 2.0, high, 0.41421356237),
            (left, high - 2.0, 0.0),
            (left, low + 2.0, 0.41421356237),
        ];
        let vertices = vertices.map(|(x, y, bulge)| format!("10\n{x}\n20\n{y}\n42\n{bulge}\n"));
        format!(
            "0\nLWPOLYLINE\n5\n{handle}\n8\n0\n90\n8\n70\n1\n{}",
            vertices.concat()
        )
    };
    let drawn = [[0.0, 0.0, 20.0, 10.0], [40.0, 0.0, 50.0, 20.0]];
    let text = format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}{}0\nENDSEC\n0\nEOF\n",
        rectangle("2A", drawn[0]),
        rectangle("2B", drawn[1])
    );
    std::fs::write(folder.path().join("two.dxf"), text).unwrap();
    for (side, correction) in [("opening", "0.1"), ("punch", "0.155")] {
        for arguments in [
            format!(
                "generate two.dxf --side {side} --correction {correction} --format 4b -o {side}.4b --overwrite"
            ),
            format!("convert {side}.4b --correction {correction} -o {side}.dxf --overwrite"),
        ] {
            let (code, _, errors) = wedm(folder.path(), &arguments);
            assert_eq!(code, 0, "{arguments}: {errors}");
        }
        let back =
            dxf::Document::read(std::fs::read(folder.path().join(format!("{side}.dxf"))).unwrap());
        let contours = back
            .drawing()
            .entities()
            .filter_map(|(_, entity)| match entity.geometry {
                Geometry::Polyline { .. } => Some(entity.geometry.segments().collect::<Vec<_>>()),
                _ => None,
            });
        let middles: Vec<Point> = contours
            .map(|segments| {
                let starts = segments.iter().map(|segment| segment.start());
                let low = starts.clone().reduce(|one, other| one.inf(&other)).unwrap();
                let high = starts.reduce(|one, other| one.sup(&other)).unwrap();
                low + (high - low) * 0.5
            })
            .collect();
        let apart = middles[1] - middles[0];
        assert!(
            (apart.x - 35.0).abs() < 2e-3 && (apart.y - 5.0).abs() < 2e-3,
            "{side}: {apart}"
        );
    }
}
