#include "host/camera_path.h"

#include <QElapsedTimer>

namespace lampblack
{

namespace
{

struct Stop
{
    int frame = 0;
    QTransform view;
};

/// Pencil2D 0.6 mixes the elements of the two matrices.
QTransform between(const QTransform& a, const QTransform& b, double t)
{
    const auto mix = [t](double from, double to)
    {
        return from + (to - from) * t;
    };
    return QTransform(mix(a.m11(), b.m11()), mix(a.m12(), b.m12()), mix(a.m21(), b.m21()),
                      mix(a.m22(), b.m22()), mix(a.dx(), b.dx()), mix(a.dy(), b.dy()));
}

/// Add the views after `from`, up to that of `to`.
void addViews(CameraPath* path, const Stop& from, const Stop& to)
{
    for (int frame = from.frame + 1; frame <= to.frame; ++frame)
    {
        const double share = double(frame - from.frame) / double(to.frame - from.frame);
        const QTransform view = between(from.view, to.view, share);
        if (!areNear(path->last(), view))
            path->insert(frame, view);
    }
}

} // namespace

QTransform cameraAt(const CameraPath& path, int frame)
{
    if (path.isEmpty())
        return QTransform();
    const auto next = path.upperBound(frame);
    return next == path.begin() ? path.first() : std::prev(next).value();
}

QPointF originIn(const QSize& size)
{
    return QPoint(size.width() / 2, size.height() / 2);
}

QTransform canvasToImage(const QTransform& view, const QSize& size)
{
    const QPointF origin = originIn(size);
    return QTransform::fromTranslate(-origin.x(), -origin.y()) * view *
           QTransform::fromTranslate(origin.x(), origin.y());
}

CameraReading::CameraReading(CameraMoves moves, int length, CameraSteps steps)
    : mMoves(moves), mLength(length), mSteps(std::move(steps))
{
}

/// Pencil2D does not tell whether a frame is a key, but goes from key to key.
int CameraReading::lastKey() const
{
    mSteps.goTo(mLength);
    mSteps.toPreviousKey();
    mSteps.toNextKey();
    return mSteps.frame();
}

bool CameraReading::read(int most, int milliseconds)
{
    QElapsedTimer clock;
    clock.start();
    if (mLast == 0)
        mLast = lastKey();
    mSteps.goTo(mNext); // before its first key, a camera stands as at that key
    for (int count = 0; count < most && !mDone && (count == 0 || clock.elapsed() < milliseconds); ++count)
    {
        const std::optional<QTransform> view = mSteps.read();
        if (!view)
            return false;
        const Stop here{mSteps.frame(), *view};
        if (mPath.isEmpty())
            mPath.insert(here.frame, here.view);
        else
            addViews(&mPath, {mBefore, mViewBefore}, here);
        mBefore = here.frame;
        mViewBefore = here.view;
        if (mMoves == CameraMoves::Straight)
            mSteps.toNextKey();
        else
            mSteps.goTo(here.frame + 1);
        mNext = mSteps.frame();
        mDone = here.frame >= mLast || mNext <= here.frame;
    }
    return true;
}

} // namespace lampblack
