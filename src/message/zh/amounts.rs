//! So many of what, and words that stand beside what is not text of ours.

translate! {
    arcs(count: usize) => { format!("{count} 段圆弧") };
    blocks(count: usize) => { format!("{count} 个程序段") };
    chorded_arcs(count: usize) => { format!("{count} 段折线圆弧") };
    contours(count: usize) => { format!("{count} 个轮廓") };
    diagnostics(count: usize) => { format!("{count} 个诊断") };
    doubles(count: usize) => { format!("{count} 个重复图元") };
    entities(count: usize) => { format!("{count} 个图元") };
    errors(count: usize) => { format!("{count} 个错误") };
    features(count: usize) => { format!("{count} 处") };
    files(count: usize) => { format!("{count} 个文件") };
    findings(count: usize) => { format!("{count} 个问题") };
    gaps(count: usize) => { format!("{count} 处间隙") };
    holes(count: usize) => { format!("{count} 个孔") };
    lines(count: usize) => { format!("{count} 行") };
    names(count: usize) => { format!("{count} 个文件名") };
    new_numbers(count: usize) => { format!("{count} 个数值") };
    notes(count: usize) => { format!("{count} 个提示") };
    overlaps(count: usize) => { format!("{count} 处重叠") };
    places(count: usize) => { format!("{count} 处") };
    programs(count: usize) => { format!("{count} 个程序") };
    segments(count: usize) => { format!("{count} 段") };
    short_segments(count: usize) => { format!("{count} 段短线段") };
    vertices(count: usize) => { format!("{count} 个顶点") };
    warnings(count: usize) => { format!("{count} 个警告") };
    cut_length(mm) => "切割 {mm:.1} mm";
    jumps_length(mm) => "跳步 {mm:.1} mm";
    comma => "，";
    semicolon => "；";
    and => " 和 ";
    error => "错误";
    warning => "警告";
    information => "信息";
    hint => "提示";
    minutes(minutes) => "{minutes:.2} 分钟";
    hours_and_minutes(hours, minutes) => "{hours} 小时 {minutes:02} 分";
    line_number(line) => "第 {line} 行";
    segment_by_number(index) => "段 {index}";
    segments_from_to(first, last) => "段 {first} 到 {last}";
    line_mm(length) => "直线，{length:.3} mm";
    arc_r_mm(radius, sweep) => "圆弧 R {radius:.3} mm，{sweep}°";
}
