// How the camera moves, frame by frame.
#pragma once

#include "host/layer_rows.h"
#include "host/view_reader.h"

#include <QMap>

#include <functional>

namespace lampblack
{

/// Key frames of a camera: its view (Pencil2D's canvas to picture, both centred) by frame.
using CameraKeys = QMap<int, QTransform>;

/// The view at a frame: held before the first and after the last key, and between two each number of
/// the matrix goes evenly from one to the other, as Pencil2D 0.6 does.
QTransform cameraAt(const CameraKeys& keys, int frame);

/// Where Pencil2D's origin lies in an exported picture of this size: its centre, in whole pixels.
QPointF originIn(const QSize& size);

/// Canvas to exported picture under this view, for pictures of this size.
QTransform canvasToImage(const QTransform& view, const QSize& size);

/// Reads the key frames of the camera in `row`, then comes back to the frame and layer that were
/// current. Nothing, if it lost its way; then at most the current frame differs.
std::optional<CameraKeys> readCamera(const Parts& parts, const LayerRows& rows, ViewReader* view, int row,
                                     const std::function<int()>& currentFrame);

} // namespace lampblack
