// SPDX-License-Identifier: GPL-2.0-or-later
// The classes of tests, each in a file of its own.
#pragma once

class QObject;

QObject *coreTests();
QObject *sessionTests();
QObject *askTests();
QObject *serverTests();
