// SPDX-License-Identifier: GPL-2.0-or-later
#include "controller.h"

#include "dialogs.h"
#include "host.h"
#include "document_interface.h"
#include "marks.h"

#include <QAction>
#include <QApplication>
#include <QMainWindow>
#include <QMdiArea>
#include <QMenu>
#include <QMessageBox>

namespace wedm {

namespace {

/// The interval at which the plugin checks whether LibreCAD has started, in ms.
constexpr int SETTLING = 50;
/// The interval at which the plugin checks whether the drawing is still the one that was checked, in ms.
constexpr int COMPARISON = 150;
/// How long LibreCAD may wait for the server when it quits, in ms.
constexpr int PATIENCE_AT_QUIT = 2000;
/// The part of the drawing that is shown round a segment, as a multiple of its size, and at least, in drawing units.
constexpr double NEIGHBOURHOOD = 4;
constexpr double LEAST_NEIGHBOURHOOD = 0.05;

/// For automation: a command that is run once the host has loaded its drawing.
QString firstCommand()
{
    return qEnvironmentVariable("WEDM_LIBRECAD_ACTION");
}

} // namespace

Controller::Controller(QObject *actions)
    : QObject(actions)
    , m_actions(actions)
    , m_session(new Session)
    , m_looks(this)
    , m_drawings(this)
    , m_attempts(m_kept, this)
{
    registerSessionTypes();
    m_session->moveToThread(&m_thread);
    connect(&m_thread, &QThread::finished, m_session, &QObject::deleteLater);
    setObjectName(QStringLiteral("wedm_controller"));
    m_thread.setObjectName(QStringLiteral("wedm"));
    connectSession();
    connect(&m_looks, &Looks::sliceWanted, this, [this] { trigger(command::LOOK); });
    connect(&m_looks, &Looks::taken, this, &Controller::looked);
    connect(&m_looks.live(), &LiveCheck::held, this, [this](const QString &reason) {
        if (m_panel)
            m_panel->setLive(reason.isEmpty() ? tr("live check on") : tr("live check %1").arg(reason));
    });
    connect(&m_drawings, &Drawings::closed, this, [this](const QString &uri) {
        post([uri](Session &session) { session.close(uri); });
        if (m_panel)
            showCurrent();
    });
    connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, this, &Controller::quit);
    connect(&m_comparison, &QTimer::timeout, this, &Controller::compare);
    m_comparison.start(COMPARISON);
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

void Controller::quit()
{
    m_looks.live().setOn(false);
    m_comparison.stop();
    // From here on LibreCAD takes its windows apart.
    m_running = true;
    m_drawings.forgetWindows();
    if (const QMainWindow *main = host::mainWindow(); main && main->findChild<QMdiArea *>())
        disconnect(main->findChild<QMdiArea *>(), nullptr, this, nullptr);
    disconnect(m_session, nullptr, this, nullptr);
    disconnect(m_session, nullptr, &m_attempts, nullptr);
    if (!m_thread.isRunning())
        return;
    post([](Session &session) {
        session.stop();
        QThread::currentThread()->quit();
    });
    if (!m_thread.wait(PATIENCE_AT_QUIT))
        m_thread.terminate();
}

void Controller::settle()
{
    // While LibreCAD starts, it processes events before its windows are up and its files are open.
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
            // The window of a drawing is also activated anew when a dialog before it has closed.
            if (!m_panel || !host::currentWindow() || host::currentWindow() == m_front)
                return;
            m_front = host::currentWindow();
            const OpenDrawing *open = m_drawings.current();
            m_panel->clear();
            m_panel->setInspection(open ? open->inspection : QSharedPointer<Inspection>());
            showCurrent();
            m_looks.live().wake();
        });
    // No plugin is told of an undo, but this action is enabled by it, however it was triggered.
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
    // LibreCAD knows a command by the action's data, not by its text.
    for (const char *name : command::SHOWN) {
        if (QAction *action = actionOf(name))
            action->setText(QCoreApplication::translate("wedm::command", name));
    }
    for (QMenu *menu : menus) {
        if (menu->actions().contains(actionOf(command::CHECK)))
            menu->setTitle(tr("Wire EDM"));
    }
    if (m_kept.live())
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
    compare();
    m_running = true;
    if (!m_panel)
        makePanel();
    m_front = host::currentWindow();
    if (!own) {
        m_panel->show();
        m_panel->raise();
        m_panel->setMessage(QString(), Panel::Tone::Plain);
    }

    if (command == QLatin1String(command::APPLY)) {
        Write write;
        std::swap(write, m_write);
        if (write)
            write(drawing);
    } else if (command == QLatin1String(command::CLEAR)) {
        const int count = clearLayer(drawing, MARK_LAYER);
        m_panel->setMessage(tr("%n mark(s) removed.", nullptr, count), Panel::Tone::Plain);
    } else if (command == QLatin1String(command::CLEAR_PATH)) {
        const bool any = clearLayer(drawing, PATH_LAYER) > 0;
        m_panel->setMessage(any ? tr("The wire path is cleared.") : tr("No wire path is drawn."), Panel::Tone::Plain);
    } else if (command == QLatin1String(command::LIVE)) {
        setLive(!m_looks.live().isOn());
        m_kept.setLive(m_looks.live().isOn());
    } else if (command == QLatin1String(command::LOOK)) {
        m_looks.slice(drawing);
    } else {
        startServer();
        if (command == QLatin1String(command::CHECK))
            post([](Session &session) { session.reloadSettings(); });
        m_looks.whole(drawing);
        const QString uri = m_drawings.of(host::currentWindow()).uri;
        if (command == QLatin1String(command::FIX))
            post([uri](Session &session) { session.requestRepair(uri, QString(), -1); });
        else if (command == QLatin1String(command::MARK))
            mark(drawing);
        else if (command == QLatin1String(command::PATH))
            post([uri](Session &session) { session.requestToolpath(uri, {}); });
        else if (command == QLatin1String(command::HOLE))
            pickHole(drawing, uri);
        else
            QTimer::singleShot(0, this, [this, command, uri] { make(command, uri); });
    }
    // LibreCAD closes its undo step after this call. What the command has drawn does not make the last look outdated; while a point is
    // picked, the user can draw.
    m_settling = command != QLatin1String(command::HOLE);
    if (m_settling)
        QTimer::singleShot(0, this, &Controller::settleChanges);
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
    connect(m_session, &Session::stateChanged, this, [this](Server::State state, const QString &text) {
        if (m_panel)
            m_panel->setServer(state, text);
    });
    connect(m_session, &Session::serverStarted, this, [this](qint64 processId) { setProperty("serverProcessId", processId); });
    connect(m_session, &Session::said, this, [this](const QString &text) {
        if (m_panel)
            m_panel->setMessage(text, Panel::Tone::Plain);
    });
    connect(m_session, &Session::found, this, [this](const QString &uri, int version, const QVector<Finding> &findings) {
        if (OpenDrawing *open = m_drawings.find(uri)) {
            open->version = version;
            open->findings = findings;
            showCurrent();
        }
    });
    connect(m_session, &Session::looked, this, [this](const QString &uri, int version, bool) {
        if (OpenDrawing *open = m_drawings.find(uri)) {
            open->looking = qMax(0, open->looking - 1);
            open->looked = version;
            if (open == m_drawings.current() && m_panel)
                m_panel->setStale(open->staleness());
        }
    });
    connect(m_session, &Session::toolpathReady, this, &Controller::pathReady);
    connect(m_session, &Session::toolpathFailed, this, &Controller::pathRefused);
    connect(m_session, &Session::figuresReady, this, &Controller::showFigures);
    connect(m_session, &Session::figuresFailed, this, [this](const QString &, const QString &reason) { say(tr("No figures: %1.").arg(reason), Panel::Tone::Bad); });
    connect(m_session, &Session::ran, this, &Controller::reported);
    connect(&m_attempts, &Attempts::asked, m_session, &Session::ask);
    connect(m_session, &Session::answered, &m_attempts, &Attempts::answered);
    connect(m_session, &Session::refused, &m_attempts, &Attempts::refused);
    connect(&m_attempts, &Attempts::said, this, &Controller::say);
    connect(&m_attempts, &Attempts::sideChosen, this, [this](const QString &side) {
        if (m_panel)
            m_panel->chooseSide(side);
    });
    connect(m_session, &Session::contourFound, this, &Controller::keepHole);
    connect(m_session, &Session::holeConfirmed, this, [this](const QString &, bool holds) {
        if (!holds) {
            m_hole.takeBack();
            post([](Session &session) { session.reloadSettings(); });
        }
        holeKept(holds ? QString() : tr("what the file holds leaves no place for it, write it there yourself"));
    });
    connect(m_session, &Session::inspected, this, [this](const QString &uri, int, const QSharedPointer<Inspection> &inspection) {
        if (OpenDrawing *open = m_drawings.find(uri)) {
            open->inspection = inspection;
            if (open == m_drawings.current() && m_panel)
                m_panel->setInspection(inspection);
        }
    });
    connect(m_session, &Session::settingsInForce, this, [this](const QString &uri, const InForce &settings) {
        if (OpenDrawing *open = m_drawings.find(uri)) {
            open->settings = settings;
            if (open == m_drawings.current() && m_panel)
                m_panel->setInForce(settings);
        }
    });
    connect(m_session, &Session::repairReady, this, &Controller::repairReady);
    connect(m_session, &Session::repairFailed, this, [this](const QString &, const QString &reason) {
        if (m_panel)
            m_panel->setMessage(reason, Panel::Tone::Bad);
    });
}

