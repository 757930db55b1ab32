// What each frame shows, and the drawings themselves as far as memory goes.
#pragma once

#include <QCache>
#include <QHash>
#include <QImage>
#include <QMap>
#include <QObject>
#include <QThreadPool>
#include <QTransform>

namespace lampblack
{

/// A drawing as a frame shows it.
struct ShownFrame
{
    QByteArray digest;   ///< 40 lower-case hexadecimal digits
    QTransform camera;   ///< canvas to view
    quint64 drawing = 0; ///< rises with every drawing that any frame comes to show
};

/// Of one thread. Digests are taken in another; shown() tells when a frame's is known.
class FrameBook : public QObject
{
    Q_OBJECT

public:
    explicit FrameBook(qint64 bytesKept = 512LL << 20, QObject* parent = nullptr);
    ~FrameBook() override;

    /// Returns the number of this call, for isSettled(). Until its digest is known the frame shows what it
    /// did.
    quint64 put(int frame, const QImage& pixels, const QTransform& camera);
    void drop(int frame);
    void clear();

    const QMap<int, ShownFrame>& frames() const { return mFrames; }
    /// Null if the drawing was never put, or let go: those least lately used go first.
    QImage drawing(const QByteArray& digest);

    quint64 lastPut() const { return mLastPut; }
    /// Whether all that was put up to call `number` has its digest.
    bool isSettled(quint64 number) const;

Q_SIGNALS:
    /// The digest of what was put is known; `changed` if the frame showed something else before.
    void shown(int frame, bool changed);

private:
    void settle(quint64 number, int frame, const QImage& pixels, const QTransform& camera,
                const QByteArray& digest);

    QMap<int, ShownFrame> mFrames;
    QMap<quint64, int> mPending; ///< frame by number of call
    QHash<int, quint64> mNewest; ///< number of call by frame
    QCache<QByteArray, QImage> mDrawings;
    quint64 mLastPut = 0;
    quint64 mLastDrawing = 0;
    QThreadPool mHashing;
};

} // namespace lampblack
