// SPDX-License-Identifier: GPL-2.0-or-later
#include "controller.h"

#include "host.h"

#include <QAction>
#include <QApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTextDocument>
#include <QUrl>

namespace wedm {

namespace command {
const char CHECK[] = "Check radii";
const char LIVE[] = "Live check";
const char FIX[] = "Fix";
const char GENERATE[] = "Generate 3B…";
const char MARK[] = "Mark faults";
const char CLEAR[] = "Clear marks";
const char LOOK[] = "wedm look";
const char APPLY[] = "wedm apply";
} // namespace command

namespace {

const char SETTING_SERVER[] = "server";
const char SETTING_CORRECTION[] = "correction";
const char SETTING_SIDE[] = "side";
const char SETTING_LIVE[] = "live";

/// A repair that keeps LibreCAD busy for longer than this, in ms, is asked about first.
constexpr qint64 LONG_REBUILD = 1000;
/// A look of the live check at a large drawing is taken in slices of this, in ms, beside what LibreCAD needs for each to list it.
constexpr qint64 SLICE = 40;
/// LibreCAD's time between two of them.
constexpr int BETWEEN_SLICES = 15;
/// How soon a repair is tried again that came while the user was in the middle of something.
constexpr int AGAIN = 100;
/// How often it is looked whether LibreCAD has started, in ms.
constexpr int SETTLING = 50;
/// How long a host may need to quit for the server's sake.
constexpr int PATIENCE_AT_QUIT = 2000;
/// What is seen of the neighbourhood, as a multiple of the segment's size, and at least, in drawing units.
constexpr double NEIGHBOURHOOD = 4;
constexpr double LEAST_NEIGHBOURHOOD = 0.05;
/// Marks are as large as that share of the drawing, but never smaller than the fault.
constexpr double MARK_SHARE = 0.015;

QSettings settings()
{
    return QSettings(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("wedm"), QStringLiteral("librecad"));
}

/// The automation's way in: a command that is run once the host has loaded its drawing.
QString firstCommand()
{
    return qEnvironmentVariable("WEDM_LIBRECAD_ACTION");
}

} // namespace

Controller::Controller(QObject *actions)
    : QObject(actions)
    , m_actions(actions)
    , m_session(new Session)
    , m_live(this)
{
    registerSessionTypes();
    m_session->moveToThread(&m_thread);
    connect(&m_thread, &QThread::finished, m_session, &QObject::deleteLater);
    setObjectName(QStringLiteral("wedm_controller"));
    m_thread.setObjectName(QStringLiteral("wedm"));
    connectSession();
    connect(&m_live, &LiveCheck::due, this, &Controller::lookInSlices);
    connect(&m_live, &LiveCheck::held, this, [this](const QString &reason) {
        if (m_panel)
            m_panel->setLive(reason.isEmpty() ? tr("live check on") : tr("live check %1").arg(reason));
    });
    connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, this, [this] {
        m_live.setOn(false);
        // From here on LibreCAD takes its windows apart.
        m_running = true;
        const QList<QMdiSubWindow *> windows = m_open.keys();
        for (QMdiSubWindow *window : windows)
            disconnect(window, nullptr, this, nullptr);
        if (const QMainWindow *main = host::mainWindow(); main && main->findChild<QMdiArea *>())
            disconnect(main->findChild<QMdiArea *>(), nullptr, this, nullptr);
        disconnect(m_session, nullptr, this, nullptr);
        if (!m_thread.isRunning())
            return;
        post([](Session &session) {
            session.stop();
            QThread::currentThread()->quit();
        });
        if (!m_thread.wait(PATIENCE_AT_QUIT))
            m_thread.terminate();
    });
    // LibreCAD makes the actions after it has asked for the menu, and its window after it has loaded the plugins.
    QTimer::singleShot(0, this, &Controller::settle);
}

Controller::~Controller()
{
    if (m_thread.isRunning()) {
        m_thread.quit();
        m_thread.wait(PATIENCE_AT_QUIT);
    }
}

