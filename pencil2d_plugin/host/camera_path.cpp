#include "host/camera_path.h"

namespace lampblack
{

namespace
{

constexpr int MaxKeys = 1000;
constexpr int MaxSteps = 10000;

QTransform between(const QTransform& a, const QTransform& b, double t)
{
    const auto mix = [t](double from, double to)
    {
        return from + (to - from) * t;
    };
    return QTransform(mix(a.m11(), b.m11()), mix(a.m12(), b.m12()), mix(a.m21(), b.m21()),
                      mix(a.m22(), b.m22()), mix(a.dx(), b.dx()), mix(a.dy(), b.dy()));
}

} // namespace

QTransform cameraAt(const CameraKeys& keys, int frame)
{
    if (keys.isEmpty())
        return QTransform();
    const auto next = keys.upperBound(frame);
    if (next == keys.begin())
        return keys.first();
    const auto before = std::prev(next);
    if (next == keys.end())
        return before.value();
    return between(before.value(), next.value(),
                   double(frame - before.key()) / double(next.key() - before.key()));
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

std::optional<CameraKeys> readCamera(const Parts& parts, const LayerRows& rows, ViewReader* view, int row,
                                     const std::function<int()>& currentFrame)
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

    // At the last key the frame does not change any more.
    const auto step = [&currentFrame](QAction* action)
    {
        const int from = currentFrame();
        action->trigger();
        return currentFrame() != from;
    };
    CameraKeys keys;
    bool whole = true;
    for (int i = 0; i < MaxKeys && step(previousKey); ++i)
    {
    }
    do
    {
        const auto matrices = view->read();
        whole = whole && matrices.has_value();
        if (matrices)
            keys.insert(currentFrame(), matrices->view);
    } while (keys.size() < MaxKeys && step(nextKey));

    for (int i = 0; i < MaxSteps && currentFrame() != frameBefore; ++i)
        (currentFrame() < frameBefore ? next : previous)->trigger();
    if (layerBefore >= 0)
        rows.select(layerBefore);
    return whole ? std::optional<CameraKeys>(keys) : std::nullopt;
}

} // namespace lampblack
