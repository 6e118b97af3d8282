<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh" sourcelanguage="en">
<context>
    <name>QObject</name>
    <message>
        <source>This plugin was built for LibreCAD %1, and this is LibreCAD %2. The plugin interface changes between versions without notice, so nothing is done. Build the plugin against the source of this version.</source>
        <translation>此插件为 LibreCAD %1 编译，而这是 LibreCAD %2。插件接口随版本变化，因此不作任何操作。请用此版本的源代码编译插件。</translation>
    </message>
    <message>
        <source>The drawing has changed while the repair was on its way; nothing was changed. Ask for it again.</source>
        <translation>等待修复期间图形已改变，未作任何修改。请重新要求修复。</translation>
    </message>
    <message>
        <source>The repair holds what this plugin cannot draw; nothing was changed.</source>
        <translation>修复中含有此插件画不出的内容，未作任何修改。</translation>
    </message>
    <message>
        <source>LibreCAD has kept something other than the repair: press Undo, and repair the saved file with &quot;wedm fix&quot;.</source>
        <translation>LibreCAD 保存的与修复内容不符：请撤销，再用“wedm fix”修复已保存的文件。</translation>
    </message>
</context>
<context>
    <name>wedm::Connection</name>
    <message>
        <source>it could not be started: %1</source>
        <translation>无法启动：%1</translation>
    </message>
    <message>
        <source>it was killed or has crashed</source>
        <translation>被终止或已崩溃</translation>
    </message>
    <message>
        <source>it ended with code %1</source>
        <translation>以代码 %1 结束</translation>
    </message>
    <message>
        <source>it does not speak the language server protocol: %1</source>
        <translation>不是语言服务器协议：%1</translation>
    </message>
