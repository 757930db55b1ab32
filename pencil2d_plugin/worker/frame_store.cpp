#include "worker/frame_store.h"

#include "protocol/planes.h"

#include <QMetaObject>

namespace lampblack
{

namespace
{

int kibibytes(const QImage& image)
{
    return static_cast<int>(image.sizeInBytes() / 1024) + 1;
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

quint64 FrameStore::put(int frame, const QImage& pixels, const QTransform& camera)
{
    const quint64 number = ++mLastPut;
    mPendingPuts.insert(number, frame);
    mNewestPuts.insert(frame, number);
    mHashThread.start(
        [this, number, frame, pixels, camera]
        {
            const QImage straight = pixels.convertToFormat(QImage::Format_RGBA8888);
            const QByteArray digest = protocol::frameDigest(straight);
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

QImage FrameStore::drawing(const QByteArray& digest)
{
    const QImage* found = mDrawings.object(digest);
    return found == nullptr ? QImage() : *found;
}

bool FrameStore::isHashed(quint64 number) const
{
    return mPendingPuts.isEmpty() || mPendingPuts.firstKey() > number;
}

void FrameStore::onHashed(quint64 number, int frame, const QImage& pixels, const QTransform& camera,
                          const QByteArray& digest)
{
    mPendingPuts.remove(number);
    const bool superseded = mNewestPuts.value(frame) != number;
    if (!superseded)
    {
        mNewestPuts.remove(frame);
        mDrawings.insert(digest, new QImage(pixels), kibibytes(pixels));
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
