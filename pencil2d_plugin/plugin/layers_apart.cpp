#include "plugin/layers_apart.h"

#include "scene/layer_roles.h"

#include <QPainter>

#include <algorithm>
#include <cstdlib>

namespace lampblack
{

namespace
{

constexpr int MaxKiB = 256 * 1024;

bool isBlank(const QImage& image)
{
    for (int y = 0; y < image.height(); ++y)
    {
        const auto* pixels = reinterpret_cast<const QRgb*>(image.constScanLine(y));
        if (std::any_of(pixels, pixels + image.width(), [](QRgb pixel) { return pixel != 0; }))
            return false;
    }
    return true;
}

QStringList withoutDuplicates(QStringList names)
{
    names.removeDuplicates();
    return names;
}

DrawnLayers bottomFirst(const QStringList& lit, const QHash<QString, QImage>& images)
{
    DrawnLayers layers;
    const QStringList names = withoutDuplicates(lit);
    for (const QString& name : names)
        layers.prepend({name, images.value(name)});
    return layers;
}

int kibibytes(const QHash<QString, QImage>& images)
{
    qint64 bytes = 0;
    for (const QImage& image : images)
        bytes += image.sizeInBytes();
    return int(bytes / 1024) + 1;
}

} // namespace

LayersApart::LayersApart(Host& host, QObject* parent) : QObject(parent), mHost(host), mKept(MaxKiB)
{
    mComparing.setMaxThreadCount(1);
    connect(&host, &Host::frameExported, this, &LayersApart::onExported);
    connect(&host, &Host::exportFailed, this, &LayersApart::onFailed);
}

LayersApart::~LayersApart()
{
    mComparing.clear();
    mComparing.waitForDone();
}

void LayersApart::request(int frame, const WantedLayers& wanted)
{
    const auto before = mWaiting.constFind(frame);
    if (before != mWaiting.constEnd() && before->wanted.lit == wanted.lit &&
        before->wanted.light == wanted.light)
        return;
    Waiting waiting;
    waiting.wanted = wanted;
    waiting.number = ++mRequests;
    const QStringList names = withoutDuplicates(wanted.lit);
    QStringList missing;
    if (names.size() > 1)
    {
        const Images* kept = mKept.object(frame);
        for (const QString& name : names)
        {
            if (kept != nullptr && kept->contains(name))
                waiting.images.insert(name, kept->value(name));
            else
                missing.append(name);
        }
        waiting.reuses = !waiting.images.isEmpty();
    }
    waiting.missing = QSet<QString>(missing.begin(), missing.end());
    mWaiting.insert(frame, waiting);
    // A host may answer at once.
    for (const QString& name : qAsConst(missing))
        mHost.requestFrames(frame, frame, {name});
    // It is not kept: nothing that is seen of a frame tells whether it has changed.
    if (!wanted.light.isEmpty())
        mHost.requestFrames(frame, frame, wanted.light);
    mHost.requestFrames(frame, frame, wanted.lit);
}

void LayersApart::markChanged(int frame, const QString& layer)
{
    mWaiting.remove(frame);
    Images* kept = mKept.object(frame);
    if (kept == nullptr)
        return;
    if (layer.isEmpty())
        mKept.remove(frame);
    else
        kept->remove(layer);
}

void LayersApart::markAllChanged()
{
    mWaiting.clear();
    mKept.clear();
}

void LayersApart::onExported(const FrameExport& frame)
{
    const auto waiting = mWaiting.find(frame.frame);
    if (waiting == mWaiting.end())
        return;
    if (frame.layers == waiting->wanted.lit)
        waiting->whole = frame;
    else if (!frame.layers.isEmpty() && frame.layers == waiting->wanted.light)
        waiting->light = isBlank(frame.image) ? QImage() : frame.image;
    else if (frame.layers.size() == 1 && waiting->missing.remove(frame.layers.first()))
        waiting->images.insert(frame.layers.first(), isBlank(frame.image) ? QImage() : frame.image);
    else
        return;
    finishIfComplete(frame.frame);
}

void LayersApart::onFailed(int frame, const UserError& error)
{
    const auto waiting = mWaiting.find(frame);
    if (waiting == mWaiting.end())
        return;
    if (waiting->whole)
    {
        // A drawing lit as one body is better than none.
        const FrameExport whole = *waiting->whole;
        mWaiting.erase(waiting);
        Q_EMIT exported(whole, {});
        return;
    }
    mWaiting.erase(waiting);
    Q_EMIT failed(frame, error);
}

void LayersApart::finishIfComplete(int frame)
{
    const Waiting& waiting = mWaiting[frame];
    const bool lacksLight = !waiting.light && !waiting.wanted.light.isEmpty();
    if (!waiting.whole || !waiting.missing.isEmpty() || lacksLight)
        return;
    if (waiting.reuses)
        compareWithWhole(frame);
    else
        deliver(frame);
}

void LayersApart::compareWithWhole(int frame)
{
    const Waiting waiting = mWaiting.value(frame);
    mComparing.start(
        [this, frame, waiting]
        {
            const bool alike =
                lookAlike(bottomFirst(waiting.wanted.lit, waiting.images), waiting.whole->image);
            QMetaObject::invokeMethod(
                this,
                [this, frame, waiting, alike]
                {
                    if (mWaiting.value(frame).number != waiting.number)
                        return;
                    if (alike)
                    {
                        deliver(frame);
                        return;
                    }
                    markChanged(frame, {});
                    request(frame, waiting.wanted);
                },
                Qt::QueuedConnection);
        });
}

void LayersApart::deliver(int frame)
{
    const Waiting waiting = mWaiting.take(frame);
    DrawnLayers layers = bottomFirst(waiting.wanted.lit, waiting.images);
    layers.erase(std::remove_if(layers.begin(), layers.end(),
                                [](const DrawnLayer& layer) { return layer.pixels.isNull(); }),
                 layers.end());
    if (layers.size() < 2)
        layers.clear();
    if (waiting.light && !waiting.light->isNull())
        layers.append({lightLayer(), *waiting.light});
    if (!waiting.images.isEmpty())
        mKept.insert(frame, new Images(waiting.images), kibibytes(waiting.images));
    Q_EMIT exported(*waiting.whole, layers);
}

bool lookAlike(const DrawnLayers& layers, const QImage& whole)
{
    constexpr auto Premultiplied = QImage::Format_RGBA8888_Premultiplied;
    QImage together(whole.size(), Premultiplied);
    together.fill(Qt::transparent);
    QPainter painter(&together);
    for (const DrawnLayer& layer : layers)
        painter.drawImage(0, 0, layer.pixels);
    painter.end();
    const QImage expected = whole.convertToFormat(Premultiplied);
    const int rounding = 2 + layers.size(); // of 255, each time that something is painted over
    for (int y = 0; y < whole.height(); ++y)
    {
        const uchar* a = together.constScanLine(y);
        const uchar* b = expected.constScanLine(y);
        for (int i = 0; i < 4 * whole.width(); ++i)
        {
            if (std::abs(a[i] - b[i]) > rounding)
                return false;
        }
    }
    return true;
}

} // namespace lampblack