</context>
<context>
    <name>wedm::Controller</name>
    <message>
        <source>live check on</source>
        <translation>实时检查已打开</translation>
    </message>
    <message>
        <source>live check %1</source>
        <translation>实时检查%1</translation>
    </message>
    <message>
        <source>Wire EDM</source>
        <translation>线切割</translation>
    </message>
    <message numerus="yes">
        <source>%n mark(s) removed.</source>
        <translation>
            <numerusform>已清除 %n 个标记。</numerusform>
        </translation>
    </message>
    <message>
        <source>Not checked here: %1. Explode them, or check the saved DXF.</source>
        <translation>此处未检查：%1。请分解，或检查保存的 DXF。</translation>
    </message>
    <message>
        <source> The drawing&apos;s unit is neither mm nor inch; it is taken as the settings say, else as mm.</source>
        <translation>图形单位既不是毫米也不是英寸；按设置处理，没有设置时为 mm。</translation>
    </message>
    <message>
        <source>The program is being made…</source>
        <translation>正在生成程序…</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>未作任何修改。</translation>
    </message>
    <message>
        <source>Done: %1. One Undo takes it back.</source>
        <translation>完成：%1。撤销一次即可恢复。</translation>
    </message>
    <message>
        <source>There is nothing to mark.</source>
        <translation>没有可标记的。</translation>
    </message>
    <message numerus="yes">
        <source>%n mark(s) on the layer WEDM_MARKS. They are saved with the drawing until they are cleared.</source>
        <translation>
            <numerusform>图层 WEDM_MARKS 上有 %n 个标记，清除之前随图形保存。</numerusform>
        </translation>
    </message>
    <message>
        <source>The wire path is cleared.</source>
        <translation>已清除切割轨迹。</translation>
    </message>
    <message>
        <source>No wire path is drawn.</source>
        <translation>没有画出切割轨迹。</translation>
    </message>
    <message>
        <source>what the file holds leaves no place for it, write it there yourself</source>
        <translation>文件中已有的写法加不进去，请自行写入</translation>
    </message>
    <message>
        <source>Another drawing has come to the front while the answer was on its way; nothing was changed.</source>
        <translation>等待答复期间另一张图形已到前面，未作任何修改。</translation>
    </message>
    <message>
        <source>The drawing was changed by Undo while the answer was on its way; nothing was changed. Ask for it again.</source>
        <translation>等待答复期间图形因撤销而改变，未作任何修改。请重新要求。</translation>
    </message>
    <message>
        <source>The drawing has changed while the path was on its way; nothing was drawn. Ask for it again.</source>
        <translation>等待切割轨迹期间图形已改变，未画出任何内容。请重新要求。</translation>
    </message>
    <message>
        <source>The wire path is on the layer %1: cut %2 mm, jumps %3 mm. It is never checked, and saved with the drawing until it is cleared.</source>
        <translation>切割轨迹在图层 %1 上：切割 %2 mm，跳步 %3 mm。它不参与检查，清除之前随图形保存。</translation>
    </message>
    <message>
        <source>A thread hole is kept in wedm.toml beside the drawing: save the drawing first.</source>
        <translation>穿丝孔记在图形旁的 wedm.toml 中：请先保存图形。</translation>
    </message>
    <message>
        <source>Thread hole: click where the wire is threaded</source>
        <translation>穿丝孔：请点选穿丝的位置</translation>
    </message>
    <message>
        <source>No thread hole was picked; nothing was changed.</source>
        <translation>没有点选穿丝孔，未作任何修改。</translation>
    </message>
    <message>
        <source>There is no contour that the thread hole could belong to; nothing was kept.</source>
        <translation>没有此穿丝孔所属的轮廓，未作任何记录。</translation>
    </message>
    <message>
        <source>Thread hole %1 for the contour at %2, kept in %3.</source>
        <translation>穿丝孔 %1，属于 %2 处的轮廓，已记入 %3。</translation>
    </message>
    <message>
        <source>The thread hole could not be kept in %1: %2.</source>
        <translation>穿丝孔无法记入 %1：%2。</translation>
    </message>
    <message>
        <source>No figures: %1.</source>
        <translation>没有数据：%1。</translation>
    </message>
    <message>
        <source>Nothing was drawn: %1.</source>
        <translation>未画出任何内容：%1。</translation>
    </message>
    <message>
        <source>There is no path of the wire: %1.</source>
        <translation>没有切割轨迹：%1。</translation>
    </message>
    <message>
        <source>drawing</source>
        <translation>图形</translation>
    </message>
    <message>
        <source>No program was made: %1.</source>
        <translation>未生成程序：%1。</translation>
    </message>
    <message>
        <source>The program is made and proved; it is not written yet.</source>
        <translation>程序已生成并验证，尚未写出。</translation>
    </message>
    <message>
        <source>No program was written to %1: %2.</source>
        <translation>程序未写到 %1：%2。</translation>
    </message>
    <message>
        <source>The programs are being made…</source>
        <translation>正在生成程序…</translation>
    </message>
    <message>
        <source>The programs are made and proved; they are not written yet.</source>
        <translation>程序已生成并验证，尚未写出。</translation>
    </message>
    <message>
        <source>Save the programs of the pair</source>
        <translation>保存一对零件的程序</translation>
    </message>
    <message>
        <source>Two parts would be written to %1: give them other names.</source>
        <translation>两个零件会写入同一文件 %1：请给它们取不同的名称。</translation>
    </message>
    <message>
        <source>The drill list is saved: %1.</source>
        <translation>钻孔清单已保存：%1。</translation>
    </message>
    <message>
        <source>The drill list could not be saved to %1: %2.</source>
        <translation>钻孔清单无法保存到 %1：%2。</translation>
    </message>
    <message>
        <source>There is no drill list: %1.</source>
        <translation>没有钻孔清单：%1。</translation>
    </message>
    <message>
        <source>Whether the parts fit is not known: %1.</source>
        <translation>不知道两件是否配合：%1。</translation>
    </message>
    <message>
        <source>Show the picture</source>
        <translation>显示图片</translation>
    </message>
    <message>
        <source>The picture could not be shown: %1.</source>
        <translation>无法显示图片：%1。</translation>
    </message>
    <message>
        <source>A report is made of the saved file: save the drawing first.</source>
        <translation>报告按已保存的文件生成：请先保存图形。</translation>
    </message>
    <message>
        <source>The report is being made…</source>
        <translation>正在生成报告…</translation>
    </message>
    <message>
        <source>No report was made: %1.</source>
        <translation>未生成报告：%1。</translation>
    </message>
    <message>
        <source>No report was made: %1</source>
        <translation>未生成报告：%1</translation>
    </message>
    <message>
        <source>it ended with code %1</source>
        <translation>以代码 %1 结束</translation>
    </message>
    <message>
        <source>The report is written: %1.</source>
        <translation>报告已写出：%1。</translation>
    </message>
    <message>
        <source>There are errors in the drawing.</source>
        <translation>图形存在错误。</translation>
    </message>
    <message>
        <source>No program was found that shows it.</source>
        <translation>没有找到可显示它的程序。</translation>
    </message>
    <message>
        <source>ellipse</source>
        <translation>椭圆</translation>
    </message>
    <message>
        <source>spline</source>
        <translation>样条曲线</translation>
    </message>
    <message>
        <source>block</source>
        <translation>块</translation>
    </message>
    <message>
        <source>hatch</source>
        <translation>填充</translation>
    </message>
    <message>
        <source>image</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>solid</source>
        <translation>实心填充</translation>
    </message>
