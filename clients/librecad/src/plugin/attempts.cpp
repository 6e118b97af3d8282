// SPDX-License-Identifier: GPL-2.0-or-later
#include "attempts.h"

#include "dialogs.h"
#include "programs.h"

namespace wedm {

namespace {

const char OPTIONS[] = "options";

Wanted with(Wanted wanted, const QJsonObject &more)
{
    QJsonObject options = wanted.params.value(OPTIONS).toObject();
    for (auto each = more.begin(); each != more.end(); ++each)
        options.insert(each.key(), each.value());
    wanted.params.insert(OPTIONS, options);
    return wanted;
}

} // namespace

Attempts::Attempts(Kept &kept, QObject *parent)
    : QObject(parent)
    , m_kept(kept)
{
}

void Attempts::begin(const Wanted &wanted)
{
    m_waiting.insert(++m_last, wanted);
    emit asked(m_last, wanted.uri, wanted.method, wanted.params);
}

void Attempts::askSide(bool mills, const std::function<void(const QString &side)> &go)
{
    dialogs::side(mills, [this, go](const QString &side) {
        emit sideChosen(side);
        go(side);
    });
}

void Attempts::answered(int number, const QJsonObject &result)
{
    const Wanted wanted = m_waiting.take(number);
    if (wanted.made)
        wanted.made(result, wanted.params.value(OPTIONS).toObject());
}

void Attempts::refused(int number, const Refusal &refusal)
{
    if (!m_waiting.contains(number))
        return;
    const Wanted wanted = m_waiting.take(number);
    const QString sentence = wanted.failure.arg(refusal.reason);
    emit said(programs::refused(sentence, refusal.findings), Panel::Tone::Bad);
    const QJsonObject options = wanted.params.value(OPTIONS).toObject();
    if (refusal.needsSide() && !options.contains("side"))
        askSide(wanted.mills, [this, wanted](const QString &side) { begin(with(wanted, {{"side", side}})); });
    else if (refusal.needsPair() && !options.contains("pair"))
        dialogs::pairSizes(m_kept.pairSizes(), [this, wanted](const dialogs::PairSizes &sizes) {
            m_kept.setPairSizes(sizes);
            const QJsonObject pair{{"drawnAs", sizes.drawnAs}, {"clearance", sizes.clearance}};
            begin(with(wanted, {{"pair", pair}, {"wireDiameter", sizes.wireDiameter}, {"gap", sizes.gap}}));
        });
    else if (!refusal.findings.isEmpty() && !wanted.params.value("force").toBool() && wanted.params.contains("format") && wanted.method != QLatin1String("wedm/holes"))
        dialogs::writeAllTheSame(sentence, refusal.findings, [this, wanted] {
            Wanted forced = wanted;
            forced.params.insert("force", true);
            begin(forced);
        });
}

} // namespace wedm
