#include "host/camera_path.h"

namespace lampblack
{

namespace
{

constexpr int MaxKeys = 1000;
constexpr int MaxSteps = 10000;

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

std::optional<CameraPath> readCamera(const Parts& parts, const LayerRows& rows, int row,
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
        for (int i = 0; i < MaxSteps && currentFrame() != frame; ++i)
            (currentFrame() < frame ? next : previous)->trigger();
    };
    goToEnd(previousKey);
    goToEnd(nextKey);
    const int last = currentFrame();
    goToEnd(previousKey);
    CameraPath path;
    bool whole = true;
    do
    {
        const std::optional<QTransform> view = read();
        whole = view.has_value();
        if (whole && (path.isEmpty() || !areNear(path.last(), *view)))
            path.insert(currentFrame(), *view);
    } while (whole && currentFrame() < last && step(next));

    goTo(frameBefore);
    if (layerBefore >= 0)
        rows.select(layerBefore);
    return whole ? std::optional<CameraPath>(path) : std::nullopt;
}

} // namespace lampblack
