//! What is read ahead, in stretches of a few lines, equals what is read in order.

use super::super::Document;
use crate::text::SourceText;
use proptest::prelude::*;

const RECORDS: [&str; 14] = [
    "0 LINE 5 A 8 DIE 10 1.0 20 2.0 11 3.0 21 2.5",
    "0 LINE 8 \u{5c42} 6 HIDDEN 10 1.0 20 2.0 11 3.0 21 x",
    "0 ARC 5 B 8 DIE 10 1 20 2 40 3 50 1 51 2",
    "0 LWPOLYLINE 5 C 8 P 90 3 70 1 10 0 20 0 42 1 10 1 20 1 10 2 20 0",
    "0 POLYLINE 66 1 8 P 0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 0 VERTEX 10 1 20 1 0 SEQEND",
    "0 INSERT 2 X 8 P 66 1 0 ATTRIB 10 1 20 1 1 a 0 SEQEND",
    "0 SPLINE 8 P 70 8 71 3 72 8 73 4 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 0 20 0 10 1 20 1 10 2 20 1 10 3 20 0",
    "0 ENDSEC",
    "0 SECTION 2 ENTITIES",
    "0 SECTION 2 BLOCKS 0 BLOCK 2 X 10 0 20 0 0 CIRCLE 10 1 20 1 40 2 0 ENDBLK 0 ENDSEC",
    "0 SECTION 2 TABLES 0 LAYER 2 P 70 0 62 -3 0 ENDSEC",
    "0 MTEXT 10 1 20 1 1 t 1001 ACAD 1000 ACAD_MTEXT_TEXT_BORDERS_BEGIN 1005 C 1000 ACAD_MTEXT_TEXT_BORDERS_END",
    "0 EOF",
    "x",
];

/// All that a reading of these lines leaves.
fn read(lines: &[String], stretch: Option<usize>) -> String {
    let mut document = Document {
        text: SourceText::new(lines.join("\n").into_bytes()),
        ..Document::default()
    };
    let reading = document.read_items_ahead(None, stretch);
    format!(
        "{:#?}",
        (
            &document.findings,
            &document.table,
            &reading.drawing,
            &reading.blocks,
            &reading.frames,
            (reading.unit, reading.any_record, reading.early)
        )
    )
}

proptest! {
    #[test]
    fn reading_ahead_equals_reading_in_order(
        chosen in prop::collection::vec(0..RECORDS.len() * 3, 0..40),
        lost in prop::collection::vec(0.0..1.0f64, 0..3),
        stretch in 1..30usize,
    ) {
        // Mostly entities.
        let records = chosen.into_iter().map(|at| RECORDS[if at < RECORDS.len() { at } else { at % 7 }]);
        let text = ["0 SECTION 2 ENTITIES"].into_iter().chain(records);
        let mut lines: Vec<String> = text.flat_map(|record| record.split(' ').map(str::to_owned)).collect();
        for share in lost {
            lines.remove((share * lines.len() as f64) as usize);
        }
        prop_assert_eq!(read(&lines, Some(stretch)), read(&lines, None));
    }
}
