// SPDX-License-Identifier: GPL-2.0-or-later
#include "kept_hole.h"

#include "contours.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QSaveFile>

namespace wedm {

namespace {

/// A name between quotes, as TOML has it.
QByteArray quoted(const QString &name)
{
    QString inner = name;
    inner.replace(QLatin1Char('\\'), QLatin1String("\\\\")).replace(QLatin1Char('"'), QLatin1String("\\\""));
    return '"' + inner.toUtf8() + '"';
}

/// The error; empty where it was written.
QString write(const QString &path, const QByteArray &text)
{
    QSaveFile file(path);
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit() ? QString() : file.errorString();
}

} // namespace

QByteArray withThread(const QByteArray &text, const QString &drawing, const QString &contour, const QPointF &hole, QString *failure)
{
    const QByteArray end = text.contains("\r\n") ? "\r\n" : "\n";
    const QByteArray head = "[drawings." + quoted(drawing) + ".contours." + quoted(contour) + ']';
    const QByteArray entry = "thread = [" + pointText(hole, ", ").toUtf8() + ']';
    QList<QByteArray> lines = text.split('\n');
    for (QByteArray &each : lines) {
        if (each.endsWith('\r'))
            each.chop(1);
    }
    if (!lines.isEmpty() && lines.last().isEmpty())
        lines.removeLast();
    int at = -1;
    for (int i = 0; i < lines.size() && at < 0; ++i) {
        const QByteArray line = lines.at(i).trimmed();
        const QByteArray behind = line.mid(head.size()).trimmed();
        if (line.startsWith(head) && (behind.isEmpty() || behind.startsWith('#')))
            at = i + 1;
    }
    if (at < 0) {
        if (!lines.isEmpty())
            lines += QByteArray();
        lines << head << entry;
        return lines.join(end) + end;
    }
    for (int i = at; i < lines.size() && !lines.at(i).trimmed().startsWith('['); ++i) {
        const QByteArray line = lines.at(i);
        if (!line.trimmed().isEmpty())
            at = i + 1;
        if (line.left(qMax(0, line.indexOf('='))).trimmed() != "thread")
            continue;
        const int last = line.indexOf(']');
        const QByteArray behind = last < 0 ? QByteArray() : line.mid(last + 1);
        if (last < 0 || !(behind.trimmed().isEmpty() || behind.trimmed().startsWith('#'))) {
            *failure = QCoreApplication::translate("wedm::Session", "line %1 is not understood").arg(i + 1);
            return text;
        }
        lines[i] = entry + behind;
        return lines.join(end) + end;
    }
    lines.insert(at, entry);
    return lines.join(end) + end;
}

QString KeptHole::keep(const QString &file, const QString &drawing, const QString &contour, const QPointF &hole)
{
    const QFileInfo drawn(drawing);
    m_file = file.isEmpty() ? drawn.absoluteDir().filePath(QStringLiteral("wedm.toml")) : file;
    QFile old(m_file);
    m_existed = old.exists();
    if (m_existed && !old.open(QIODevice::ReadOnly))
        return old.errorString();
    m_before = m_existed ? old.readAll() : QByteArray();
    QString failure;
    const QByteArray text = withThread(m_before, drawn.fileName(), contour, hole, &failure);
    return failure.isEmpty() ? write(m_file, text) : failure;
}

void KeptHole::takeBack() const
{
    if (m_existed)
        write(m_file, m_before);
    else
        QFile::remove(m_file);
}

} // namespace wedm
