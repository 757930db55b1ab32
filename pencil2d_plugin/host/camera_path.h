// The view of the camera at each frame.
#pragma once

#include "host/layer_rows.h"
#include "host/view_reader.h"

#include <QMap>

#include <functional>

namespace lampblack
{

/// The view of a camera (Pencil2D's canvas to picture, both with origins at the centre) by frame: at its
/// first key, and at each frame after it at which the view is another one, up to the last key.
using CameraPath = QMap<int, QTransform>;

/// The view at a frame. Before the first frame of the path it is that of the first.
QTransform cameraAt(const CameraPath& path, int frame);

/// Pencil2D's origin in an exported picture of this size: the centre, rounded down to whole pixels.
QPointF originIn(const QSize& size);

/// Transforms canvas coordinates to an exported picture of this size under this view.
QTransform canvasToImage(const QTransform& view, const QSize& size);

/// The view of the camera whose layer is the current one, at the current frame.
using CameraReader = std::function<std::optional<QTransform>()>;

/// How cameras move between two keys: straight, as in Pencil2D 0.6; or by curves that only Pencil2D knows.
enum class CameraMoves
{
    Straight,
    Curved
};

/// Read the path of the camera layer in `row`, by going from its first key to its last: to each key, or to
/// each frame if it moves in curves, which takes time. The current frame and layer are restored. No value on
/// failure, after which the current frame may be another one.
std::optional<CameraPath> readCamera(const Parts& parts, const LayerRows& rows, int row, CameraMoves moves,
                                     const CameraReader& read, const std::function<int()>& currentFrame);

} // namespace lampblack
