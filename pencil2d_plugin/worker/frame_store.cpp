#include "worker/frame_store.h"

#include "protocol/planes.h"

#include <QMetaObject>

namespace lampblack
{

namespace
{

int kibibytes(const Drawing& drawing)
{
    qint64 bytes = drawing.pixels.sizeInBytes();
    for (const DrawnLayer& layer : drawing.layers)
    {
        bytes += layer.pixels.sizeInBytes();
    }
    return static_cast<int>(bytes / 1024) + 1;
}

void makeStraight(QImage& image)
{
    image = image.convertToFormat(QImage::Format_RGBA8888);
}

QByteArray digestOf(const Drawing& drawing)
{
    QVector<protocol::PlaneView> planes = {protocol::viewOf(protocol::Role::Pixels, drawing.pixels)};
    QStringList names;
    for (const DrawnLayer& layer : drawing.layers)
    {
        planes.append(protocol::viewOf(protocol::Role::Layer, layer.pixels));
        names.append(layer.name);
    }
    return protocol::frameDigest(planes, names);
}

} // namespace

FrameStore::FrameStore(qint64 bytesKept, QObject* parent)
    : QObject(parent), mDrawings(static_cast<int>(bytesKept / 1024))
{
    mHashThread.setMaxThreadCount(1); // keeps the order
}

FrameStore::~FrameStore()
{
    mHashThread.clear();
    mHashThread.waitForDone();
}

quint64 FrameStore::put(int frame, const Drawing& drawing, const QTransform& camera)
{
    const quint64 number = ++mLastPut;
    mPendingPuts.insert(number, frame);
    mNewestPuts.insert(frame, number);
    mHashThread.start(
        [this, number, frame, drawing, camera]
        {
            Drawing straight = drawing;
            makeStraight(straight.pixels);
            for (DrawnLayer& layer : straight.layers)
            {
                makeStraight(layer.pixels);
            }
            const QByteArray digest = digestOf(straight);
            QMetaObject::invokeMethod(
                this,
                [this, number, frame, straight, camera, digest]
                { onHashed(number, frame, straight, camera, digest); },
                Qt::QueuedConnection);
        });
    return number;
}

void FrameStore::drop(int frame)
{
    mNewestPuts.remove(frame);
    mFrames.remove(frame);
}

void FrameStore::clear()
{
    mNewestPuts.clear();
    mFrames.clear();
    mDrawings.clear();
}

Drawing FrameStore::drawing(const QByteArray& digest)
{
    const Drawing* found = mDrawings.object(digest);
    return found == nullptr ? Drawing() : *found;
}

bool FrameStore::isHashed(quint64 number) const
{
    return mPendingPuts.isEmpty() || mPendingPuts.firstKey() > number;
}

void FrameStore::onHashed(quint64 number, int frame, const Drawing& drawing, const QTransform& camera,
                          const QByteArray& digest)
{
    mPendingPuts.remove(number);
    const bool superseded = mNewestPuts.value(frame) != number;
    if (!superseded)
    {
        mNewestPuts.remove(frame);
        mDrawings.insert(digest, new Drawing(drawing), kibibytes(drawing));
    }
    const ShownFrame before = mFrames.value(frame);
    const bool changed = !superseded && (before.digest != digest || before.camera != camera);
    if (changed)
    {
        mFrames.insert(frame, {digest, camera, ++mLastDrawing});
    }
    Q_EMIT frameHashed(frame, changed);
}

} // namespace lampblack
