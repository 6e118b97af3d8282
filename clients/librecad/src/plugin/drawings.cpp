// SPDX-License-Identifier: GPL-2.0-or-later
#include "drawings.h"

#include "host.h"

#include <QFileInfo>
#include <QUrl>

namespace wedm {

OpenDrawing &Drawings::of(QMdiSubWindow *window)
{
    const auto there = m_open.find(window);
    if (there != m_open.end())
        return *there;
    OpenDrawing open;
    const QString path = host::filePath(window);
    if (!path.isEmpty()) {
        open.uri = QUrl::fromLocalFile(path).toString(QUrl::FullyEncoded);
        open.folder = QFileInfo(path).absolutePath();
    }
    if (open.uri.isEmpty() || find(open.uri))
        open.uri = QStringLiteral("librecad:drawing/%1").arg(++m_names);
    const QString uri = open.uri;
    connect(window, &QObject::destroyed, this, [this, window, uri] {
        m_open.remove(window);
        emit closed(uri);
    });
    return *m_open.insert(window, open);
}

OpenDrawing *Drawings::find(const QString &uri, QMdiSubWindow **window)
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

OpenDrawing *Drawings::current()
{
    const auto there = m_open.find(host::currentWindow());
    return there == m_open.end() ? nullptr : &*there;
}

void Drawings::forgetWindows()
{
    for (auto each = m_open.begin(); each != m_open.end(); ++each)
        disconnect(each.key(), nullptr, this, nullptr);
}

} // namespace wedm
