//! Files that cannot be read or written.

translate! {
    it_has_too_many_bytes(bytes, cap) => "文件有 {bytes} 字节，最多允许 {cap} 字节";
    it_holds_too_many_bytes(cap) => "内容超过 {cap} 字节，这是上限";
    a_link_to_nothing => "这是一个链接，所指的文件不存在";
    a_folder_is_no_file => "是文件夹，应为一个文件";
    it_is_a_folder => "是文件夹";
    it_is_no_regular_file => "不是普通文件";
    it_lies_outside => "在所显示的文件夹之外";
    it_is_read_only => "是只读的";
    it_is_not_the_file_any_more_that_was_read => "已不是当初读入的文件，未作任何修改";
    its_owner_user_group_cannot_be_kept(uid, gid, error) => "文件的所有者（用户 {uid}，组 {gid}）无法保留：{error}";
    no_such_file_or_directory => "没有这个文件或文件夹";
    permission_denied => "没有权限";
    not_a_directory => "不是文件夹";
    is_a_directory => "是文件夹";
    no_space_left_on_device => "磁盘已满";
    read_only_file_system => "文件系统只读";
    the_text_is_utf_16 => "文本是 UTF-16：请存为 UTF-8";
}
