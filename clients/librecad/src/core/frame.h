// SPDX-License-Identifier: GPL-2.0-or-later
// The base protocol of LSP: "Content-Length: N", an empty line, N bytes. Knows nothing of JSON or of processes.
#pragma once

#include <QByteArray>
#include <QList>

namespace wedm {

/// The bytes that carry `body`.
QByteArray frame(const QByteArray &body);

/// Cuts a stream of bytes into bodies. Memory grows with what has arrived, never with a number that stands in it.
class FrameReader {
public:
    /// Bodies above this are no messages of a sound server.
    static constexpr qint64 LARGEST_BODY = 256ll * 1024 * 1024;
    /// A header block longer than this is none.
    static constexpr int LARGEST_HEADER = 8192;

    /// Takes what has arrived and returns the bodies that are complete now.
    /// After damage nothing more is returned: where the next message begins is not known.
    QList<QByteArray> feed(const QByteArray &bytes);

    /// Empty while the stream is sound, else what is wrong with it.
    QString damage() const { return m_damage; }

private:
    bool readHeader();

    QByteArray m_waiting;
    qint64 m_length = -1;
    QString m_damage;
};

} // namespace wedm
