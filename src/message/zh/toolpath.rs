//! Paths of the wire, and why there is none.

translate! {
    the_lead_in_cuts_through_contour(x, y, x1, y1, crossed) => "从穿丝孔 ({x:.3}, {y:.3}) 到 ({x1:.3}, {y1:.3}) 的引入线切穿轮廓 {crossed}";
    the_way_cuts_into_contour(x, y, x1, y1, contour) => "从 ({x:.3}, {y:.3}) 到 ({x1:.3}, {y1:.3}) 的跳步会切入轮廓 {contour}：profile 的暂停码不停机，电极丝没有拆下";
    contour_has_no_length(handle) => "轮廓 {handle} 没有长度";
    contour_is_open_and_cannot_be_entered_at(handle, x, y) => "轮廓 {handle} 不封闭，不能从 ({x}, {y}) 切入，应从它的一个端点切入";
    contour_is_open_the_side_of_the_wire_is_not_known(handle) => "轮廓 {handle} 不封闭：不知道电极丝在哪一侧；请封闭轮廓，或把 compensation 设为 none 按图线切割";
    side_of_contour_is_not_known(handle) => "不知道轮廓 {handle} 的补偿方向：请把 side（--side）设为 opening（型孔）或 punch（凸模）";
    the_thread_hole_comes_nearer_to_the_contour(x, y, correction, x1, y1) => "穿丝孔 ({x:.3}, {y:.3}) 到轮廓的距离小于补偿量 {correction:.3} mm：电极丝只能停在 ({x1:.3}, {y1:.3})";
    there_is_no_entity_with_the_handle(handle) => "没有句柄为 {handle} 的图元";
    entity_belongs_to_no_contour_that_is_cut(handle) => "图元 {handle} 不属于要切割的轮廓";
    there_is_no_contour_to_cut => "没有要切割的轮廓";
    crosses_the_contour_or_comes_nearer(correction) => "与轮廓相交，或到轮廓的距离小于补偿量 {correction:.3} mm";
    the_path_comes_too_near_to_contour(handle, correction, other) => "沿轮廓 {handle} 的路径在此切入轮廓 {other}，或到它的距离小于补偿量 {correction:.3} mm";
    cuts_into_contour_or_comes_nearer(contour, correction) => "切入轮廓 {contour}，或到它的距离小于补偿量 {correction:.3} mm";
    runs_into_the_cut_along_contour(contour) => "切入轮廓 {contour} 的切缝";
    an_open_contour_keeps_no_tab(handle) => "轮廓 {handle} 未封闭：没有会落下的部分，因此不留暂留段；请按句柄只给需要的轮廓设置 tab，或把它设为 0";
    no_contour_keeps_a_tab(key) => "{key}：此程序没有轮廓留暂留段；只有凸模，以及废料重于 job.slug-limit 的型孔才留";
    a_punch_is_free_after_its_first_pass(handle) => "轮廓 {handle} 是凸模而不留暂留段：第一次切割后它就掉下，以后各次切不到东西；若不另行固定，请设 program.tab";
    the_tab_is_longer_than_contour(tab, handle, length) => "暂留段长 {tab:.3} mm，而轮廓 {handle} 只长 {length:.3} mm，没有可切的了：请缩短暂留段";
    the_overlap_is_longer_than_contour(overlap, handle, length) => "重叠段长 {overlap:.3} mm，绕满了只长 {length:.3} mm 的轮廓 {handle}：请缩短重叠段";
    nothing_of_the_tab_is_left_standing(tab, handle, x, y, cut) => "轮廓 {handle} 的暂留段长 {tab:.3} mm，却什么也没留下：停机前的切缝在 ({x:.3}, {y:.3}) 处相通，共切去 {cut:.3} mm；请加长暂留段，换引入线或切入点，或用更小、更远的穿丝孔";
    the_tab_stands_by_a_neck(tab, handle, width, x, y) => "轮廓 {handle} 的暂留段长 {tab:.3} mm，停机前在 ({x:.3}, {y:.3}) 处只剩 {width:.3} mm 宽的颈";
    the_cut_meets_itself(handle, x, y, area) => "轮廓 {handle} 的切缝在停机前于 ({x:.3}, {y:.3}) 处相遇：那里有 {area:.1} mm² 的废料松脱，暂留段没有支撑它；请换切入点、缩短引入线或不留暂留段";
    no_tab_fits_at(x, y) => "({x:.3}, {y:.3}) 处留不出暂留段：电极丝到不了那里";
    the_start_hole_cuts_into(diameter, x, y, handle, by) => "({x:.3}, {y:.3}) 处 Ø {diameter:.3} mm 的穿丝孔切入轮廓 {handle} {by:.3} mm";
    the_start_hole_comes_near(diameter, x, y, left, handle, correction, clear) => "({x:.3}, {y:.3}) 处 Ø {diameter:.3} mm 的穿丝孔距轮廓 {handle} 只剩 {left:.3} mm，应为补偿量 {correction:.3} mm 加 {clear} mm";
    the_start_holes_meet(diameter, x, y, handle, x1, y1) => "({x:.3}, {y:.3}) 处 Ø {diameter:.3} mm 的穿丝孔与轮廓 {handle} 在 ({x1:.3}, {y1:.3}) 的穿丝孔相碰";
    no_start_hole_fits_in(diameter, handle, depth, most) => "轮廓 {handle} 放不下 Ø {diameter:.3} mm 的穿丝孔：最深处距最近的轮廓 {depth:.3} mm，最大可用 Ø {most:.3} mm";
    no_start_hole_at_all_fits_in(diameter, handle, depth) => "轮廓 {handle} 放不下 Ø {diameter:.3} mm 的穿丝孔：最深处距最近的轮廓 {depth:.3} mm；请在别处给出穿丝孔";
    no_start_hole_fits_beside(diameter, x, y, least, why) => "切入点 ({x:.3}, {y:.3}) 旁放不下 Ø {diameter:.3} mm 的穿丝孔{why}：引线应不短于 {least:.3} mm，或换一个切入点，或给出穿丝孔";
    no_arc_fits_at(length, least, x, y, why) => "({x:.3}, {y:.3}) 处放不下从 {length:.3} mm 起、圆弧不小于 R {least:.3} mm 的引线{why}：请给出穿丝孔，或换一个切入点";
    no_arc_leads_from_to(least, x, y, x1, y1, why) => "从穿丝孔 ({x:.3}, {y:.3}) 到切割轨迹 ({x1:.3}, {y1:.3}) 放不下不小于 R {least:.3} mm 的圆弧引线{why}";
    the_lead_in_does(x, y, x1, y1, does) => "从穿丝孔 ({x:.3}, {y:.3}) 到 ({x1:.3}, {y1:.3}) 的引入线{does}";
    the_way_back_does(x, y, x1, y1, does) => "从轮廓终点 ({x:.3}, {y:.3}) 到穿丝孔 ({x1:.3}, {y1:.3}) 的直线返回段{does}";
    no_lead_in_fits_at(length, correction, x, y, why) => "({x:.3}, {y:.3}) 处放不下长 {length:.3} mm 直至等于补偿量 {correction:.3} mm 的引入线{why}：请给出穿丝孔，或换一个切入点";
    the_lead_is_longer_than_the_part(contour, length, size) => "轮廓 {contour} 的引线长 {length:.3} mm，而工件只有 {size:.3} mm：穿丝孔是别的工件的，或用了别的单位";
    the_lead_is_shortened(handle, wanted, length) => "轮廓 {handle} 的引入线长 {length:.3} mm：放不下 lead-in 所定的 {wanted:.3} mm";
    because_it(does) => "（它{does}）";
    the_entry_lies_from_contour(x, y, distance, handle) => "切入点 ({x}, {y}) 离轮廓 {handle} 有 {distance:.3} mm，应在轮廓上";
    one_is_given_for_several_contours(what, count) => "一个{what}对应 {count} 个轮廓：请用句柄选一个轮廓，或按句柄列表给出";
    entry => "切入点";
    whether_it_fits_needs(missing) => "不知道凸模与凹模是否配合：请设置 {missing}";
    no_contour_has_a_partner => "没有一个工件的轮廓在其他工件中有配对：没有可切的一对（--force 仍写出程序）";
    a_pair_needs(missing) => "不知道这一对零件的补偿量：请设置 {missing}";
    no_contour_is_of_a_pair => "没有成对的轮廓：应有两侧都走丝的封闭轮廓，或互相套在一起的两个工件";
    passes_run_on_both_sides_of_the_contour(part, key, length, corrections) => "{key} {length} mm 落在补偿量 {corrections} 之间：{part} 的各次切割有的在图中轮廓一侧，有的在另一侧，而由控制器补偿时只能在一侧；应设 program.compensation = \"path\"，用 3B 或 ISO";
}
