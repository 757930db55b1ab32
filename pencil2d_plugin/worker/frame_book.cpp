#include "worker/frame_book.h"

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

FrameBook::FrameBook(qint64 bytesKept, QObject* parent)
    : QObject(parent), mDrawings(static_cast<int>(bytesKept / 1024))
{
    mHashing.setMaxThreadCount(1); // in order, and one core is enough
}

FrameBook::~FrameBook()
{
    mHashing.clear();
    mHashing.waitForDone();
}

quint64 FrameBook::put(int frame, const QImage& pixels, const QTransform& camera)
{
    const quint64 number = ++mLastPut;
    mPending.insert(number, frame);
    mNewest.insert(frame, number);
    mHashing.start(
        [this, number, frame, pixels, camera]
        {
            const QImage straight = pixels.convertToFormat(QImage::Format_RGBA8888);
            const QByteArray digest = protocol::frameDigest(straight);
            QMetaObject::invokeMethod(
                this,
                [this, number, frame, straight, camera, digest]
                { settle(number, frame, straight, camera, digest); },
                Qt::QueuedConnection);
        });
    return number;
}

void FrameBook::drop(int frame)
{
    mNewest.remove(frame);
    mFrames.remove(frame);
}

void FrameBook::clear()
{
    mNewest.clear();
    mFrames.clear();
    mDrawings.clear();
}

QImage FrameBook::drawing(const QByteArray& digest)
{
    const QImage* found = mDrawings.object(digest);
    return found == nullptr ? QImage() : *found;
}

bool FrameBook::isSettled(quint64 number) const
{
    return mPending.isEmpty() || mPending.firstKey() > number;
}

void FrameBook::settle(quint64 number, int frame, const QImage& pixels, const QTransform& camera,
                       const QByteArray& digest)
{
    mPending.remove(number);
    const bool superseded = mNewest.value(frame) != number;
    if (!superseded)
    {
        mNewest.remove(frame);
        mDrawings.insert(digest, new QImage(pixels), kibibytes(pixels));
    }
    const ShownFrame before = mFrames.value(frame);
    const bool changed = !superseded && (before.digest != digest || before.camera != camera);
    if (changed)
    {
        mFrames.insert(frame, {digest, camera, ++mLastDrawing});
    }
    Q_EMIT shown(frame, changed);
}

} // namespace lampblack
