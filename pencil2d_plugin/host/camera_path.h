// The view of the camera at each frame.
#pragma once

#include "host/layer_rows.h"
#include "host/view_reader.h"

#include <QMap>

#include <functional>

namespace lampblack
{

/// The key frames of a camera: its view (Pencil2D's canvas to picture, both with origins at the centre) by
/// frame.
using CameraKeys = QMap<int, QTransform>;

/// The view at a frame. Before the first and after the last key it is constant. Between two keys the elements
/// of the matrix are interpolated linearly, as in Pencil2D 0.6.
QTransform cameraAt(const CameraKeys& keys, int frame);

/// Pencil2D's origin in an exported picture of this size: the centre, rounded down to whole pixels.
QPointF originIn(const QSize& size);

/// Transforms canvas coordinates to an exported picture of this size under this view.
QTransform canvasToImage(const QTransform& view, const QSize& size);

/// Read the key frames of the camera layer in `row`, by going to each of them. The current frame and layer
/// are restored. No value on failure, after which the current frame may be another one.
std::optional<CameraKeys> readCamera(const Parts& parts, const LayerRows& rows, ViewReader* view, int row,
                                     const std::function<int()>& currentFrame);

} // namespace lampblack