</context>
<context>
    <name>wedm::Drawing</name>
    <message>
        <source>entity %1 is not a polyline</source>
        <translation>图元 %1 不是多段线</translation>
    </message>
    <message>
        <source>vertices %1 to %2 of %3, which has %4</source>
        <translation>%3 的顶点 %1 到 %2 超出范围，共 %4 个</translation>
    </message>
    <message>
        <source>a vertex of %1 is not finite</source>
        <translation>%1 有顶点不是有限数</translation>
    </message>
    <message>
        <source>a number of %1 is not finite</source>
        <translation>%1 有数不是有限数</translation>
    </message>
    <message>
        <source>there is no entity %1 to put %2 before</source>
        <translation>没有图元 %1，无法把 %2 放在它前面</translation>
    </message>
    <message>
        <source>there is no entity %1</source>
        <translation>没有图元 %1</translation>
    </message>
</context>
<context>
    <name>wedm::LiveCheck</name>
    <message>
        <source>paused: a check now would end Redo</source>
        <translation>已暂停：现在检查会使重做失效</translation>
    </message>
</context>
<context>
    <name>wedm::Panel</name>
    <message>
        <source>Wire EDM</source>
        <translation>线切割</translation>
    </message>
    <message>
        <source>Fix this</source>
        <translation>修复此处</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>not set here</source>
        <translation>此处未设置</translation>
    </message>
    <message>
        <source>Wire radius + spark gap. A wedm.toml beside the drawing comes first; without either it is 0.1 mm.</source>
        <translation>丝半径 + 放电间隙。图形旁的 wedm.toml 优先；两者都没有时为 0.1 mm。</translation>
    </message>
    <message>
        <source>opening: the wire runs inside</source>
        <translation>型孔：丝在内侧走</translation>
    </message>
    <message>
        <source>punch: the wire runs outside</source>
        <translation>凸模：丝在外侧走</translation>
    </message>
    <message>
        <source>by nesting</source>
        <translation>按嵌套</translation>
    </message>
    <message>
        <source>both sides</source>
        <translation>两侧</translation>
    </message>
    <message>
        <source>Where the wire runs. A program can be made only where that is known.</source>
        <translation>丝在哪一侧走。知道补偿方向才能生成程序。</translation>
    </message>
    <message>
        <source>Faults</source>
        <translation>问题</translation>
    </message>
    <message>
        <source>Arcs and faults</source>
        <translation>圆弧和问题</translation>
    </message>
    <message>
        <source>All vertices</source>
        <translation>全部顶点</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>检查</translation>
    </message>
    <message>
        <source>Fix all</source>
        <translation>全部修复</translation>
    </message>
    <message>
        <source>Mark</source>
        <translation>标记</translation>
    </message>
    <message>
        <source>Clear marks</source>
        <translation>清除标记</translation>
    </message>
    <message>
        <source>Server…</source>
        <translation>服务器…</translation>
    </message>
    <message>
        <source>Check the drawing now</source>
        <translation>立即检查图形</translation>
    </message>
    <message>
        <source>Make every repair that is safe, in one undo step</source>
        <translation>做所有安全的修复，一次撤销即可恢复</translation>
    </message>
    <message>
        <source>Repair the selected segment</source>
        <translation>修复选中的段</translation>
    </message>
    <message>
        <source>Draw a circle about each fault, on the layer WEDM_MARKS</source>
        <translation>在图层 WEDM_MARKS 上给每个问题画圈</translation>
    </message>
    <message>
        <source>Choose the program of the wedm server</source>
        <translation>选择 wedm 服务器程序</translation>
    </message>
    <message>
        <source>Correction</source>
        <translation>补偿量</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>补偿方向</translation>
    </message>
    <message>
        <source>this dock</source>
        <translation>此面板</translation>
    </message>
    <message>
        <source>drawing</source>
        <translation>图形</translation>
    </message>
    <message>
        <source>default</source>
        <translation>默认</translation>
    </message>
    <message>
        <source>sides by nesting</source>
        <translation>按嵌套</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>型孔</translation>
    </message>
    <message>
        <source>punch</source>
        <translation>凸模</translation>
    </message>
    <message>
        <source>wire on the left</source>
        <translation>丝在左侧</translation>
    </message>
    <message>
        <source>wire on the right</source>
        <translation>丝在右侧</translation>
    </message>
    <message>
        <source>inches</source>
        <translation>英寸</translation>
    </message>
    <message>
        <source>units of %1 mm</source>
        <translation>单位 %1 mm</translation>
    </message>
    <message>
        <source>correction %1 mm (%2)</source>
        <translation>补偿量 %1 mm（%2）</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
    <message>
        <source>, </source>
        <translation>，</translation>
    </message>
    <message>
        <source>against: %1</source>
        <translation>依据：%1</translation>
    </message>
    <message>
        <source>, entity %1</source>
        <translation>，图元 %1</translation>
    </message>
    <message>
        <source> vertex %1</source>
        <translation> 顶点 %1</translation>
    </message>
    <message>
        <source>and more: %1 that were sent are not listed</source>
        <translation>另有 %1 个未列出</translation>
    </message>
    <message>
        <source>not checked since Undo</source>
        <translation>撤销后未检查</translation>
    </message>
    <message>
        <source>The list is from an earlier check. Check looks at the drawing again; Redo is lost then.</source>
        <translation>列出的是以前的结果。重新检查后，不能再重做。</translation>
    </message>
    <message>
        <source>no fault found</source>
        <translation>没有问题</translation>
    </message>
    <message>
        <source>errors: %1   warnings: %2</source>
        <translation>错误：%1   警告：%2</translation>
    </message>
    <message>
        <source>%1 at the last check</source>
        <translation>上次检查：%1</translation>
    </message>
    <message>
        <source>Program</source>
        <translation>程序</translation>
    </message>
    <message>
        <source>Write the program to a file</source>
        <translation>把程序写入文件</translation>
    </message>
    <message>
        <source>Thread hole…</source>
        <translation>穿丝孔…</translation>
    </message>
    <message>
        <source>Click where the wire is threaded for the contour nearest to that point; it is kept in wedm.toml</source>
        <translation>点选穿丝的位置，属于离该点最近的轮廓；记入 wedm.toml</translation>
    </message>
    <message>
        <source>Wire path</source>
        <translation>切割轨迹</translation>
    </message>
    <message>
        <source>Draw the path of the wire on the layer WEDM_PATH, which is never checked</source>
        <translation>在图层 WEDM_PATH 上画出切割轨迹，该图层不参与检查</translation>
    </message>
    <message>
        <source>Clear path</source>
        <translation>清除轨迹</translation>
    </message>
    <message>
        <source>Remove the path of the wire</source>
        <translation>清除切割轨迹</translation>
    </message>
    <message>
        <source>Remove the circles</source>
        <translation>清除这些圆圈</translation>
    </message>
    <message>
        <source>not checked since the last change</source>
        <translation>上次改动后尚未检查</translation>
    </message>
    <message>
        <source>   notes: %1</source>
        <translation>   说明：%1</translation>
    </message>
    <message>
        <source>error</source>
        <translation>错误</translation>
    </message>
    <message>
        <source>warning</source>
        <translation>警告</translation>
    </message>
    <message>
        <source>note</source>
        <translation>注意</translation>
    </message>
    <message>
        <source>hint</source>
        <translation>提示</translation>
    </message>
    <message>
        <source>More</source>
        <translation>更多</translation>
    </message>
    <message>
        <source>Figures, the fit of punch and plate, the drill list, a report</source>
        <translation>数据、凸模与凹模是否配合、钻孔清单、报告</translation>
    </message>
