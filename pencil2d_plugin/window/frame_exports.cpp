#include "window/frame_exports.h"

#include <algorithm>

namespace lampblack
{

void FrameExports::request(int frame, const QStringList& layers)
{
    const bool waits = std::any_of(mRequests.begin(), mRequests.end(),
                                   [&](const Request& request)
                                   { return request.frame == frame && request.layers == layers; });
    if (!waits)
        mRequests.append({frame, layers});
    answer(frame);
}

void FrameExports::cancel()
{
    mRequests.clear();
    mPainter.cancel();
}

void FrameExports::begin(const Shot& shot)
{
    cancel();
    mShot = shot;
    mFrames.clear();
}

void FrameExports::setFrame(int frame, const LayeredFrame& shown)
{
    mFrames.insert(frame, shown);
    for (Request& request : mRequests)
        request.painting = request.frame == frame ? 0 : request.painting;
    answer(frame);
}

QStringList FrameExports::files(int frame, const QStringList& layers) const
{
    const LayeredFrame shown = mFrames.value(frame);
    QStringList files;
    bool areVisible = true;
    for (const Layer& layer : mShot.layers)
    {
        const bool isWanted = layers.isEmpty() ? layer.visible : layers.contains(layer.name);
        areVisible = areVisible && isWanted == layer.visible;
        if (isWanted && shown.files.contains(layer.name))
            files.prepend(shown.files.value(layer.name));
    }
    return areVisible && !shown.whole.isEmpty() ? QStringList(shown.whole) : files;
}

void FrameExports::answer(int frame)
{
    const auto shown = mFrames.constFind(frame);
    if (shown == mFrames.constEnd())
        return;
    for (Request& request : mRequests)
    {
        if (request.frame != frame || request.painting != 0)
            continue;
        request.painting = ++mPaintings;
        const QStringList files = shown->error ? QStringList(QString()) : this->files(frame, request.layers);
        mPainter.paint(files, mShot.canvas,
                       [this, painting = mPaintings](const QImage& image) { finish(painting, image); });
    }
}

void FrameExports::finish(quint64 painting, const QImage& image)
{
    const auto found = std::find_if(mRequests.begin(), mRequests.end(),
                                    [painting](const Request& each) { return each.painting == painting; });
    if (found == mRequests.end())
        return;
    const Request request = *found;
    mRequests.erase(found);
    const LayeredFrame shown = mFrames.value(request.frame);
    if (image.isNull())
        Q_EMIT failed(request.frame, shown.error.value_or(UserError{
                                         tr("Frame %1 could not be read.").arg(request.frame), {}, {}}));
    else
        Q_EMIT exported({request.frame, image, shown.view, request.layers});
}

} // namespace lampblack
