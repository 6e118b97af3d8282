//! What is made of a document, and why it is not.

translate! {
    no_contour_that_is_cut_is_on_the_layer(layer) => "图层“{layer}”上没有要切割的轮廓";
    an_error_stands_in_the_drawing => "图形中有错误";
    the_path_was_given_up => "切割轨迹已放弃计算";
    laying_the_path => "正在计算切割轨迹";
    writing_and_proving => "正在写出并校核程序";
    the_program_does_not_hold_its_proof(reason) => "程序没有通过校核：{reason}";
    no_program_of_this_drawing(reason) => "此图形得不出通过校核的程序：{reason}";
    four_b_ends_with_an_open_contour => "4B 程序说不出切完未封闭轮廓后丝在哪里：这样的轮廓只能是程序中的最后一个，并且只切一次；请单独切割，或换一种格式";
    four_b_cuts_a_corner_off(depth, radius) => "4B 在这个拐角处写为 R {radius:.3} mm 的圆弧：电极丝切掉它 {depth:.3} mm；ISO 和 3B 保留拐角";
    four_b_has_no_tab => "4B 程序各次切割共用一个轮廓：只有一次切割时才有暂留段，没有重叠段；请把 tab 或 closing-overlap 设为 0，或换一种格式";
    no_other_program(reason) => "由它得不出通过校核的新程序，未写出任何程序：{reason}";
    a_target_that_is_not_written(name, names) => "不能写出 {name:?}，应为 dxf、{names}";
    it_cuts_nothing => "没有切割任何轮廓";
    the_program_breaks_off_there => "程序在此中断，没有结束";
    a_drawing_is_no_program => "这是图形，此处要程序（.3b、.iso）";
    a_program_is_no_drawing => "这是程序，此处要图形（.dxf）";
    nothing_is_said_of_a_wire(format) => "没有电极丝的数据，只有 [milling] 的电极：请选格式 milling，或为 {format} 设置 correction 或 wire-diameter";
    parts_have_a_program_each(parts) => "这是一对零件（{parts}），每件各有自己的程序：由 `wedm pair` 写出";
    parts_of_have_a_program_each(parts, path) => "这是一对零件（{parts}），每件各有自己的程序：由 `wedm pair {path}` 写出";
    holes_of_a_pair_are_csv => "成对零件的穿丝孔写为 .csv：放在同一张图里，一件的孔也会被当作另一件的";
    a_pair_is_not_milled => "成对的零件用电极丝切割：应为 3b、4b 或 iso";
    the_electrode_wears_more_than_a_layer(wear) => "沿此轮廓每铣一层，电极缩短 {wear:.2} 个层高：一层之内底面不平；电极粗一些或轮廓短一些，损耗就小";
    the_step_is_longer(step, length) => "milling.step 是 {step} mm，比此轮廓一层的长度 {length:.3} mm 还长：步长应更短";
    the_floor_is_uneven(wear, least, most) => "沿此轮廓每铣一层，电极缩短 {wear:.2} 个层高：一层之内底面不平，最后深 {least:.4} 到 {most:.4} mm；电极粗一些或轮廓短一些，损耗就小";
    it_is_milled => "它由电极分层铣削：高度与各段运动相关，不是电极丝的轨迹";
    nothing_is_picked(key, other) => "{key} 是 as-picked，但没有选取轮廓：按 {other} 的顺序切割";
    a_pass_that_is_not_set(pass, count) => "测量了第 {pass} 次切割，但设置中只有 {count} 次";
    the_wire_is_thicker_than_its_kerf(pass, half, radius) => "第 {pass} 次切割：切缝半宽 {half:.4} mm 小于电极丝半径 {radius:.4} mm：请检查 wire-diameter 和机床上实际设定的补偿量";
    a_pass_cuts_wider_than_the_one_before(pass, half, before, of_before, allowed) => "第 {pass} 次切割的切缝半宽为 {half:.4} mm，第 {before} 次为 {of_before:.4} mm：更精的一次放电间隙不会更大，不确定度只允许 {allowed:.4} mm；请检查每个尺寸是在哪一次切割之后测量的";
    no_kerf_explains_a_size(feature, measured, nominal, correction, half) => "{feature}：公称 {nominal} mm，实测 {measured} mm，切割时补偿量 {correction:.4} mm，得切缝半宽 {half:.4} mm：请检查尺寸，以及是外形还是内形";
    a_feature_stands_out(pass, feature, half, others, allowed) => "第 {pass} 次切割：由 {feature} 得切缝半宽 {half:.4} mm，由其余各处得 {others:.4} mm：相差超过其分散所允许的 {allowed:.4} mm；请重新测量，或不计入";
    outer_and_inner_features_differ(pass, outer, inner, allowed) => "第 {pass} 次切割：由外形得切缝半宽 {outer:.4} mm，由内形得 {inner:.4} mm：相差超过其分散和测量所允许的 {allowed:.4} mm。这不是补偿量能解释的：请检查机床的比例、锥度或量爪";
}
