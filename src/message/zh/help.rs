//! The help of the command line: the rows of English, and those for what `clap` says by itself.

/// What `clap` puts into a help by itself.
pub(in crate::message) const BESIDE: [(&str, &str); 4] = [
    ("[default: ", "[默认："),
    ("[possible values: ", "[可选："),
    ("Possible values:", "可选："),
    ("[aliases: ", "[别名："),
];

pub(in crate::message) const HELP: &[(&str, &str)] = &[
    (
        "wedm",
        "检查并修复线切割图形，生成经过校核的 3B、4B、ISO 程序",
    ),
    (
        "wedm/",
        "找出半径小于补偿量的每一段圆弧并修复；每个程序写出前都重新解码校核。不带命令时是标准输入输出上的语言服务器；在终端上显示本帮助。",
    ),
    (
        "wedm-examples",
        "示例：
  wedm check plate.dxf                     半径小于 0.10 mm 的每段圆弧及其位置
  wedm check --correction 0.12 drawings/   整个文件夹，用另一补偿量
  wedm fix plate.dxf -o fixed.dxf          自动修复可安全修复的问题
  wedm generate fixed.dxf --side opening -o plate.3b
  wedm format plate.3b --layout aligned    程序段按列对齐
  wedm convert plate.3b -o plate.dxf       程序转回图形，或转成 ISO
  wedm demo                                用自带的图形演示全过程

退出码：0 没有错误，1 图形有错误，2 读不出，或用法不对。",
    ),
    ("check", "检查图形和程序有什么问题"),
    (
        "check/",
        "文件夹中查找 .dxf、.dxb、.dxfb、.3b、.4b、.iso 和 .nc；.gitignore、.ignore、.wedmignore 所列的和隐藏文件不查。没有错误以 0 结束，有错误以 1 结束，有内容读不出以 2 结束。",
    ),
    ("check paths", "文件，以及要查找的文件夹；`-` 是标准输入"),
    ("check output concise", "每个问题一行"),
    ("check output grouped", "同上，每个文件有标题"),
    ("check output github", "GitHub 工作流的注释"),
    ("check output junit", "JUnit 的 XML"),
    (
        "check output lisp",
        "给 AutoLISP 的一个 S 表达式，修复写成组码",
    ),
    ("check statistics", "不列出问题，只列出每条规则的次数"),
    ("check select", "只查这些规则，以及无法检查的文件"),
    ("check ignore", "不查这些规则"),
    (
        "check exclude",
        "跳过符合此模式的文件和文件夹，写法同 .gitignore",
    ),
    ("check no_ignore", "也查隐藏文件和 .gitignore 等所列的文件"),
    (
        "check stdin_name",
        "标准输入的名称：扩展名说明是什么，没有时看内容；所在文件夹说明用哪个 wedm.toml",
    ),
    ("check watch", "文件一改就再查，直到按 Ctrl-C 结束"),
    ("check show_suppressed", "也列出允许保留的问题及其理由"),
    ("check deny", "有此级别的问题也以 1 结束"),
    ("fix", "自动修复可安全修复的问题"),
    (
        "fix/",
        "只写出改变的数值，其余字节不动：代码页、换行、wedm 不认识的内容。写出之前重新读一遍并检查。旁边的行已损坏、无法写入的修复会指明，其余照做。还有错误或有修复没有做时以 1 结束。",
    ),
    ("fix paths", "图形和程序，或放它们的文件夹"),
    ("fix quiet", "不说修复了什么"),
    (
        "fix output",
        "修复后的图形写到这里（`-` 是标准输出）；`lisp`：把修复内容写给 AutoLISP（标准输出），可单用或与文件同用",
    ),
    ("fix in_place", "修复后的图形写回原文件"),
    ("fix diff", "显示会改什么，不写出"),
    ("format", "把程序整理成一种排版"),
    (
        "format/",
        "程序段、代码、注释、段号和终点不变，机床的动作也不变：每一行都重新读过才采用。读不出的行原样保留。这里和设置中都没有指定排版时，用程序中多数程序段的排版。`--check` 或 `--diff` 发现要改的，以 1 结束。",
    ),
    ("format paths", "程序，以及要查找程序的文件夹"),
    (
        "format output",
        "整理后的程序写到这里（`-` 是标准输出）；只能有一个 PATH",
    ),
    ("format in_place", "整理后的程序写回原文件"),
    ("format check", "列出会改变的程序，不写出"),
    ("format diff", "显示会改什么，不写出"),
    (
        "format layout",
        "程序段的形式 [默认：设置中的 `program.layout`，没有则为程序自己的]",
    ),
    ("generate", "写出图形的程序"),
    (
        "generate/",
        "写出之前，每个程序段都重新解码并与切割轨迹核对。有错误的图形会被拒绝，除非用 --force。程序写到标准输出，或用 -o 写到文件；结果说明在标准错误中。",
    ),
    (
        "generate format",
        "程序的语言：3b、4b、iso；milling 为电极铣削 [默认：按 OUT 的扩展名，否则 `program.format`，否则 3b]",
    ),
    (
        "generate output",
        "程序写到这里 [默认：标准输出]；`lisp`：把结果写给 AutoLISP（标准输出），可单用或与文件同用",
    ),
    (
        "generate handle",
        "只切含有此图元的轮廓；可多次给出，按切割次序",
    ),
    (
        "generate layer",
        "只切在此图层上有图元的轮廓；可多次给出，可与 --handle 并用",
    ),
    ("generate force", "图形有错误也写出"),
    ("pair", "写出凸模、凹模、卸料板和固定板的程序"),
    (
        "pair/",
        "补偿量由配合间隙得出。写出之前每个程序都重新解码并与切割轨迹核对；已有的文件不会被覆盖，除非用 --overwrite。",
    ),
    (
        "pair format",
        "程序的语言：3b、4b、iso [默认：`program.format`，否则 3b]",
    ),
    ("pair output", "程序写到此文件夹 [默认：图形所在的文件夹]"),
    ("pair handle", "只切含有此图元的轮廓；可多次给出"),
    ("pair force", "图形有错误也写出"),
    ("fit", "把丝切出的凸模与凹模相配"),
    (
        "fit/",
        "配不上时以 1 结束。两个零件是切两次的同一轮廓（pair.drawn-as），或两个工件（[workpieces]）。",
    ),
    ("fit output", "图片写到这里（.svg、.png 或 .pdf）"),
    ("fit format", "输出的形式"),
    ("holes", "列出要钻的穿丝孔：CSV，或 DXF 的一个图层"),
    (
        "holes/",
        "每个孔一行：图形，x、y（mm），直径（mm，有 --start-hole 或设置时），由它切割的轮廓，是给定的还是找到的。会切入轮廓的孔在标准错误中说明；若是找到的，不列出，并以 1 结束。只是离轮廓或另一个孔太近的，列出并警告。",
    ),
    ("holes paths", "图形"),
    (
        "holes output",
        "列表写到这里（.csv 或 .dxf）[默认：CSV，写到标准输出]",
    ),
    ("inspect", "列出每一段的半径和判定"),
    ("inspect/", "图形有错误时以 1 结束；JSON 仍会输出。"),
    ("inspect handle", "只列此图元"),
    (
        "draw",
        "把图形的轮廓、问题和切割轨迹，或程序的轨迹画成 SVG、PNG 或 PDF；轮廓和切割轨迹也可画成 DXF",
    ),
    ("draw path", "图形或程序"),
    (
        "draw output",
        "图片写到这里（.svg、.png、.pdf 或 .dxf）[默认：SVG，写到标准输出]",
    ),
    (
        "contours",
        "列出轮廓：哪些图元相接，封闭与否，用途、面积和长度",
    ),
    ("convert", "把程序转成图形，或转成另一种语言的程序"),
    (
        "convert/",
        "轮廓成为图层 CUT 上带圆弧的多段线，引线成为 LEAD 上的直线，跳步成为 WAY 上的直线。3B 程序带有坐标（checking 排版）的用坐标；否则说明机床走一圈累计的偏差。有错误的程序会被拒绝，除非用 --force。",
    ),
    ("convert path", "程序：.3b、.4b、.iso 或 .nc"),
    (
        "convert output",
        "写到这里；扩展名说明转成什么：.dxf、.3b、.4b、.iso 或 .nc",
    ),
    (
        "convert format",
        "没有 OUT 说明时，转成什么：dxf、3b、4b、iso",
    ),
    ("convert force", "有错误也转换；没有移动的程序段略去"),
    ("simulate", "说明机床实际走到哪里"),
    (
        "simulate/",
        "3B 控制器在一个轴上计数，以微米计，数完就停：逐段照此走，每次 1 µm，终点与理论直线、圆弧不同的，两个终点都列出。点以 mm 计，自程序起点；程序说明起点的，为绝对坐标。JSON 是 `wedm/simulate` 的结果，单位 µm。",
    ),
    ("simulate path", "程序"),
    ("simulate feed", "切割速度，用来算时间"),
    (
        "report",
        "每个图形写一页，并有索引：图片、轮廓、半径列表、问题、各次切割、时间、钻孔列表、配合、程序",
    ),
    (
        "report/",
        "每页是一个 HTML 文件，不要别的文件，亮暗随查看者，可打印在 A4 上。图形有错误时以 1 结束，页仍会写出。已有的文件若不是 wedm 的报告页，不会被覆盖，除非用 --overwrite。",
    ),
    ("report paths", "图形，或图形的文件夹"),
    ("report output", "放这些页的文件夹；没有则建立"),
    (
        "report format",
        "程序的语言：3b、4b、iso；milling 为电极铣削 [默认：`program.format`，否则 3b]",
    ),
    (
        "explain",
        "说明一条规则查什么，对切割有什么影响，可以怎么办",
    ),
    ("explain/", "不给规则名：列出全部规则。"),
    ("explain rule", "规则名，即问题级别后括号中的名称"),
    ("init", "为图形文件夹写出带注释的 wedm.toml"),
    (
        "init/",
        "在终端上会询问选项没有给出的内容；不在终端上时说明写了什么、补偿量是多少。多次切割时算出各次补偿量：粗切为电极丝半径 + 放电间隙 + 余量，n 次修切中的第 i 次为半径 + 修切放电间隙 + 余量 × (n − i) / n。",
    ),
    ("init folder", "文件写到此文件夹"),
    ("init wire", "电极丝直径，mm"),
    ("init gap", "放电间隙，mm；多次切割时为粗切的"),
    ("init fine_gap", "修切的放电间隙，mm [默认：间隙的一半]"),
    ("init stock", "粗切为修切留下的余量，mm"),
    ("init passes", "每个轮廓切几次"),
    ("init side", "丝在轮廓的哪一侧；auto：按嵌套自动判定"),
    ("init machine", "机床读什么：3b，或一种 ISO profile"),
    ("calibrate", "由切好的试件的测量值算出放电间隙和补偿量"),
    (
        "calibrate/",
        "切割时设定的补偿量为 c，公称尺寸 s、实测 m 的外形得切缝半宽 c − (m − s) / 2，内形得 c + (m − s) / 2。其平均值就是切到尺寸的补偿量，减去电极丝半径即放电间隙。± 为 95 % 置信度。自相矛盾的拒绝，并以 1 结束。不加 --write 不写任何文件。",
    ),
    (
        "calibrate path",
        "测量值，每行一个：feature、kind（outer 或 inner）、pass、nominal、measured（mm）；第一行是列名",
    ),
    ("calibrate outer", "外形尺寸（两面之间是材料）；可多次给出"),
    ("calibrate inner", "内形（型孔）尺寸；可多次给出"),
    (
        "calibrate pass",
        "--outer 和 --inner 是在第几次切割之后测量的 [默认：最后一次]",
    ),
    (
        "calibrate uncertainty",
        "单次测量的不确定度，mm：100 次中有 95 次在此之内",
    ),
    ("calibrate output", "输出的形式"),
    ("calibrate write", "把这些值连同日期写入 wedm.toml"),
    ("config", "说明可以设置什么"),
    (
        "config-examples",
        "示例：
  wedm config schema > wedm.schema.json    供能给 TOML 指定 schema 的编辑器补全和检查：
                                           在 wedm.toml 第一行写 `#:schema ./wedm.schema.json`",
    ),
    ("schema", "wedm.toml 的 JSON Schema"),
    ("view", "在浏览器中显示图形和程序，可与任何 CAD 软件并用"),
    (
        "view/",
        "只向本机提供一个页面，显示其地址并打开浏览器。每次保存后页面随之更新：问题、半径、丝的路径、修复、程序。除上级文件夹中的 wedm.toml 外，不读取所列文件夹之外的任何内容；只写入在页面中保存的文件。按 Ctrl-C 结束，或在最后一个页面关闭一分钟后结束。",
    ),
    (
        "view paths",
        "要显示的文件夹；若是文件，则显示其所在的文件夹",
    ),
    ("view port", "页面的端口 [默认：一个空闲的端口]"),
    ("view no_open", "只显示地址，不打开浏览器"),
    ("demo", "用自带的图形与真实的服务器演示全过程"),
    (
        "demo/",
        "打开凹模板图形，像设计员一样修改，显示每个诊断，采用修复，取得 3B 程序，重新解码，写出 demo.dxf、demo.3b、demo.svg 和 wedm.toml。所说的全部属实才以 0 结束。已有的同名文件若不是演示生成的，不会被覆盖，除非用 --overwrite。",
    ),
    ("demo folder", "文件写到此文件夹"),
    (
        "serve",
        "在标准输入输出上提供语言服务器协议（不带命令时就是这样）",
    ),
    ("stdio", "不起作用；为兼容而接受"),
    (
        "no_parent_watch",
        "客户端所指的进程结束后继续运行：在容器中它的编号没有意义",
    ),
    ("completions", "输出命令行补全脚本"),
    ("completions shell", "哪一种 shell"),
    ("man", "写出手册页，每个命令一页"),
    ("man folder", "手册页写到此文件夹"),
    ("help", "显示本帮助，或命令的帮助"),
    ("version", "显示版本"),
    ("subcommand", "命令"),
    ("output", "输出的形式"),
    ("encoding", "`--output lisp` 的编码；没有的字写成 \\U+XXXX"),
    ("overwrite", "覆盖内容不同的已有文件"),
    ("path", "图形"),
    (
        "config-file",
        "设置文件，叠加在输入所在处向上找到的 `wedm.toml` 之上",
    ),
    (
        "language",
        "文件是什么，不管其名称 [默认：看扩展名，扩展名看不出的看内容]",
    ),
    (
        "lang",
        "所有语句的语言 [默认：LC_ALL、LC_MESSAGES 或 LANG 的，否则 en]",
    ),
    ("refused", "错误："),
    (
        "refused UnknownArgument",
        "没有 '{InvalidArg}' 这个选项或参数",
    ),
    (
        "refused InvalidSubcommand",
        "没有 '{InvalidSubcommand}' 这个命令",
    ),
    (
        "refused InvalidValue",
        "'{InvalidArg}' 的值 '{InvalidValue}' 无效",
    ),
    ("refused NoValue", "'{InvalidArg}' 需要一个值"),
    (
        "refused ValueValidation",
        "'{InvalidArg}' 的值 '{InvalidValue}' 无效：{source}",
    ),
    (
        "refused MissingRequiredArgument",
        "缺少必需的参数：{InvalidArg}",
    ),
    (
        "refused ArgumentConflict",
        "'{InvalidArg}' 不能与 {PriorArg} 同时使用",
    ),
    (
        "refused TooManyValues",
        "'{InvalidArg}' 的值 '{InvalidValue}' 多余",
    ),
    (
        "refused TooFewValues",
        "'{InvalidArg}' 需要 {MinValues} 个值，只给了 {ActualNumValues} 个",
    ),
    (
        "refused WrongNumberOfValues",
        "'{InvalidArg}' 需要 {ExpectedNumValues} 个值，给了 {ActualNumValues} 个",
    ),
    ("refused ValidValue", "可选："),
    ("refused ValidSubcommand", "命令："),
    ("refused SuggestedArg", "是否想写："),
    ("refused SuggestedSubcommand", "是否想写："),
    ("refused SuggestedValue", "是否想写："),
    ("refused-more", "详见 '--help'。"),
    ("heading Settings", "设置"),
    ("heading Program", "程序"),
    ("heading Words", "代码"),
    ("heading Pair", "凸凹模"),
    ("heading Job", "工件"),
    ("heading Options", "选项"),
    ("heading Arguments", "参数"),
    ("heading Commands", "命令"),
    ("heading Usage", "用法："),
];