void Controller::makePanel()
{
    QMainWindow *main = host::mainWindow();
    m_panel = new Panel(main);
    // The right side is full of LibreCAD's own docks.
    main->addDockWidget(Qt::LeftDockWidgetArea, m_panel);
    connectPanel();
    startServer();
}

void Controller::connectPanel()
{
    m_panel->setSettings(m_kept.correction(), m_kept.side());
    connect(m_panel, &Panel::commandWanted, this, &Controller::trigger);
    connect(m_panel, &Panel::serverWanted, this, &Controller::chooseServer);
    connect(m_panel, &Panel::placeWanted, this, &Controller::zoom);
    connect(m_panel, &Panel::fixOneWanted, this, [this](const QString &handle, int segment) {
        const OpenDrawing *open = m_drawings.current();
        if (!open)
            return;
        // The drawing is looked at first, so that the repair is made for its present state.
        trigger(command::CHECK);
        const QString uri = open->uri;
        post([uri, handle, segment](Session &session) { session.requestRepair(uri, handle, segment); });
    });
    connect(m_panel, &Panel::settingsChanged, this, [this] {
        m_kept.setCorrection(m_panel->correction());
        m_kept.setSide(m_panel->side());
        sendSettings();
    });
}

void Controller::undone()
{
    if (!m_running)
        becomesStale(Stale::Undone);
}