void Controller::settle()
{
    // While LibreCAD starts, it lets events through before its windows stand and its files are open.
    if (QThread::currentThread()->loopLevel() == 0) {
        QTimer::singleShot(SETTLING, this, &Controller::settle);
        return;
    }
    QMainWindow *main = host::mainWindow();
    QAction *look = actionOf(command::LOOK);
    if (!main || !look)
        return;
    if (const QMdiArea *area = main->findChild<QMdiArea *>())
        connect(area, &QMdiArea::subWindowActivated, this, [this] {
            if (!m_panel || !host::currentWindow())
                return;
            const Open *open = current();
            m_panel->clear();
            m_panel->setInspection(open ? open->inspection : QSharedPointer<Inspection>());
            showCurrent();
            m_live.wake();
        });
    // No plugin is told of an undo, but this action comes to life with it, however it was asked for.
    for (const char *name : {"EditUndo", "EditRedo"}) {
        if (QAction *action = host::action(name)) {
            connect(action, &QAction::triggered, this, &Controller::undone);
            if (name == QLatin1String("EditRedo"))
                connect(action, &QAction::changed, this, [this] {
                    if (host::redoIsPossible())
                        undone();
                });
        }
    }
    const QList<QMenu *> menus = main->findChildren<QMenu *>();
    for (QMenu *menu : menus) {
        menu->removeAction(look);
        menu->removeAction(actionOf(command::APPLY));
    }
    actionOf(command::LIVE)->setCheckable(true);
    if (settings().value(QString::fromLatin1(SETTING_LIVE)).toBool())
        setLive(true);
    if (!firstCommand().isEmpty())
        trigger(firstCommand().toUtf8().constData());
}

void Controller::run(const QString &command, Document_Interface &drawing)
{
    const bool own = command == QLatin1String(command::LOOK) || command == QLatin1String(command::APPLY);
    const QString fault = host::versionFault();
    if (!fault.isEmpty()) {
        setLive(false);
        if (!own)
            QMessageBox::warning(host::mainWindow(), tr("Wire EDM"), fault);
        return;
    }
    if (m_running)
        return;
    m_running = true;
    if (!m_panel) {
        QMainWindow *main = host::mainWindow();
        m_panel = new Panel(main);
        // The right side is full of LibreCAD's own docks.
        main->addDockWidget(Qt::LeftDockWidgetArea, m_panel);
        connectPanel();
        startServer();
    }
    if (!own) {
        m_panel->show();
        m_panel->raise();
        m_panel->setMessage(QString(), Panel::Tone::Plain);
    }

    if (command == QLatin1String(command::APPLY)) {
        apply(drawing);
    } else if (command == QLatin1String(command::CLEAR)) {
        const int count = clearMarks(drawing);
        m_panel->setMessage(tr("%n mark(s) taken away.", nullptr, count), Panel::Tone::Plain);
    } else if (command == QLatin1String(command::LIVE)) {
        setLive(!m_live.isOn());
        settings().setValue(QString::fromLatin1(SETTING_LIVE), m_live.isOn());
    } else if (command == QLatin1String(command::LOOK)) {
        lookSlice(drawing);
    } else {
        if (!own)
            startServer();
        if (command == QLatin1String(command::CHECK))
            post([](Session &session) { session.reloadSettings(); });
        look(drawing);
        const QString uri = openFor(host::currentWindow()).uri;
        if (command == QLatin1String(command::FIX))
            post([uri](Session &session) { session.requestRepair(uri, QString(), -1); });
        else if (command == QString::fromUtf8(command::GENERATE))
            QTimer::singleShot(0, this, [this, uri] { askForFile(uri); });
        else if (command == QLatin1String(command::MARK))
            mark(drawing);
    }
    m_running = false;
}

QAction *Controller::actionOf(const char *command) const
{
    const QString name = QString::fromUtf8(command);
    const QList<QAction *> actions = m_actions->findChildren<QAction *>();
    for (QAction *each : actions) {
        if (each->data().toString() == name)
            return each;
    }
    return nullptr;
}

void Controller::trigger(const char *command)
{
    if (QAction *action = actionOf(command); action && host::currentWindow() && !m_running)
        action->trigger();
}