</context>
<context>
    <name>wedm::ProgramSearch</name>
    <message>
        <source>Build it in wedm&apos;s folder with &quot;cargo install --path .&quot;, or put the program into the folder wedm-server beside the plugin, or choose it with the button &quot;Server…&quot;.</source>
        <translation>请在 wedm 文件夹中用“cargo install --path .”编译，或把程序放到插件旁的 wedm-server 文件夹，或用“服务器…”按钮选择。</translation>
    </message>
    <message>
        <source>The wedm server is set to &quot;%1&quot;, and there is no such program. %2</source>
        <translation>wedm 服务器设为“%1”，但没有这个程序。%2</translation>
    </message>
    <message>
        <source>The wedm server was not found: it is not set, not in &quot;%1&quot;, not on PATH and not in &quot;%2&quot;. %3</source>
        <translation>找不到 wedm 服务器：没有设置，“%1”中没有，PATH 中没有，“%2”中也没有。%3</translation>
    </message>
</context>
<context>
    <name>wedm::RadiusTable</name>
    <message>
        <source>Vertex</source>
        <translation>顶点</translation>
    </message>
    <message>
        <source>Entity</source>
        <translation>图元</translation>
    </message>
    <message>
        <source>Layer</source>
        <translation>图层</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>类型</translation>
    </message>
    <message>
        <source>Radius %1</source>
        <translation>半径 %1</translation>
    </message>
    <message>
        <source>Sweep °</source>
        <translation>圆心角 °</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>判定</translation>
    </message>
    <message>
        <source>× %1 mm</source>
        <translation>× %1 mm</translation>
    </message>
    <message>
        <source>polyline</source>
        <translation>多段线</translation>
    </message>
    <message>
        <source>line</source>
        <translation>直线</translation>
    </message>
    <message>
        <source>arc</source>
        <translation>圆弧</translation>
    </message>
    <message>
        <source>circle</source>
        <translation>圆</translation>
    </message>
    <message>
        <source>ok</source>
        <translation>正常</translation>
    </message>
