// SPDX-License-Identifier: GPL-2.0-or-later
// The base protocol of LSP: "Content-Length: N", an empty line, N bytes. Knows nothing of JSON or of processes.
#pragma once

#include <QByteArray>
#include <QList>

namespace wedm {

/// The bytes that carry `body`.
QByteArray frame(const QByteArray &body);

/// Cuts a stream of bytes into bodies. Memory grows with what has arrived, never with a number that it contains.
class FrameReader {
public:
    /// The largest body that a sound server sends, in bytes.
    static constexpr qint64 LARGEST_BODY = 256ll * 1024 * 1024;
    /// The longest header block, in bytes.
    static constexpr int LARGEST_HEADER = 8192;

    /// Takes what has arrived and returns the bodies that are complete now.
    /// After damage nothing more is returned: it is not known where the next message begins.
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
