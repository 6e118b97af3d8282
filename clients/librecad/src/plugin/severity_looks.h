// SPDX-License-Identifier: GPL-2.0-or-later
// One colour for each severity, wherever it is shown: text and ground, so that both can be read in a dark and in a light window.
#pragma once

#include "core/messages.h"

#include <QColor>

namespace wedm {

struct Look {
    QColor text;
    QColor ground;
};

inline Look lookOf(Severity severity)
{
    switch (severity) {
    case Severity::Error:
        return {QColor(120, 0, 0), QColor(255, 205, 205)};
    case Severity::Warning:
        return {QColor(100, 60, 0), QColor(255, 232, 184)};
    case Severity::Information:
        return {QColor(0, 50, 110), QColor(214, 230, 250)};
    case Severity::Hint:
        break;
    }
    return {QColor(70, 70, 70), QColor(236, 236, 236)};
}

/// For findings from before the drawing changed: no colour of a severity.
inline Look staleLook()
{
    return {QColor(130, 130, 130), QColor(244, 244, 244)};
}

} // namespace wedm