</context>
<context>
    <name>wedm::Server</name>
    <message>
        <source>%1 does not answer: there was nothing within %2 s.</source>
        <translation>%1 没有应答：已等待 %2 s。</translation>
    </message>
    <message>
        <source>Starting %1</source>
        <translation>正在启动 %1</translation>
    </message>
    <message>
        <source>%1 refuses to start: %2</source>
        <translation>%1 拒绝启动：%2</translation>
    </message>
    <message>
        <source>%1 is not a wedm server (it calls itself &quot;%2&quot;). Choose the right program with the button &quot;Server…&quot;.</source>
        <translation>%1 不是 wedm 服务器（它自称“%2”）。请用“服务器…”按钮选择正确的程序。</translation>
    </message>
    <message>
        <source>wedm %1 at %2 speaks protocol %3, this plugin speaks protocol %4. Install the server and the plugin of the same release, or choose another server with the button &quot;Server…&quot;.</source>
        <translation>wedm %1（%2）的协议是 %3，此插件的协议是 %4。请安装同一版本的服务器和插件，或用“服务器…”按钮另选服务器。</translation>
    </message>
    <message>
        <source>wedm %1</source>
        <translation>wedm %1</translation>
    </message>
    <message>
        <source>%1: %2.</source>
        <translation>%1：%2。</translation>
    </message>
    <message>
        <source>The wedm server has ended 6 times in a row (%1) and is not started again before the next command.</source>
        <translation>wedm 服务器已连续结束 6 次（%1），下一个命令之前不再启动。</translation>
    </message>
    <message>
        <source> in %1 s</source>
        <translation>，%1 s 后</translation>
    </message>
    <message>
        <source>The wedm server has ended (%1). It is started again%2.</source>
        <translation>wedm 服务器已结束（%1）%2重新启动。</translation>
    </message>
</context>
<context>
    <name>wedm::Session</name>
    <message>
        <source>change %1 of the fix is not understood</source>
        <translation>看不懂修复中的修改 %1</translation>
    </message>
    <message>
        <source>The server is not running; nothing was changed.</source>
        <translation>服务器没有运行，未作任何修改。</translation>
    </message>
    <message>
        <source>Nothing was found at this segment; nothing was changed.</source>
        <translation>此段没有问题，未作任何修改。</translation>
    </message>
    <message>
        <source>The server ended before it answered; nothing was changed.</source>
        <translation>服务器没有应答就结束了，未作任何修改。</translation>
    </message>
    <message>
        <source>No repair: %1. Nothing was changed.</source>
        <translation>没有修复：%1。未作任何修改。</translation>
    </message>
    <message>
        <source>the server ended before it answered</source>
        <translation>服务器没有应答就结束了</translation>
    </message>
    <message>
        <source>There is nothing that can be repaired safely; nothing was changed.</source>
        <translation>没有能安全修复的，未作任何修改。</translation>
    </message>
    <message>
        <source>The drawing has changed while the repair was on its way; nothing was changed. Ask for it again.</source>
        <translation>等待修复期间图形已改变，未作任何修改。请重新要求修复。</translation>
    </message>
    <message>
        <source>The repair does not fit the drawing: %1. Nothing was changed.</source>
        <translation>修复与图形不符：%1。未作任何修改。</translation>
    </message>
    <message>
        <source>the server sent none</source>
        <translation>服务器没有发来程序</translation>
    </message>
    <message>
        <source>line %1 is not understood</source>
        <translation>无法理解第 %1 行</translation>
    </message>
    <message>
        <source>the server is not running</source>
        <translation>服务器没有运行</translation>
    </message>
