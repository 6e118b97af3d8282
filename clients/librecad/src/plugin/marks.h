// SPDX-License-Identifier: GPL-2.0-or-later
// Circles about the faults, in the drawing itself.
#pragma once

#include "core/messages.h"

class Document_Interface;

namespace wedm {

/// Draws a circle about each error and warning in place of the marks that are there; returns how many.
int markFaults(Document_Interface &drawing, const QVector<Finding> &findings);

} // namespace wedm