void Controller::connectSession()
{
    connect(m_session, &Session::stateChanged, this, [this](Session::State state, const QString &text) {
        if (m_panel)
            m_panel->setServer(state, text);
    });
    connect(m_session, &Session::serverStarted, this, [this](qint64 processId) { setProperty("serverProcessId", processId); });
    connect(m_session, &Session::said, this, [this](const QString &text) {
        if (m_panel)
            m_panel->setMessage(text, Panel::Tone::Plain);
    });
    connect(m_session, &Session::found, this, [this](const QString &uri, int version, const QVector<Finding> &findings) {
        if (Open *open = openOf(uri)) {
            open->version = version;
            open->findings = findings;
            showCurrent();
        }
    });
    connect(m_session, &Session::inspected, this, [this](const QString &uri, int, const QSharedPointer<Inspection> &inspection) {
        if (Open *open = openOf(uri)) {
            open->inspection = inspection;
            if (open == current() && m_panel)
                m_panel->setInspection(inspection);
        }
    });
    connect(m_session, &Session::settingsInForce, this, [this](const QString &uri, const InForce &settings) {
        if (Open *open = openOf(uri)) {
            open->settings = settings;
            if (open == current() && m_panel)
                m_panel->setInForce(settings);
        }
    });
    connect(m_session, &Session::repairReady, this, &Controller::repairReady);
    connect(m_session, &Session::repairFailed, this, [this](const QString &, const QString &reason) {
        if (m_panel)
            m_panel->setMessage(reason, Panel::Tone::Bad);
    });
    connect(m_session, &Session::generateFailed, this, &Controller::generateFailed);
    connect(m_session, &Session::generated, this, [this](const QString &, const Program &program) {
        if (!m_panel)
            return;
        QString text = tr("Written: %1, %2 blocks, wire path %3 mm. Every block was decoded again: at most %4 µm from the path; a control "
                          "that counts J drifts by %5, %6 µm.")
                           .arg(QDir::toNativeSeparators(program.path))
                           .arg(program.blocks)
                           .arg(program.length, 0, 'f', 3)
                           .arg(program.deviation, 0, 'f', 2)
                           .arg(program.closureX, 0, 'f', 2)
                           .arg(program.closureY, 0, 'f', 2);
        if (!program.warnings.isEmpty())
            text += QLatin1Char('\n') + tr("Findings that stand in the drawing: %1").arg(program.warnings.mid(0, 5).join(QStringLiteral("; ")));
        m_panel->setMessage(text, program.warnings.isEmpty() ? Panel::Tone::Good : Panel::Tone::Plain);
    });
}

void Controller::connectPanel()
{
    const QSettings kept = settings();
    m_panel->setSettings(kept.value(QString::fromLatin1(SETTING_CORRECTION)).toDouble(), kept.value(QString::fromLatin1(SETTING_SIDE)).toString());
    connect(m_panel, &Panel::checkWanted, this, [this] { trigger(command::CHECK); });
    connect(m_panel, &Panel::fixWanted, this, [this] { trigger(command::FIX); });
    connect(m_panel, &Panel::generateWanted, this, [this] { trigger(command::GENERATE); });
    connect(m_panel, &Panel::marksWanted, this, [this] { trigger(command::MARK); });
    connect(m_panel, &Panel::marksUnwanted, this, [this] { trigger(command::CLEAR); });
    connect(m_panel, &Panel::serverWanted, this, &Controller::chooseServer);
    connect(m_panel, &Panel::placeWanted, this, &Controller::zoom);
    connect(m_panel, &Panel::fixOneWanted, this, [this](const QString &handle, int segment) {
        const Open *open = current();
        if (!open)
            return;
        // The drawing is looked at first, so that the repair is made for what stands there now.
        trigger(command::CHECK);
        const QString uri = open->uri;
        post([uri, handle, segment](Session &session) { session.requestRepair(uri, handle, segment); });
    });
    connect(m_panel, &Panel::settingsChanged, this, [this] {
        QSettings kept = settings();
        kept.setValue(QString::fromLatin1(SETTING_CORRECTION), m_panel->correction());
        kept.setValue(QString::fromLatin1(SETTING_SIDE), m_panel->side());
        sendSettings();
    });
}

Controller::Open &Controller::openFor(QMdiSubWindow *window)
{
    const auto there = m_open.find(window);
    if (there != m_open.end())
        return *there;
    Open open;
    const QString path = host::filePath(window);
    if (!path.isEmpty()) {
        open.uri = QUrl::fromLocalFile(path).toString(QUrl::FullyEncoded);
        m_lastFolder = QFileInfo(path).absolutePath();
    }
    if (open.uri.isEmpty() || openOf(open.uri))
        open.uri = QStringLiteral("librecad:drawing/%1").arg(++m_names);
    const QString uri = open.uri;
    connect(window, &QObject::destroyed, this, [this, window, uri] {
        m_open.remove(window);
        post([uri](Session &session) { session.close(uri); });
        if (m_panel)
            showCurrent();
    });
    return *m_open.insert(window, open);
}

