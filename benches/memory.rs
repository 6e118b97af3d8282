//! Where memory goes, by structure: `cargo bench --bench memory`.
//!
//! Counted by the allocator: bytes that are in use beyond the text, for each byte of text. What the allocator itself keeps, and
//! what the process as a whole has, is in `cargo bench --bench session`.

mod generated;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use wedm::analysis::Analysis;
use wedm::drawing::Chains;
use wedm::program::{self, Language};
use wedm::settings::Effective;
use wedm::text::SourceText;

struct Counting;

static IN_USE: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all calls go to the system's allocator as they come; only their sizes are counted.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let now = IN_USE.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        MOST.fetch_max(now, Ordering::Relaxed);
        // SAFETY: the caller's promise about the layout is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: what was allocated above goes back with the same layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn in_use() -> usize {
    IN_USE.load(Ordering::Relaxed)
}

fn main() {
    println!(
        "{:<32} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}   goal",
        "for each byte of text", "lines", "reader", "chains", "the rest", "in all", "most"
    );
    for (name, text) in [
        ("5 MB of LWPOLYLINE", generated::polylines(5_000_000)),
        ("5 MB of LINE and ARC", generated::lines_and_arcs(5_000_000)),
        ("5 MB, one LWPOLYLINE", generated::one_polyline(140_000)),
    ] {
        let size = text.len();
        let share = |bytes: usize| format!("{:.2}", bytes as f64 / size as f64);
        let settings = Arc::new(Effective::default());
        let of_lines = of_lines(&text);
        let bytes = text.clone().into_bytes();
        let before = in_use() - bytes.capacity();
        MOST.store(in_use(), Ordering::Relaxed);
        let document = wedm::dxf::Document::read(bytes);
        let of_document = in_use() - before - size;
        let drawing = document.drawing();
        let at = in_use();
        let chains = Chains::new(drawing, 0.01, &|id| {
            drawing
                .get(id)
                .is_some_and(|entity| entity.geometry.segment_count() > 0)
        });
        let of_chains = in_use() - at;
        drop(chains);
        let mut analysis = Analysis::new(drawing, settings);
        let findings = analysis.findings(drawing, 500);
        let (all, most) = (
            in_use() - before - size,
            MOST.load(Ordering::Relaxed) - before - size,
        );
        println!(
            "{name:<32} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}   3",
            share(of_lines),
            share(of_document - of_lines),
            share(of_chains),
            share(all - of_document - of_chains),
            share(all),
            share(most)
        );
        drop(findings);
    }
    for (name, language, text) in [
        ("5 MB 3B", Language::ThreeB, generated::three_b(200_000)),
        ("5 MB ISO", Language::Iso, generated::iso(200_000)),
        (
            "5 MB 3B, the same squares round",
            Language::ThreeB,
            generated::three_b_round(200_000),
        ),
        (
            "5 MB ISO, the same squares round",
            Language::Iso,
            generated::iso_round(200_000),
        ),
        (
            "5 MB ISO, holes of every size",
            Language::Iso,
            generated::iso_holes(200_000),
        ),
    ] {
        let size = text.len();
        let share = |bytes: usize| format!("{:.2}", bytes as f64 / size as f64);
        let lines = of_lines(&text);
        let bytes = text.into_bytes();
        let before = in_use() - bytes.capacity();
        MOST.store(in_use(), Ordering::Relaxed);
        let document = program::Document::read(language, bytes, &Effective::default());
        let (all, most) = (
            in_use() - before - size,
            MOST.load(Ordering::Relaxed) - before - size,
        );
        println!(
            "{name:<32} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}   3",
            share(lines),
            share(all - lines),
            "",
            "",
            share(all),
            share(most)
        );
        drop(document);
    }
}

/// Bytes that the lines of a text take.
fn of_lines(text: &str) -> usize {
    let bytes = text.as_bytes().to_vec();
    let before = in_use() - bytes.capacity();
    let lines = SourceText::new(bytes);
    let taken = in_use() - before - lines.len();
    drop(lines);
    taken
}
