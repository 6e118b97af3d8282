// SPDX-License-Identifier: GPL-2.0-or-later
// The thread hole of a contour, kept in a wedm.toml.
#pragma once

#include <QPointF>
#include <QString>

namespace wedm {

/// `text` of a wedm.toml with the thread hole of one contour in it; every other line stays as it is. Where an existing line of that hole
/// is not understood, `failure` says so.
QByteArray withThread(const QByteArray &text, const QString &drawing, const QString &contour, const QPointF &hole, QString *failure);

class KeptHole {
public:
    /// Writes the hole into `file`, or if that is empty into the wedm.toml beside the drawing. Returns why that failed, or nothing.
    QString keep(const QString &file, const QString &drawing, const QString &contour, const QPointF &hole);
    /// Makes the file what it was.
    void takeBack() const;
    const QString &file() const { return m_file; }

    /// The message to show once the server has read it.
    QString told;

private:
    QString m_file;
    bool m_existed = false;
    QByteArray m_before;
};

} // namespace wedm
