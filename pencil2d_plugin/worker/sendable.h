// What callers hand over, within the limits of the protocol.
#pragma once

#include "worker/drawn_layer.h"

#include <QRectF>
#include <QSize>
#include <QString>

namespace lampblack
{

bool isFinite(const QRectF& rect);

/// `crop` within the limits of SPEC 6.
QRectF bounded(const QRectF& crop);

/// `size` shrunk to the allowed maximum, with the same proportions.
QSize bounded(const QSize& size);

/// `layers` as they may be sent of a drawing of this size: if they are too many or too large, none but
/// painted light.
DrawnLayers sendable(DrawnLayers layers, const QSize& size);

/// Whether it is a path and pattern of rendered files.
bool isOutput(const QString& output);

} // namespace lampblack
