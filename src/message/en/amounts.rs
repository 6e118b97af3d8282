//! How many of what, and words that stand beside what is not text of ours.

declare! {
    arcs(count: usize) => { counted(*count, "arc", "arcs") };
    blocks(count: usize) => { counted(*count, "block", "blocks") };
    chorded_arcs(count: usize) => { counted(*count, "chorded arc", "chorded arcs") };
    contours(count: usize) => { counted(*count, "contour", "contours") };
    diagnostics(count: usize) => { counted(*count, "diagnostic", "diagnostics") };
    doubles(count: usize) => { counted(*count, "duplicate", "duplicates") };
    entities(count: usize) => { counted(*count, "entity", "entities") };
    errors(count: usize) => { counted(*count, "error", "errors") };
    features(count: usize) => { counted(*count, "feature", "features") };
    files(count: usize) => { counted(*count, "file", "files") };
    findings(count: usize) => { counted(*count, "finding", "findings") };
    gaps(count: usize) => { counted(*count, "gap", "gaps") };
    holes(count: usize) => { counted(*count, "hole", "holes") };
    lines(count: usize) => { counted(*count, "line", "lines") };
    names(count: usize) => { counted(*count, "name", "names") };
    new_numbers(count: usize) => { counted(*count, "new number", "new numbers") };
    notes(count: usize) => { counted(*count, "note", "notes") };
    overlaps(count: usize) => { counted(*count, "overlap", "overlaps") };
    places(count: usize) => { counted(*count, "place", "places") };
    programs(count: usize) => { counted(*count, "program", "programs") };
    segments(count: usize) => { counted(*count, "segment", "segments") };
    short_segments(count: usize) => { counted(*count, "short segment", "short segments") };
    vertices(count: usize) => { counted(*count, "vertex", "vertices") };
    warnings(count: usize) => { counted(*count, "warning", "warnings") };
    cut_length(mm) => "cut {mm:.1} mm";
    jumps_length(mm) => "jumps {mm:.1} mm";
    comma => ", ";
    semicolon => "; ";
    and => " and ";
    error => "error";
    warning => "warning";
    information => "information";
    hint => "hint";
    minutes(minutes) => "{minutes:.2} min";
    hours_and_minutes(hours, minutes) => "{hours} h {minutes:02} min";
    line_number(line) => "line {line}";
    segment_by_number(index) => "segment {index}";
    segments_from_to(first, last) => "segments {first} to {last}";
    line_mm(length) => "line, {length:.3} mm";
    arc_r_mm(radius, sweep) => "arc R {radius:.3} mm, {sweep}°";
}

fn counted(count: usize, one: &str, many: &str) -> String {
    let noun = if count == 1 { one } else { many };
    format!("{count} {noun}")
}
