// The view of the camera at each frame.
#pragma once

#include "host/view_reader.h"

#include <QMap>
#include <QSize>

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

/// How cameras move between two keys: straight, as in Pencil2D 0.6; or by curves that only Pencil2D knows.
enum class CameraMoves
{
    Straight,
    Curved
};

/// What is done with the program to read a camera, whose layer is the current one.
struct CameraSteps
{
    std::function<std::optional<QTransform>()> read; ///< the view at the current frame
    std::function<int()> frame;                      ///< the current frame
    std::function<void(int)> goTo;
    std::function<void()> toNextKey;
    std::function<void()> toPreviousKey;
};

/// Reads the path of a camera, a few frames at a time: its keys, or every frame up to its last key if it
/// moves in curves.
class CameraReading
{
public:
    /// `length`: of the animation, frames.
    CameraReading(CameraMoves moves, int length, CameraSteps steps);

    /// Read at least one frame more, and at most so many, for so long. Afterwards the current frame is
    /// another one. False if a view is not to be had.
    bool read(int most, int milliseconds);
    bool isDone() const { return mDone; }
    const CameraPath& path() const { return mPath; }

private:
    int lastKey() const;

    CameraMoves mMoves;
    int mLength;
    CameraSteps mSteps;
    CameraPath mPath;
    int mLast = 0; ///< key; 0 while it is not known
    int mNext = 1;
    int mBefore = 0; ///< the frame that was read last
    QTransform mViewBefore;
    bool mDone = false;
};

} // namespace lampblack