</context>
<context>
    <name>wedm::Sheet</name>
    <message>
        <source>and %1 more, which Copy takes along</source>
        <translation>另有 %1 行，复制时一并带上</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>复制</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
</context>
<context>
    <name>wedm::command</name>
    <message>
        <source>Check radii</source>
        <translation>检查半径</translation>
    </message>
    <message>
        <source>Live check</source>
        <translation>实时检查</translation>
    </message>
    <message>
        <source>Fix</source>
        <translation>修复</translation>
    </message>
    <message>
        <source>Generate 3B…</source>
        <translation>生成 3B…</translation>
    </message>
    <message>
        <source>Mark faults</source>
        <translation>标记问题</translation>
    </message>
    <message>
        <source>Clear marks</source>
        <translation>清除标记</translation>
    </message>
    <message>
        <source>Generate 4B…</source>
        <translation>生成 4B…</translation>
    </message>
    <message>
        <source>Generate ISO…</source>
        <translation>生成 ISO…</translation>
    </message>
    <message>
        <source>Generate milling…</source>
        <translation>生成电火花铣削…</translation>
    </message>
    <message>
        <source>Pick thread hole</source>
        <translation>点选穿丝孔</translation>
    </message>
    <message>
        <source>Draw wire path</source>
        <translation>画出切割轨迹</translation>
    </message>
    <message>
        <source>Clear wire path</source>
        <translation>清除切割轨迹</translation>
    </message>
    <message>
        <source>Generate the programs of the pair…</source>
        <translation>生成一对零件的程序…</translation>
    </message>
    <message>
        <source>Show whether punch and plate fit</source>
        <translation>显示凸模与凹模是否配合</translation>
    </message>
    <message>
        <source>Save drill list…</source>
        <translation>保存钻孔清单…</translation>
    </message>
    <message>
        <source>Show figures</source>
        <translation>显示数据</translation>
    </message>
    <message>
        <source>Make a report</source>
        <translation>生成报告</translation>
    </message>
