// SPDX-License-Identifier: GPL-2.0-or-later
// The core apart from LibreCAD. Each class of tests prints its own totals.
#include "unit.h"

#include <QCoreApplication>
#include <QScopedPointer>
#include <QtTest>

int main(int count, char **words)
{
    const QCoreApplication application(count, words);
    int failed = 0;
    for (QObject *tests : {coreTests(), sessionTests(), askTests(), serverTests()}) {
        const QScopedPointer<QObject> owned(tests);
        failed += QTest::qExec(tests, count, words);
    }
    return failed;
}
