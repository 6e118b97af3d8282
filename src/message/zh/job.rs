//! What is made of a document, and why it is not.

translate! {
    no_contour_that_is_cut_is_on_the_layer(layer) => "图层“{layer}”上没有要切割的轮廓";
    an_error_stands_in_the_drawing => "图形中有错误";
    the_path_was_given_up => "切割路线已放弃计算";
    laying_the_path => "正在计算切割路线";
    writing_and_proving => "正在写出并校核程序";
    the_program_does_not_hold_its_proof(reason) => "程序没有通过校核：{reason}";
    no_program_of_this_drawing(reason) => "此图形得不出通过校核的程序：{reason}";
    four_b_has_no_tab => "4B 程序各次切割共用一个轮廓：只有一次切割时才有暂留段，没有重叠段；请把 tab 或 closing-overlap 设为 0，或换一种格式";
    no_other_program(reason) => "由它得不出通过校核的新程序，未写出任何程序：{reason}";
    a_target_that_is_not_written(name, names) => "不能写出 {name:?}，应为 dxf、{names}";
    it_cuts_nothing => "没有切割任何轮廓";
    a_drawing_is_no_program => "这是图形，此处要程序（.3b、.iso）";
    a_program_is_no_drawing => "这是程序，此处要图形（.dxf）";
}
