//! The pages of `wedm report`.

translate! {
    no_drawing_to_report_of => "没有图纸，应为 .dxf";
    pages_are_written(written, pages, index) => "{written} {pages}：{index}";
    pages(count: usize) => { format!("{count} 页") };
    report_of_drawings(count: usize) => { format!("{count} 张图纸的报告") };
    head_contours => "轮廓";
    head_findings => "问题";
    head_radius_list => "半径表";
    head_passes => "加工次数";
    head_program => "程序";
    column_drawing => "图纸";
    column_number => "序号";
    column_kind => "类型";
    column_role => "用途";
    column_length => "长度 mm";
    column_area => "面积 mm²";
    column_order => "切割顺序";
    column_found => "内容";
    column_place => "位置";
    column_turn => "圆心角 °";
    column_entity => "图元";
    column_segment => "段";
    column_verdict => "结论";
    column_pass => "第几次";
    column_correction => "补偿量 mm";
    column_contours => "轮廓数";
    column_length_with_leads => "长度（含引线）mm";
    column_smallest_radius => "最小半径 mm";
    column_blocks => "程序段";
    cut_off_in_pass(pass) => "切断，第 {pass} 次";
    a_program_and_its_proof(language, blocks, contours, length, deviation) => "{language}：{blocks}，{contours}，{length:.3} mm；反解校核，偏离路线不超过 {deviation:.2} µm";
    its_text => "程序文本";
    and_more_of_them(count) => "另有 {count} 项";
}