void Controller::compare()
{
    const OpenDrawing *open = m_drawings.current();
    if (open && !m_running && !m_settling && !(open->changes == ChangeCount()) && !(changesOf(host::currentWindow()) == open->changes))
        becomesStale(Stale::Changed);
}

void Controller::becomesStale(Stale why)
{
    OpenDrawing *open = m_drawings.current();
    if (!open || open->stale != Stale::No)
        return;
    open->stale = why;
    if (m_panel) {
        // The message about a repair or a path was about the drawing before the change.
        m_panel->setMessage(QString(), Panel::Tone::Plain);
        m_panel->setStale(open->staleness());
    }
}

void Controller::settleChanges()
{
    OpenDrawing *open = m_drawings.current();
    m_settling = false;
    if (open && open->stale == Stale::No && !m_running)
        open->changes = changesOf(host::currentWindow());
}

/// What was seen goes to the session.
void Controller::looked(const Snapshot &snapshot)
{
    OpenDrawing &open = m_drawings.of(host::currentWindow());
    QStringList unchecked;
    for (auto each = snapshot.unchecked.constBegin(); each != snapshot.unchecked.constEnd(); ++each)
        unchecked += QStringLiteral("%1 × %2").arg(each.value()).arg(tr(each.key().toLatin1().constData()));
    open.stale = Stale::No;
    ++open.looking;
    open.changes = changesOf(host::currentWindow());
    open.unchecked = unchecked.isEmpty() ? QString() : tr("Not checked here: %1. Explode them, or check the saved DXF.").arg(unchecked.join(QStringLiteral(", ")));
    if (snapshot.otherUnit != 0)
        open.unchecked += tr(" The drawing's unit is neither mm nor inch; it is taken as the settings say, else as mm.");
    const QString uri = open.uri;
    post([uri, snapshot](Session &session) {
        session.look(uri, snapshot.entities, snapshot.units);
        session.watchRadii(uri, true);
    });
    m_panel->setUnchecked(open.unchecked);
}

void Controller::startServer()
{
    if (!m_thread.isRunning()) {
        m_thread.start();
        sendSettings();
    }
    ProgramSearch search;
    search.setting = m_kept.server();
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
    const OpenDrawing *open = m_drawings.current();
    if (!open) {
        m_panel->clear();
        return;
    }
    m_panel->setUnchecked(open->unchecked);
    if (open->version < 0)
        return;
    m_panel->setFindings(open->findings);
    m_panel->setStale(open->staleness());
    if (!open->settings.corrections.isEmpty())
        m_panel->setInForce(open->settings);
}

void Controller::setLive(bool on)
{
    m_looks.live().setOn(on);
    if (QAction *action = actionOf(command::LIVE))
        action->setChecked(on);
    if (m_panel)
        m_panel->setLive(on ? tr("live check on") : QString());
}

void Controller::mark(Document_Interface &drawing)
{
    const int count = markFaults(drawing, m_drawings.of(host::currentWindow()).findings);
    m_panel->setMessage(count == 0 ? tr("There is nothing to mark.")
                                         : tr("%n mark(s) on the layer WEDM_MARKS. They are saved with the drawing until they are cleared.", nullptr,
                                              count),
                        Panel::Tone::Plain);
}

void Controller::chooseServer()
{
    dialogs::serverProgram(m_kept.server(), [this](const QString &path) {
        m_kept.setServer(path);
        startServer();
        trigger(command::CHECK);
    });
}

void Controller::zoom(const QPointF &middle, double size)
{
    QMdiSubWindow *window = host::currentWindow();
    if (!host::versionFault().isEmpty() || !zoomTo(window, middle, qMax(size * NEIGHBOURHOOD, LEAST_NEIGHBOURHOOD)))
        return;
    // The click must hit what is shown, so it waits until that is painted.
    QTimer::singleShot(0, this, [window] {
        if (window == host::currentWindow())
            selectInMiddle(window);
    });
}

} // namespace wedm
