// SPDX-License-Identifier: GPL-2.0-or-later
// The drawings that have been looked at, by the window that each is in.
#pragma once

#include "core/session.h"
#include "view.h"

#include <QMdiSubWindow>

namespace wedm {

/// Why what is shown of a drawing is outdated.
enum class Stale { No, Changed, Undone };

/// A drawing that has been looked at, and what is known of it.
struct OpenDrawing {
    QString uri;
    /// Where programs of it are written, as proposed: the folder of its file, then that of its last program.
    QString folder;
    /// Changed since it was looked at, by Undo or Redo or otherwise.
    Stale stale = Stale::No;
    /// LibreCAD's count of its changes at the last look.
    ChangeCount changes;
    /// The number of looks that the session has not compared yet, the version that the last compared one became, and that of the findings.
    int looking = 0;
    int looked = -1;
    int version = -1;
    QVector<Finding> findings;
    QSharedPointer<Inspection> inspection;
    QString unchecked;
    InForce settings;

    /// Whether the findings are those of the drawing as it is now.
    Stale staleness() const { return stale == Stale::No && looking == 0 && looked != version ? Stale::Changed : stale; }
};

class Drawings : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

    /// The drawing of the window; it is added when there is none yet.
    OpenDrawing &of(QMdiSubWindow *window);
    /// Null when no drawing has that name; else `window`, where given, becomes its window.
    OpenDrawing *find(const QString &uri, QMdiSubWindow **window = nullptr);
    /// The drawing of the window in front, if it has been looked at.
    OpenDrawing *current();
    /// No longer listens to any window.
    void forgetWindows();

signals:
    /// The window of a drawing is gone.
    void closed(const QString &uri);

private:
    QHash<QMdiSubWindow *, OpenDrawing> m_open;
    int m_names = 0;
};

} // namespace wedm
