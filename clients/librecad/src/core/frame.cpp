// SPDX-License-Identifier: GPL-2.0-or-later
#include "frame.h"

#include <QString>

namespace wedm {

QByteArray frame(const QByteArray &body)
{
    return "Content-Length: " + QByteArray::number(body.size()) + "\r\n\r\n" + body;
}

QList<QByteArray> FrameReader::feed(const QByteArray &bytes)
{
    QList<QByteArray> bodies;
    if (!m_damage.isEmpty())
        return bodies;
    m_waiting += bytes;
    for (;;) {
        if (m_length < 0 && !readHeader())
            break;
        if (m_waiting.size() < m_length)
            break;
        bodies += m_waiting.left(int(m_length));
        m_waiting.remove(0, int(m_length));
        m_length = -1;
    }
    return bodies;
}

bool FrameReader::readHeader()
{
    const int end = m_waiting.indexOf("\r\n\r\n");
    if (end < 0) {
        if (m_waiting.size() > LARGEST_HEADER)
            m_damage = QStringLiteral("%1 bytes without the end of a header").arg(m_waiting.size());
        return false;
    }
    const QList<QByteArray> lines = m_waiting.left(end).split('\n');
    qint64 length = -1;
    for (const QByteArray &line : lines) {
        const int colon = line.indexOf(':');
        if (line.left(colon).trimmed().toLower() != "content-length")
            continue;
        bool sound = false;
        length = line.mid(colon + 1).trimmed().toLongLong(&sound);
        if (!sound)
            length = -1;
    }
    if (length < 0 || length > LARGEST_BODY) {
        m_damage = QStringLiteral("a header without a sound Content-Length: \"%1\"").arg(QString::fromLatin1(m_waiting.left(qMin(end, 80))));
        return false;
    }
    m_waiting.remove(0, end + 4);
    m_length = length;
    return true;
}

} // namespace wedm