Controller::Open *Controller::openOf(const QString &uri, QMdiSubWindow **window)
{
    for (auto each = m_open.begin(); each != m_open.end(); ++each) {
        if (each->uri == uri) {
            if (window)
                *window = each.key();
            return &*each;
        }
    }
    return nullptr;
}

Controller::Open *Controller::current()
{
    const auto there = m_open.find(host::currentWindow());
    return there == m_open.end() ? nullptr : &*there;
}

void Controller::undone()
{
    Open *open = current();
    if (!open || m_running)
        return;
    open->stale = true;
    if (m_panel)
        m_panel->setStale(true);
}

void Controller::look(Document_Interface &drawing)
{
    QElapsedTimer clock;
    clock.start();
    m_slices.drop();
    const Snapshot snapshot = takeSnapshot(drawing);
    setProperty("lookMilliseconds", clock.elapsed());
    deliver(snapshot, clock.elapsed());
}

/// Each call of the plugin reads a slice of the drawing, and LibreCAD goes on in between.
void Controller::lookInSlices()
{
    if (!m_slices.isBegun()) {
        m_sliced = host::currentWindow();
        m_spent = 0;
        setProperty("slices", 0);
        setProperty("sliceMilliseconds", 0);
    }
    {
        HeldPainting held(m_sliced);
        m_held = &held;
        trigger(command::LOOK);
        m_held = nullptr;
    }
    if (!m_slices.isBegun()) {
        m_live.broken();
        return;
    }
    QElapsedTimer clock;
    clock.start();
    QTimer::singleShot(BETWEEN_SLICES, this, [this, clock] {
        // A command has looked at all of it meanwhile.
        if (!m_slices.isBegun())
            return;
        if (host::currentWindow() != m_sliced || (!m_slices.isComplete() && !m_live.mayGoOn())) {
            m_slices.drop();
            m_live.broken();
        } else if (m_slices.isComplete()) {
            // LibreCAD has painted now: comparing the drawing with the last one would have taken a processor from it.
            deliver(m_slices.take(), m_spent + clock.elapsed());
        } else {
            lookInSlices();
        }
    });
}

void Controller::lookSlice(Document_Interface &drawing)
{
    QElapsedTimer clock;
    clock.start();
    m_slices.read(drawing, SLICE);
    // The one painting that the look costs.
    if (m_slices.isComplete() && m_held)
        m_held->release();
    m_spent += clock.elapsed();
    setProperty("lookMilliseconds", m_spent);
    setProperty("slices", property("slices").toInt() + 1);
    setProperty("sliceMilliseconds", qMax(property("sliceMilliseconds").toLongLong(), clock.elapsed()));
}

/// What was seen goes to the session. LibreCAD was busy with it for `spent` ms so far.
void Controller::deliver(const Snapshot &snapshot, qint64 spent)
{
    QElapsedTimer clock;
    clock.start();
    Open &open = openFor(host::currentWindow());
    QStringList unchecked;
    for (auto each = snapshot.unchecked.constBegin(); each != snapshot.unchecked.constEnd(); ++each)
        unchecked += QStringLiteral("%1 × %2").arg(each.value()).arg(each.key());
    open.stale = false;
    m_panel->setStale(false);
    open.unchecked = unchecked.isEmpty() ? QString() : tr("Not checked here: %1. Explode them, or check the saved DXF.").arg(unchecked.join(QStringLiteral(", ")));
    if (snapshot.otherUnit != 0)
        open.unchecked += tr(" The drawing's unit is neither mm nor inch; it is taken as the settings say, else as mm.");
    const QString uri = open.uri;
    post([uri, snapshot](Session &session) {
        session.look(uri, snapshot.entities, snapshot.units);
        session.watchRadii(uri, true);
    });
    m_panel->setUnchecked(open.unchecked);
    setProperty("looks", property("looks").toInt() + 1);
    // LibreCAD paints the drawing again after a call of a plugin; that belongs to the cost of a look.
    QTimer::singleShot(0, this, [this, clock, spent] { m_live.looked(spent + clock.elapsed()); });
}

void Controller::startServer()
{
    if (!m_thread.isRunning()) {
        m_thread.start();
        sendSettings();
    }
    ProgramSearch search;
    search.setting = settings().value(QString::fromLatin1(SETTING_SERVER)).toString();
    search.pluginFolder = host::pluginFolder();
    post([search](Session &session) { session.start(search); });
}

