// SPDX-License-Identifier: GPL-2.0-or-later
#include "layer_looks.h"

#include "document_interface.h"

namespace wedm {

namespace {

const char BY_LAYER[] = "BYLAYER";
/// LibreCAD's name of a linetype as it is in DXF: DashDotLine2 is DASHDOT2. Empty for a continuous line, and for that of a block, of which
/// there is none around an entity of the drawing.
QString nameInDxf(const QString &linetype)
{
    QString name = linetype.toUpper().remove(QLatin1String("LINE"));
    if (name == QLatin1String("SOLID") || name == QLatin1String("BYBLOCK") || name == QLatin1String(BY_LAYER))
        return QString();
    // DashLine is DASHED, its longer relatives are DASHDOT.
    if (name.startsWith(QLatin1String("DASH")) && !name.startsWith(QLatin1String("DASHDOT")))
        name.insert(4, QLatin1String("ED"));
    return name;
}

/// The same of a layer, by LibreCAD 2.2.0's own number, which the interface hands on as it is: names of it would lack the tiny linetypes, such as
/// that which HIDDEN2 becomes. From 2 on there are four sizes of each.
QString nameInDxf(int linetype)
{
    static const char *const NAMES[] = {"DOT", "DASHED", "DASHDOT", "DIVIDE", "CENTER", "BORDER"};
    static const char *const SIZES[] = {"", "TINY", "2", "X2"};
    constexpr int FIRST = 2;
    constexpr int END = FIRST + 6 * 4;
    if (linetype < FIRST || linetype >= END)
        return QString();
    return QString::fromLatin1(NAMES[(linetype - FIRST) / 4]) + QLatin1String(SIZES[(linetype - FIRST) % 4]);
}

/// Empty for that of a layer or a block, which is negative.
QString nameOfColour(int colour)
{
    return colour < 0 ? QString() : QStringLiteral("#%1").arg(colour & 0xffffff, 6, 16, QLatin1Char('0'));
}

} // namespace

LayerLooks::LayerLooks(Document_Interface &drawing, QHash<QString, EntityLook> &known)
    : m_drawing(drawing)
    , m_known(known)
    , m_active(drawing.getCurrentLayer())
    , m_now(m_active)
{
}

LayerLooks::~LayerLooks()
{
    if (m_now != m_active)
        m_drawing.setLayer(m_active);
}

EntityLook LayerLooks::of(const Data &data)
{
    const QString linetype = data.value(DPI::LTYPE).toString();
    const int colour = data.value(DPI::COLOR).toInt();
    const bool isByLayer = linetype == QLatin1String(BY_LAYER);
    EntityLook look;
    if (isByLayer || colour < 0)
        look = ofLayer(data.value(DPI::LAYER).toString());
    if (!isByLayer) {
        look.linetype = nameInDxf(linetype);
        look.linetypeByLayer = false;
    }
    if (colour >= 0)
        look.color = nameOfColour(colour);
    return look;
}

EntityLook LayerLooks::ofLayer(const QString &layer)
{
    const auto found = m_known.constFind(layer);
    if (found != m_known.constEnd())
        return *found;
    if (m_now != layer)
        m_drawing.setLayer(layer);
    m_now = layer;
    int colour = 0;
    DPI::LineWidth width = DPI::WidthByLayer;
    DPI::LineType linetype = DPI::SolidLine;
    m_drawing.getCurrentLayerProperties(&colour, &width, &linetype);
    EntityLook look;
    look.linetype = nameInDxf(int(linetype));
    look.linetypeByLayer = !look.linetype.isEmpty();
    look.color = nameOfColour(colour);
    m_known.insert(layer, look);
    return look;
}

} // namespace wedm