</context>
<context>
    <name>wedm::dialogs</name>
    <message>
        <source>Wire EDM</source>
        <translation>线切割</translation>
    </message>
    <message>
        <source>The program of the wedm server</source>
        <translation>wedm 服务器程序</translation>
    </message>
    <message>
        <source>Write it all the same</source>
        <translation>仍然写出</translation>
    </message>
    <message>
        <source>This repair rebuilds a large polyline.</source>
        <translation>此修复要重建一条很大的多段线。</translation>
    </message>
    <message>
        <source>LibreCAD would be busy for about %1 s, because a plugin can only replace a polyline as a whole. Another way: save the drawing and repair the file with &quot;wedm fix FILE --in-place&quot;, which takes no time.</source>
        <translation>插件只能整条替换多段线，LibreCAD 约 %1 s 不能操作。另一办法：保存图形，用“wedm fix FILE --in-place”修复文件，立即完成。</translation>
    </message>
    <message>
        <source>Repair it here</source>
        <translation>在此修复</translation>
    </message>
    <message>
        <source>milling</source>
        <translation>电火花铣削</translation>
    </message>
    <message>
        <source>Write the %1 program</source>
        <translation>写出 %1 程序</translation>
    </message>
    <message>
        <source>%1 programs (%2);;All files (*)</source>
        <translation>%1 程序 (%2);;所有文件 (*)</translation>
    </message>
    <message>
        <source>Save the drill list</source>
        <translation>保存钻孔清单</translation>
    </message>
    <message>
        <source>List for the drill (*.csv);;Drawing with the holes (*.dxf)</source>
        <translation>钻孔清单 (*.csv);;带穿丝孔的图形 (*.dxf)</translation>
    </message>
    <message>
        <source>The programs of the pair: what does the machine read?</source>
        <translation>一对零件的程序：机床读什么？</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>%1 is there already. Overwrite it?</source>
        <translation>%1 已存在。覆盖它吗？</translation>
    </message>
    <message>
        <source>%1 are there already. Overwrite them?</source>
        <translation>%1 已存在。覆盖它们吗？</translation>
    </message>
    <message>
        <source>Overwrite</source>
        <translation>覆盖</translation>
    </message>
    <message>
        <source>Which side does the electrode run on?</source>
        <translation>电极在哪一侧走？</translation>
    </message>
    <message>
        <source>Which side does the wire run on?</source>
        <translation>丝在哪一侧走？</translation>
    </message>
    <message>
        <source>Opening: electrode inside</source>
        <translation>型腔：电极在内侧</translation>
    </message>
    <message>
        <source>Opening: wire inside</source>
        <translation>型孔：丝在内侧</translation>
    </message>
    <message>
        <source>Punch: electrode outside</source>
        <translation>凸台：电极在外侧</translation>
    </message>
    <message>
        <source>Punch: wire outside</source>
        <translation>凸模：丝在外侧</translation>
    </message>
    <message>
        <source>By nesting</source>
        <translation>按嵌套</translation>
    </message>
    <message>
        <source>%1: what lies outermost is a punch, a contour within it an opening, and so on.</source>
        <translation>%1：最外面的是凸模，其中的轮廓是型孔，依此类推。</translation>
    </message>
    <message>
        <source>%1: it mills along the wall of a pocket.</source>
        <translation>%1：沿型腔的壁铣削。</translation>
    </message>
    <message>
        <source>%1: what falls out is scrap, as of a die&apos;s plate.</source>
        <translation>%1：落下的是废料，如凹模板。</translation>
    </message>
    <message>
        <source>%1: it mills round what stays.</source>
        <translation>%1：绕着留下的部分铣削。</translation>
    </message>
    <message>
        <source>%1: what falls out is the part.</source>
        <translation>%1：落下的是工件。</translation>
    </message>
    <message>
        <source>The answer holds for all contours that no setting covers, and stays in the dock under Side.</source>
        <translation>此回答用于没有设置的所有轮廓，并保留在停靠窗的“补偿方向”中。</translation>
    </message>
    <message>
        <source>Punch and plate</source>
        <translation>凸模与凹模</translation>
    </message>
    <message>
        <source>punch</source>
        <translation>凸模</translation>
    </message>
    <message>
        <source>plate</source>
        <translation>凹模</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>For this time. Kept in a wedm.toml beside the drawing (pair.drawn-as, pair.clearance, wire-diameter, gap), they hold always.</source>
        <translation>仅用于这一次。写入图形旁的 wedm.toml（pair.drawn-as、pair.clearance、wire-diameter、gap）则始终有效。</translation>
    </message>
    <message>
        <source>OK</source>
        <translation>确定</translation>
    </message>
    <message>
        <source>Drawn is the size of the</source>
        <translation>图上画的尺寸属于</translation>
    </message>
    <message>
        <source>Clearance on each side</source>
        <translation>单边间隙</translation>
    </message>
    <message>
        <source>Diameter of the wire</source>
        <translation>电极丝直径</translation>
    </message>
    <message>
        <source>Spark gap</source>
        <translation>放电间隙</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
