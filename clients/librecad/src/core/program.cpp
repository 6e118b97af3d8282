// SPDX-License-Identifier: GPL-2.0-or-later
#include "program.h"

#include <QCoreApplication>
#include <QJsonArray>
#include <QRegularExpression>
#include <QSaveFile>

#include <algorithm>

namespace wedm {

Program programFromJson(const QJsonObject &result, const QString &format)
{
    Program program;
    program.format = format;
    program.part = result.value("part").toString();
    const QJsonArray corrections = result.value("corrections").toArray();
    for (const QJsonValue &each : corrections)
        program.corrections += each.toDouble();
    program.otherSide = result.value("otherSide").toBool();
    program.text = result.value("program").toString().toUtf8();
    program.blocks = result.value("blocks").toInt();
    program.cut = result.value("length").toDouble();
    program.jumps = result.value("jumps").toDouble();
    program.deviation = result.value("deviation").toDouble();
    program.offChords = result.value("offChords").toDouble();
    program.closureX = result.value("closure").toObject().value("x").toDouble();
    program.closureY = result.value("closure").toObject().value("y").toDouble();
    const QJsonObject milling = result.value("milling").toObject();
    program.layers = milling.value("layers").toInt();
    const QJsonArray milled = milling.value("contours").toArray();
    for (const QJsonValue &each : milled) {
        const QJsonObject floor = each.toObject().value("floor").toObject();
        const double least = floor.value("least").toDouble();
        program.floorLeast = program.floorLeast > 0 ? std::min(program.floorLeast, least) : least;
        program.floorMost = std::max(program.floorMost, floor.value("most").toDouble());
        program.worn = each.toObject().value("worn").toDouble();
    }
    const QJsonArray warnings = result.value("warnings").toArray();
    for (const QJsonValue &each : warnings)
        program.warnings += each.toObject().value("message").toString();
    return program;
}

QString partFile(const QString &base, const QString &part, const QString &ending)
{
    static const QRegularExpression unfit(QStringLiteral("[^\\p{L}\\p{N}_.-]"), QRegularExpression::UseUnicodePropertiesOption);
    return QStringLiteral("%1-%2.%3").arg(base, QString(part).replace(unfit, QStringLiteral("_")), ending);
}

QString writeFile(const QString &path, const QByteArray &content)
{
    if (content.isEmpty())
        return QCoreApplication::translate("wedm::Session", "the server sent none");
    QSaveFile file(path);
    const bool written = file.open(QIODevice::WriteOnly) && file.write(content) == content.size() && file.commit();
    return written ? QString() : file.errorString();
}

// The server's sentences, in either language: its error code is one for all refusals.

bool Refusal::needsSide() const
{
    static const QRegularExpression sentence(QStringLiteral("side of contour .* is not known|不知道轮廓 .*的补偿方向"));
    return sentence.match(reason).hasMatch();
}

bool Refusal::needsPair() const
{
    static const QRegularExpression sentence(
        QStringLiteral("corrections of a pair are not known|parts fit cannot be judged|不知道这一对零件的补偿量|不知道凸模与凹模是否配合"));
    return sentence.match(reason).hasMatch();
}

} // namespace wedm
