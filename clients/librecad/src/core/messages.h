// SPDX-License-Identifier: GPL-2.0-or-later
// The `wedm/` types as JSON, in both directions. Knows nothing of who sends them.
#pragma once

#include "drawing.h"

#include <QByteArray>
#include <QJsonObject>
#include <QPointF>

namespace wedm {

/// A `Drawing` as JSON. Written straight to text: 200,000 vertices as a tree of JSON values take ten times as long.
QByteArray toJson(const Drawing &drawing);

/// The params of `wedm/didChangeDrawing`.
QByteArray toJson(const QString &uri, int version, const QVector<Change> &changes);

/// A string as JSON, with its quotes.
QByteArray toJson(const QString &text);

/// Changes as a fix holds them. If it is no such list, `failure` says why, and the result is empty.
QVector<Change> changesFromJson(const QJsonArray &changes, QString *failure);

enum class Severity { Error = 1, Warning = 2, Information = 3, Hint = 4 };

/// A diagnostic of a drawing.
struct Finding {
    Severity severity = Severity::Error;
    QString rule;
    QString message;
    /// Empty where the finding is about the whole drawing.
    QString handle;
    int segment = -1;
    /// Whether the ends of the segment are known, and these ends, in drawing units.
    bool placed = false;
    QPointF start;
    QPointF end;
    /// As it came, for `context.diagnostics` of a request for its fixes.
    QJsonObject diagnostic;
};

Finding findingFromJson(const QJsonObject &diagnostic);

/// One line of the radius list.
struct Row {
    QString handle;
    QString type;
    QString layer;
    int segment = 0;
    QString kind;
    QPointF start;
    QPointF end;
    bool hasCentre = false;
    QPointF centre;
    bool hasRadius = false;
    double radius = 0;
    double sweep = 0;
    QString verdict;
};

/// The result of `wedm/inspect`.
struct Inspection {
    double unitsToMm = 1;
    QVector<Row> rows;
};

Inspection inspectionFromJson(const QJsonObject &inspection);

} // namespace wedm