void Controller::sendSettings()
{
    QJsonObject object;
    if (m_panel->correction() > 0)
        object.insert(QStringLiteral("correction"), m_panel->correction());
    if (!m_panel->side().isEmpty())
        object.insert(QStringLiteral("side"), m_panel->side());
    post([object](Session &session) { session.setSettings(object); });
}

void Controller::showCurrent()
{
    if (!m_panel)
        return;
    const Open *open = current();
    if (!open) {
        m_panel->clear();
        return;
    }
    m_panel->setUnchecked(open->unchecked);
    if (open->version < 0)
        return;
    m_panel->setFindings(open->findings);
    m_panel->setStale(open->stale);
    if (open->settings.correction > 0)
        m_panel->setInForce(open->settings);
}

void Controller::setLive(bool on)
{
    m_live.setOn(on);
    if (QAction *action = actionOf(command::LIVE))
        action->setChecked(on);
    if (m_panel)
        m_panel->setLive(on ? tr("live check on") : QString());
}

void Controller::askForFile(const QString &uri)
{
    QMdiSubWindow *window = nullptr;
    if (!openOf(uri, &window))
        return;
    const QString path = host::filePath(window);
    const QString base = path.isEmpty() ? QStringLiteral("drawing") : QFileInfo(path).completeBaseName();
    const QString folder = m_lastFolder.isEmpty() ? QDir::currentPath() : m_lastFolder;
    QFileDialog *dialog = new QFileDialog(host::mainWindow(), tr("Write the 3B program"), QDir(folder).filePath(base + QStringLiteral(".3b")),
                                          tr("3B programs (*.3b);;All files (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setObjectName(QStringLiteral("wedm_file"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QStringLiteral("3b"));
    dialog->selectFile(base + QStringLiteral(".3b"));
    connect(dialog, &QFileDialog::fileSelected, this, [this, uri](const QString &chosen) {
        m_lastFolder = QFileInfo(chosen).absolutePath();
        m_panel->setMessage(tr("The program is being made…"), Panel::Tone::Plain);
        post([uri, chosen](Session &session) { session.generate(uri, chosen, false); });
    });
    dialog->open();
}

void Controller::generateFailed(const QString &uri, const QString &path, const QString &reason, const QStringList &findings)
{
    if (!m_panel)
        return;
    m_panel->setMessage(findings.isEmpty() ? reason : reason + QLatin1Char('\n') + findings.mid(0, 5).join(QLatin1Char('\n')), Panel::Tone::Bad);
    if (findings.isEmpty())
        return;
    QMessageBox *box = new QMessageBox(QMessageBox::Warning, tr("Wire EDM"), reason, QMessageBox::NoButton, host::mainWindow());
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName(QStringLiteral("wedm_refused"));
    box->setTextFormat(Qt::PlainText);
    // The informative text takes what looks like mark-up for it, whatever the format of the other: names come out of drawings.
    box->setInformativeText(Qt::convertFromPlainText(findings.mid(0, 8).join(QLatin1Char('\n'))));
    QPushButton *force = box->addButton(tr("Write it all the same"), QMessageBox::DestructiveRole);
    QPushButton *close = box->addButton(QMessageBox::Close);
    box->setDefaultButton(close);
    connect(box, &QMessageBox::buttonClicked, this, [this, force, uri, path](QAbstractButton *button) {
        if (button == force)
            post([uri, path](Session &session) { session.generate(uri, path, true); });
    });
    box->open();
}

void Controller::repairReady(const Repair &repair)
{
    const qint64 milliseconds = rebuildTime(repair);
    if (milliseconds > LONG_REBUILD)
        askBeforeRebuild(repair, milliseconds);
    else
        applyNow(repair);
}

void Controller::askBeforeRebuild(const Repair &repair, qint64 milliseconds)
{
    QMessageBox *box = new QMessageBox(QMessageBox::Question, tr("Wire EDM"), tr("This repair rebuilds a large polyline."), QMessageBox::NoButton,
                                       host::mainWindow());
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName(QStringLiteral("wedm_rebuild"));
    box->setInformativeText(tr("LibreCAD would be busy for about %1 s, because a plugin can only replace a polyline as a whole. "
                               "Another way: save the drawing and repair the file with \"wedm fix FILE --in-place\", which takes no time.")
                                .arg(qMax<qint64>(1, milliseconds / 1000)));
    QPushButton *go = box->addButton(tr("Repair it here"), QMessageBox::AcceptRole);
    QPushButton *cancel = box->addButton(QMessageBox::Cancel);
    box->setDefaultButton(cancel);
    connect(box, &QMessageBox::buttonClicked, this, [this, go, repair](QAbstractButton *button) {
        if (button == go)
            QTimer::singleShot(0, this, [this, repair] { applyNow(repair); });
        else
            m_panel->setMessage(tr("Nothing was changed."), Panel::Tone::Plain);
    });
    box->open();
}

void Controller::applyNow(const Repair &repair)
{
    const Open *open = current();
    if (!open || open->uri != repair.uri) {
        m_panel->setMessage(tr("Another drawing has come to the front while the repair was on its way; nothing was changed."), Panel::Tone::Bad);
        return;
    }
    // LibreCAD drops what could be done again when a plugin is called: after an undo not even a look is taken.
    if (host::redoIsPossible()) {
        m_panel->setMessage(tr("The drawing was changed by Undo while the repair was on its way; nothing was changed. Ask for it again."),
                            Panel::Tone::Bad);
        return;
    }
    if (host::userIsBusy()) {
        QTimer::singleShot(AGAIN, this, [this, repair] { applyNow(repair); });
        return;
    }
    m_repair = repair;
    trigger(command::APPLY);
}

void Controller::apply(Document_Interface &drawing)
{
    const Repair repair = m_repair;
    m_repair = Repair();
    if (repair.uri.isEmpty() || openFor(host::currentWindow()).uri != repair.uri)
        return;
    QString failure;
    QElapsedTimer clock;
    clock.start();
    const bool done = applyRepair(drawing, repair, &failure);
    setProperty("applyMilliseconds", clock.elapsed());
    look(drawing);
    if (done)
        m_panel->setMessage(tr("Done: %1. One Undo takes it back.").arg(repair.title), Panel::Tone::Good);
    else
        m_panel->setMessage(failure, Panel::Tone::Bad);
}

void Controller::mark(Document_Interface &drawing)
{
    clearMarks(drawing);
    const Open &open = openFor(host::currentWindow());
    QVector<QPointF> places;
    double left = 0, right = 0, low = 0, high = 0;
    bool any = false;
    const Snapshot snapshot = takeSnapshot(drawing);
    const auto reach = [&](double x, double y) {
        left = any ? qMin(left, x) : x;
        right = any ? qMax(right, x) : x;
        low = any ? qMin(low, y) : y;
        high = any ? qMax(high, y) : y;
        any = true;
    };
    for (const Entity &entity : snapshot.entities) {
        for (const Vertex &vertex : entity.vertices)
            reach(vertex.x, vertex.y);
        if (entity.vertices.isEmpty()) {
            reach(entity.x - entity.radius, entity.y - entity.radius);
            reach(entity.x + entity.radius, entity.y + entity.radius);
        }
    }
    for (const Finding &finding : open.findings) {
        if (finding.placed && finding.severity <= Severity::Warning)
            places += (finding.start + finding.end) / 2;
    }
    drawMarks(drawing, places, qMax(right - left, high - low) * MARK_SHARE);
    m_panel->setMessage(places.isEmpty() ? tr("There is nothing to mark.")
                                         : tr("%n mark(s) on the layer WEDM_MARKS. They are saved with the drawing until they are cleared.", nullptr,
                                              places.size()),
                        Panel::Tone::Plain);
}

void Controller::chooseServer()
{
    QFileDialog *dialog = new QFileDialog(host::mainWindow(), tr("The program of the wedm server"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    const QString now = settings().value(QString::fromLatin1(SETTING_SERVER)).toString();
    if (!now.isEmpty())
        dialog->selectFile(now);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString &path) {
        settings().setValue(QString::fromLatin1(SETTING_SERVER), path);
        startServer();
        trigger(command::CHECK);
    });
    dialog->open();
}

void Controller::zoom(const QPointF &middle, double size)
{
    QMdiSubWindow *window = host::currentWindow();
    if (!host::versionFault().isEmpty() || !zoomTo(window, middle, qMax(size * NEIGHBOURHOOD, LEAST_NEIGHBOURHOOD)))
        return;
    // The click must meet what is seen, so it waits for the paint.
    QTimer::singleShot(0, this, [window] {
        if (window == host::currentWindow())
            selectInMiddle(window);
    });
}

} // namespace wedm
