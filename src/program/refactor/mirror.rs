//! Mirror and rotate a program about the origin of its frame: its zero, or where it begins, where nothing says otherwise.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GYL2         G01 X5. Y0.                G01 X0. Y5.
//! B5000B0B10000GYNR1    →    B0B5000B10000GXNR2       G03 X0. Y5. I-5. J0.  →    G03 X-5. Y0. I0. J-5.     (a quarter turn)
//! ```
//!
//! Every number stays as it is written; only axes, quadrants, letters and signs change. So the
//! transformation is exact.

use super::{Edits, Notation, Refactoring, Rewrite, Sheet, Transform};

pub(super) fn all<N: Notation>() -> [Refactoring<N>; 5] {
    [
        Refactoring {
            id: "refactor.rewrite.mirror.x",
            title: |_| say!(mirror_left_and_right).into(),
            rewrite: |sheet| transformed(sheet, [-1, 0, 0, 1]),
        },
        Refactoring {
            id: "refactor.rewrite.mirror.y",
            title: |_| say!(mirror_up_and_down).into(),
            rewrite: |sheet| transformed(sheet, [1, 0, 0, -1]),
        },
        Refactoring {
            id: "refactor.rewrite.rotate.left",
            title: |_| say!(rotate_by_90_counter_clockwise).into(),
            rewrite: |sheet| transformed(sheet, [0, -1, 1, 0]),
        },
        Refactoring {
            id: "refactor.rewrite.rotate.right",
            title: |_| say!(rotate_by_90_clockwise).into(),
            rewrite: |sheet| transformed(sheet, [0, 1, -1, 0]),
        },
        Refactoring {
            id: "refactor.rewrite.rotate.half",
            title: |_| say!(rotate_by_180).into(),
            rewrite: |sheet| transformed(sheet, [-1, 0, 0, -1]),
        },
    ]
}

fn transformed<N: Notation>(sheet: &Sheet<'_, N>, [xx, xy, yx, yy]: [i64; 4]) -> Edits {
    let transform = Transform { xx, xy, yx, yy };
    let content = sheet.content()?;
    let mut rewrite = Rewrite::new();
    for row in 0..content.rows.len() {
        let new = N::transformed(sheet.at(content, row), transform);
        rewrite.rows.insert(row, vec![new]);
    }
    N::transform_words(sheet, transform, &mut rewrite)?;
    let first = content.rows.first();
    rewrite.start = first.map(|row| transform.of_node(row.from));
    rewrite.end = Some(transform.of_point(sheet.trace.end()));
    rewrite.edits(sheet, content)
}
