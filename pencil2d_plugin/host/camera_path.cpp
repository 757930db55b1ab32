#include "host/camera_path.h"

namespace lampblack
{

namespace
{

constexpr int MaxKeys = 1000;
constexpr int MaxSteps = 10000;

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

std::optional<CameraPath> readCamera(const Parts& parts, const LayerRows& rows, int row, CameraMoves moves,
                                     const CameraReader& read, const std::function<int()>& currentFrame)
{
    QAction* nextKey = parts.action("actionNext_KeyFrame");
    QAction* previousKey = parts.action("actionPrev_KeyFrame");
    QAction* next = parts.action("actionNext_Frame");
    QAction* previous = parts.action("actionPrevious_Frame");
    if (nextKey == nullptr || previousKey == nullptr || next == nullptr || previous == nullptr)
        return std::nullopt;

    const UpdatesOff unseen({parts.window});
    const int layerBefore = rows.currentRow();
    const int frameBefore = currentFrame();
    rows.select(row);

    // At the first and the last key the frame does not change any more.
    const auto step = [&currentFrame](QAction* action)
    {
        const int from = currentFrame();
        action->trigger();
        return currentFrame() != from;
    };
    const auto goToEnd = [&step](QAction* action)
    {
        for (int i = 0; i < MaxKeys && step(action); ++i)
        {
        }
    };
    const auto goTo = [&](int frame)
    {
        // By keys first: each frame on the way takes time.
        while (currentFrame() > frame && step(previousKey))
        {
        }
        for (int i = 0; i < MaxSteps && currentFrame() != frame; ++i)
            (currentFrame() < frame ? next : previous)->trigger();
    };
    goToEnd(previousKey);
    goToEnd(nextKey);
    const int last = currentFrame();
    goToEnd(previousKey);
    CameraPath path;
    Stop before;
    bool whole = true;
    do
    {
        const std::optional<QTransform> view = read();
        whole = view.has_value();
        if (!whole)
            break;
        const Stop here{currentFrame(), *view};
        if (path.isEmpty())
            path.insert(here.frame, here.view);
        else
            addViews(&path, before, here);
        before = here;
    } while (currentFrame() < last && step(moves == CameraMoves::Straight ? nextKey : next));

    goTo(frameBefore);
    if (layerBefore >= 0)
        rows.select(layerBefore);
    return whole ? std::optional<CameraPath>(path) : std::nullopt;
}

} // namespace lampblack
