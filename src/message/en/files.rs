//! Files that cannot be read or written.

declare! {
    it_has_too_many_bytes(bytes, cap) => "it has {bytes} bytes, expected at most {cap}";
    it_holds_too_many_bytes(cap) => "it has more than {cap} bytes, expected at most that many";
    a_link_to_nothing => "it is a link to a file that is not there";
    a_folder_is_no_file => "it is a folder, expected one file";
    it_is_a_folder => "it is a folder";
    it_is_no_regular_file => "it is not a regular file";
    it_lies_outside => "it lies outside of the folders that are shown";
    it_is_read_only => "it is read-only";
    it_is_not_the_file_any_more_that_was_read => "it is no longer the file that was read, nothing is changed";
    its_owner_user_group_cannot_be_kept(uid, gid, error) => "its owner (user {uid}, group {gid}) cannot be kept: {error}";
    no_such_file_or_directory => "no such file or directory";
    permission_denied => "permission denied";
    not_a_directory => "not a directory";
    is_a_directory => "is a directory";
    no_space_left_on_device => "no space left on device";
    read_only_file_system => "read-only file system";
    the_text_is_utf_16 => "the text is UTF-16: save it as UTF-8";
}
