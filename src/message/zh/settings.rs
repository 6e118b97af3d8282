//! What a setting may be.

/// A space stands between Chinese and what begins in other letters.
fn apart(words: &dyn crate::message::Shown) -> String {
    let words = format!("{words}");
    match words.starts_with(|letter: char| letter.is_ascii()) {
        true => format!(" {words}"),
        false => words,
    }
}

translate! {
    a_number_above(least) => "大于 {least} 的数";
    a_number_of_or_above(least) => "不小于 {least} 的数";
    a_number_up_to(most) => "不超过 {most} 的数";
    a_number_from_to(least, most) => "{least} 到 {most} 的数";
    a_whole_number_from_to(least, most) => "{least} 到 {most} 的整数";
    a_list_of_numbers_one_for_each_wire => "数的列表，每种电极丝一个";
    each_wire_needs_all(wires, gaps, rates) => "job.wires 有 {wires} 种电极丝，job.wire-gaps 有 {gaps} 个，job.wire-rates 有 {rates} 个：每种电极丝应各有一个";
    wires_need_a_height(key, other) => "{key} 不起作用：算代价需要时间；还应设置 {other}";
    a_list_of_numbers_one_for_each_pass => "大于 0 的数的列表，每次切割一个";
    a_list_of_words => "由字母和数字组成的代码列表，如 [\"D1\", \"D2\"]";
    a_list_of_lines => "行的列表，如 [\"G90\"]";
    one_line_of_text => "一行文字";
    one_line_without_control_characters => "一行不含控制字符的文字";
    the_path_of_a_drawing => "本机上图形的路径，.dxf 或 .dxb";
    an_address_with_rule_in_it => "网址，如 https://edm.example/rules/{rule}.html，其中 {rule} 代表规则名";
    the_name_of_a_profile => "profile 的名称";
    true_or_false => "true 或 false";
    a_table => "表";
    a_list => "列表";
    not_set => "未设置";
    a_point => "点 [x, y]";
    a_point_of_numbers_up_to(most) => "点 [x, y]，其中的数不超过 {most}";
    a_word_of_letters_and_digits => "由字母和数字组成的代码，如 \"DD\"，且不是程序段的一部分";
    colors_that_are_known => "red、yellow、green、cyan、blue、magenta、white、1 到 255 的数或 #rrggbb";
    the_reason_in_words => "用文字写明理由";
    did_you_mean_of(expected, near) => "{expected}：是否想写 {near}？";
    is_not_known_did_you_mean(key, near) => "未知的 {key}，是否想写 {near}？";
    mark_did_you_mean(bearer, mark, near) => "{bearer} 的标记 {mark:?} 不起作用，应为 \"suppress 规则名：理由\"：是否想写 {near}？";
    mark_is_not_understood(bearer, mark) => "{bearer} 的标记 {mark:?} 不起作用，应为 \"suppress 规则名：理由\"";
    suppresses_nothing(handle, rule) => "{handle} 处允许保留 {rule} 的设置不起作用：请删去";
    no_contour_of_that_name(drawing, key) => "本图中没有 {key}：[drawings.\"{drawing}\".contours] 中对它的规定不起作用";
    one_or_other(ones, other) => "{ones} 或 {other}";
    is_not_what_is_expected(key: dyn crate::message::Shown, found: dyn crate::message::Shown, expected: dyn crate::message::Shown) => { format!("{key} 是{}，应为{}", apart(found), apart(expected)) };
    is_empty(key: dyn crate::message::Shown, expected: dyn crate::message::Shown) => { format!("{key} 为空，应为{}", apart(expected)) };
    is_not_known(key: dyn crate::message::Shown, expected: dyn crate::message::Shown) => { format!("没有 {key} 这一项，应为{}", apart(expected)) };
    holds_an_unknown_name(key, name) => "{key} 含有 {name}，应为 {{x}}、{{y}}、{{side}} 或 {{register}}";
    no_absolute_center_under_g91(center, coordinates) => "{center} 为 \"absolute\"，而 {coordinates} 为 \"incremental\"：G91 下圆心没有自己的坐标，应为 start-to-center 或 center-to-start";
    there_is_no_profile(name, names) => "没有名为 {name:?} 的 profile，应为 {names}";
    is_more_than_the_pass_before(pass, correction, before) => "{pass} 是 {correction}，最多应为上一次切割的 {before}：补偿量须逐次减小";
    is_of_passes_expected_one_for_each(key: dyn crate::message::Shown, count: usize, passes: usize) => { format!("{key} 列出 {count} 个，应与切割次数一致，共 {passes} 个") };
    is_less_than_the_wire_radius(pass, correction, radius) => "{pass} 是 {correction}，不得小于电极丝半径 {radius}：否则丝会切入工件";
    a_list_of_layers => "图层名的列表，如 [\"PUNCH\"]";
    the_name_of_a_layer => "图层名";
    a_fit_needs(key, missing) => "{key} 要求检查配合：同时须设置 {missing}";
    a_pair_without_partner(key) => "{key} 没有成对的零件：同一轮廓切两次时应设 pair.drawn-as，两个零件都画出时应有两个 workpieces";
    a_pair_without_clearance(key) => "没有 pair.clearance，{key} 不起作用：应设单边间隙，mm";
    a_pair_drawn_and_cut_twice(key) => "{key} 表示每个轮廓切两次，workpieces 表示两个零件都已画出：只能取其一";
    a_pair_on_one_side(key, side) => "此处生效的设置（wedm.toml、客户端、命令行或请求）中 side 是 \"{side}\"，而 {key} 表示每个轮廓切两次，两侧各一次：应为 side = \"both\"，或不设";
    a_pair_on_the_drawn_line(key, other) => "{key} 是两个零件之间的间隙，而 {other} 是 none：两者都会沿图中的线本身切割；{other} 应为 path 或 controller";
    an_extra_needs_a_drawn_part(key) => "{key} 需要为多个零件切割的轮廓：同时应设 pair.drawn-as";
    a_layer_in_two_workpieces(layer, one, other) => "图层 {layer} 同时属于工件 {one} 和 {other}：只能属于一个";
    milling_needs(missing) => "铣削需要电极和分层的数据：应设置 {missing}";
    one_word_for_pause_and_end(key, word, other) => "{key} 是 {word}，{other} 也是：程序不能用结束码来暂停";
    is_no_place_of_a_correction(key, word) => "{key} 是 {word}，不是补偿号：应为 D1、H1 之类";
    a_register_of_two_corrections(key, word, correction, other, before) => "{key} 是 {word}，其中应存 {correction}，而 {other} 也是它，应存 {before}：每个补偿量应有自己的补偿号";
    the_wire_and_its_gap_cut_beyond(key, correction, half, beyond) => "{key} 是 {correction}，而电极丝连同放电间隙每侧切去 {half:.4} mm：会切过轮廓 {beyond:.4} mm；不应小于它，有意如此时请设 pair.clearance";
    a_stop_that_ends(key, word) => "{key} 是 {word}，它结束程序：暂留段永远不会切断";
    a_text_on_one_line(most) => "一行文字，不超过 {most} 个字符";
    a_pause_that_ends(key, word) => "{key} 是 {word}，它结束程序：其后的各次切割永远不会执行";
    a_stop_that_does_not_stop(key, word, pause) => "{key} 是 {word}，它不使机床停下：ISO 应为 M00 或 M01，3B 应为 {pause}";
    the_control_runs_beside_the_drawn_contour(key, other) => "{key} 是 constant-stock，而 {other} 是 controller：每次切割都会沿图中轮廓走，与 sharp 一样；{other} 应为 path，或应为 sharp";
    a_lead_within_the_kerf(key, length, correction) => "{key} 是 {length}，小于补偿量 {correction}：穿丝处会落在自身的切缝内；应至少为补偿量";
    passes_on_the_drawn_line(key, other, count) => "{key} 列出 {count} 次切割，而 {other} 是 none：丝只沿图中的线本身走一次，其余各次不起作用";
    registers_need_the_control(key, other) => "{other} 是 path 时 {key} 不起作用：程序写的就是切割轨迹，不用补偿号";
    a_stock_needs_skims(key, other) => "{key} 是 constant-stock，只切一次时不起作用：{other} 应列出多次切割";
    a_pause_needs_passes(key, other) => "只切一次时 {key} 不起作用：{other} 应列出多次切割";
    a_stop_needs_a_tab(key, other) => "没有 {other}，{key} 不起作用：没有暂留段";
    a_step_needs_linear_feed(key, other) => "{other} 不是 linear 时，{key} 不起作用";
    a_hole_narrower_than_the_wire(key, hole, other, wire) => "{key} 是 {hole}，应大于 {other} {wire}：丝穿不过这个孔";
    a_mass_needs_a_height(key) => "{key} 是废料的质量：应同时设置 job.thickness";
    a_rate_needs_minutes(key, missing) => "{key} 不起作用：算费用需要切割的分钟数；还应设置 {missing}";
    a_limit_needs_a_tab(key) => "没有 program.tab，{key} 不起作用：应设废料更重的型孔暂留段的长度，mm";
    roles_of_no_layer(key, names, layers) => "{key} 给 {names} 指定了用途，而图形中没有这个图层：图形的图层有 {layers}";
    a_contour_of_two_roles(name, role, by, other, other_by) => "轮廓 {name} 有两种用途：{by} 定为 {role}，以它为准；{other_by} 定为 {other}";
    its_color => "其颜色";
    the_entity_itself => "图元本身";
    a_point_that_is_given_twice(what, name, at, by, other, other_by) => "轮廓 {name} 的{what}给了两次：{by} 给 {at}，以它为准；{other_by} 给 {other}";
    a_mark_o => "标记 O";
    a_punch_within_a_punch(inner, outer, others) => "轮廓 {inner} 是凸模，却在凸模 {outer} 之内{others}：丝会切入那个工件；应作为型孔，或画在另一个工件中";
    and_more_punches(more) => "，这样的还有 {more} 个";
    an_outline_that_may_be_a_copy(copy, outline, thin) => "轮廓 {copy} 处处与轮廓 {outline} 相距不到 {thin:.3} mm：若是重复绘制，请删去；若真是这样薄的壁，请给两者都指定用途；其内所有轮廓的加工侧都取决于此";
    a_layer_above_the_depth(key, layer, depth) => "{key} 是 {layer}，最多应为 milling.depth {depth}";
    too_many_layers(key, layer, layers, most) => "{key} 是 {layer}，milling.depth 要分 {layers:.0} 层，最多允许 {most} 层";
    the_file_has_too_many_bytes(bytes, most) => "文件有 {bytes} 字节，最多允许 {most}：整个文件无效";
    a_value_without_quotes => "没有值，或文字没有加引号";
    a_key_without_a_sign => "键后缺少 =";
    a_sign_without_a_key => "= 前没有键";
    a_key_of_other_letters => "键含有字母、数字、- 和 _ 以外的字符：须加引号";
    a_key_that_is_repeated => "键重复";
    text_behind_a_value => "值后还有文字，应换行";
    a_bracket_that_is_open => "括号没有闭合";
    a_quote_that_is_open => "引号没有闭合";
    a_backslash_that_stands_for_nothing => "反斜杠不成转义：应写两个";
    a_number_that_is_none => "不是 TOML 的数：小数点前后都应有数字，前面不应多写 0";
    comma_between_words => "、";
    or_between_words => " 或 ";
    part_punch => "凸模";
    part_plate => "凹模";
    part_stripper => "卸料板";
    part_holder => "固定板";
    one_of(words) => "{words} 之一";
    not_toml(reason) => "不是 TOML：{reason}";
}