</context>
<context>
    <name>wedm::programs</name>
    <message>
        <source>Written: %1, %2 blocks, cut %3 mm, jumps %4 mm. Every block was decoded again: at most %5 µm from the path.</source>
        <translation>已写出：%1，%2 段，切割 %3 mm，跳步 %4 mm。每段均已重新解码：偏离切割轨迹最多 %5 µm。</translation>
    </message>
    <message>
        <source>Rounding of J, added up: %1, %2 µm.</source>
        <translation>J 取整误差合计 %1, %2 µm。</translation>
    </message>
    <message>
        <source>Chords of the drawing are cut as arcs: at most %1 µm from the outline.</source>
        <translation>图形中的弦按圆弧切割：偏离轮廓最多 %1 µm。</translation>
    </message>
    <message>
        <source>%1 layers; simulated: the floor %2 to %3 mm deep, the electrode %4 mm shorter.</source>
        <translation>%1 层；模拟：底面深 %2 至 %3 mm，电极缩短 %4 mm。</translation>
    </message>
    <message>
        <source>Findings in the drawing: %1</source>
        <translation>图形中的问题：%1</translation>
    </message>
    <message>
        <source>cut on the line</source>
        <translation>沿线切割</translation>
    </message>
    <message>
        <source>punch</source>
        <translation>凸模</translation>
    </message>
    <message>
        <source>plate</source>
        <translation>凹模</translation>
    </message>
    <message>
        <source>stripper</source>
        <translation>卸料板</translation>
    </message>
    <message>
        <source>holder</source>
        <translation>固定板</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>型孔</translation>
    </message>
    <message>
        <source>left</source>
        <translation>左侧</translation>
    </message>
    <message>
        <source>right</source>
        <translation>右侧</translation>
    </message>
    <message>
        <source>both sides</source>
        <translation>两侧</translation>
    </message>
    <message>
        <source>%1, %2: correction %3 mm</source>
        <translation>%1，%2：补偿量 %3 mm</translation>
    </message>
    <message>
        <source>, the wire on what is drawn or on its other side</source>
        <translation>，丝走在图线上或图线的另一侧</translation>
    </message>
    <message>
        <source>, %1 blocks, cut %2 mm, jumps %3 mm</source>
        <translation>，%1 段，切割 %2 mm，跳步 %3 mm</translation>
    </message>
    <message>
        <source>Written to %1:</source>
        <translation>已写到 %1：</translation>
    </message>
    <message>
        <source>Whether punch and plate fit</source>
        <translation>凸模与凹模是否配合</translation>
    </message>
    <message>
        <source>Nothing was compared: no contour has a partner.</source>
        <translation>未作比较：没有一个轮廓有配对的轮廓。</translation>
    </message>
    <message>
        <source>Does not fit: the parts overlap by %1 mm where it is tightest, %2 mm of clearance are wanted.</source>
        <translation>不能配合：最紧处两件重叠 %1 mm，应有间隙 %2 mm。</translation>
    </message>
    <message>
        <source>Fits: %1 mm of %2 mm are left where it is tightest.</source>
        <translation>能够配合：最紧处 %2 mm 间隙剩 %1 mm。</translation>
    </message>
    <message>
        <source>Does not fit: %1 mm of %2 mm are left where it is tightest.</source>
        <translation>不能配合：最紧处 %2 mm 间隙剩 %1 mm。</translation>
    </message>
    <message>
        <source>mm left</source>
        <translation>剩余 mm</translation>
    </message>
    <message>
        <source>Part</source>
        <translation>零件</translation>
    </message>
    <message>
        <source>Entity</source>
        <translation>图元</translation>
    </message>
    <message>
        <source>Vertex</source>
        <translation>顶点</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%2 的 %1</translation>
    </message>
    <message>
        <source>Without a partner: %1</source>
        <translation>没有配对：%1</translation>
    </message>
    <message>
        <source>Less is left at these places than there should be. A double click shows one.</source>
        <translation>这些位置的剩余间隙小于应有间隙。双击可显示该处。</translation>
    </message>
    <message>
        <source>Figures</source>
        <translation>数据</translation>
    </message>
    <message>
        <source>Contours: %1, %2 mm round</source>
        <translation>轮廓：%1 个，共长 %2 mm</translation>
    </message>
    <message>
        <source>%1: </source>
        <translation>%1：</translation>
    </message>
    <message>
        <source>cut %1 mm, jumps %2 mm</source>
        <translation>切割 %1 mm，跳步 %2 mm</translation>
    </message>
    <message>
        <source>, %1 min on the machine</source>
        <translation>，机床用时 %1 分钟</translation>
    </message>
    <message>
        <source>, cost %1</source>
        <translation>，费用 %1</translation>
    </message>
    <message>
        <source>Contour</source>
        <translation>轮廓</translation>
    </message>
    <message>
        <source>Layer</source>
        <translation>图层</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>补偿方向</translation>
    </message>
    <message>
        <source>Segments</source>
        <translation>段数</translation>
    </message>
    <message>
        <source>Length mm</source>
        <translation>长度 mm</translation>
    </message>
    <message>
        <source>Area mm²</source>
        <translation>面积 mm²</translation>
    </message>
    <message>
        <source>Extents mm</source>
        <translation>外形 mm</translation>
    </message>
    <message>
        <source>Least R mm</source>
        <translation>最小 R mm</translation>
    </message>
    <message>
        <source>Cut no.</source>
        <translation>切割顺序</translation>
    </message>
    <message>
        <source>Cut mm</source>
        <translation>切割 mm</translation>
    </message>
    <message>
        <source>min</source>
        <translation>分钟</translation>
    </message>
    <message>
        <source>Drops g</source>
        <translation>落料 g</translation>
    </message>
    <message>
        <source>%1, open</source>
        <translation>%1，不封闭</translation>
    </message>
    <message>
        <source>Largest wire: not known, since gap is not set</source>
        <translation>最粗可用电极丝：未设 gap，无法得知</translation>
    </message>
    <message>
        <source>Largest wire: Ø %1 mm</source>
        <translation>最粗可用电极丝：Ø %1 mm</translation>
    </message>
    <message>
        <source>There is no path of the wire: %1.</source>
        <translation>没有切割轨迹：%1。</translation>
    </message>
    <message>
        <source>Not known, since not set: %1</source>
        <translation>未设而无法得知：%1</translation>
    </message>
</context>
</TS>
