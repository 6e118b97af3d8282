// SPDX-License-Identifier: GPL-2.0-or-later
// How often a server that ends is started again, and after what pause: "When the server ends" in docs/protocol.md.
#pragma once

#include <QtGlobal>

#include <optional>

namespace wedm {

class Restarts {
public:
    /// The pause in ms before the next start, after a server that has ended `life` ms after its answer to `initialize` (0 where none
    /// came). Nothing when it has ended too often.
    std::optional<int> afterLifeOf(qint64 life)
    {
        constexpr int PAUSES[] = {0, 500, 1000, 2000, 4000};
        constexpr qint64 SOUND_LIFE = 60000;
        if (life >= SOUND_LIFE)
            m_ends = 0;
        if (m_ends == int(sizeof PAUSES / sizeof *PAUSES))
            return std::nullopt;
        return PAUSES[m_ends++];
    }
    /// The user wants another start: earlier ends no longer count.
    void reset() { m_ends = 0; }

private:
    int m_ends = 0;
};

} // namespace wedm
