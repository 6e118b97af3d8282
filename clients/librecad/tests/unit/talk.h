// SPDX-License-Identifier: GPL-2.0-or-later
// A session with a server, and what came of it.
#pragma once

#include "core/session.h"

#include <QSignalSpy>

#include <algorithm>

namespace wedm {

/// A busy machine may be slow; a test that waits so long has failed.
constexpr int LONG = 300000;

inline QString serverProgram()
{
    return qEnvironmentVariable("WEDM");
}

/// A session with the signals that it has sent.
struct Talk {
    Session session;
    QSignalSpy states{&session, &Session::stateChanged};
    QSignalSpy started{&session, &Session::serverStarted};
    QSignalSpy found{&session, &Session::found};
    QSignalSpy inspected{&session, &Session::inspected};
    QSignalSpy repairs{&session, &Session::repairReady};
    QSignalSpy noRepairs{&session, &Session::repairFailed};
    QSignalSpy answers{&session, &Session::answered};
    QSignalSpy refusals{&session, &Session::refused};
    QSignalSpy figures{&session, &Session::figuresReady};
    QSignalSpy noFigures{&session, &Session::figuresFailed};
    QSignalSpy runs{&session, &Session::ran};
    QSignalSpy paths{&session, &Session::toolpathReady};
    QSignalSpy noPaths{&session, &Session::toolpathFailed};
    QSignalSpy contours{&session, &Session::contourFound};
    QSignalSpy confirmed{&session, &Session::holeConfirmed};

    void start(const QString &program = serverProgram())
    {
        ProgramSearch search;
        search.setting = program;
        session.start(search);
    }
    Server::State state() const { return states.isEmpty() ? Server::State::Stopped : states.last().at(0).value<Server::State>(); }
    bool hasWaited() const
    {
        return std::any_of(states.begin(), states.end(), [](const QList<QVariant> &each) { return each.at(0).value<Server::State>() == Server::State::Waiting; });
    }
    QString text() const { return states.isEmpty() ? QString() : states.last().at(1).toString(); }
    QStringList rules() const
    {
        QStringList result;
        if (found.isEmpty())
            return {"nothing came"};
        for (const Finding &finding : found.last().at(2).value<QVector<Finding>>())
            if (finding.severity <= Severity::Warning)
                result += QStringLiteral("%1 %2/%3").arg(finding.rule, finding.handle).arg(finding.segment);
        return result;
    }
    Refusal refusal() const { return refusals.isEmpty() ? Refusal() : refusals.last().at(1).value<Refusal>(); }
    QJsonObject answer() const { return answers.isEmpty() ? QJsonObject() : answers.last().at(1).toJsonObject(); }
    int version() const { return found.isEmpty() ? -1 : found.last().at(1).toInt(); }
};

} // namespace wedm
