//! What a setting may be.

translate! {
    a_number_above(least) => "大于 {least} 的数";
    a_number_of_or_above(least) => "不小于 {least} 的数";
    a_number_from_to(least, most) => "{least} 到 {most} 的数";
    a_whole_number_from_to(least, most) => "{least} 到 {most} 的整数";
    a_list_of_numbers_one_for_each_pass => "大于 0 的数的列表，每次切割一个";
    a_list_of_words => "由字母和数字组成的代码列表，如 [\"D1\", \"D2\"]";
    a_list_of_lines => "行的列表，如 [\"G90\"]";
    one_line_of_text => "一行文字";
    one_line_without_control_characters => "一行不含控制字符的文字";
    the_path_of_a_drawing => "图纸的路径，.dxf 或 .dxb";
    an_address_with_rule_in_it => "网址，如 https://edm.example/rules/{rule}.html，其中 {rule} 代表规则名";
    the_name_of_a_profile => "profile 的名称";
    true_or_false => "true 或 false";
    a_table => "表";
    a_list => "列表";
    not_set => "未设置";
    a_point => "点 [x, y]";
    a_word_of_letters_and_digits => "由字母和数字组成的代码，如 \"DD\"";
    colors_that_are_known => "red、yellow、green、cyan、blue、magenta、white、1 到 255 的数或 #rrggbb";
    the_reason_in_words => "用文字写明理由";
    did_you_mean_of(expected, near) => "{expected}：是否想写 {near}？";
    is_not_known_did_you_mean(key, near) => "未知的 {key}，是否想写 {near}？";
    suppresses_nothing(handle, rule) => "对 {handle} 处 {rule} 的忽略不起作用：请删去";
    no_contour_of_that_name(drawing, key) => "本图中没有 {key}：[drawings.\"{drawing}\".contours] 中对它的规定不起作用";
    one_or_other(ones, other) => "{ones} 或 {other}";
    is_not_what_is_expected(key, found, expected) => "{key} 是 {found}，应为 {expected}";
    is_empty(key, expected) => "{key} 为空，应为 {expected}";
    is_not_known(key, expected) => "没有 {key} 这一项，应为 {expected}";
    holds_an_unknown_name(key, name) => "{key} 含有 {name}，应为 {{x}}、{{y}}、{{side}} 或 {{register}}";
    there_is_no_profile(name, names) => "没有名为 {name:?} 的 profile，应为 {names}";
    is_more_than_the_pass_before(pass, correction, before) => "{pass} 是 {correction}，最多应为上一次切割的 {before}：补偿量须逐次减小";
    is_of_passes_expected_one_for_each(key, count, passes) => "{key} 列出 {count} 个，应与切割次数一致，共 {passes} 个";
    is_less_than_the_wire_radius(pass, correction, radius) => "{pass} 是 {correction}，不得小于电极丝半径 {radius}：否则丝会切入工件";
    a_list_of_layers => "图层名的列表，如 [\"PUNCH\"]";
    the_name_of_a_layer => "图层名";
    a_fit_needs(key, missing) => "{key} 要求检查配合：同时须设置 {missing}";
    a_pair_without_partner(key) => "{key} 没有成对的零件：同一轮廓切两次时应设 pair.drawn-as，两个零件都画出时应有两个 workpieces";
    a_pair_without_clearance(key) => "没有 pair.clearance，{key} 不起作用：应设单边间隙，mm";
    a_pair_drawn_and_cut_twice(key) => "{key} 表示每个轮廓切两次，workpieces 表示两个零件都已画出：只能取其一";
    a_pair_on_one_side(key, side) => "{key} 表示每个轮廓两侧都切，而 side 是 {side}：应为 both";
    an_extra_needs_a_drawn_part(key) => "{key} 需要为多个零件切割的轮廓：同时应设 pair.drawn-as";
    a_layer_in_two_workpieces(layer, one, other) => "图层 {layer} 同时属于工件 {one} 和 {other}：只能属于一个";
    the_file_has_too_many_bytes(bytes, most) => "文件有 {bytes} 字节，最多允许 {most}：整个文件无效";
    not_toml(reason) => "不是 TOML：{reason}";
}
