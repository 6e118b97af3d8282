//! The page in the browser, and what its server refuses.

translate! {
    another_host => "此地址只用于 127.0.0.1 或 localhost 加本进程的端口";
    another_page_asks => "这是另一个网页的请求";
    another_address => "请打开 wedm view 显示的地址：其中有此页面的密钥";
    another_method => "此处应使用另一种请求方式";
    nothing_is_there => "此地址没有内容";
    a_websocket_is_expected => "应为 WebSocket 连接的开始，版本 13";
    a_file_uri_is_expected => "应有 ?uri= 和文件的 file: URI（百分号编码）";
    a_condition_is_expected => "应有 If-Match 和引号中的一个版本，或 If-None-Match: *";
    it_has_changed => "文件已被改动：没有写入";
    there_is_one_already => "文件已存在：没有写入";
    it_took_too_long => "传送时间过长";
    too_much_at_a_time => "同时进行的内容过多";
    it_ends_with_the_last_page => "按 Ctrl-C 结束；最后一个页面关闭一分钟后自行结束";
    the_port_is_taken(port) => "端口 {port} 已被其他程序占用：请用 --port 另选一个，或不指定";
    the_port_cannot_be_had(port, reason) => "无法使用本机的端口 {port}：{reason}";
    it_is_nothing_to_show => "不是可以显示的图形、程序或 wedm.toml";
    no_browser_could_be_opened => "无法打开浏览器：请在浏览器中打开此地址";
}
